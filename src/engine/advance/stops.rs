//! Stopping at events: where a discrete output changes, time stops before the change, which is made when the caller goes on
//! or asks for it.
//!
//! The run is the same to the last bit as one without stops: the step that ends at the event is planned once, and what it is
//! planned from does not change while time stands still.

use crate::engine::base::contact::Episode;
use crate::engine::base::planned::Event;
use crate::engine::base::stop::Stop;
use crate::engine::error::EngineError;
use crate::engine::excitation::segment::Segment;
use crate::engine::model::Model;
use crate::engine::state::State;

impl Model {
    /// Advances as [`Model::advance`] does, but stops at the first event that changes a discrete output: entry or release of a
    /// contact, yield, turn or collapse of a storey. The state is then that just before the event, which waits: the next advance
    /// handles it first, or [`Model::handle_event`] does.
    ///
    /// Inputs belong to the step that leads to the event: they are set when it has been handled.
    ///
    /// Returns whether an event waits. Whether a collapse has ended the run, [`Model::collapse`] says.
    ///
    /// # Errors
    /// As for [`Model::advance`].
    pub fn advance_to_event(
        &self,
        state: &mut State,
        until: f64,
        on_episode: &mut dyn FnMut(&Episode),
    ) -> Result<bool, EngineError> {
        self.advance_up_to(state, until, true, on_episode)?;
        Ok(state.has_event())
    }

    /// Handles the event that waits, if one does, and all others at the same instant. The state is that just after them then.
    ///
    /// # Errors
    /// Too many events at one instant, or numbers beyond double precision.
    #[inline]
    pub fn handle_event(&self, state: &mut State, on_episode: &mut dyn FnMut(&Episode)) -> Result<(), EngineError> {
        match state.stop {
            Stop::Waiting { end, goal } => self.handle_waiting(state, (end, goal), on_episode),
            Stop::No | Stop::Handled { .. } => Ok(()),
        }
    }

    /// Takes the step that has led to the event that waits, at `end` on the way to the time `goal`.
    #[cold]
    fn handle_waiting(
        &self,
        state: &mut State,
        (mut end, goal): (f64, f64),
        on_episode: &mut dyn FnMut(&Episode),
    ) -> Result<(), EngineError> {
        state.stop = Stop::Handled { goal };
        let mut progress = None;
        loop {
            self.take_planned(state, end, &mut progress, on_episode)?;
            if state.base.collapsed.is_some() || !self.begin_next_segment(state) {
                return Ok(());
            }
            let limit = self.limit(&state.base.segment, goal);
            if limit <= state.base.elapsed {
                return Ok(());
            }
            self.plan(state, limit);
            if state.step.planned.length > 0.0 || state.step.planned.event.is_none() {
                return Ok(());
            }
            end = state.step_end(limit);
        }
    }

    /// Stops at the end of the planned step, if an event waits there that changes a discrete output.
    pub(super) fn stop_at_event(&self, state: &mut State, end: f64, until: f64) -> bool {
        let changes_outputs = |event| !matches!(event, Event::Branch(_));
        if !state.step.planned.event.is_some_and(changes_outputs) {
            return false;
        }
        let segment = &state.base.segment;
        state.time = self.time_of(segment, end).min(until).max(state.time);
        state.stop = Stop::Waiting { end, goal: until };
        true
    }

    /// The time of an instant of a segment, s.
    fn time_of(&self, segment: &Segment, elapsed: f64) -> f64 {
        match &self.system.ground {
            Some(ground) if elapsed == segment.length => ground.end_of(segment),
            _ => segment.start + elapsed,
        }
    }
}
