//! The common case of a run at the price of its arithmetic: whole segments of a record in which no two floors can meet.
//!
//! Nothing here is needed for the result: `plan` and `take` do the same segment by segment, bit for bit.

use super::ground::GroundMotion;
use super::model::Model;
use super::state::*;

impl Model {
    /// Flies over up to `most` whole segments that end by `until`, as long as no pair has to be looked at more closely;
    /// returns how many.
    pub(super) fn glide(&self, state: &mut State, until: f64, most: u64) -> u64 {
        let State { base, step, .. } = state;
        if step.kind != StepKind::Unknown || until - base.segment.start < base.segment.length {
            return 0;
        }
        let Some((ground, first)) = self.watched_segment(base) else { return 0 };
        let is_plain = self.structure.is_classical() && base.energy.is_none() && base.elapsed == 0.0;
        if !is_plain
            || base.coordinates != Coordinates::Modes
            || base.contacts.iter().any(|contact| contact.in_contact() || contact.at_surface)
        {
            return 0;
        }
        let flown = fly_over(self, ground, state, (first, most), until);
        if flown > 0 {
            state.base.segment = ground.segment(first + flown);
            state.counters.flight_steps += flown;
            state.counters.flights_dismissed += if self.pairs.is_empty() { 0 } else { flown };
        }
        flown
    }
}

/// The loop over segments, from number `first` on. Wide instructions are chosen where the machine has them; they do the
/// same operations in the same order, so they give the same bits.
#[multiversion::multiversion(targets("x86_64+avx2"))]
fn fly_over(model: &Model, ground: &GroundMotion, state: &mut State, (first, most): (u64, u64), until: f64) -> u64 {
    let State { base, step, counters, work, .. } = state;
    for number in first..first.saturating_add(most) {
        let segment = ground.segment(number);
        if until - segment.start < segment.length {
            return number - first;
        }
        let Some(interval) = ground.prepared(&segment) else { return number - first };
        let is_free = base.watch.are_all_free(number);
        if !is_free && !model.dismiss(ground, base, number, counters, &mut work.node_v) {
            return number - first;
        }
        let is_finite = interval.fly_on_ground(
            (&base.q, &base.v),
            (&model.structure.participation, (segment.acceleration_at(0.0), segment.slope)),
            (&mut step.q, &mut step.v),
        );
        if !is_finite {
            return number - first;
        }
        std::mem::swap(&mut base.q, &mut step.q);
        std::mem::swap(&mut base.v, &mut step.v);
        // No contact has a flag to clear: none was at the surface at the start, and one that is carried is not dismissed.
        base.watch.move_on();
        model.update_peak_drift(base);
    }
    most
}
