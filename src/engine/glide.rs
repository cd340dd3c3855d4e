//! The common case of a run at the price of its arithmetic: whole segments of a record in which no two floors can meet.
//!
//! Nothing here is needed for correctness: what [`Model::plan`] and [`Model::take`] do segment by segment gives the same
//! state, bit for bit.

use super::model::Model;
use super::state::*;

impl Model {
    /// Flies over up to `most` whole segments that end by `until`, as long as no pair has to be looked at more closely;
    /// returns how many.
    pub(super) fn glide(&self, state: &mut State, until: f64, most: u64) -> u64 {
        let State { base, step, counters, work, .. } = state;
        let Some((ground, mut number)) = self.watched_segment(base) else { return 0 };
        let is_plain = self.structure.is_classical() && base.energy.is_none() && base.elapsed == 0.0;
        if !is_plain || step.kind != StepKind::Unknown || base.contacts.iter().any(Contact::in_contact) {
            return 0;
        }
        let mut flown = 0;
        while flown < most {
            let segment = ground.segment(number);
            if until - segment.start < segment.length {
                break;
            }
            let Some(interval) = ground.prepared(&segment) else { break };
            if !base.watch.are_all_free(number) && !self.dismiss(ground, base, number, counters, &mut work.node_v) {
                break;
            }
            let is_finite = interval.fly_on_ground(
                (&base.q, &base.v),
                (&self.structure.participation, (segment.acceleration_at(0.0), segment.slope)),
                (&mut step.q, &mut step.v),
            );
            if !is_finite {
                break;
            }
            std::mem::swap(&mut base.q, &mut step.q);
            std::mem::swap(&mut base.v, &mut step.v);
            // A pair that is dismissed is neither at the surface nor carried: its contact has no flag to clear.
            base.watch.move_on();
            self.update_peak_drift(base);
            number += 1;
            flown += 1;
        }
        if flown > 0 {
            base.segment = ground.segment(number);
            counters.flight_steps += flown;
            counters.flights_dismissed += if self.pairs.is_empty() { 0 } else { flown };
        }
        flown
    }
}
