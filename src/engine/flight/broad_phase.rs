//! The broad phase: for each pair, bounds on the closing velocity of its floors give a number of segments of the record
//! in which it cannot meet. This is conservative advancement \[Mirtich1996\] with bounds of structural dynamics.
//!
//! Apart from contact, the amplitude e = sqrt(q'^2 + w^2 q^2) of each mode grows at most by A = |participation| x the
//! integral of |ground acceleration|, as damping only reduces it. Without the ground's part |q''| <= (w + c) e. The ground
//! accelerates all floors alike, and so a pair by its acceleration times |W|, W the sum of the weights in its row: 0
//! between two floors, not so at a wall and where the ground has a share. With S, the integral of |ground acceleration|,
//! and the present e, after a time t
//!
//! ```text
//! penetration <= penetration now + t sum over modes of |row| (e + A)
//! penetration <= penetration now + t (rate now + |W| S + t/2 sum over modes of |row| (w + c) (e + A))
//! ```
//!
//! The first bound never falls with t and the second is convex: if it is below 0 at the end of an interval, it was
//! below 0 throughout. Where damping couples no modes, the pair's relative acceleration by springs and dashpots, a =
//! -row (c v + w^2 q), changes at a rate |a'| <= sum of |row| (k (e + A) + c |participation| |ground acceleration|)
//! with k^2 = (w^2 + c^2)^2 + c^2 w^2. This gives
//!
//! ```text
//! penetration <= penetration now + t (rate now + |W| S) + t^2/2 (a now + S sum of |row| c |participation|)
//!                + t^3/6 sum over modes of |row| k (e + A)
//! ```
//!
//! a cubic in t, which is bounded by its Bernstein coefficients.

use crate::engine::base::Base;
use crate::engine::base::clearance::MOST;
use crate::engine::base::counters::Counters;
use crate::engine::excitation::record::{Ahead, GroundMotion};
use crate::engine::pairs::pair::Pair;
use crate::engine::system::System;
use crate::numerics::polynomial::each;
use crate::structure::{LANES, Lane, ModalDamping, Side, Structure};
use std::ops::Range;

/// Numbers of segments for which a pair is tested, four at a time.
const TRIED: [[u64; LANES]; 3] = [[1, 2, 3, 4], [6, 8, 12, 16], [24, 32, 48, MOST]];

/// Number of segments for which a broad phase mostly clears a pair when no pair is near.
const USUAL: u64 = 8;

/// Number of segments to wait before another broad phase where it costs less to check each segment by both of its ends.
pub const NEAR_SEGMENTS: u64 = 16;

/// Margin for rounding, relative to the terms of a penetration or closing velocity.
const MARGIN: f64 = 1e-10;

/// sqrt(2) - 1, rounded up: sqrt(a^2 + b^2) <= a + this b for a >= b >= 0.
const CHORD: f64 = 0.414_213_562_4;

/// The bounds' coefficients for each mode and pair; constant during a run.
#[derive(Debug)]
pub struct ClosingBounds {
    /// The modes of both buildings, in blocks.
    modes: Vec<BoundedModes>,
    /// For each pair, the increase of its bounds per unit of cumulative absolute velocity (integral of |ground
    /// acceleration|), 1 m/s.
    pairs: Vec<Growth>,
    /// Ranges of the modes of buildings in which damping couples modes.
    coupled: Vec<Range<usize>>,
}

/// Coefficients of [`LANES`] modes, side by side.
#[derive(Clone, Copy, Debug, Default)]
struct BoundedModes {
    /// Natural frequency w, rad/s.
    omega: Lane,
    /// w + c, 1/s.
    quickness: Lane,
    /// k, 1/s2; infinite where damping couples the mode to others.
    bend: Lane,
    /// Damping c, 1/s.
    damping: Lane,
    /// w^2, 1/s2.
    omega2: Lane,
    /// Largest |row| entry over all pairs, kg^-1/2.
    weight: Lane,
}

/// Increase of a pair's bounds per unit of cumulative absolute velocity, 1 m/s.
#[derive(Clone, Copy, Debug)]
struct Growth {
    /// The sums over modes, with |participation| in place of e.
    sums: Sums,
    /// Increase of the relative acceleration by dashpots, m/s2: sum over modes of |row| c |participation|.
    dragged: f64,
    /// Increase of the closing velocity by the ground itself, |W|.
    shaken: f64,
}

/// Sums over modes of |row| e, m/s, of |row| (w + c) e, m/s2, and of |row| k e, m/s3.
#[derive(Clone, Copy, Debug)]
struct Sums {
    /// Of |row| e, m/s.
    speed: f64,
    /// Of |row| (w + c) e, m/s2.
    change: f64,
    /// Of |row| k e, m/s3.
    bend: f64,
}

impl ClosingBounds {
    /// For the pairs of a structure; `weight` is the largest |row| entry of each mode over all pairs.
    pub fn of(structure: &Structure, pairs: &[Pair], weight: &[f64]) -> ClosingBounds {
        let mut growth: Vec<f64> = structure.participation.iter().map(|p| p.abs()).collect();
        let coupled = [Side::Left, Side::Right]
            .into_iter()
            .filter(|side| matches!(structure.modes(*side).damping, ModalDamping::Coupled(_)));
        let coupled: Vec<Range<usize>> = coupled.map(|side| structure.range(side)).collect();
        for range in &coupled {
            share_amplitude(&mut growth[range.clone()]);
        }
        let omega: Vec<f64> = structure.omega2.iter().map(|w2| w2.sqrt()).collect();
        let mut quickness: Vec<f64> = omega.iter().zip(&structure.damping).map(|(w, c)| w + c).collect();
        for range in &coupled {
            // |C| |v| + w |w q|, with the largest row sum of |C|.
            quickness[range.clone()].fill(2.0 * structure.fastest);
        }
        let of_mode = |(w, c): (&f64, &f64)| ((w * w + c * c) * (w * w + c * c) + c * c * w * w).sqrt();
        let mut bend: Vec<f64> = omega.iter().zip(&structure.damping).map(of_mode).collect();
        for range in &coupled {
            bend[range.clone()].fill(f64::INFINITY);
        }
        let dragged = |pair: &Pair| {
            let of_modes = pair.row.iter().zip(&structure.damping).zip(&structure.participation);
            of_modes.map(|((row, c), participation)| (row * c * participation).abs()).sum()
        };
        let growth = |pair: &Pair| Growth {
            sums: Sums::of(&pair.row, &growth, &quickness, &bend),
            dragged: dragged(pair),
            shaken: pair.share_of_ground().abs(),
        };
        let block = |c: usize| {
            let lane = |all: &[f64]| -> Lane { std::array::from_fn(|i| all[c * LANES + i]) };
            BoundedModes {
                omega: lane(&omega),
                quickness: lane(&quickness),
                bend: lane(&bend),
                damping: lane(&structure.damping),
                omega2: lane(&structure.omega2),
                weight: lane(weight),
            }
        };
        ClosingBounds {
            modes: (0..structure.lanes / LANES).map(block).collect(),
            pairs: pairs.iter().map(growth).collect(),
            coupled,
        }
    }
}

impl ClosingBounds {
    /// Tests the pairs that are not cleared for the base's segment, which has that number; returns whether all are
    /// cleared now. If not, the next broad phase is `segments_to_wait` segments later.
    pub fn dismiss(
        &self,
        system: &System,
        ground: &GroundMotion,
        (base, segment, segments_to_wait): (&mut Base, u64, u64),
        counters: &mut Counters,
        amplitude: &mut [f64],
    ) -> bool {
        let is_free = base.clearance.are_all_free(segment);
        if is_free || segment < base.clearance.next_look() {
            return is_free;
        }
        if !cfg!(without = "dismissal") {
            bound_all((self, system), ground, base, segment, counters, amplitude);
        }
        let due = base.clearance.first_due();
        base.clearance.note(due, if due >= segment + USUAL { due } else { due.max(segment + segments_to_wait) });
        base.clearance.are_all_free(segment)
    }

    /// Writes upper bounds on sqrt(v^2 + w^2 q^2) of all modes at the base. Returns a bound on the contribution of the
    /// displacements to any penetration, m.
    #[inline(always)]
    fn amplitudes(&self, base: &Base, amplitude: &mut [f64]) -> f64 {
        let [(q, _), (v, _)] = [&base.q, &base.v].map(|vector| vector.as_chunks::<LANES>());
        let mut size = [0.0; LANES];
        let blocks = self.modes.iter().zip(q).zip(v);
        for (((mode, q), v), amplitude) in blocks.zip(amplitude.as_chunks_mut::<LANES>().0) {
            let moved = each(|i| q[i].abs());
            let (a, b) = (each(|i| v[i].abs()), each(|i| mode.omega[i] * moved[i]));
            // Not `max` and `min`, which ignore a NaN.
            let more = each(|i| if a[i] > b[i] { a[i] } else { b[i] });
            let less = each(|i| if a[i] > b[i] { b[i] } else { a[i] });
            *amplitude = each(|i| more[i] + CHORD * less[i]);
            size = each(|i| size[i] + mode.weight[i] * moved[i]);
        }
        for range in &self.coupled {
            share_amplitude(&mut amplitude[range.clone()]);
        }
        size.iter().sum()
    }
}

/// Gives each of some coupled modes the amplitude of all of them together: they exchange energy, and only that
/// amplitude cannot grow without excitation.
fn share_amplitude(modes: &mut [f64]) {
    let whole = modes.iter().map(|e| e * e).sum::<f64>().sqrt();
    modes.fill(whole);
}

/// Tests each pair that is not cleared for a segment.
#[multiversion::multiversion(targets("x86_64+avx2"))]
fn bound_all(
    (closing, system): (&ClosingBounds, &System),
    ground: &GroundMotion,
    base: &mut Base,
    segment: u64,
    counters: &mut Counters,
    amplitude: &mut [f64],
) {
    let size = closing.amplitudes(base, amplitude);
    let (ahead, mut ends) = (ground.ahead_of(segment), [Ends::default(); TRIED.len()]);
    for (ends, segments) in ends.iter_mut().zip(&TRIED) {
        ends.set(&ahead, base.elapsed, segments);
    }
    for (p, pair) in system.pairs.iter().enumerate() {
        if base.clearance.is_free(p, segment) {
            continue;
        }
        let Seen { bounds: sums, pull, moved, rate } = bound_one(closing, base, &pair.row, amplitude);
        let contact = &mut base.contacts[p];
        if !base.clearance.is_known(p) {
            counters.pairs_evaluated += 1;
            (contact.penetration, contact.rate) = (moved - pair.gap, rate);
            base.clearance.set_known(p);
        }
        if contact.tracked {
            continue;
        }
        let closing = Closing {
            start: contact.flight_start() + MARGIN * (pair.gap.abs() + size),
            rate: contact.rate,
            pull: pull + MARGIN * sums.change,
            sums,
            growth: &closing.pairs[p],
        };
        base.clearance.clear(p, segment + closing.longest(&ends));
    }
}

/// At the ends of some numbers of segments: time from the base, s, and integral of |ground acceleration|, m/s.
#[derive(Clone, Copy, Default)]
struct Ends {
    time: Lane,
    cumulative: Lane,
}

impl Ends {
    /// Sets the ends of some numbers of segments, counted from the base.
    #[inline(always)]
    fn set(&mut self, ahead: &Ahead, elapsed: f64, segments: &[u64; LANES]) {
        for (i, segments) in segments.iter().enumerate() {
            let (time, cumulative) = ahead.over(*segments);
            self.time[i] = (1.0 + MARGIN) * (time - elapsed);
            self.cumulative[i] = cumulative;
        }
    }
}

/// Terms of one pair's bounds.
struct Closing<'a> {
    /// Penetration at the base, m, and its rate, m/s.
    start: f64,
    rate: f64,
    /// Relative acceleration by springs and dashpots at the base, m/s2.
    pull: f64,
    /// Sums over modes with the present amplitudes.
    sums: Sums,
    /// Their increase per unit of cumulative absolute velocity.
    growth: &'a Growth,
}

impl Closing<'_> {
    /// The largest of the tested numbers of segments for which the pair stays apart; 0 if it does for none.
    #[inline(always)]
    fn longest(&self, ends: &[Ends; TRIED.len()]) -> u64 {
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
fn bound_one(closing: &ClosingBounds, base: &Base, row: &[f64], amplitude: &[f64]) -> Seen {
    let [row, amplitude, q, v] = [row, amplitude, &base.q, &base.v].map(|all| all.as_chunks::<LANES>().0);
    // Equal lengths: no bounds checks below.
    let (modes, count) = (&closing.modes[..], closing.modes.len());
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
struct Seen {
    bounds: Sums,
    /// Relative acceleration by springs and dashpots, m/s2, where damping couples no modes.
    pull: f64,
    /// Displacement of the left face relative to the right one, m, and its rate, m/s: positive when they approach.
    moved: f64,
    rate: f64,
}

impl Sums {
    fn of(row: &[f64], amplitude: &[f64], quickness: &[f64], bends: &[f64]) -> Sums {
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
