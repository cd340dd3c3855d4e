//! The broad phase: for each pair, and for all elements that can yield, the number of segments of the record in which no
//! limit can be reached, however the ground shakes in them ([`crate::engine::bounds::amplitude`]).

use crate::engine::base::Base;
use crate::engine::base::counters::Counters;
use crate::engine::base::element::Sense;
use crate::engine::bounds::amplitude::{Ends, Gain, MARGIN, ModeRates, Seen, TRIED, Together};
use crate::engine::excitation::record::GroundMotion;
use crate::engine::system::System;
use crate::engine::system::limits::Limit;

/// The coefficients of the bounds; constant during a run.
#[derive(Debug)]
pub struct BroadPhase {
    rates: ModeRates,
    pairs: Vec<Gain>,
    elements: Vec<Gain>,
    /// What the bound on all storeys together gains per unit of cumulative absolute velocity, s/m.
    together: f64,
}

impl BroadPhase {
    /// For a system; `weight` is the largest |row| entry of each mode over its pairs and storeys.
    pub fn of(System { structure, pairs, elements, together, .. }: &System, weight: &[f64]) -> BroadPhase {
        let rates = ModeRates::of(structure, weight);
        BroadPhase {
            pairs: pairs.iter().map(|of| rates.gain(structure, of.in_flight(), of.row.share_of_ground)).collect(),
            elements: elements.iter().map(|of| rates.gain(structure, of.in_flight(), of.row.share_of_ground)).collect(),
            together: together.largest_share(&rates.gains),
            rates,
        }
    }

    /// Tests the pairs that are not cleared for the base's segment, which has that number, and the storeys; returns
    /// whether all are cleared now. If not, the next broad phase is that of the next segment. Called seldom, so kept out of
    /// the loops of its callers.
    #[inline(never)]
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
            look_ahead((self, system), ground, base, segment, counters, amplitude);
        }
        base.clearance.settle(segment);
        base.clearance.are_all_free(segment)
    }

    /// The largest of the tested numbers of segments for which all elements stay elastic; 0 if they do for none. All
    /// together are tested first, by the amplitudes alone; `size` bounds what displacements contribute to any drift.
    #[inline(always)]
    fn longest_elastic(
        &self,
        system: &System,
        base: &Base,
        (amplitude, size): (&[f64], f64),
        ends: &[Ends; TRIED.len()],
    ) -> u64 {
        let share = (system.together.largest_share(amplitude), self.together);
        let together = Together::longest(share, 1.0 - system.moved_share(&base.elements), ends);
        if together > 0 {
            return together;
        }
        let mut least = u64::MAX;
        for (i, ((of, present), gain)) in system.elements_at(&base.elements).zip(&self.elements).enumerate() {
            let seen = self.rates.see(of.in_flight(), base.motion(), amplitude);
            let limit = Limit::of_element(i, of, present);
            for sense in Sense::BOTH {
                let start = limit.start(sense, || (seen.moved, seen.rate)).0 + MARGIN * (of.limit + size);
                least = least.min(seen.longest(gain, (sense.sign(), start), ends));
            }
            if least == 0 {
                break;
            }
        }
        least
    }
}

/// Tests each pair that is not cleared for a segment, and the storeys.
#[multiversion::multiversion(targets("x86_64+avx2"))]
fn look_ahead(
    (of, system): (&BroadPhase, &System),
    ground: &GroundMotion,
    base: &mut Base,
    segment: u64,
    counters: &mut Counters,
    amplitude: &mut [f64],
) {
    let size = of.rates.amplitudes(base.motion(), amplitude);
    let ends = Ends::of(&ground.ahead_of(segment), base.elapsed);
    for (p, (pair, &gap)) in system.pairs.iter().zip(&base.rest.gaps).enumerate() {
        if base.clearance.is_free(p, segment) {
            continue;
        }
        let seen = of.rates.see(pair.in_flight(), base.motion(), amplitude);
        let contact = &mut base.contacts[p];
        if !base.clearance.is_known(p) {
            counters.pairs_evaluated += 1;
            (contact.penetration, contact.rate) = (seen.moved - gap, seen.rate);
            base.clearance.set_known(p);
        }
        if contact.tracked {
            continue;
        }
        let start = contact.flight_start() + MARGIN * (gap.abs() + size);
        let seen = Seen { rate: contact.rate, ..seen };
        base.clearance.clear(p, segment + seen.longest(&of.pairs[p], (1.0, start), &ends));
    }
    if let Some(elements) = system.place_of_elements().filter(|elements| !base.clearance.is_free(*elements, segment)) {
        let segments = of.longest_elastic(system, base, (amplitude, size), &ends);
        base.clearance.clear(elements, segment + segments);
    }
}
