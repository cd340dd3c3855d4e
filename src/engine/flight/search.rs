//! The narrow phase: the first entry in a flight, or the first yield of a storey, is searched for piece by piece, in
//! the power series of the penetrations and drifts.
//!
//! The search does not change the motion: a flight without an entry ends at the exact solution, to the same bits
//! whether it was searched or not. So pairs that never meet do not affect the results.

use crate::engine::base::Base;
use crate::engine::base::counters::Counters;
use crate::engine::base::planned::{Event, First, Planned};
use crate::engine::bounds::certificate::Certificate;
use crate::engine::flight::workspace::Look;
use crate::engine::system::System;
use crate::engine::system::buffers::Buffers;
use crate::engine::system::limits::Expanded;
use crate::numerics::polynomial::{ALL, MAX_ORDER};
use crate::structure::{EXACT, LinearLoad, Motion, MotionMut, PIECE_ANGLE, flight_order};

/// Largest number of pieces in which one flight is searched; a longer one takes another step.
const MOST_PIECES: u32 = 10_000;

/// A piece of this many times that length, doubled after each success, is first tested by both ends, without a series;
/// where the test fails, as many pieces are searched by series.
const LONGER: u32 = 2;

/// The search for the first event in a planned flight.
pub struct Search<'a> {
    pub certificate: &'a Certificate,
    pub system: &'a System,
    pub base: &'a Base,
    pub look: &'a mut Look,
    /// Holds the load at the base and its rate.
    pub work: &'a mut Buffers,
}

impl Search<'_> {
    /// Finds the first event in the planned flight and ends the step there.
    pub fn first_event(&mut self, planned: &mut Planned, counters: &mut Counters) {
        let Search { system, base, .. } = *self;
        let (remaining, flying) = (planned.length, system.structure.in_flight());
        let mut unit = if flying.fastest * remaining > PIECE_ANGLE { PIECE_ANGLE / flying.fastest } else { remaining };
        let is_tracked = base.contacts.iter().any(|contact| contact.tracked);
        self.look.start(base, &self.work.load);
        if is_tracked {
            system.structure.accelerate(&base.q, &base.v, &self.work.load, &mut self.work.q);
            unit = unit.min(system.rebound_step_limit(base, &self.work.q));
        }
        let (mut series_left, mut longer) = (1, f64::from(LONGER) * unit);
        for _ in 0..MOST_PIECES {
            counters.narrow_phase_pieces += 1;
            let left = remaining - self.look.from;
            if series_left == 0 && left > unit {
                let length = left.min(longer);
                let (motion, loads) =
                    (self.look.motion(), LinearLoad { load: &self.look.load, slope: &self.work.slope });
                if system.envelopes_stay_within(base, motion, loads, left) {
                    return;
                }
                if !self.piece_stays_within(length) {
                    (series_left, longer) = (LONGER, f64::from(LONGER) * unit);
                    continue;
                }
                longer *= 2.0;
            } else {
                series_left -= u32::from(series_left > 0);
                let length = left.min(unit);
                let event = self.first_upcrossing_in(length);
                if event.is_some() || is_tracked {
                    return self.cut(planned, length, event);
                }
                self.move_on(length);
            }
            if self.look.from >= remaining {
                return;
            }
        }
        planned.motion_mut().copy_from(self.look.motion());
        (planned.length, planned.reaches_limit) = (self.look.from, false);
    }

    /// Ends the step at the event found in the series of the last piece, or at the end of that piece.
    fn cut(&mut self, planned: &mut Planned, length: f64, event: Option<(f64, Event)>) {
        let Search { system, base, look, work, .. } = self;
        let x = event.map_or(1.0, |(x, _)| x);
        work.powers.set(x, work.series.order);
        if event.is_some() || length < planned.length {
            work.series.evaluate(&work.powers, &mut planned.q, &mut planned.v);
            planned.length = look.from + x * length;
            planned.reaches_limit = false;
            planned.event = event.map(|(_, event)| event);
        }
        system.track(base, &work.series, &work.powers, &mut planned.tracked);
    }

    /// The first event in a piece by its power series: (share of the piece, event).
    fn first_upcrossing_in(&mut self, length: f64) -> Option<(f64, Event)> {
        let Search { system, base, look, work, .. } = self;
        let flying = system.structure.in_flight();
        let order = flight_order(flying.fastest * length, EXACT).unwrap_or(MAX_ORDER);
        // Series of oscillators lose a term where their rates enter.
        let order = (order + usize::from(system.structure.oscillators().is_some())).min(MAX_ORDER);
        let Look { from, q, v, load, is_free, .. } = &*look;
        work.series.expand_flight(flying, Motion { q, v }, LinearLoad { load, slope: &work.slope }, (length, order));
        let mut first = First::up_to(1.0);
        let expanded = Expanded { series: &work.series, factors: &ALL, substitution: None, is_start: *from == 0.0 };
        for i in (0..system.count_limits()).filter(|i| !is_free[*i]) {
            system.limit(base, i).search(system, base, &expanded, &mut first);
        }
        first.found()
    }

    /// Whether both ends of a piece prove that no limit is reached in it; if so, the search moves on to its end.
    fn piece_stays_within(&mut self, length: f64) -> bool {
        let Search { certificate, system, look, work, .. } = self;
        let (motion, loads) = (look.motion(), LinearLoad { load: &look.load, slope: &work.slope });
        let deviation = certificate.deviation(system.structure.in_flight(), motion, loads, length, &mut work.scratch);
        self.fly(length);
        let Search { system, base, look, work, .. } = self;
        let (from, to) = (look.motion(), Motion { q: &look.end_q, v: &look.end_v });
        let all_stay_within = (0..system.count_limits()).all(|i| {
            let limit = system.limit(base, i);
            let row = limit.row.in_flight();
            let at = |motion: Motion| (row.value(motion), row.rate(motion));
            look.is_free[i] || limit.keeps_off(|sense| limit.later(sense, at(from)), at(to), (length, deviation))
        });
        if all_stay_within {
            look.move_on(length, &work.slope);
        }
        all_stay_within
    }

    /// Moves the search by the exact flight over a piece of `length` seconds.
    fn move_on(&mut self, length: f64) {
        self.fly(length);
        self.look.move_on(length, &self.work.slope);
    }

    /// Writes the motion at the end of a piece, by the exact flight from the base.
    fn fly(&mut self, length: f64) {
        let Search { system, base, look, work, .. } = self;
        let Look { from, end_q, end_v, .. } = &mut **look;
        system.fly(base, *from + length, work, MotionMut { q: end_q, v: end_v });
    }
}
