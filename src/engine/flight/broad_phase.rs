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
use crate::engine::base::counters::Counters;
use crate::engine::bounds::all_storeys::Reach;
use crate::engine::bounds::amplitude::{BoundedModes, Closing, Ends, Growth, MARGIN, Seen, Sums, TRIED, bound_one};
use crate::engine::bounds::stretch::share;
use crate::engine::excitation::record::GroundMotion;
use crate::engine::flight::elastic::ElasticBounds;
use crate::engine::pairs::pair::Pair;
use crate::engine::system::System;
use crate::engine::yielding::storey::YieldingStorey;
use crate::numerics::polynomial::each;
use crate::structure::{LANES, Lane, ModalDamping, Side, Structure};
use std::ops::Range;

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
    /// Of the storeys that can yield.
    elastic: ElasticBounds,
}

impl ClosingBounds {
    /// For the pairs of a structure and the storeys that can yield; `weight` is the largest |row| entry of each mode over
    /// all of them.
    pub fn of(
        structure: &Structure,
        (pairs, storeys, reach): (&[Pair], &[YieldingStorey], &Reach),
        weight: &[f64],
    ) -> ClosingBounds {
        let mut growth: Vec<f64> = structure.participation.iter().map(|p| p.abs()).collect();
        let coupled = [Side::Left, Side::Right]
            .into_iter()
            .filter(|side| matches!(structure.modes(*side).damping, ModalDamping::Coupled(_)));
        let coupled: Vec<Range<usize>> = coupled.map(|side| structure.range(side)).collect();
        for range in &coupled {
            share(&mut growth[range.clone()]);
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
        let dragged = |row: &[f64]| {
            let of_modes = row.iter().zip(&structure.damping).zip(&structure.participation);
            of_modes.map(|((row, c), participation)| (row * c * participation).abs()).sum()
        };
        let growth_of = |row: &[f64], share_of_ground: f64| Growth {
            sums: Sums::of(row, &growth, &quickness, &bend),
            dragged: dragged(row),
            shaken: share_of_ground.abs(),
        };
        let of_storeys = storeys.iter().map(|of| growth_of(&of.row, of.share_of_ground())).collect();
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
            pairs: pairs.iter().map(|pair| growth_of(&pair.row, pair.share_of_ground())).collect(),
            elastic: ElasticBounds::of(reach, &growth, of_storeys),
            coupled,
        }
    }
}

impl ClosingBounds {
    /// Tests the pairs that are not cleared for the base's segment, which has that number, and the storeys; returns whether
    /// all are cleared now. If not, the next broad phase is that of the next segment.
    pub fn dismiss(
        &self,
        system: &System,
        ground: &GroundMotion,
        base: &mut Base,
        segment: u64,
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
        base.clearance.note(due, due.max(segment + 1));
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
            share(&mut amplitude[range.clone()]);
        }
        size.iter().sum()
    }
}

/// Tests each pair that is not cleared for a segment, and the storeys.
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
    for (p, (pair, &gap)) in system.pairs.iter().zip(&base.rest.gaps).enumerate() {
        if base.clearance.is_free(p, segment) {
            continue;
        }
        let Seen { bounds: sums, pull, moved, rate } = bound_one(&closing.modes, base, &pair.row, amplitude);
        let contact = &mut base.contacts[p];
        if !base.clearance.is_known(p) {
            counters.pairs_evaluated += 1;
            (contact.penetration, contact.rate) = (moved - gap, rate);
            base.clearance.set_known(p);
        }
        if contact.tracked {
            continue;
        }
        let closing = Closing {
            start: contact.flight_start() + MARGIN * (gap.abs() + size),
            rate: contact.rate,
            pull: pull + MARGIN * sums.change,
            sums,
            growth: &closing.pairs[p],
        };
        base.clearance.clear(p, segment + closing.longest(&ends));
    }
    let storeys = system.pairs.len();
    if !system.storeys.is_empty() && !base.clearance.is_free(storeys, segment) {
        let segments = closing.elastic.longest((&closing.modes, system), base, (amplitude, size), &ends);
        base.clearance.clear(storeys, segment + segments);
    }
}
