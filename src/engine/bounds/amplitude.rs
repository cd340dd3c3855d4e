//! What the modes can gain from the ground in a time, and how far a row can get with that: conservative advancement
//! \[Mirtich1996\] with bounds of structural dynamics.
//!
//! Apart from contact, the amplitude e = sqrt(q'^2 + w^2 q^2) of each mode grows at most by A = |participation| x the
//! integral of |ground acceleration|, as damping only reduces it. Without the ground's part |q''| <= (w + c) e. The
//! ground moves the row's own quantity by its acceleration times W, the row's share of the ground: 0 between two
//! floors, not so at a wall, in the lowest storey and where the ground has a part of a column. With S, the integral of
//! |ground acceleration|, and the present e, after a time t
//!
//! ```text
//! y <= y now + t sum over modes of |row| (e + A)                                           velocity
//! y <= y now + t (y' now + |W| S + t/2 sum over modes of |row| (w + c) (e + A))            acceleration
//! ```
//!
//! The first bound never falls with t and the second is convex: if it is below a limit at the end of an interval, it
//! was below it throughout. Where damping couples no modes, the row's acceleration by springs and dashpots, a = -row (c
//! v + w^2 q), changes at a rate |a'| <= sum of |row| (k (e + A) + c |participation| |ground acceleration|) with k^2 =
//! (w^2 + c^2)^2 + c^2 w^2. This gives
//!
//! ```text
//! y <= y now + t (y' now + |W| S) + t^2/2 (a now + S sum of |row| c |participation|)
//!      + t^3/6 sum over modes of |row| k (e + A)                                           jerk
//! ```
//!
//! a cubic in t, which is bounded by its Bernstein coefficients. And however long it takes, of many rows with a limit L
//! each none gets beyond the share sum over modes of (largest |row| / (w L)) (e + A) of it: [`Together`].

use crate::engine::excitation::record::Ahead;
use crate::engine::quantities::flight_row::FlightRow;
use crate::numerics::polynomial::each;
use crate::structure::{LANES, Lane, LinearLoad, Motion, Structure, from_left_to_right};
use std::ops::Range;

/// Largest number of segments for which a row is looked ahead.
pub const MOST: u64 = 64;

/// Numbers of segments for which a row is tested, four at a time.
pub const TRIED: [[u64; LANES]; 3] = [[1, 2, 3, 4], [6, 8, 12, 16], [24, 32, 48, MOST]];

/// Margin for rounding, relative to the terms of a quantity or its rate.
pub const MARGIN: f64 = 1e-10;

/// sqrt(2) - 1, rounded up: sqrt(a^2 + b^2) <= a + this b for a >= b >= 0.
const CHORD: f64 = 0.414_213_562_4;

/// How fast the modes can change; constant during a run.
#[derive(Debug)]
pub struct ModeRates {
    /// The modes of all buildings, in blocks.
    blocks: Vec<BlockRates>,
    /// What each mode's amplitude gains at most per unit of cumulative absolute velocity (integral of |ground
    /// acceleration|), kg^1/2: |participation|, where damping couples modes that of all together.
    pub gains: Vec<f64>,
    /// Ranges of the modes of bodies in which damping couples modes.
    coupled: Vec<Range<usize>>,
    /// Whether oscillators move in flights: then quantities have rows over rates, too.
    oscillates: bool,
}

/// Rates of [`LANES`] modes, side by side.
#[derive(Clone, Copy, Debug, Default)]
struct BlockRates {
    /// Natural frequency w, rad/s.
    omega: Lane,
    /// w + c, 1/s.
    quickness: Lane,
    /// k, 1/s2; infinite where damping couples the mode to others.
    jerk: Lane,
    /// Damping c, 1/s.
    damping: Lane,
    /// w^2, 1/s2.
    omega2: Lane,
    /// Largest |row| entry over all rows, kg^-1/2.
    weight: Lane,
}

/// Sums over modes of |row| times a bound on a derivative of the mode.
#[derive(Clone, Copy, Debug, Default)]
pub struct Sums {
    /// Of |row| e, m/s.
    pub velocity: f64,
    /// Of |row| (w + c) e, m/s2.
    pub acceleration: f64,
    /// Of |row| k e, m/s3.
    pub jerk: f64,
}

/// Increase of a row's bounds per unit of cumulative absolute velocity, 1 m/s.
#[derive(Clone, Copy, Debug)]
pub struct Gain {
    /// The sums over modes, with [`ModeRates::gains`] in place of e.
    sums: Sums,
    /// Increase of the acceleration by dashpots, m/s2: sum over modes of |row| c |participation|.
    dragged: f64,
    /// Increase of the rate by the ground itself, |W|.
    shaken: f64,
}

/// The quantity of a row at the base, and its bounds there.
pub struct Seen {
    pub sums: Sums,
    /// Its acceleration by springs and dashpots, m/s2, where damping couples no modes.
    pub pull: f64,
    /// The quantity, m, and its rate, m/s.
    pub moved: f64,
    pub rate: f64,
}

/// At the ends of some numbers of segments: time from the base, s, and integral of |ground acceleration|, m/s.
#[derive(Clone, Copy, Default)]
pub struct Ends {
    time: Lane,
    cumulative: Lane,
}

impl Ends {
    /// The ends of all numbers of segments that are tested, counted from the base, which is `elapsed` seconds after the
    /// start of its segment.
    #[inline(always)]
    pub fn of(ahead: &Ahead, elapsed: f64) -> [Ends; TRIED.len()] {
        let mut all = [Ends::default(); TRIED.len()];
        for (ends, segments) in all.iter_mut().zip(&TRIED) {
            for (i, segments) in segments.iter().enumerate() {
                let (time, cumulative) = ahead.over(*segments);
                (ends.time[i], ends.cumulative[i]) = ((1.0 + MARGIN) * (time - elapsed), cumulative);
            }
        }
        all
    }
}

impl ModeRates {
    /// For a structure; `weight` is the largest |row| entry of each mode over all rows.
    pub fn of(structure: &Structure, weight: &[f64]) -> ModeRates {
        let oscillates = structure.oscillators().is_some();
        let structure = structure.in_flight();
        let coupled = structure.bodies.iter().filter(|body| body.is_coupled());
        let coupled: Vec<Range<usize>> = coupled.map(|body| body.range.clone()).collect();
        let mut gains: Vec<f64> = structure.participation.iter().map(|p| p.abs()).collect();
        let omega: Vec<f64> = structure.omega2.iter().map(|w2| w2.sqrt()).collect();
        let mut quickness = structure.quickness.clone();
        let of_mode = |(w, c): (&f64, &f64)| ((w * w + c * c) * (w * w + c * c) + c * c * w * w).sqrt();
        let mut jerk: Vec<f64> = omega.iter().zip(&structure.damping).map(of_mode).collect();
        for range in &coupled {
            share(&mut gains[range.clone()]);
            // |C| |v| + w |w q|, with the largest row sum of |C|.
            quickness[range.clone()].fill(2.0 * structure.fastest);
            jerk[range.clone()].fill(f64::INFINITY);
        }
        let block = |c: usize| {
            let lane = |all: &[f64]| -> Lane { std::array::from_fn(|i| all[c * LANES + i]) };
            BlockRates {
                omega: lane(&omega),
                quickness: lane(&quickness),
                jerk: lane(&jerk),
                damping: lane(&structure.damping),
                omega2: lane(&structure.omega2),
                weight: lane(weight),
            }
        };
        ModeRates { blocks: (0..structure.lanes / LANES).map(block).collect(), gains, coupled, oscillates }
    }

    /// What the bounds of a row with that share of the ground gain.
    pub fn gain(&self, structure: &Structure, row: FlightRow, share_of_ground: f64) -> Gain {
        let Structure { damping, participation, .. } = structure.in_flight();
        let pulls = |m: usize| match row {
            FlightRow::OfModes(row) => row[m] * damping[m] * participation[m],
            FlightRow::OfOscillators(rows) => rows.pull_by_rates()[m] * participation[m],
        };
        let dragged = (0..participation.len()).map(|m| pulls(m).abs()).sum();
        let at_rest = vec![0.0; participation.len()];
        let Seen { sums, .. } = self.see(row, Motion { q: &at_rest, v: &at_rest }, &self.gains);
        Gain { sums, dragged, shaken: share_of_ground.abs() }
    }

    /// Writes upper bounds on sqrt(v^2 + w^2 q^2) of all modes in a motion. Returns a bound on the contribution of the
    /// displacements to any row's quantity, m.
    #[inline(always)]
    pub fn amplitudes(&self, Motion { q, v }: Motion, amplitude: &mut [f64]) -> f64 {
        let [(q, _), (v, _)] = [q, v].map(|vector| vector.as_chunks::<LANES>());
        let mut size = [0.0; LANES];
        let blocks = self.blocks.iter().zip(q).zip(v);
        for (((mode, q), v), amplitude) in blocks.zip(amplitude.as_chunks_mut::<LANES>().0) {
            let moved = each(|i| q[i].abs());
            let (a, b) = (each(|i| v[i].abs()), each(|i| mode.omega[i] * moved[i]));
            // Not `max` and `min`, which ignore a NaN.
            let more = each(|i| if a[i] > b[i] { a[i] } else { b[i] });
            let less = each(|i| if a[i] > b[i] { b[i] } else { a[i] });
            *amplitude = each(|i| more[i] + CHORD * less[i]);
            size = each(|i| size[i] + mode.weight[i] * moved[i]);
            if self.oscillates {
                // |A| |x| + |B| |x'|, with (w + c) |B| in the weight.
                size =
                    each(|i| size[i] + mode.weight[i] * if mode.omega[i] > 0.0 { a[i] / mode.omega[i] } else { 0.0 });
            }
        }
        for range in &self.coupled {
            share(&mut amplitude[range.clone()]);
        }
        size.iter().sum()
    }

    /// For one row, its quantity in a motion, and the sums over modes in its bounds for those amplitudes.
    #[inline(always)]
    pub fn see(&self, row: FlightRow, motion: Motion, amplitude: &[f64]) -> Seen {
        let seen = self.see_modes(row.sizes(), motion, amplitude);
        match row {
            FlightRow::OfModes(_) => seen,
            FlightRow::OfOscillators(rows) => {
                Seen { pull: rows.pull(motion), moved: row.value(motion), rate: row.rate(motion), ..seen }
            }
        }
    }

    /// The same of a row over the modes.
    #[inline(always)]
    fn see_modes(&self, row: &[f64], Motion { q, v }: Motion, amplitude: &[f64]) -> Seen {
        let [row, amplitude, q, v] = [row, amplitude, q, v].map(|all| all.as_chunks::<LANES>().0);
        // Equal lengths: no bounds checks below.
        let count = self.blocks.len();
        let (row, amplitude, q, v) = (&row[..count], &amplitude[..count], &q[..count], &v[..count]);
        let (mut velocity, mut acceleration, mut jerk) = ([0.0; LANES], [0.0; LANES], [0.0; LANES]);
        let (mut pull, mut moved, mut rate) = ([0.0; LANES], [0.0; LANES], [0.0; LANES]);
        for c in 0..count {
            let (mode, row, q, v) = (&self.blocks[c], &row[c], &q[c], &v[c]);
            let part = each(|i| row[i].abs() * amplitude[c][i]);
            velocity = each(|i| velocity[i] + part[i]);
            acceleration = each(|i| acceleration[i] + mode.quickness[i] * part[i]);
            jerk = each(|i| jerk[i] + mode.jerk[i] * part[i]);
            pull = each(|i| pull[i] - row[i] * (mode.damping[i] * v[i] + mode.omega2[i] * q[i]));
            moved = each(|i| moved[i] + row[i] * q[i]);
            rate = each(|i| rate[i] + row[i] * v[i]);
        }
        let [velocity, acceleration, jerk, pull, moved, rate] =
            totals(&[velocity, acceleration, jerk, pull, moved, rate]);
        Seen { sums: Sums { velocity, acceleration, jerk }, pull, moved, rate }
    }
}

/// Sums over lanes, from left to right. Not inlined: otherwise compilers transpose every block of modes in order to add
/// up the same lane of several sums side by side.
#[inline(never)]
fn totals(sums: &[Lane; 6]) -> [f64; 6] {
    sums.map(from_left_to_right)
}

impl Seen {
    /// The largest of the tested numbers of segments for which `sign` times the quantity stays below a limit; 0 if it
    /// does for none. It is `start` above the limit at the base, m: below 0, with the rounding error of the quantity
    /// included.
    #[inline(always)]
    pub fn longest(&self, gain: &Gain, (sign, start): (f64, f64), ends: &[Ends; TRIED.len()]) -> u64 {
        let mut free = 0;
        for (segments, ends) in TRIED.iter().zip(ends) {
            let highest = highest(self, gain, (sign, start), ends);
            for i in 0..LANES {
                free = if highest[i] < 0.0 { segments[i] } else { free };
            }
            if free < segments[LANES - 1] {
                break;
            }
        }
        free
    }
}

/// The least of three numbers, each of which is below 0 only if a quantity does not reach its limit up to some ends: by a line and
/// a parabola its largest distance beyond the limit, m, by a cubic its largest control value or three times that. A NaN of the
/// cubic is ignored, one of the others is returned.
#[multiversion::multiversion(targets("x86_64+avx2"))]
fn highest(seen: &Seen, gain: &Gain, (sign, start): (f64, f64), Ends { time, cumulative }: &Ends) -> Lane {
    let &Seen { ref sums, pull, rate, .. } = seen;
    let (rate, pull) = (sign * rate, sign * pull + MARGIN * sums.acceleration);
    let (smaller, larger) = (|a: f64, b: f64| if a < b { a } else { b }, |a: f64, b: f64| if a > b { a } else { b });
    each(|i| {
        let (time, cumulative) = (time[i], cumulative[i]);
        let velocity = sums.velocity + gain.sums.velocity * cumulative;
        let acceleration = sums.acceleration + gain.sums.acceleration * cumulative;
        let jerk = sums.jerk + gain.sums.jerk * cumulative;
        let rate = rate + gain.shaken * cumulative + MARGIN * velocity;
        let (line, parabola) = (start + time * velocity, start + time * (rate + 0.5 * time * acceleration));
        let (first, second) = (time * rate, 0.5 * time * time * (pull + cumulative * gain.dragged));
        let end = start + (first + second + time * time * time * (jerk * (1.0 / 6.0)));
        let inner = [3.0 * start + first, 3.0 * start + 2.0 * first + second];
        // The end as the last operand: it is NaN where anything before it is.
        let last = end + 0.0 * (inner[0] + inner[1]);
        let cubic = larger(larger(larger(start, inner[0]), inner[1]), last);
        smaller(cubic, smaller(line, parabola))
    })
}

/// A bound on some rows with limits, such as all storeys, at once: by the amplitudes of the modes alone.
#[derive(Clone, Debug, Default)]
pub struct Together {
    /// For each mode, the largest |row| / (w limit) of all rows, s/(m kg^1/2).
    of_modes: Vec<f64>,
}

impl Together {
    /// Of rows, each with the limit of its magnitude, m.
    pub fn of<'a>(structure: &Structure, rows: impl Iterator<Item = (FlightRow<'a>, f64)>) -> Together {
        let structure = structure.in_flight();
        let mut of_modes = vec![0.0_f64; structure.lanes];
        for (row, limit) in rows {
            for (m, row) in row.sizes().iter().enumerate().filter(|(_, row)| **row != 0.0) {
                of_modes[m] = of_modes[m].max(row.abs() / (structure.omega2[m].sqrt() * limit));
            }
        }
        Together { of_modes }
    }

    /// Bound on the largest share of its limit that any row's quantity gets to with amplitudes up to these.
    pub fn largest_share(&self, amplitudes: &[f64]) -> f64 {
        (1.0 + MARGIN) * self.of_modes.iter().zip(amplitudes).map(|(of, amplitude)| of * amplitude).sum::<f64>()
    }

    /// The largest of the tested numbers of segments for which no row reaches its limit; 0 if one may in any. They are
    /// at `share` of their limits with the present amplitudes, gain `gain` per unit of cumulative absolute velocity,
    /// and have `left` of the way before them.
    pub fn longest((share, gain): (f64, f64), left: f64, ends: &[Ends; TRIED.len()]) -> u64 {
        let mut free = 0;
        for (segments, ends) in TRIED.iter().zip(ends) {
            for (segments, cumulative) in segments.iter().zip(&ends.cumulative) {
                // Written so that a NaN never counts as below.
                if share + gain * cumulative < left {
                    free = *segments;
                }
            }
        }
        free
    }
}

/// Writes what the amplitudes of modes that damping does not couple are at most within `h` seconds, under a load that
/// is linear in time and impulses of which each is at most a number, N s, times a row.
pub fn pushed<'a>(
    omega2: &[f64],
    Motion { q, v }: Motion,
    LinearLoad { load, slope }: LinearLoad,
    h: f64,
    impulses: impl Iterator<Item = (&'a [f64], f64)>,
    amplitudes: &mut [f64],
) {
    for m in 0..omega2.len() {
        let amplitude = (v[m] * v[m] + omega2[m] * q[m] * q[m]).sqrt();
        amplitudes[m] = amplitude + h * (load[m].abs() + h * slope[m].abs());
    }
    for (row, impulse) in impulses {
        amplitudes.iter_mut().zip(row).for_each(|(amplitude, row)| *amplitude += impulse * row.abs());
    }
}

/// Gives each of some coupled modes the amplitude of all together: they exchange energy, and any may get all of it.
pub fn share(modes: &mut [f64]) {
    let whole = modes.iter().map(|e| e * e).sum::<f64>().sqrt();
    modes.fill(whole);
}
