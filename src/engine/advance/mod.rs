//! The algorithm's outer loop: plan a step, take it, handle its event, until the communication time is reached.

pub mod choose;
pub mod events;
pub mod stops;

use crate::engine::base::Base;
use crate::engine::base::contact::Episode;
use crate::engine::base::planned::{At, Planned};
use crate::engine::budget::Progress;
use crate::engine::error::EngineError;
use crate::engine::excitation::inputs::Inputs;
use crate::engine::excitation::segment::Segment;
use crate::engine::model::Model;
use crate::engine::state::{State, Workspace};
use crate::engine::step::{Step, StepKind};
use crate::engine::yielding::element::ElementOf;
use crate::structure::BuildingId;

/// The collapse of a storey, which ends a run.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Collapse {
    /// Its building.
    pub building: BuildingId,
    /// Counted from 0.
    pub storey: usize,
    /// s.
    pub time: f64,
}

impl Model {
    /// Advances the state to the time `until`, s, and reports each episode when it ends.
    ///
    /// With a record inside, the engine's own steps end at segments, events and where series end, whatever `until` is.
    /// Where a master drives the ground or the floors, its input changes at communication points, so that steps end
    /// there too.
    ///
    /// A run ends where a storey collapses: the state stays at that time, which is returned, and goes no further.
    ///
    /// # Errors
    /// Too much work for one communication step, steps shorter than the time can resolve, or numbers beyond double
    /// precision, each with what to change in the scene. The state then still has the time that it came with, and its
    /// motion is what had been reached: it can be read, and restored from what was saved before.
    #[inline]
    pub fn advance(
        &self,
        state: &mut State,
        until: f64,
        on_episode: &mut dyn FnMut(&Episode),
    ) -> Result<Option<Collapse>, EngineError> {
        self.advance_up_to(state, until, false, on_episode)?;
        Ok(self.collapse(state))
    }

    /// The same, but where it `stops` no further than to the next event that changes a discrete output.
    fn advance_up_to(
        &self,
        state: &mut State,
        until: f64,
        stops: bool,
        on_episode: &mut dyn FnMut(&Episode),
    ) -> Result<(), EngineError> {
        self.handle_event(state, on_episode)?;
        if state.base.collapsed.is_some() {
            return Ok(());
        }
        let resumed = std::mem::take(&mut state.stop).resumed(until);
        let until = resumed.unwrap_or(until);
        if resumed.is_none() {
            self.begin_step(state, until);
        }
        self.check_segments(state, until)?;
        self.go_on(state, until, stops, on_episode)?;
        if !state.has_event() {
            state.time = if state.base.collapsed.is_some() { state.base.time().min(until) } else { until };
        }
        Ok(())
    }

    /// Begins a communication step up to a time, s: where a master drives, its inputs are those of now.
    fn begin_step(&self, state: &mut State, until: f64) {
        if self.system.ground.is_none() {
            // The ground as it is from here to `until`: no second copy of the input, which may be set anew at `until`
            // while the base still stands at the end of this segment.
            let input = &state.inputs.ground_acceleration;
            state.base.segment = Segment::under_input(state.time, until - state.time, input);
            state.base.elapsed = 0.0;
        }
        if self.system.is_driven() {
            state.step.kind = StepKind::NotPlanned;
        }
    }

    /// The collapse that has ended the run of a state, if one has.
    #[inline]
    pub fn collapse(&self, state: &State) -> Option<Collapse> {
        state.base.collapsed.and_then(|element| self.collapse_of(element, state.time))
    }

    #[cold]
    fn collapse_of(&self, element: usize, time: f64) -> Option<Collapse> {
        match self.system.elements[element].place {
            ElementOf::Storey(id, storey) => Some(Collapse { building: id, storey, time }),
            ElementOf::Link(_) => None,
        }
    }

    /// Advances step by step, up to the next event if it `stops` there.
    fn go_on(
        &self,
        state: &mut State,
        until: f64,
        stops: bool,
        on_episode: &mut dyn FnMut(&Episode),
    ) -> Result<(), EngineError> {
        let mut progress = None;
        loop {
            let segment = &state.base.segment;
            let limit = self.limit(segment, until);
            if limit > state.base.elapsed || !self.system.is_driven() {
                self.plan(state, limit);
                let segment = &state.base.segment;
                let end = state.step_end(limit);
                if self.ends_after(segment, end, until) || stops && self.stop_at_event(state, end, until) {
                    break;
                }
                self.take_planned(state, end, &mut progress, on_episode)?;
                if state.base.collapsed.is_some() {
                    break;
                }
            }
            if !self.begin_next_segment(state) {
                break;
            }
            if self.system.is_driven() && state.base.elapsed >= limit {
                break;
            }
        }
        Ok(())
    }

    /// Takes the planned step, which ends at `end` (s since the segment's start), and looks at what has come of it.
    fn take_planned(
        &self,
        state: &mut State,
        end: f64,
        progress: &mut Option<Progress>,
        on_episode: &mut dyn FnMut(&Episode),
    ) -> Result<(), EngineError> {
        if state.step.planned.is_cleared {
            // Of these there are no more than segments, which have been counted before, and no bounds clear what is no number.
            self.take_cleared(state, end);
            return Ok(());
        }
        let progress = progress.get_or_insert_with(|| self.progress(state));
        progress.note(end > state.base.elapsed);
        self.take(state, end, on_episode);
        self.check_numbers(state)?;
        self.check_progress(state, progress)
    }

    /// Goes on to the next segment where the base is at the end of its own; `false` where there is none.
    fn begin_next_segment(&self, state: &mut State) -> bool {
        if state.base.elapsed >= state.base.segment.length {
            let Some(ground) = &self.system.ground else { return false };
            state.base.segment = ground.following(&state.base.segment);
            state.base.elapsed = 0.0;
        }
        true
    }

    /// The latest end of a step, s since the start of the segment.
    #[inline]
    pub(in crate::engine) fn limit(&self, segment: &Segment, until: f64) -> f64 {
        if self.system.is_driven() && self.ends_after(segment, segment.length, until) {
            return segment.length.min(until - segment.start);
        }
        segment.length
    }

    /// Whether a step, which ends `end` seconds after the start of the segment, ends after a time, s. The end of a whole
    /// segment of a record is the time of its sample, whatever rounding makes of the difference.
    fn ends_after(&self, segment: &Segment, end: f64, time: f64) -> bool {
        match &self.system.ground {
            Some(ground) if end == segment.length => time < ground.end_of(segment),
            _ => time - segment.start < end,
        }
    }

    /// Takes a flight for which bounds have cleared all pairs and elements: nothing but the motion changes, since no
    /// contact is closed or at its surface, and no element yields.
    fn take_cleared(&self, state: &mut State, end: f64) {
        let State { base, step, inputs, counters, work, .. } = state;
        self.system.add_work(&mut At { base, inputs, counters }, step, work.for_energy());
        self.raise_over_flight(base, step, inputs, work);
        std::mem::swap(&mut base.q, &mut step.planned.q);
        std::mem::swap(&mut base.v, &mut step.planned.v);
        base.elapsed = end;
        base.leave_cleared_flight();
        step.kind = StepKind::NotPlanned;
    }

    /// Takes the planned step, which ends at `end` (s since the segment's start), and handles its event.
    ///
    /// The order must not change. The step is a function of the base that it was planned from: whatever integrates it,
    /// or follows it, has to see that base and comes first. Then the base moves to the end, each part after those that
    /// it is worked out from.
    fn take(&self, state: &mut State, end: f64, on_episode: &mut dyn FnMut(&Episode)) {
        let State { base, step, inputs, counters, work, .. } = state;
        // Work integrates the step from the motion, the contacts and the elements at its start.
        self.system.add_work(&mut At { base, inputs, counters }, step, work.for_energy());
        // So do impulses and peaks. From here on forces, impulses and work of closed contacts are those of the end, and
        // all else is still that of the start.
        self.follow_and_raise(base, step, inputs, end, work);
        // The time map of a series reads the age at the start: it goes on only when the series has been followed.
        let Step { planned, .. } = &mut *step;
        base.contacts.iter_mut().filter(|contact| contact.in_contact()).for_each(|c| c.age += planned.length);
        // The motion of the base is that of the end, still about the position of rest of the start; `planned` has the
        // old one, which nothing reads any more.
        std::mem::swap(&mut base.q, &mut planned.q);
        std::mem::swap(&mut base.v, &mut planned.v);
        // From here on `base.time()` is the end of the step.
        base.elapsed = end;
        // Plastic drifts move the position of rest, and with it `q` and the gaps at rest: before anything is measured
        // from them.
        self.move_elements(base, step);
        let Step { planned, .. } = &mut *step;
        // What planned the length of this step says where the next one begins to look; an entry, below, forgets it.
        base.last_length = planned.next_length.unwrap_or(base.last_length);
        // Penetrations of open contacts are measured on `q` with the new gaps; of closed ones the step knows them
        // better.
        self.move_contacts(base, planned);
        self.system.track_on(base, inputs, &mut work.buffers);
        // Floors that are held together are put together again, by what rounding has moved them apart: after the
        // contacts, whose phases say which they are and whose penetrations do not change by it.
        self.system.project_constraints(base, &mut work.buffers);
        // That may have moved an element that yields off its limit: it is put back by plastic drift, not by its floors.
        self.anchor_elements(base);
        // The event sees all of this at its instant, and begins or ends what changes there.
        if let Some(event) = planned.event {
            counters.events += 1;
            base.clearance.restart();
            work.log.close(base.motion());
            self.system.settle(base, work.for_energy());
            work.note(event, base.time());
            let Base { oscillates, q, v, .. } = base;
            self.system.to_modes((oscillates, q, v), [&mut work.buffers.q, &mut work.buffers.v]);
            self.handle(base, event, inputs, &mut work.buffers, on_episode);
        }
        // Rates are those of the floors from now on, of which the step has other last digits, and impulses elsewhere
        // change them at once: the forces that are read from here on count.
        base.raise_peak_forces();
        // The base has moved: the step that was planned from the old one means nothing.
        step.kind = StepKind::NotPlanned;
    }

    /// Moves the elements, and with them the position of rest, to the end of the planned step, whose motion is that of
    /// the base by now.
    fn move_elements(&self, base: &mut Base, step: &Step) {
        if base.elements.is_empty() || step.planned.length == 0.0 {
            return;
        }
        base.elements.iter_mut().for_each(|element| element.turned = None);
        if !base.is_yielding() {
            return;
        }
        for i in 0..base.elements.len() {
            let (from, element) = (base.elements[i], &mut base.elements[i]);
            step.move_element(i, step.end_powers(), element);
            self.system.elements[i].move_rest(base.coordinates, (&from, element), &mut base.q);
        }
        self.set_rest(base);
    }

    /// Puts each element that yields exactly on its limit: what rounding has added up, or floors that are held together
    /// have been moved by to stay so, is plastic drift.
    fn anchor_elements(&self, base: &mut Base) {
        if !base.is_yielding() {
            return;
        }
        for i in 0..base.elements.len() {
            let (of, (&from, centre)) = self.system.element_at(i, &base.elements);
            let Some(sense) = from.yields else { continue };
            let excess = of.excess(centre, sense, of.drift(base.coordinates, &base.q));
            let element = &mut base.elements[i];
            element.plastic += sense.sign() * excess;
            element.furthest = element.furthest.max(element.plastic.abs());
            of.move_rest(base.coordinates, (&from, element), &mut base.q);
        }
        self.set_rest(base);
    }

    /// Moves penetrations and rates of the contacts to the end of the planned step.
    fn move_contacts(&self, base: &mut Base, planned: &Planned) {
        if !planned.ends.is_empty() {
            base.clearance.move_on(1);
            for (p, (contact, end)) in base.contacts.iter_mut().zip(&planned.ends).enumerate() {
                contact.leave_surface();
                if let Some((penetration, rate)) = *end {
                    base.clearance.set_known(p);
                    (contact.penetration, contact.rate) = (penetration, rate);
                }
            }
            return;
        }
        // A zero-length step keeps the stored penetration, which may be more accurate than the floors' displacements
        // give it.
        if planned.length == 0.0 {
            return;
        }
        base.clearance.move_on(1);
        base.clearance.set_all_known();
        let mut contacts = std::mem::take(&mut base.contacts);
        for ((p, contact), (pair, tracked)) in
            contacts.iter_mut().enumerate().zip(self.system.pairs.iter().zip(&planned.tracked))
        {
            contact.at_surface = false;
            contact.let_go = false;
            contact.undecided = false;
            if contact.is_held() {
                continue;
            }
            contact.tracked = false;
            if let Some((penetration, rate)) = *tracked {
                (contact.penetration, contact.rate) = (penetration, rate);
                contact.tracked = true;
                continue;
            }
            // That of a closed contact the step has followed.
            if !contact.in_contact() {
                contact.penetration = pair.row.value_at(base) - base.rest.gaps[p];
            }
            contact.rate = pair.row.rate_at(base);
        }
        base.contacts = contacts;
    }

    /// Logs the planned flight, or raises the peaks over it.
    fn raise_over_flight(&self, base: &mut Base, step: &Step, inputs: &Inputs, work: &mut Workspace) {
        let peaks = self.peaks();
        match () {
            _ if self.watched.rows.are_none() || step.planned.length == 0.0 => {}
            _ if peaks.logs_flights() => peaks.log_flight(base, step, inputs, work.for_log()),
            _ => peaks.raise_over_flight(base, step, inputs, &mut work.for_peaks()),
        }
    }

    /// Moves the contacts through the step to its end, and logs it or raises the peaks over it.
    fn follow_and_raise(&self, base: &mut Base, step: &Step, inputs: &Inputs, end: f64, work: &mut Workspace) {
        let (peaks, start) = (self.peaks(), base.time());
        if step.is_flight() {
            return self.raise_over_flight(base, step, inputs, work);
        }
        peaks.note_first_forces(&base.contacts, &mut work.for_peaks());
        step.follow(&self.system, &mut base.contacts, start);
        if !self.watched.rows.are_none() && step.planned.length > 0.0 {
            peaks.raise_over_step(base, step, inputs, end, &mut work.for_peaks());
        }
    }
}
