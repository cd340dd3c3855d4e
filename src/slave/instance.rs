//! One instance: what it is made of, its life and its steps.

use super::log::{Log, Message};
use super::run::Run;
use super::sequence::{Call, Phase};
use super::simulation::Simulation;
use super::snapshots::Snapshots;
use super::status::{Refusal, Status, StatusKind};
use crate::description::{Category, Package, guid};
use crate::engine::{Collapse, Episode};
use crate::figures::plain;
use crate::scene::rule::MOST_TIME;
use crate::variables::{Settings, Table};
use std::sync::Arc;
use uuid::Uuid;

/// Communication points may differ by the rounding of the master: s, relative to their magnitude above 1 s.
const TIME_TOLERANCE: f64 = 1e-9;

/// One instance.
#[derive(Debug)]
pub struct Slave {
    /// Of the FMU: its GUID.
    pub(super) fingerprint: Uuid,
    pub(super) table: Table,
    /// The parameters as the scene gives them, for a reset.
    pub(super) defaults: Arc<Settings>,
    pub(super) settings: Arc<Settings>,
    pub(super) phase: Phase,
    pub(super) log: Log,
    /// s, end that the master has announced.
    pub(super) stop_time: Option<f64>,
    pub(super) run: Run,
    pub(super) snapshots: Snapshots,
    pub(super) has_warned_of_ground: bool,
}

impl Slave {
    /// A fresh instance of what an FMU holds.
    pub fn new(package: Package, log: Log) -> Slave {
        let table = Table::new(&package.scene);
        let fingerprint = package.fingerprint_with(&table);
        let settings = Arc::new(Settings::new(package.scene, package.record.map(|packaged| packaged.record)));
        Slave {
            fingerprint,
            table,
            run: Run::new(&settings.scene),
            defaults: Arc::clone(&settings),
            settings,
            phase: Phase::Instantiated,
            log,
            stop_time: None,
            snapshots: Snapshots::default(),
            has_warned_of_ground: false,
        }
    }

    /// The GUID of the FMU, as its description writes it.
    pub fn guid(&self) -> String {
        guid(self.fingerprint)
    }

    /// Whether the standard allows a call now.
    ///
    /// # Errors
    /// A call that the standard does not allow in the present phase.
    pub fn check(&self, call: Call) -> Result<(), Refusal> {
        if call.is_allowed_in(self.phase) { Ok(()) } else { Err(self.out_of_sequence(call)) }
    }

    #[cold]
    fn out_of_sequence(&self, call: Call) -> Refusal {
        let phases = call.rule().1.iter().map(|phase| format!("{phase:?}")).collect::<Vec<_>>();
        let expected = if phases.is_empty() { "no phase of this FMU".to_owned() } else { phases.join(", ") };
        Refusal::from(format!("called in phase {:?}: expected in {expected}", self.phase))
    }

    /// Turns the result of a call into its status. After an error the standard allows little but a reset.
    pub fn report(&mut self, call: Call, result: Result<Status, Refusal>) -> Status {
        let refusal = match result {
            Ok(status) => return status,
            Err(refusal) => refusal,
        };
        self.phase = Phase::Error;
        for problem in refusal.problems {
            self.log.add(Category::StatusError, format!("{}: {problem}", call.name()));
        }
        Status::Error
    }

    /// Logs a failure after which the instance cannot be used.
    pub fn report_fatal(&mut self, call: Call, failure: &str) -> Status {
        self.log.add(Category::StatusFatal, format!("{}: internal failure: {failure}", call.name()));
        Status::Fatal
    }

    /// The messages since the last time.
    pub fn take_messages(&mut self) -> Vec<Message> {
        self.log.take()
    }

    /// Chooses the log categories.
    ///
    /// # Errors
    /// Categories that there are not.
    pub fn set_debug_logging(&mut self, on: bool, categories: &[&str]) -> Result<(), Refusal> {
        self.log.choose(on, categories).map_err(|problems| Refusal { problems })
    }

    /// Start and end, s. The tolerance is only looked at: `solver.relative_tolerance` rules the accuracy.
    ///
    /// # Errors
    /// Numbers that are not finite, negative tolerances, an end before the start, times beyond what can be followed.
    pub fn setup_experiment(&mut self, tolerance: Option<f64>, start: f64, stop: Option<f64>) -> Result<(), Refusal> {
        let mut problems = Vec::new();
        if let Some(tolerance) = tolerance.filter(|tolerance| !(tolerance.is_finite() && *tolerance >= 0.0)) {
            problems.push(format!("tolerance = {}: expected a finite number >= 0", plain(tolerance)));
        }
        if !is_time(start) {
            problems
                .push(format!("startTime = {}: expected a number from -{MOST_TIME:e} to {MOST_TIME:e}", plain(start)));
        }
        if let Some(stop) = stop.filter(|stop| !(stop.is_finite() && *stop >= start)) {
            problems.push(format!(
                "stopTime = {}: expected a finite number >= startTime = {}",
                plain(stop),
                plain(start)
            ));
        }
        Refusal::unless_empty(problems)?;
        self.stop_time = stop;
        self.run.start_at(start);
        Ok(())
    }

    /// From here on everything computed can be read.
    pub fn enter_initialization(&mut self) -> Status {
        self.phase = Phase::Initialization;
        Status::Ok
    }

    /// The parameters are fixed from here on: what looks like a slip in them is said.
    ///
    /// # Errors
    /// Settings of which no model can be made.
    pub fn exit_initialization(&mut self) -> Result<(), Refusal> {
        self.start()?;
        self.phase = Phase::StepComplete;
        if self.log.is_enabled(Category::StatusWarning) {
            for warning in self.settings.warnings() {
                self.log.add(Category::StatusWarning, warning.to_string());
            }
        }
        if let Some(scaled) = self.settings.rescaled_record() {
            self.log.add(Category::Events, scaled);
        }
        Ok(())
    }

    /// No more steps.
    pub fn terminate(&mut self) -> Status {
        self.phase = Phase::Terminated;
        Status::Ok
    }

    /// As after instantiation. The logging stays as the master has chosen it, and so do the snapshots.
    pub fn reset(&mut self) -> Status {
        self.settings = Arc::clone(&self.defaults);
        (self.run, self.stop_time) = (Run::new(&self.settings.scene), None);
        self.has_warned_of_ground = false;
        self.phase = Phase::Instantiated;
        Status::Ok
    }

    /// One communication step, s: from the last communication point, give or take the rounding of the master. Where a storey
    /// collapses the run ends: the step is discarded, outputs are those of that time, and so is every further step.
    ///
    /// # Errors
    /// A step that does not begin at the present communication point or leads beyond the end, inputs that leave their
    /// range in it, and a step that the engine gives up ([`EngineError`](crate::engine::EngineError)).
    pub fn do_step(&mut self, current: f64, step: f64) -> Result<Status, Refusal> {
        if let Some(collapse) = self.run.collapse() {
            return Ok(self.discard_for(Call::DoStep, vec![describe_collapse(&collapse)]));
        }
        let target = self.target(current, step)?;
        let log_events = self.log.is_enabled(Category::Events);
        let mut events = Vec::new();
        let result = self.start()?.advance(target, &mut |episode| {
            if log_events {
                events.push(describe(episode));
            }
        });
        for event in events {
            self.log.add(Category::Events, event);
        }
        let collapse = result?.as_ref().map(describe_collapse);
        Ok(self.discard_for(Call::DoStep, collapse.into_iter().collect()))
    }

    /// Whether a storey has collapsed, which ends the run.
    pub fn is_over(&self) -> bool {
        self.run.collapse().is_some()
    }

    /// The communication point that a step leads to, or everything that is wrong with the step.
    fn target(&self, current: f64, step: f64) -> Result<f64, Refusal> {
        let (mut problems, now) = (Vec::new(), self.run.time());
        let tolerance = |time: f64| TIME_TOLERANCE * time.abs().max(1.0);
        if !(current.is_finite() && (current - now).abs() <= tolerance(now)) {
            let expected = format!("expected {now} within {:e}", tolerance(now));
            problems.push(format!("currentCommunicationPoint = {}: {expected}", plain(current)));
        }
        if !(step.is_finite() && step > 0.0) {
            problems.push(format!("communicationStepSize = {}: expected a finite number > 0", plain(step)));
        }
        let target = current + step;
        if let Some(stop) = self.stop_time.filter(|stop| target > stop + tolerance(*stop)) {
            let expected = format!("expected at most stopTime = {}", plain(stop));
            problems.push(format!("currentCommunicationPoint + communicationStepSize = {}: {expected}", plain(target)));
        }
        Refusal::unless_empty(problems)?;
        if !is_time(target) {
            return Err(Refusal::from(format!(
                "the step leads to {} s: expected a time up to {MOST_TIME:e} s",
                plain(target)
            )));
        }
        // Only here it is known how far a line goes on.
        if self.run.inputs().are_moving() {
            let beyond = self.table.problems(self.run.inputs(), target);
            let at_end = |problem| format!("at the end of the step, {target} s, {problem}");
            Refusal::unless_empty(beyond.into_iter().map(at_end).collect())?;
        }
        // A tiny step may fall short of the rounding of `current`: time stands still then, it never runs back. So it
        // does for steps whose inverse is no number.
        let stands_still = target - now < f64::MIN_POSITIVE;
        Ok(if stands_still { now } else { target })
    }

    /// s, time up to which the solution is known.
    pub fn last_successful_time(&self) -> f64 {
        self.run.time()
    }

    /// Status information that there is not: nothing is ever pending.
    pub fn no_status(&mut self, call: Call, kind: StatusKind) -> Status {
        self.discard_for(call, vec![format!("there is no {kind:?} of this type")])
    }

    /// The status of a call that only asks: one that asks for what there is not is discarded, and the instance goes on.
    pub(super) fn discard_for(&mut self, call: Call, problems: Vec<String>) -> Status {
        let status = if problems.is_empty() { Status::Ok } else { Status::Discard };
        for problem in problems {
            self.log.add(Category::StatusDiscard, format!("{}: {problem}", call.name()));
        }
        status
    }

    /// The solution at the present time.
    #[inline]
    pub(super) fn start(&mut self) -> Result<&mut Simulation, Refusal> {
        self.run.start(&self.settings)
    }
}

/// Whether motion can be followed at a time, s.
pub(super) fn is_time(time: f64) -> bool {
    time.abs() <= MOST_TIME
}

fn describe_collapse(Collapse { side, storey, time, .. }: &Collapse) -> String {
    format!("storey {} of the {side} building has collapsed at {time:.9} s, and the run ends there", storey + 1)
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
