//! The exact response of [`LANES`] modes side by side over any interval: a short series, doubled as often as needed.
//!
//! [`super::propagator`] does the same mode by mode, with more care for each: for intervals that are prepared once. Here
//! a mode takes some 50 instructions, for flights of a length that no other flight has.

use super::lanes::{LANES, Lane};
use super::motion::LinearGround;
use super::propagator::ModeIncrement;
use crate::numerics::polynomial::each;

/// Largest (rate) x (time) over which the series is summed.
const SERIES_ANGLE: f64 = 0.5;

/// Terms of the series of the response to a sloped load, from t^3 on: the last is below 1e-18 of the first.
const TERMS: usize = 12;

/// Doublings that cost less than a closed form, and lose less than a digit.
const MOST_DOUBLINGS: i32 = 7;

/// 1 / ((n + 1) (n + 2)) for n from 2 on, and (n + 2).
static FACTORS: [[f64; 2]; TERMS] = {
    let mut table = [[0.0; 2]; TERMS];
    let mut i = 0;
    while i < TERMS {
        let n = (i + 2) as f64;
        table[i] = [1.0 / ((n + 1.0) * (n + 2.0)), n + 2.0];
        i += 1;
    }
    table
};

/// The increments of [`LANES`] modes side by side.
#[derive(Clone, Copy, Debug, Default)]
pub struct ModeIncrements {
    dqq: Lane,
    dqv: Lane,
    dvq: Lane,
    dvv: Lane,
    rq0: Lane,
    rq1: Lane,
    rv0: Lane,
    rv1: Lane,
}

impl ModeIncrements {
    /// Enters one of the modes.
    pub fn set(&mut self, i: usize, mode: &ModeIncrement) {
        self.dqq[i] = mode.dqq;
        self.dqv[i] = mode.dqv;
        self.dvq[i] = mode.dvq;
        self.dvv[i] = mode.dvv;
        self.rq0[i] = mode.rq0;
        self.rq1[i] = mode.rq1;
        self.rv0[i] = mode.rv0;
        self.rv1[i] = mode.rv1;
    }

    /// q and v at the end, from q, v and the load and its slope at the start.
    #[inline(always)]
    pub fn end(
        &self,
        q: &[f64; LANES],
        v: &[f64; LANES],
        load: &[f64; LANES],
        slope: &[f64; LANES],
    ) -> ([f64; LANES], [f64; LANES]) {
        let pushed = each(|i| self.rq0[i] * load[i] + self.rq1[i] * slope[i]);
        let end_q = each(|i| q[i] + (self.dqq[i] * q[i] + self.dqv[i] * v[i] + pushed[i]));
        let pushed = each(|i| self.rv0[i] * load[i] + self.rv1[i] * slope[i]);
        let end_v = each(|i| v[i] + (self.dvq[i] * q[i] + self.dvv[i] * v[i] + pushed[i]));
        (end_q, end_v)
    }

    /// The same under the ground's acceleration and its slope alone.
    #[inline(always)]
    pub fn end_on_ground(
        &self,
        (q, v): (&Lane, &Lane),
        participation: &Lane,
        LinearGround { acceleration, slope }: LinearGround,
    ) -> (Lane, Lane) {
        let (pull, rate) = (-acceleration, -slope);
        self.end(q, v, &participation.map(|p| p * pull), &participation.map(|p| p * rate))
    }
}

/// How often an interval is halved for a block of modes whose quickest rate times the interval is `angle`; `None` where
/// that would be too often.
pub(super) fn halvings(angle: f64) -> Option<i32> {
    (0..=MOST_DOUBLINGS).find(|halvings| libm::ldexp(angle, -halvings) <= SERIES_ANGLE)
}

/// The increments of modes of squared frequencies w^2, 1/s2, and damping, 1/s, over an interval of `h` seconds that is
/// halved so many times.
#[inline(always)]
pub(super) fn increments((omega2, damping): (&Lane, &Lane), h: f64, halvings: i32) -> ModeIncrements {
    let mut short = h;
    for _ in 0..halvings {
        short *= 0.5;
    }
    let mut increments = series((omega2, damping), short);
    for _ in 0..halvings {
        increments = twice(&increments, short);
        short *= 2.0;
    }
    increments
}

/// From the response y to a load t, y'' + c y' + w^2 y = t: with its rate the response to a constant load, all others
/// follow. y'' is that to an impulse.
#[inline(always)]
fn series((omega2, damping): (&Lane, &Lane), h: f64) -> ModeIncrements {
    let (c, k) = (each(|i| damping[i] * h), each(|i| omega2[i] * h * h));
    let (mut before, mut last) = ([0.0; LANES], [1.0 / 6.0; LANES]);
    let (mut value, mut slope) = (last, [0.5; LANES]);
    let mut terms = [[0.0; LANES]; TERMS];
    // By numbers: iterators would copy the table.
    for n in 0..TERMS {
        let [reciprocal, count] = [FACTORS[n][0], FACTORS[n][1] - 1.0];
        for i in 0..LANES {
            terms[n][i] = -(count * c[i] * last[i] + k[i] * before[i]) * reciprocal;
        }
        (before, last) = (last, terms[n]);
    }
    let (mut small, mut steep) = ([0.0; LANES], [0.0; LANES]);
    for n in (0..TERMS).rev() {
        let power = FACTORS[n][1];
        for i in 0..LANES {
            small[i] += terms[n][i];
            steep[i] += power * terms[n][i];
        }
    }
    (value, slope) = (each(|i| value[i] + small[i]), each(|i| slope[i] + steep[i]));
    // Responses to a sloped and to a constant load, to a velocity and to a displacement, in units of h.
    let (rq1, rq0) = (value, slope);
    let dqv = each(|i| 1.0 - (c[i] * rq0[i] + k[i] * rq1[i]));
    let dvv = each(|i| -(c[i] * dqv[i] + k[i] * rq0[i]));
    let (h2, rate) = (h * h, 1.0 / h);
    ModeIncrements {
        dqq: each(|i| -(k[i] * rq0[i])),
        dqv: dqv.map(|x| x * h),
        dvq: each(|i| -(k[i] * dqv[i]) * rate),
        dvv,
        rq0: rq0.map(|x| x * h2),
        rq1: rq1.map(|x| x * (h2 * h)),
        rv0: dqv.map(|x| x * h),
        rv1: rq0.map(|x| x * h2),
    }
}

/// The increments over twice the interval `h`, see [`super::ModeIncrement`].
#[inline(always)]
fn twice(of: &ModeIncrements, h: f64) -> ModeIncrements {
    let ModeIncrements { dqq, dqv, dvq, dvv, rq0, rq1, rv0, rv1 } = of;
    ModeIncrements {
        dqq: each(|i| 2.0 * dqq[i] + (dqq[i] * dqq[i] + dqv[i] * dvq[i])),
        dqv: each(|i| 2.0 * dqv[i] + (dqq[i] * dqv[i] + dqv[i] * dvv[i])),
        dvq: each(|i| 2.0 * dvq[i] + (dvq[i] * dqq[i] + dvv[i] * dvq[i])),
        dvv: each(|i| 2.0 * dvv[i] + (dvq[i] * dqv[i] + dvv[i] * dvv[i])),
        rq0: each(|i| 2.0 * rq0[i] + (dqq[i] * rq0[i] + dqv[i] * rv0[i])),
        rq1: each(|i| 2.0 * rq1[i] + (dqq[i] * rq1[i] + dqv[i] * rv1[i]) + h * rq0[i]),
        rv0: each(|i| 2.0 * rv0[i] + (dvq[i] * rq0[i] + dvv[i] * rv0[i])),
        rv1: each(|i| 2.0 * rv1[i] + (dvq[i] * rq1[i] + dvv[i] * rv1[i]) + h * rv0[i]),
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    /// Against the closed form or the longer series of [`ModeIncrement`], from resting to heavily damped modes.
    #[test]
    fn a_block_moves_like_its_modes() {
        let modes = [(0.0, 0.0), (3.0, 0.1), (40.0, 12.0), (400.0, 1300.0), (400.0, 40.0), (1e-3, 1e-6), (90.0, 180.0)];
        for h in [1e-9, 1e-4, 3.3e-3, 0.01, 0.04] {
            for four in modes.windows(LANES) {
                let (omega2, damping) = (each(|i| four[i].0 * four[i].0), each(|i| four[i].1));
                let angle = four.iter().fold(0.0, |most: f64, (w, c)| most.max(*w).max(*c)) * h;
                let got = increments((&omega2, &damping), h, halvings(angle).unwrap());
                for (i, (w, c)) in four.iter().enumerate() {
                    let exact = ModeIncrement::new(*w, *c, h);
                    let near = |got: f64, exact: f64, unit: f64| {
                        let allowed = 4e-15 * unit;
                        assert!((got - exact).abs() <= allowed, "{w} {c} over {h}: {got} instead of {exact}");
                    };
                    // Relative to the change itself, as far as oscillations have not brought it back.
                    let (w, size) = (*w, |x: f64| x.min(1.0));
                    near(got.dqq[i], exact.dqq, size((w * h) * (w * h)));
                    near(got.dqv[i], exact.dqv, h);
                    near(got.dvq[i], exact.dvq, w * w * h);
                    near(got.dvv[i], exact.dvv, size(*c * h + (w * h) * (w * h)));
                    near(got.rq0[i], exact.rq0, h * h);
                    near(got.rq1[i], exact.rq1, h * h * h);
                    near(got.rv0[i], exact.rv0, h);
                    near(got.rv1[i], exact.rv1, h * h);
                }
            }
        }
    }

    #[test]
    fn long_intervals_are_left_to_closed_forms() {
        assert_eq!([0.0, 0.5, 0.51, 60.0].map(halvings), [Some(0), Some(0), Some(1), Some(7)]);
        assert_eq!([65.0, f64::INFINITY, f64::NAN].map(halvings), [None; 3]);
    }
}
