//! Communication steps, and the events at which they may end.
//!
//! The engine handles events at their own instants, whatever a master takes of them. One that takes early returns sees each
//! of them: the step ends there. With Event Mode the event waits until the master enters it, and what is read before that are
//! the values just before the event; without, it is handled at once. A master with Event Mode that takes no early returns
//! has them handled within the step; discrete outputs are held until it enters Event Mode.

use super::held::Held;
use super::instance::{Slave, is_time};
use super::sequence::{Call, Phase};
use super::simulation::Simulation;
use super::status::{Refusal, Status};
use super::stepped::{StepPart, Stepped};
use crate::FmiVersion;
use crate::description::Category;
use crate::engine::{Collapse, Episode};
use crate::figures::plain;
use crate::scene::Scene;
use crate::scene::rule::MOST_TIME;

/// Communication points may differ by the rounding of the master: s, relative to their magnitude above 1 s.
const TIME_TOLERANCE: f64 = 1e-9;

impl Slave {
    /// One communication step, s: from the last communication point, give or take the rounding of the master. Where a storey
    /// collapses the run ends: outputs are those of that time, and every further step is discarded, so that a master which
    /// does not care that the run is over does not go on with a motion that stands still.
    ///
    /// # Errors
    /// A step that does not begin at the present communication point or leads beyond the end, inputs that leave their
    /// range in it, and a step that the engine gives up ([`EngineError`](crate::engine::EngineError)).
    pub fn do_step(&mut self, current: f64, step: f64) -> Result<Stepped, Refusal> {
        let mut part = self.begin_step(current, step)?;
        loop {
            match part {
                StepPart::Done(stepped) => return Ok(stepped),
                StepPart::Update(_) => part = self.go_on()?,
            }
        }
    }

    /// The first part of such a step, up to the first turn of a master that wants updates, or all of it.
    ///
    /// # Errors
    /// Those of [`Slave::do_step`].
    #[inline(always)]
    pub fn begin_step(&mut self, current: f64, step: f64) -> Result<StepPart, Refusal> {
        if self.is_over() {
            return Ok(self.done(current + step, false));
        }
        let target = self.target(current, step)?;
        if self.updates.inputs {
            return Ok(self.wait(target, true));
        }
        self.check_lines(target)?;
        let held = self.hold()?;
        self.advance(target, held)
    }

    /// Goes on to the end of a step, or to an event in it. `held` are the discrete outputs as the master sees them until it
    /// enters Event Mode.
    #[inline]
    pub(super) fn advance(&mut self, target: f64, held: Option<Held>) -> Result<StepPart, Refusal> {
        let (returns_early, updates) = (self.interface.returns_early(), self.updates.outputs);
        let stops = returns_early || updates;
        let waits = self.with_episodes(|simulation, note| simulation.advance(target, stops, note))?;
        if waits || held.is_some() { self.end_at_events(target, waits, held) } else { Ok(self.done(target, false)) }
    }

    /// Ends a part of a step where an event waits, or discrete outputs have been held.
    #[inline(never)]
    fn end_at_events(&mut self, target: f64, waits: bool, held: Option<Held>) -> Result<StepPart, Refusal> {
        let returns_early = self.interface.returns_early();
        if waits && !(returns_early && self.interface.has_event_mode()) {
            self.handle_event()?;
        }
        if waits && !returns_early && !self.is_over() {
            self.held = held;
            return Ok(self.wait(target, false));
        }
        let is_changed = match held {
            Some(held) => self.keep(held)?,
            None => false,
        };
        Ok(self.done(target, is_changed || self.run.has_event()))
    }

    /// The step is over.
    #[inline(always)]
    fn done(&mut self, target: f64, needs_event_mode: bool) -> StepPart {
        let status = self.tell_collapse();
        let time = self.run.time();
        let is_early = self.interface.returns_early() && status == Status::Ok && time < target;
        StepPart::Done(Stepped { status, time, is_early, needs_event_mode, is_over: self.is_over() })
    }

    /// The status of a step: FMI 2.0 has no other way to say that the run has ended than to discard it. FMI 3.0 has, and a
    /// master makes one more step to hear it that has been told in Event Mode.
    #[inline]
    fn tell_collapse(&mut self) -> Status {
        match self.run.collapse() {
            Some(collapse) => self.tell(&collapse),
            None => Status::Ok,
        }
    }

    #[cold]
    fn tell(&mut self, collapse: &Collapse) -> Status {
        let text = describe_collapse(&self.settings.scene, collapse);
        if self.interface.version() == FmiVersion::V2 || std::mem::replace(&mut self.has_told_end, true) {
            return self.discard_for(Call::DoStep, vec![text]);
        }
        self.log.add(Category::Events, text);
        Status::Ok
    }

    /// `fmi3EnterEventMode`: handles the event that waits, if there is one.
    ///
    /// # Errors
    /// An instance that has been made without Event Mode, and an event that the engine gives up.
    pub fn enter_event_mode(&mut self) -> Result<(), Refusal> {
        if !self.interface.has_event_mode() {
            return Err(Refusal::from("eventModeUsed was false at instantiation: expected true".to_owned()));
        }
        self.handle_event()?;
        self.held = None;
        self.phase = Phase::Event;
        Ok(())
    }

    /// `fmi3EnterStepMode`
    pub fn enter_step_mode(&mut self) -> Status {
        self.phase = Phase::StepComplete;
        Status::Ok
    }

    /// Whether a storey has collapsed, which ends the run.
    #[inline]
    pub fn is_over(&self) -> bool {
        self.run.collapse().is_some()
    }

    /// Handles the event that waits at the present time, if one does: with the inputs that have led to it, so before any other
    /// is set.
    pub(super) fn handle_event(&mut self) -> Result<(), Refusal> {
        if !self.run.has_event() {
            return Ok(());
        }
        self.with_episodes(|simulation, note| simulation.handle_event(note))
    }

    /// Lets the engine work, and logs the contact episodes that end in it.
    fn with_episodes<T>(
        &mut self,
        work: impl FnOnce(&mut Simulation, &mut dyn FnMut(&Episode)) -> Result<T, Refusal>,
    ) -> Result<T, Refusal> {
        let Slave { run, settings, log, .. } = self;
        work(run.start(settings)?, &mut |episode| {
            if log.is_enabled(Category::Events) {
                log.add(Category::Events, describe(episode));
            }
        })
    }

    /// The discrete outputs as they are, where the master sees them change in Event Mode only although events are handled
    /// within steps.
    #[inline(always)]
    pub(super) fn hold(&mut self) -> Result<Option<Held>, Refusal> {
        if self.interface.holds_discrete_outputs() { self.read_held().map(Some) } else { Ok(None) }
    }

    #[inline(never)]
    fn read_held(&mut self) -> Result<Held, Refusal> {
        self.held = None;
        let Slave { table, run, settings, .. } = self;
        Ok(Held::read(table, &run.start(settings)?.now()))
    }

    /// Keeps them until Event Mode is entered, if any has another value by now. A run that is over has no Event Mode to come:
    /// what has ended it is shown.
    fn keep(&mut self, held: Held) -> Result<bool, Refusal> {
        let Slave { table, run, settings, .. } = self;
        let is_changed = Held::read(table, &run.start(settings)?.now()) != held;
        self.held = (is_changed && !self.is_over()).then_some(held);
        Ok(is_changed)
    }

    /// The communication point that a step leads to, or everything that is wrong with the step.
    #[inline]
    fn target(&self, current: f64, step: f64) -> Result<f64, Refusal> {
        let (now, target) = (self.run.time(), current + step);
        // Written so that a NaN is refused.
        let is_possible = begins_at(current, now) && step > 0.0 && is_time(target) && !self.is_beyond_stop(target);
        if !is_possible {
            return Err(self.refuse_step(current, step));
        }
        // A tiny step may fall short of the rounding of `current`: time stands still then, it never runs back. So it
        // does for steps whose inverse is no number.
        let stands_still = target - now < f64::MIN_POSITIVE;
        Ok(if stands_still { now } else { target })
    }

    fn is_beyond_stop(&self, target: f64) -> bool {
        self.stop_time.is_some_and(|stop| target > stop + tolerance(stop))
    }

    #[cold]
    fn refuse_step(&self, current: f64, step: f64) -> Refusal {
        let (mut problems, now, target) = (Vec::new(), self.run.time(), current + step);
        if !begins_at(current, now) {
            let expected = format!("expected {now} within {:e}", tolerance(now));
            problems.push(format!("currentCommunicationPoint = {}: {expected}", plain(current)));
        }
        if !(step.is_finite() && step > 0.0) {
            problems.push(format!("communicationStepSize = {}: expected a finite number > 0", plain(step)));
        }
        if let Some(stop) = self.stop_time.filter(|_| self.is_beyond_stop(target)) {
            let expected = format!("expected at most stopTime = {}", plain(stop));
            problems.push(format!("currentCommunicationPoint + communicationStepSize = {}: {expected}", plain(target)));
        }
        if problems.is_empty() {
            problems.push(format!("the step leads to {} s: expected a time up to {MOST_TIME:e} s", plain(target)));
        }
        Refusal { problems }
    }

    /// Whether inputs that are lines stay in their range up to a time, s: how far a line goes on is known only here.
    #[inline]
    fn check_lines(&self, target: f64) -> Result<(), Refusal> {
        if self.run.inputs().are_moving() { self.check_moving(target) } else { Ok(()) }
    }

    #[inline(never)]
    fn check_moving(&self, target: f64) -> Result<(), Refusal> {
        let beyond = self.table.problems(self.run.inputs(), target);
        let at_end = |problem| format!("at the end of the step, {target} s, {problem}");
        Refusal::unless_empty(beyond.into_iter().map(at_end).collect())
    }

    /// s, time up to which the solution is known.
    pub fn last_successful_time(&self) -> f64 {
        self.run.time()
    }
}

/// By how much communication points may differ, s.
#[inline]
fn tolerance(time: f64) -> f64 {
    TIME_TOLERANCE * time.abs().max(1.0)
}

/// Whether a step that is to begin at a time begins now, s; one that is no number does not.
#[inline]
fn begins_at(current: f64, now: f64) -> bool {
    (current - now).abs() <= tolerance(now)
}

fn describe_collapse(scene: &Scene, Collapse { building, storey, time, .. }: &Collapse) -> String {
    let name = &scene.building(*building).name;
    format!("storey {} of the {name} building has collapsed at {time:.9} s, and the run ends there", storey + 1)
}

/// An episode in one line, as the contacts are counted in the scene.
fn describe(episode: &Episode) -> String {
    let Episode { contact, start, end, approach_velocity, separation_velocity, peak_force, impulse, .. } = episode;
    let end = end.map_or("now".to_owned(), |end| format!("{end:.9} s"));
    format!(
        "contact[{}] from {start:.9} s to {end}: approach {approach_velocity:.6} m/s, separation \
         {separation_velocity:.6} m/s, peak force {peak_force:.6e} N, impulse {impulse:.6e} N s",
        contact + 1
    )
}
