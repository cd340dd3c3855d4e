//! Flight: no floors touch and no element yields, and all buildings move by their exact modal solution until the
//! segment ends, two floors meet or an element yields.

pub mod accounted;
pub mod broad_phase;
pub mod log;
pub mod propagate;
pub mod search;
pub mod workspace;

use crate::engine::base::Base;
use crate::engine::base::kinds::Kind;
use crate::engine::base::planned::{At, Planned};
use crate::engine::bounds::certificate::Certificate;
use crate::engine::flight::broad_phase::BroadPhase;
use crate::engine::flight::search::Search;
use crate::engine::flight::workspace::Look;
use crate::engine::quantities::flight_row::FlightRow;
use crate::engine::system::System;
use crate::engine::system::buffers::Buffers;
use crate::engine::system::limits::Limit;
use crate::structure::{LinearLoad, Motion};

/// Coefficients for the proofs that no pair meets and no element yields; constant during a run.
#[derive(Debug)]
pub struct Flight {
    pub broad_phase: BroadPhase,
    certificate: Certificate,
}

impl Flight {
    /// For the pairs and storeys of a system.
    pub fn new(system: &System) -> Flight {
        let certificate = Certificate::of(&system.structure, system.rows_with_limits().map(FlightRow::sizes));
        Flight { broad_phase: BroadPhase::of(system, &certificate.weight), certificate }
    }

    /// Plans the flight over the whole segment of the record at whose start the base stands, if bounds clear all pairs
    /// and elements for it: then its end is all that has to be worked out.
    #[inline]
    pub fn plan_cleared(&self, system: &System, at: &mut At, planned: &mut Planned, amplitude: &mut [f64]) -> bool {
        let At { base, counters, .. } = at;
        let flying = system.structure.in_flight();
        let Some((ground, segment)) = system.watched_segment(base) else { return false };
        let is_prepared = base.elapsed == 0.0
            && system.is_in_flight(base)
            && flying.is_classical()
            && system.is_accounted_at_once(ground, base);
        let is_cleared = is_prepared
            && (base.clearance.are_all_free(segment)
                || self.broad_phase.dismiss(system, ground, base, segment, counters, amplitude));
        if !is_cleared {
            return false;
        }
        let Some(interval) = ground.prepared(&base.segment) else { return false };
        planned.plan_cleared(interval.length);
        interval.fly_on_ground(base.motion(), (&flying.participation, base.ground()), planned.motion_mut());
        true
    }

    /// Plans the flight from the base, under the load in `work`, over `longest` seconds or until the first event; returns
    /// what has shown that there is none, or found it.
    pub fn plan(
        &self,
        system: &System,
        at: &mut At,
        longest: f64,
        planned: &mut Planned,
        look: &mut Look,
        work: &mut Buffers,
    ) -> Kind {
        planned.plan(longest, None, planned.reaches_limit, None);
        system.fly(at.base, longest, work, planned.motion_mut());
        if system.count_limits() == 0 {
            return Kind::Cleared;
        }
        let watched = system.watched_segment(at.base);
        let segment = watched.map(|(_, segment)| segment);
        if let Some((ground, segment)) = watched
            && self.broad_phase.dismiss(system, ground, at.base, segment, at.counters, &mut work.node_v)
        {
            planned.is_cleared = true;
            return Kind::Cleared;
        }
        if self.both_ends_hold(system, at, planned, (look, work), segment) {
            return Kind::ByEnds;
        }
        let is_over = planned.ends.iter().flatten().any(|(penetration, _)| *penetration >= 0.0);
        planned.ends.clear();
        if !is_over && system.envelopes_stay_within(at.base, at.base.motion(), work.loads(), longest) {
            return Kind::ByAmplitudes;
        }
        Search { certificate: &self.certificate, system, base: at.base, look, work }.first_event(planned, at.counters);
        Kind::Searched
    }

    /// Whether both ends of the planned flight prove that no pair meets and no element yields in it; what is cleared for
    /// its segment is not tested.
    pub fn both_ends_hold(
        &self,
        system: &System,
        At { base, counters, .. }: &mut At,
        planned: &mut Planned,
        (look, work): (&mut Look, &mut Buffers),
        segment: Option<u64>,
    ) -> bool {
        let (h, loads) = (planned.length, LinearLoad { load: &work.load, slope: &work.slope });
        let (start, end) = (Motion { q: &base.q, v: &base.v }, Motion { q: &planned.q, v: &planned.v });
        let deviation = self.certificate.deviation(system.structure.in_flight(), start, loads, h, &mut work.scratch);
        let is_cleared =
            |base: &Base, place: usize| segment.is_some_and(|segment| base.clearance.is_free(place, segment));
        for (p, pair) in system.pairs.iter().enumerate() {
            if !is_cleared(base, p) && !base.clearance.is_known(p) {
                counters.pairs_evaluated += 1;
                let contact = &mut base.contacts[p];
                (contact.penetration, contact.rate) = pair.penetration(base.rest.gaps[p], start);
                base.clearance.set_known(p);
            }
        }
        let at = |limit: &Limit, motion: Motion| {
            let row = limit.row.in_flight();
            (row.value(motion), row.rate(motion))
        };
        for i in 0..system.count_limits() {
            // All elements are cleared together, at the place after those of the pairs.
            let is_cleared = is_cleared(base, i.min(system.pairs.len()));
            let limit = system.limit(base, i);
            let to = (!is_cleared).then(|| at(&limit, end));
            if i < system.pairs.len() {
                planned.ends.push(to.map(|(x, rate)| (x - base.rest.gaps[i], rate)));
                counters.pairs_evaluated += u64::from(!is_cleared);
            }
            let from = |sense| limit.start(sense, || at(&limit, start));
            let keeps_off = |to| limit.keeps_off(from, to, (h, deviation));
            look.is_free[i] = to.is_none_or(|to| !cfg!(without = "certificate") && keeps_off(to));
        }
        look.is_free.iter().all(|is_free| *is_free)
    }
}
