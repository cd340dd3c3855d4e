//! Conservative advancement of one row over the modes, of a pair or of a storey: for how many segments it stays below its
//! limit, by the bounds of `flight/broad_phase.rs`.

use crate::engine::base::Base;
use crate::engine::base::clearance::MOST;
use crate::engine::excitation::record::Ahead;
use crate::numerics::polynomial::each;
use crate::structure::{LANES, Lane};

/// Numbers of segments for which a pair is tested, four at a time.
pub const TRIED: [[u64; LANES]; 3] = [[1, 2, 3, 4], [6, 8, 12, 16], [24, 32, 48, MOST]];

/// Margin for rounding, relative to the terms of a penetration or closing velocity.
pub const MARGIN: f64 = 1e-10;

/// Coefficients of [`LANES`] modes, side by side.
#[derive(Clone, Copy, Debug, Default)]
pub struct BoundedModes {
    /// Natural frequency w, rad/s.
    pub omega: Lane,
    /// w + c, 1/s.
    pub quickness: Lane,
    /// k, 1/s2; infinite where damping couples the mode to others.
    pub bend: Lane,
    /// Damping c, 1/s.
    pub damping: Lane,
    /// w^2, 1/s2.
    pub omega2: Lane,
    /// Largest |row| entry over all pairs, kg^-1/2.
    pub weight: Lane,
}

/// Increase of a pair's bounds per unit of cumulative absolute velocity, 1 m/s.
#[derive(Clone, Copy, Debug)]
pub struct Growth {
    /// The sums over modes, with |participation| in place of e.
    pub sums: Sums,
    /// Increase of the relative acceleration by dashpots, m/s2: sum over modes of |row| c |participation|.
    pub dragged: f64,
    /// Increase of the closing velocity by the ground itself, |W|.
    pub shaken: f64,
}

/// Sums over modes of |row| e, m/s, of |row| (w + c) e, m/s2, and of |row| k e, m/s3.
#[derive(Clone, Copy, Debug)]
pub struct Sums {
    /// Of |row| e, m/s.
    pub speed: f64,
    /// Of |row| (w + c) e, m/s2.
    pub change: f64,
    /// Of |row| k e, m/s3.
    pub bend: f64,
}

/// At the ends of some numbers of segments: time from the base, s, and integral of |ground acceleration|, m/s.
#[derive(Clone, Copy, Default)]
pub struct Ends {
    pub time: Lane,
    pub cumulative: Lane,
}

impl Ends {
    /// Sets the ends of some numbers of segments, counted from the base.
    #[inline(always)]
    pub fn set(&mut self, ahead: &Ahead, elapsed: f64, segments: &[u64; LANES]) {
        for (i, segments) in segments.iter().enumerate() {
            let (time, cumulative) = ahead.over(*segments);
            self.time[i] = (1.0 + MARGIN) * (time - elapsed);
            self.cumulative[i] = cumulative;
        }
    }
}

/// Terms of one pair's bounds.
pub struct Closing<'a> {
    /// Penetration at the base, m, and its rate, m/s.
    pub start: f64,
    pub rate: f64,
    /// Relative acceleration by springs and dashpots at the base, m/s2.
    pub pull: f64,
    /// Sums over modes with the present amplitudes.
    pub sums: Sums,
    /// Their increase per unit of cumulative absolute velocity.
    pub growth: &'a Growth,
}

impl Closing<'_> {
    /// The largest of the tested numbers of segments for which the pair stays apart; 0 if it does for none.
    #[inline(always)]
    pub fn longest(&self, ends: &[Ends; TRIED.len()]) -> u64 {
        let mut free = 0;
        for (segments, ends) in TRIED.iter().zip(ends) {
            let nearest = nearest(self, ends);
            for i in 0..LANES {
                free = if nearest[i] < 0.0 { segments[i] } else { free };
            }
            if free < segments[LANES - 1] {
                break;
            }
        }
        free
    }
}

/// The least of the three upper bounds on a penetration up to some ends, m: where it is below 0 the pair stays apart. A
/// NaN of the cubic bound is ignored, one of the others is returned.
#[multiversion::multiversion(targets("x86_64+avx2"))]
fn nearest(closing: &Closing, Ends { time, cumulative }: &Ends) -> Lane {
    let &Closing { start, rate, pull, ref sums, growth: &Growth { sums: ref growth, dragged, shaken } } = closing;
    let (smaller, larger) = (|a: f64, b: f64| if a < b { a } else { b }, |a: f64, b: f64| if a > b { a } else { b });
    let mut nearest = [0.0; LANES];
    for i in 0..LANES {
        let (time, cumulative) = (time[i], cumulative[i]);
        let speed = sums.speed + growth.speed * cumulative;
        let change = sums.change + growth.change * cumulative;
        let bend = sums.bend + growth.bend * cumulative;
        let rate = rate + shaken * cumulative + MARGIN * speed;
        let (line, parabola) = (start + time * speed, start + time * (rate + 0.5 * time * change));
        let (first, second) = (time * rate, 0.5 * time * time * (pull + cumulative * dragged));
        let end = start + (first + second + time * time * time * (bend * (1.0 / 6.0)));
        let inner = [3.0 * start + first, 3.0 * start + 2.0 * first + second];
        // The end as the last operand: it is NaN where anything before it is.
        let last = end + 0.0 * (inner[0] + inner[1]);
        let cubic = larger(larger(larger(start, inner[0]), inner[1]), last);
        nearest[i] = smaller(cubic, smaller(line, parabola));
    }
    nearest
}

/// For one pair, the sums over modes in its bounds, and its motion at the base.
#[inline(always)]
pub fn bound_one(modes: &[BoundedModes], base: &Base, row: &[f64], amplitude: &[f64]) -> Seen {
    let [row, amplitude, q, v] = [row, amplitude, &base.q, &base.v].map(|all| all.as_chunks::<LANES>().0);
    // Equal lengths: no bounds checks below.
    let count = modes.len();
    let (row, amplitude, q, v) = (&row[..count], &amplitude[..count], &q[..count], &v[..count]);
    let (mut speed, mut change, mut bend) = ([0.0; LANES], [0.0; LANES], [0.0; LANES]);
    let (mut pull, mut moved, mut rate) = ([0.0; LANES], [0.0; LANES], [0.0; LANES]);
    for c in 0..count {
        let (mode, row, q, v) = (&modes[c], &row[c], &q[c], &v[c]);
        let part = each(|i| row[i].abs() * amplitude[c][i]);
        speed = each(|i| speed[i] + part[i]);
        change = each(|i| change[i] + mode.quickness[i] * part[i]);
        bend = each(|i| bend[i] + mode.bend[i] * part[i]);
        pull = each(|i| pull[i] - row[i] * (mode.damping[i] * v[i] + mode.omega2[i] * q[i]));
        moved = each(|i| moved[i] + row[i] * q[i]);
        rate = each(|i| rate[i] + row[i] * v[i]);
    }
    let [speed, change, bend, pull, moved, rate] = totals(&[speed, change, bend, pull, moved, rate]);
    Seen { bounds: Sums { speed, change, bend }, pull, moved, rate }
}

/// Sums over lanes, from left to right. Not inlined: otherwise compilers transpose every block of modes in order to add
/// up the same lane of several sums side by side.
#[inline(never)]
fn totals(sums: &[Lane; 6]) -> [f64; 6] {
    let mut totals = [0.0; 6];
    for (total, [a, b, c, d]) in totals.iter_mut().zip(sums) {
        *total = ((a + b) + c) + d;
    }
    totals
}

/// Result of `bound_one`.
pub struct Seen {
    pub bounds: Sums,
    /// Relative acceleration by springs and dashpots, m/s2, where damping couples no modes.
    pub pull: f64,
    /// Displacement of the left face relative to the right one, m, and its rate, m/s: positive when they approach.
    pub moved: f64,
    pub rate: f64,
}

impl Sums {
    pub fn of(row: &[f64], amplitude: &[f64], quickness: &[f64], bends: &[f64]) -> Sums {
        let (mut speed, mut change, mut bend) = (0.0, 0.0, 0.0);
        for (((row, amplitude), quickness), own_bend) in row.iter().zip(amplitude).zip(quickness).zip(bends) {
            let part = row.abs() * amplitude;
            speed += part;
            change += quickness * part;
            bend += own_bend * part;
        }
        Sums { speed, change, bend }
    }
}
