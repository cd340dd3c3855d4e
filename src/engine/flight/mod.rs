//! Flight: no floors touch and no storey yields, and both buildings move by their exact modal solution until the segment
//! ends, two floors meet or a storey yields.

pub mod accounted;
pub mod broad_phase;
pub mod certificate;
pub mod elastic;
pub mod envelope;
pub mod fast_account;
pub mod narrow_phase;
pub mod propagate;
pub mod workspace;

use crate::engine::base::Base;
use crate::engine::base::counters::Counters;
use crate::engine::base::planned::{At, Planned};
use crate::engine::excitation::record::GroundMotion;
use crate::engine::flight::broad_phase::ClosingBounds;
use crate::engine::flight::certificate::Certificate;
use crate::engine::flight::narrow_phase::Search;
use crate::engine::flight::workspace::Look;
use crate::engine::system::System;
use crate::engine::system::buffers::Buffers;

/// Coefficients for the proofs that no pair meets and no storey yields; constant during a run.
#[derive(Debug)]
pub struct Flight {
    closing: ClosingBounds,
    certificate: Certificate,
}

impl Flight {
    /// For the pairs of a system.
    pub fn new(System { structure, pairs, storeys, reach_of_storeys, .. }: &System) -> Flight {
        let rows = pairs.iter().map(|pair| &pair.row).chain(storeys.iter().map(|storey| &storey.row));
        let certificate = Certificate::of(structure, rows);
        Flight {
            closing: ClosingBounds::of(structure, (pairs, storeys, reach_of_storeys), &certificate.weight),
            certificate,
        }
    }

    /// Broad phase: tests the pairs that are not cleared for the base's segment, which has that number, and the storeys;
    /// returns whether all are cleared now.
    pub fn dismiss(
        &self,
        system: &System,
        ground: &GroundMotion,
        base: &mut Base,
        segment: u64,
        counters: &mut Counters,
        amplitude: &mut [f64],
    ) -> bool {
        self.closing.dismiss(system, ground, base, segment, counters, amplitude)
    }

    /// Plans the flight from the base, under the load in `work`, over `longest` seconds or until the first event.
    pub fn plan(
        &self,
        system: &System,
        at: &mut At,
        longest: f64,
        planned: &mut Planned,
        look: &mut Look,
        work: &mut Buffers,
    ) {
        at.counters.flight_steps += 1;
        planned.length = longest;
        planned.event = None;
        planned.next_length = None;
        planned.tracked.fill(None);
        planned.ends.clear();
        system.fly(at.base, longest, work, (&mut planned.q, &mut planned.v));
        if system.cleared_together() == 0 {
            return;
        }
        let watched = system.watched_segment(at.base);
        let segment = watched.map(|(_, segment)| segment);
        if let Some((ground, segment)) = watched
            && self.dismiss(system, ground, at.base, segment, at.counters, &mut work.node_v)
        {
            at.counters.flights_cleared += 1;
            planned.ends.resize(system.pairs.len(), None);
        } else if !self.certificate.holds(system, at, planned, (look, work), segment) {
            let is_over = planned.ends.iter().flatten().any(|(penetration, _)| *penetration >= 0.0);
            planned.ends.clear();
            let loads = (&work.load[..], &work.slope[..]);
            if is_over || !system.envelopes_stay_apart(at.base, (&at.base.q, &at.base.v), loads, longest) {
                let certificate = &self.certificate;
                Search { certificate, system, base: at.base, look, work }.first_event(planned, at.counters);
            }
        }
    }
}
