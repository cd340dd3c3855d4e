//! The variable of a step's power series: time, or one in which the motion is smoother.
//!
//! A power law's force has a root of the time since the entry behind it, or of the time until the release before it, and
//! no series in time gets further than to there. In the root itself the motion is analytic there: with
//!
//! ```text
//! t = x + x^2 / (4 a),    1 + t/a = (1 + x / (2 a))^2
//! ```
//!
//! the entry a time a ago is no singularity in x, nor, with a < 0, is the release after a time of -a. The terms of a
//! series in x follow from those in t without any more of the motion: the first n in x from the first n in t.

use crate::polynomial::ROOM;

/// Lanes that are worked on together.
const LANES: usize = 4;

/// Time, in units of a series' scale, as a function of x: t = x + bend x^2.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Clock {
    /// 1 over four times the time since an entry, or minus that until a release; 0 where x is the time.
    pub bend: f64,
}

/// Of term m - j of a series in time, for its term m in x.
type Weights = [f64; ROOM / 2 + 1];

/// (m - j) over j.
const BINOMIAL: [Weights; ROOM] = {
    let mut table = [[0.0; ROOM / 2 + 1]; ROOM];
    let mut m = 0;
    while m < ROOM {
        table[m][0] = 1.0;
        let mut j = 1;
        while 2 * j <= m {
            table[m][j] = table[m][j - 1] * ((m - 2 * j + 2) * (m - 2 * j + 1)) as f64 / ((m - j + 1) * j) as f64;
            j += 1;
        }
        m += 1;
    }
    table
};

impl Clock {
    /// Whether x is not the time.
    pub fn is_bent(&self) -> bool {
        self.bend != 0.0
    }

    /// The time at x.
    pub fn time(&self, x: f64) -> f64 {
        x + self.bend * x * x
    }

    /// dt/dx at x.
    pub fn rate(&self, x: f64) -> f64 {
        1.0 + 2.0 * self.bend * x
    }

    /// x at a time; where the clock does not reach it, one beyond all that it reaches.
    pub fn place(&self, time: f64) -> f64 {
        2.0 * time / (1.0 + (1.0 + 4.0 * self.bend * time).max(0.0).sqrt())
    }
}

/// What makes of the terms of a series in time those in the x of a clock.
#[derive(Clone, Debug)]
pub struct Bend {
    weights: [Weights; ROOM],
}

impl Default for Bend {
    fn default() -> Bend {
        Bend { weights: [[0.0; ROOM / 2 + 1]; ROOM] }
    }
}

impl Bend {
    /// For a clock and series of so many terms or less.
    pub fn set(&mut self, clock: &Clock, terms: usize) {
        let mut powers = [1.0; ROOM / 2 + 1];
        for j in 1..powers.len() {
            powers[j] = powers[j - 1] * clock.bend;
        }
        for (m, (weights, binomials)) in self.weights.iter_mut().zip(&BINOMIAL).enumerate().take(terms) {
            let entries = weights.iter_mut().zip(binomials).zip(&powers).take(m / 2 + 1);
            entries.for_each(|((weight, binomial), power)| *weight = binomial * power);
        }
    }

    /// Changes the terms of some series, `lanes` of them side by side.
    pub fn apply(&self, terms: &mut [f64], lanes: usize) {
        bend_terms(terms.as_chunks_mut::<LANES>().0, lanes / LANES, &self.weights);
    }

    /// The same for two series of [`LANES`] lanes each, with no more than so many terms.
    pub fn apply_to_both(&self, terms: [&mut [[f64; LANES]; ROOM]; 2], count: usize) {
        bend_both(terms, &self.weights, count);
    }
}

/// See [`Bend::apply_to_both`]. Wide instructions give the same bits.
#[multiversion::multiversion(targets("x86_64+avx2"))]
fn bend_both(terms: [&mut [[f64; LANES]; ROOM]; 2], weights: &[Weights; ROOM], count: usize) {
    let [first, second] = terms;
    for m in (2..count.min(ROOM)).rev() {
        let (mut sum, mut other) = (first[m], second[m]);
        for j in 1..=m / 2 {
            let weight = weights[m][j];
            for i in 0..LANES {
                sum[i] += weight * first[m - j][i];
                other[i] += weight * second[m - j][i];
            }
        }
        (first[m], second[m]) = (sum, other);
    }
}

/// See [`Bend::apply`]. Wide instructions give the same bits.
#[multiversion::multiversion(targets("x86_64+avx2"))]
fn bend_terms(terms: &mut [[f64; LANES]], width: usize, weights: &[Weights]) {
    let mut first = 0;
    while first < width {
        first += match width - first {
            1 => bend_blocks::<1>(terms, (first, width), weights),
            2 => bend_blocks::<2>(terms, (first, width), weights),
            3 => bend_blocks::<3>(terms, (first, width), weights),
            5 => bend_blocks::<5>(terms, (first, width), weights),
            4 => bend_blocks::<4>(terms, (first, width), weights),
            6 => bend_blocks::<6>(terms, (first, width), weights),
            7 => bend_blocks::<7>(terms, (first, width), weights),
            _ => bend_blocks::<8>(terms, (first, width), weights),
        };
    }
}

/// The same for `N` blocks of lanes, from the `first` of each row on; returns how many that are.
#[inline(always)]
fn bend_blocks<const N: usize>(
    terms: &mut [[f64; LANES]],
    (first, width): (usize, usize),
    weights: &[Weights],
) -> usize {
    for (m, weights) in weights[..terms.len() / width].iter().enumerate().skip(2).rev() {
        let (known, own) = terms.split_at_mut(m * width);
        let own = &mut own[first..first + N];
        let mut sum = [[0.0; LANES]; N];
        sum.copy_from_slice(own);
        for (row, weight) in known.chunks_exact(width).rev().zip(&weights[1..=m / 2]) {
            let row = &row[first..first + N];
            for c in 0..N {
                for i in 0..LANES {
                    sum[c][i] += weight * row[c][i];
                }
            }
        }
        own.copy_from_slice(&sum);
    }
    N
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::polynomial::value_and_slope;

    #[test]
    fn places_and_rates_belong_to_the_time() {
        for clock in [0.0, 0.25, -0.2].map(|bend| Clock { bend }) {
            for x in [0.0, 0.1, 0.5, 1.5] {
                let (t, h) = (clock.time(x), 1e-6);
                assert!((clock.place(t) - x).abs() <= 1e-15, "{clock:?}: {x}");
                let slope = (clock.time(x + h) - clock.time(x - h)) / (2.0 * h);
                assert!((clock.rate(x) - slope).abs() < 1e-9, "{clock:?}: {} and {slope} at {x}", clock.rate(x));
            }
        }
        let plain = Clock::default();
        assert_eq!([plain.time(0.7), plain.place(0.7), plain.rate(0.7)], [0.7, 0.7, 1.0]);
        let past = Clock { bend: -0.25 };
        assert!(past.place(1.1) > past.place(1.0), "a clock that goes until 1");
    }

    /// (1 + t)^3.5 has no series in t beyond 1, but one in the root of 1 + t, and there it ends with the seventh power.
    #[test]
    fn a_root_becomes_a_polynomial() {
        const LENGTH: usize = 24;
        let mut terms = [0.0; LENGTH * LANES];
        let (mut term, scale) = (1.0, [1.0, 2.0, -1.0, 0.5]);
        for n in 0..LENGTH {
            for i in 0..LANES {
                terms[n * LANES + i] = term * scale[i];
            }
            term *= (3.5 - n as f64) / (n + 1) as f64;
        }
        let clock = Clock { bend: 0.25 };
        let mut bend = Bend::default();
        bend.set(&clock, LENGTH);
        bend.apply(&mut terms, LANES);
        for i in 0..LANES {
            let terms: Vec<f64> = terms.chunks_exact(LANES).map(|row| row[i]).collect();
            for x in [0.5, 2.0, 4.0] {
                let exact = scale[i] * libm::pow(1.0 + clock.time(x), 3.5);
                let value = value_and_slope(&terms[..8], x).0;
                assert!((value - exact).abs() < 1e-12 * exact.abs(), "{value} instead of {exact} at {x}");
            }
            assert!(terms[8..].iter().all(|term| term.abs() < 1e-11), "{terms:?}");
        }
    }
}
