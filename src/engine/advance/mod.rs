//! Advancing: plan a step, take it, handle its event, until the communication time is reached.

pub mod budget;
pub mod fast_flight;

use crate::contact::EpisodeForce;
use crate::engine::base::contact::Contact;
use crate::engine::base::contact::Episode;
use crate::engine::base::planned::Event;
use crate::engine::base::{Base, Coordinates};
use crate::engine::error::EngineError;
use crate::engine::excitation::segment::Segment;
use crate::engine::model::Model;
use crate::engine::state::{State, Workspace};
use crate::engine::step::{Step, StepKind};
use crate::numerics::powers::Powers;
use crate::structure::LANES;

impl Model {
    /// Brings the state to a time, s, and reports each episode when it ends.
    ///
    /// With a record inside, the engine's own steps are segments, events and contact steps, whatever `until` is.
    /// Where a master drives the ground or the floors, its input acts from one communication point to the next, so
    /// these cut the steps too.
    pub fn advance(
        &self,
        state: &mut State,
        until: f64,
        on_episode: &mut dyn FnMut(&Episode),
    ) -> Result<(), EngineError> {
        if self.ground.is_none() {
            let input = &state.inputs.ground_acceleration;
            state.base.segment = Segment::under_input(state.time, until - state.time, input);
            state.base.elapsed = 0.0;
        }
        if self.is_driven() {
            state.step.kind = StepKind::Unknown;
        }
        self.check_segments(state, until)?;
        let glide = self.glide(state, until, self.most_flights as u64);
        if !glide.has_arrived {
            self.go_on(state, until, glide.flown, on_episode)?;
        }
        state.time = until;
        Ok(())
    }

    /// Advances from where gliding has ended, over so many segments.
    #[inline(never)]
    fn go_on(
        &self,
        state: &mut State,
        until: f64,
        flown: u64,
        on_episode: &mut dyn FnMut(&Episode),
    ) -> Result<(), EngineError> {
        let mut progress = self.progress(state, flown);
        loop {
            let segment = &state.base.segment;
            let limit = self.limit(segment, until);
            if limit > state.base.elapsed || !self.is_driven() {
                self.plan(state, limit);
                let segment = &state.base.segment;
                let end = state.step_end(limit);
                if until - segment.start < end {
                    break;
                }
                progress.note(end > state.base.elapsed);
                self.take(state, end, on_episode);
                self.check_numbers(state)?;
                self.check_progress(state, &progress)?;
            }
            if state.base.elapsed >= state.base.segment.length {
                let Some(ground) = &self.ground else { break };
                state.base.segment = ground.following(&state.base.segment);
                state.base.elapsed = 0.0;
            } else if self.is_driven() && state.base.elapsed >= limit {
                break;
            }
            let glide = self.glide(state, until, progress.flights_left(&state.counters));
            if glide.flown > 0 {
                progress.note(true);
            }
            if glide.has_arrived {
                break;
            }
        }
        Ok(())
    }

    /// Where a step has to end, s since the start of the segment.
    pub(in crate::engine) fn limit(&self, segment: &Segment, until: f64) -> f64 {
        if self.is_driven() { segment.length.min(until - segment.start) } else { segment.length }
    }

    /// Works out the next step, unless that has been done already.
    pub(in crate::engine) fn plan(&self, state: &mut State, limit: f64) {
        match state.step.kind {
            StepKind::Unknown => {}
            StepKind::Glide => self.forget_glide(state),
            _ => return,
        }
        if state.base.contacts.iter().any(Contact::in_contact) {
            self.plan_contact(state, limit);
        } else {
            self.plan_flight(state, limit);
        }
    }

    /// Takes the planned step, which ends at `end` (s since the segment's start), and handles its event.
    fn take(&self, state: &mut State, end: f64, on_episode: &mut dyn FnMut(&Episode)) {
        self.add_work(state, state.step.length);
        let State { base, step, inputs, counters, work, .. } = state;
        let start = base.time();
        let is_watched = !self.peak_rows.are_none() && step.length > 0.0;
        match step.kind {
            StepKind::Flight if is_watched => self.raise_over_flight(base, step, inputs, work),
            _ => self.note_starts(&base.contacts, work),
        }
        self.follow(&mut base.contacts, step, start);
        if is_watched && step.kind != StepKind::Flight {
            self.raise_over_step(base, step, inputs, end, work);
        }
        base.contacts.iter_mut().filter(|contact| contact.in_contact()).for_each(|contact| contact.age += step.length);
        std::mem::swap(&mut base.q, &mut step.q);
        std::mem::swap(&mut base.v, &mut step.v);
        base.elapsed = end;
        base.last_length = step.next_length.unwrap_or(base.last_length);
        self.move_contacts(base, step);
        self.keep_together(base, work);
        if let Some(event) = step.event {
            counters.events += 1;
            base.watch.restart();
            work.peaks.restart();
            self.handle(base, event, work, on_episode);
        }
        step.kind = StepKind::Unknown;
    }

    /// Follows the contacts to the end of a step, which has begun at `start` [s].
    fn follow(&self, contacts: &mut [Contact], step: &Step, start: f64) {
        match step.kind {
            StepKind::Onset => {
                let x = step.length / step.onset.scale;
                contacts.iter_mut().filter(|c| c.in_contact()).for_each(|c| c.follow_onset(&step.onset, x, start));
            }
            StepKind::Window => {
                contacts
                    .iter_mut()
                    .filter(|c| c.in_contact())
                    .for_each(|c| c.follow_window(&step.window, step.length, start));
            }
            StepKind::Contact if step.length > 0.0 => {
                step.closed.follow(contacts, &step.series, start, &step.end);
                for (terms, &p) in step.reactions.iter().zip(&self.rigid.pairs) {
                    if contacts[p].is_held() {
                        contacts[p].follow_reaction(terms, step.reaction_order, step.series.scale, start, &step.end);
                    }
                }
            }
            _ => {}
        }
    }

    /// Follows one contact, `elapsed` seconds into a step that has begun at `start` [s]; for a series in time, `powers`
    /// are those of that time.
    pub(in crate::engine) fn follow_one(
        &self,
        contact: &mut Contact,
        step: &Step,
        elapsed: f64,
        start: f64,
        powers: &Powers,
    ) {
        let p = contact.episode.contact;
        match step.kind {
            StepKind::Onset => contact.follow_onset(&step.onset, elapsed / step.onset.scale, start),
            StepKind::Window if elapsed > 0.0 => contact.follow_window(&step.window, elapsed, start),
            StepKind::Contact if elapsed > 0.0 && contact.is_held() => {
                let reaction = self.rigid.pairs.iter().position(|&pair| pair == p).map(|k| &step.reactions[k]);
                if let Some(terms) = reaction {
                    contact.follow_reaction(terms, step.reaction_order, step.series.scale, start, powers);
                }
            }
            StepKind::Contact if elapsed > 0.0 => step.closed.follow_one(contact, &step.series, start, powers),
            _ => {}
        }
    }

    /// Penetrations and rates at the end of a step.
    fn move_contacts(&self, base: &mut Base, step: &Step) {
        if !step.ends.is_empty() {
            base.watch.move_on(1);
            for (p, (contact, end)) in base.contacts.iter_mut().zip(&step.ends).enumerate() {
                contact.at_surface = false;
                contact.let_go = false;
                contact.carried = false;
                if let Some((penetration, rate)) = *end {
                    base.watch.set_known(p);
                    (contact.penetration, contact.rate) = (penetration, rate);
                }
            }
            return;
        }
        // What a step without length has not moved keeps what is known of it, which may be more than its floors tell.
        if step.length == 0.0 {
            return;
        }
        base.watch.move_on(1);
        base.watch.set_all_known();
        let (coordinates, q, v) = (base.coordinates, &base.q, &base.v);
        for ((p, contact), (pair, carried)) in
            base.contacts.iter_mut().enumerate().zip(self.pairs.iter().zip(&step.carried))
        {
            contact.at_surface = false;
            contact.let_go = false;
            contact.undecided = false;
            if contact.is_held() {
                continue;
            }
            contact.carried = false;
            if let Some((penetration, rate)) = *carried {
                (contact.penetration, contact.rate) = (penetration, rate);
                contact.carried = self.is_close(p, penetration, coordinates, q);
                continue;
            }
            if !contact.in_contact() {
                contact.penetration = pair.relative(coordinates, q) - pair.gap;
            }
            contact.rate = pair.relative(coordinates, v);
        }
    }

    fn handle(&self, base: &mut Base, event: Event, work: &mut Workspace, on_episode: &mut dyn FnMut(&Episode)) {
        let time = base.time();
        match event {
            Event::Entry(p) if self.pairs[p].law.is_rigid() => {
                self.convert(base, Coordinates::Modes, &mut work.q);
                self.meet(base, p, work, on_episode);
            }
            Event::Entry(p) => {
                let contact = &mut base.contacts[p];
                contact.penetration = 0.0;
                // What enters does not move apart but for rounding.
                contact.rate = self.pairs[p].difference(base.coordinates, &base.v).0.max(0.0);
                contact.at_surface = true;
                let (pair, approach) = (&self.pairs[p], contact.rate.max(self.least_approach));
                contact.force = EpisodeForce::new(&pair.law, pair.mass, Some(approach));
                contact.begin(time, contact.rate);
                base.impacts += 1;
                // The first series of an episode finds its own scale.
                base.last_length = 0.0;
            }
            Event::Release(p) => base.release(p, on_episode),
            Event::Branch(p) => base.contacts[p].change_branch(),
        }
    }

    /// Nothing may run on without numbers.
    fn check_numbers(&self, state: &State) -> Result<(), EngineError> {
        let base = &state.base;
        // A sum is finite only if all of its terms are.
        let contacts: f64 =
            base.contacts.iter().map(|contact| contact.impulse + contact.work + contact.peak_force).sum();
        let account = base.energy.map_or(0.0, |account| account.largest);
        if (lanes_sum(&base.q) + lanes_sum(&base.v) + contacts + account).is_finite() {
            return Ok(());
        }
        Err(self.overflow(base))
    }

    #[cold]
    fn overflow(&self, base: &Base) -> EngineError {
        // Afterwards nothing has numbers: of the contacts that were closed the stiffest is the likeliest cause.
        let closed = base.contacts.iter().enumerate().filter(|(_, contact)| contact.in_contact());
        let stiffness = |p: usize| self.pairs[p].law.stiffness;
        let contact = closed.map(|(p, _)| p).max_by(|&p, &other| stiffness(p).total_cmp(&stiffness(other)));
        let place = contact.map_or(String::new(), |p| {
            let law = &self.pairs[p].law;
            let stiffness = match law.is_rigid() {
                true => String::new(),
                false => format!(", whose stiffness is {:e}", law.stiffness),
            };
            format!(" at contact[{}]{stiffness}", p + 1)
        });
        EngineError {
            message: format!(
                "the motion exceeds what double precision can hold at t = {} s{place}; check the units of masses, \
                 stiffnesses, gaps and ground acceleration",
                base.time()
            ),
        }
    }
}

/// Sum of a modal vector.
fn lanes_sum(modal: &[f64]) -> f64 {
    let mut sum = [0.0; LANES];
    for modal in modal.as_chunks::<LANES>().0 {
        for i in 0..LANES {
            sum[i] += modal[i];
        }
    }
    sum.iter().sum()
}

impl State {
    /// Where the planned step ends, s since the start of the segment: by the `limit`, whatever rounding adds.
    pub(in crate::engine) fn step_end(&self, limit: f64) -> f64 {
        if self.step.reaches_limit { limit } else { (self.base.elapsed + self.step.length).min(limit) }
    }
}
