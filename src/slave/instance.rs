//! One instance: what it is made of, and its life but for its steps (`steps.rs`).

use super::held::Held;
use super::interface::Interface;
use super::log::{Log, Message};
use super::run::Run;
use super::sequence::{Call, Phase};
use super::simulation::Simulation;
use super::snapshots::Snapshots;
use super::status::{Refusal, Status, StatusKind};
use super::stepped::{UnderWay, Updates};
use crate::FmiVersion;
use crate::description::{Category, Package, guid};
use crate::figures::plain;
use crate::scene::rule::MOST_TIME;
use crate::variables::{Settings, Table};
use std::sync::Arc;
use uuid::Uuid;

/// One instance.
#[derive(Debug)]
pub struct Slave {
    pub(super) interface: Interface,
    /// Of the FMU: its GUID, or token.
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
    pub(super) held: Option<Held>,
    pub(super) updates: Updates,
    /// A step in which the master has its turn.
    pub(super) under_way: Option<UnderWay>,
    pub(super) snapshots: Snapshots,
    pub(super) has_warned_of_ground: bool,
    /// A step has said that the run is over.
    pub(super) has_told_end: bool,
}

impl Slave {
    /// A fresh instance of what an FMU holds.
    pub fn new(package: Package, interface: Interface, log: Log) -> Slave {
        let table = Table::of_fmu(&package.scene);
        let fingerprint = package.fingerprint_with(&table, interface.version());
        let settings = Arc::new(Settings::new(package.scene, package.record.map(|packaged| packaged.record)));
        Slave {
            interface,
            fingerprint,
            table,
            run: Run::new(&settings.scene),
            held: None,
            updates: Updates::default(),
            under_way: None,
            defaults: Arc::clone(&settings),
            settings,
            phase: Phase::Instantiated,
            log,
            stop_time: None,
            snapshots: Snapshots::new(interface.version()),
            has_warned_of_ground: false,
            has_told_end: false,
        }
    }

    /// The GUID (FMI 3.0: the token) of the FMU, as its description writes it.
    pub fn guid(&self) -> String {
        guid(self.fingerprint)
    }

    /// The version of the standard whose functions it is used by.
    pub const fn version(&self) -> FmiVersion {
        self.interface.version()
    }

    /// Name of the C function of a call.
    pub(super) fn name(&self, call: Call) -> &'static str {
        call.name(self.interface.version())
    }

    /// Whether the standard allows a call now.
    ///
    /// # Errors
    /// A call that the standard does not allow in the present phase.
    #[inline(always)]
    pub fn check(&self, call: Call) -> Result<(), Refusal> {
        if call.is_allowed_in(self.phase, self.interface.version()) { Ok(()) } else { Err(self.out_of_sequence(call)) }
    }

    #[cold]
    fn out_of_sequence(&self, call: Call) -> Refusal {
        let version = self.interface.version();
        let mut phases: Vec<&str> = call.rule(version).1.iter().filter_map(|phase| phase.name(version)).collect();
        phases.dedup();
        let expected = if phases.is_empty() { "no phase of this FMU".to_owned() } else { phases.join(", ") };
        Refusal::from(format!(
            "called in phase {}: expected in {expected}",
            self.phase.name(version).unwrap_or_default()
        ))
    }

    /// Turns the result of a call into its status. After an error the standard allows little but a reset.
    #[inline]
    pub fn report(&mut self, call: Call, result: Result<Status, Refusal>) -> Status {
        result.unwrap_or_else(|refusal| self.report_refusal(call, refusal))
    }

    #[cold]
    fn report_refusal(&mut self, call: Call, refusal: Refusal) -> Status {
        self.phase = Phase::Error;
        for problem in refusal.problems {
            self.log.add(Category::StatusError, format!("{}: {problem}", self.name(call)));
        }
        Status::Error
    }

    /// Logs a failure after which the instance cannot be used.
    pub fn report_fatal(&mut self, call: Call, failure: &str) -> Status {
        self.log.add(Category::StatusFatal, format!("{}: internal failure: {failure}", self.name(call)));
        Status::Fatal
    }

    /// Whether there are messages since the last time.
    pub fn has_messages(&self) -> bool {
        self.log.has_any()
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
        self.phase = if self.interface.has_event_mode() { Phase::Event } else { Phase::StepComplete };
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

    /// As after instantiation, with the same interface and the same updates. The logging stays as the master has chosen it,
    /// and so do the snapshots.
    pub fn reset(&mut self) -> Status {
        self.settings = Arc::clone(&self.defaults);
        (self.run, self.held, self.stop_time) = (Run::new(&self.settings.scene), None, None);
        (self.has_warned_of_ground, self.has_told_end) = (false, false);
        self.phase = Phase::Instantiated;
        Status::Ok
    }

    /// Status information that there is not: nothing is ever pending.
    pub fn no_status(&mut self, call: Call, kind: StatusKind) -> Status {
        self.discard_for(call, vec![format!("there is no {kind:?} of this type")])
    }

    /// The status of a call that only asks: one that asks for what there is not is discarded, and the instance goes on.
    pub(super) fn discard_for(&mut self, call: Call, problems: Vec<String>) -> Status {
        let status = if problems.is_empty() { Status::Ok } else { Status::Discard };
        for problem in problems {
            self.log.add(Category::StatusDiscard, format!("{}: {problem}", self.name(call)));
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
