//! Everything that changes during a run: plain data, cloned to save it.

use crate::collocation::{MOST_PAIRS, WindowWorkspace};
use crate::engine::base::counters::Counters;
use crate::engine::base::planned::Event;
use crate::engine::base::stop::Stop;
use crate::engine::base::{Account, Base};
use crate::engine::energy::Accounting;
use crate::engine::excitation::inputs::{Input, Inputs};
use crate::engine::flight::log::FlightLog;
use crate::engine::flight::workspace::Look;
use crate::engine::model::Model;
use crate::engine::peaks::room::{PeakRoom, PeakWork};
use crate::engine::step::{Step, StepKind};
use crate::engine::system::buffers::Buffers;
use crate::structure::BuildingId;

/// Everything that changes during a run.
///
/// `base` is the end of the engine's last own step at or before the communication time, and `step` is the dense
/// solution from there on. `step` follows from `base` and the inputs alone; with a record inside it does not depend on
/// the communication points.
///
/// Where a master drives the ground or the floors, it sets them between two calls of [`Model::advance`]:
///
/// ```
/// use pounding::engine::{BuildingId, Input, Model, Output, Point};
///
/// # let scene = pounding::scene::Scene::from_toml(
/// #     "name = \"Mast\"\n\
/// #     left = { mass = [1e3], stiffness = [1e5], damping = { ratio = 0.0 } }",
/// # )?;
/// let model = Model::new(&scene, None)?;
/// let (mut state, mut point) = (model.start(0.0), Point::default());
/// state.set_input(Input::GroundAcceleration, 1.0); // m/s2, held from here on
/// model.advance(&mut state, 0.05, &mut |_| ())?;
/// let now = model.observe(&state, &mut point);
/// // The mast swings with 10 rad/s about the displacement at which its spring takes the ground along.
/// let exact = -1.0 / 100.0 * (1.0 - f64::cos(10.0 * 0.05));
/// assert!((now.read(Output::Displacement(BuildingId::LEFT, 0)) - exact).abs() < 1e-15);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct State {
    /// The communication time, s.
    pub(in crate::engine) time: f64,
    pub(in crate::engine) stop: Stop,
    pub(in crate::engine) base: Base,
    pub(in crate::engine) step: Step,
    pub(in crate::engine) inputs: Inputs,
    pub(in crate::engine) counters: Counters,
    pub(in crate::engine) work: Workspace,
}

impl State {
    /// The communication time, s.
    pub fn time(&self) -> f64 {
        self.time
    }

    /// Time from the base to the present, s, as far as the planned step reaches.
    pub(in crate::engine) fn since_base(&self) -> f64 {
        match self.step.kind {
            StepKind::NotPlanned => 0.0,
            // Here the difference of two times would be less exact.
            _ if self.has_event() => self.step.planned.length,
            _ => (self.time - (self.base.segment.start + self.base.elapsed)).max(0.0),
        }
    }

    /// Whether time has stopped at an event, which waits to be handled.
    pub fn has_event(&self) -> bool {
        matches!(self.stop, Stop::Waiting { .. })
    }

    /// The counts of work so far.
    pub fn counters(&self) -> Counters {
        self.counters
    }

    /// From now on notes the instants at which storeys begin to yield or turn back; unasked, nothing is noted.
    pub fn note_switches(&mut self) {
        self.work.switches.get_or_insert_default();
    }

    /// The instants, s, at which storeys have begun to yield or have turned back since [`State::note_switches`], ascending.
    /// They are those of the run that this state has made: no saved state holds them.
    pub fn switches(&self) -> &[f64] {
        self.work.switches.as_deref().unwrap_or_default()
    }

    /// The inputs as set so far.
    pub fn inputs(&self) -> &Inputs {
        &self.inputs
    }

    /// Sets an input at the present time, in its unit. It is constant from now on, unless a rate is set for the same
    /// time. One that the scene does not have is left alone.
    pub fn set_input(&mut self, input: Input, value: f64) {
        self.change(input, |inputs, time| inputs.set(input, value, time));
    }

    /// Sets the rate of an input, per second, from now on until the input or its rate is set again.
    pub fn set_input_rate(&mut self, input: Input, rate: f64) {
        self.change(input, |inputs, time| inputs.set_rate(input, rate, time));
    }

    /// Where an input goes on in another way than before, so does a step that an event has interrupted.
    fn change(&mut self, input: Input, change: impl FnOnce(&mut Inputs, f64)) {
        let before = self.inputs.get(input);
        change(&mut self.inputs, self.time);
        let now = self.inputs.get(input);
        let is_same = (before.at(self.time), before.slope()) == (now.at(self.time), now.slope());
        if !is_same && !self.has_event() {
            self.stop = Stop::No;
        }
    }

    /// Sets the ground acceleration, m/s2, at the present time; used only where the scene has no record. It is constant
    /// from now on, unless a rate is set for the same time.
    pub fn set_ground_acceleration(&mut self, acceleration: f64) {
        self.set_input(Input::GroundAcceleration, acceleration);
    }

    /// Sets the rate of the ground acceleration, m/s3, from now on until the acceleration or its rate is set again.
    pub fn set_ground_acceleration_rate(&mut self, rate: f64) {
        self.set_input_rate(Input::GroundAcceleration, rate);
    }

    /// Sets the force on a floor, counted from 0, N, at the present time; used only where the scene has floor forces.
    /// It is constant from now on, unless a rate is set for the same time.
    pub fn set_floor_force(&mut self, id: BuildingId, floor: usize, force: f64) {
        self.set_input(Input::Force(id, floor), force);
    }

    /// Sets the rate of the force on a floor, N/s, from now on until the force or its rate is set again.
    pub fn set_floor_force_rate(&mut self, id: BuildingId, floor: usize, rate: f64) {
        self.set_input_rate(Input::Force(id, floor), rate);
    }
}

/// Scratch memory of all kinds of steps; its content means nothing between calls, but for what is logged and the
/// noted instants.
#[derive(Clone, Debug)]
pub(super) struct Workspace {
    pub buffers: Buffers,
    pub look: Look,
    pub windows: WindowWorkspace,
    pub peaks: PeakRoom,
    /// The flights over which the peaks of the base have not been raised yet.
    pub log: FlightLog,
    /// The flights whose work the energy account of the base does not have yet.
    pub waiting: FlightLog,
    /// The instants at which storeys have begun to yield or turned, s, where somebody asks for them.
    pub switches: Option<Vec<f64>>,
}

impl Workspace {
    /// Notes an event at a time, s, if it is one of storeys and somebody asks for them.
    pub(super) fn note(&mut self, event: Event, time: f64) {
        if let (Some(switches), Event::Yield(..) | Event::Turn(_)) = (&mut self.switches, event) {
            switches.push(time);
        }
    }

    /// The part of it that the peaks use.
    pub(super) fn for_peaks(&mut self) -> PeakWork<'_> {
        PeakWork { buffers: &mut self.buffers, peaks: &mut self.peaks }
    }

    /// The log of flights, and the part of it that the peaks use.
    pub(in crate::engine) fn for_log(&mut self) -> (&mut FlightLog, PeakWork<'_>) {
        (&mut self.log, PeakWork { buffers: &mut self.buffers, peaks: &mut self.peaks })
    }

    /// The flights that wait for the energy account, and the part of it that the account uses.
    pub(in crate::engine) fn for_energy(&mut self) -> Accounting<'_> {
        (&mut self.waiting, &mut self.buffers)
    }

    fn new(model: &Model) -> Workspace {
        let (pairs, lanes) = (model.system.pairs.len(), model.system.structure.lanes);
        let log = if model.peaks().logs_flights() {
            FlightLog::new(lanes, model.inputs.pushes().count())
        } else {
            FlightLog::new(0, 0)
        };
        Workspace {
            buffers: model.buffers(),
            look: Look::new(lanes, model.system.count_limits()),
            windows: WindowWorkspace::new(if model.windows.is_ok() { pairs } else { 0 }),
            peaks: model.peaks().peak_room(log.capacity()),
            log,
            waiting: model.waiting(),
            switches: None,
        }
    }
}

impl Model {
    /// Scratch vectors for this model.
    pub(in crate::engine) fn buffers(&self) -> Buffers {
        let in_windows = if self.windows.is_ok() { self.system.pairs.len().min(MOST_PAIRS) } else { 0 };
        Buffers::new(&self.system.structure, self.system.rigid.pairs.len(), in_windows)
    }

    /// The initial state at a time, s, with all inputs 0.
    pub fn start(&self, time: f64) -> State {
        self.start_with(time, self.inputs.clone())
    }

    /// The initial state at a time, s, with the inputs of its scene as set so far.
    pub fn start_with(&self, time: f64, inputs: Inputs) -> State {
        let mut state = State {
            time,
            stop: Stop::No,
            base: self.system.start(time, self.peaks().start_peaks(), self.energy.then(Account::default)),
            step: Step::new(&self.system),
            inputs,
            counters: Counters::default(),
            work: Workspace::new(self),
        };
        self.set_rest(&mut state.base);
        self.system.open_account(&mut state.base);
        // What is shown at the start counts, before a contact that begins at that very instant changes it.
        let mut peaks = std::mem::take(&mut state.base.peaks);
        match state.base.is_forced() && !self.watched.rows.are_none() {
            true => self.peaks().raise_to_contact(&state.base, &mut peaks, &mut state.work.for_peaks()),
            false => self.peaks().raise_to_motion(&state.base, &mut peaks),
        }
        state.base.peaks = peaks;
        state
    }
}

impl State {
    /// The end of the planned step, s since the start of the segment; never beyond the `limit` by rounding.
    pub(in crate::engine) fn step_end(&self, limit: f64) -> f64 {
        if self.step.planned.reaches_limit { limit } else { (self.base.elapsed + self.step.planned.length).min(limit) }
    }
}
