//! Any bytes as a sequence of calls, against a model of the table of allowed calls: FMI 2.0.4, section 4.2.4.
//!
//! Two bytes make a call: which, and with which arguments. Each has to return what the model says, and after the last
//! one a reset has to bring back a fresh instance, to the bit.

use crate::linked::*;
use crate::two_and_three_storeys::CALLS;
use pounding::variables::{Settings, Slot, Table, Type, Value};
use std::ffi::c_int;
use std::ptr::{null, null_mut};
use std::sync::OnceLock;

const MOST_CALLS: usize = 100;

/// What all sequences share.
struct Shared {
    resources: Resources,
    table: Table,
    defaults: Settings,
    /// The bits of a run of a fresh instance.
    reference: Vec<u64>,
}

fn shared() -> &'static Shared {
    static SHARED: OnceLock<Shared> = OnceLock::new();
    SHARED.get_or_init(|| {
        let resources = Resources::new(CALLS);
        let scene = resources.package.scene.clone();
        let (table, defaults) = (Table::new(&scene), Settings::new(scene, None));
        let mut shared = Shared { resources, table, defaults, reference: Vec::new() };
        let component = shared.resources.instantiate();
        shared.reference = run(component, &shared.table);
        // SAFETY: alive, and not used afterwards.
        unsafe { fmi2FreeInstance(component) };
        shared
    })
}

/// The bits of every Real variable during a short run with impacts.
fn run(c: Component, table: &Table) -> Vec<u64> {
    let reals: Vec<u32> = table.iter().filter(|(_, row)| matches!(row.ty, Type::Real(_))).map(|(vr, _)| vr).collect();
    let mut values = vec![0.0_f64; reals.len()];
    let mut bits = Vec::new();
    // SAFETY: a live component, arrays of as many elements as it says.
    unsafe {
        assert_eq!(fmi2SetupExperiment(c, 0, 0.0, 0.0, 0, 0.0), OK);
        assert_eq!(fmi2EnterInitializationMode(c), OK);
        assert_eq!(fmi2ExitInitializationMode(c), OK);
        for k in 0..4 {
            assert_eq!(fmi2DoStep(c, f64::from(k) * 0.05, 0.05, 1), OK);
            assert_eq!(fmi2GetReal(c, reals.as_ptr(), reals.len(), values.as_mut_ptr()), OK);
            bits.extend(values.iter().map(|value| value.to_bits()));
        }
    }
    bits
}

/// The states of the standard that an instance without asynchronous steps can be in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Phase {
    Instantiated,
    Initialization,
    StepComplete,
    Terminated,
    Error,
}
use Phase::{Error, Initialization, Instantiated, StepComplete, Terminated};

/// What the model knows of an instance, and what a snapshot of it brings back.
#[derive(Clone, Copy, Debug)]
struct Model {
    phase: Phase,
    time: f64,
    stop: Option<f64>,
}

/// An instance in the middle of a sequence.
struct Session {
    c: Component,
    model: Model,
    /// Two places for states, and what the model knows of what they hold.
    snapshots: [(State, Option<Model>); 2],
    /// Calls that the model knows to be errors are left out, so that long lives are tried too.
    only_legal: bool,
}

/// Panics where a call returns what the model does not expect, or where a reset does not bring back a fresh instance.
pub fn check(bytes: &[u8]) {
    let Some((first, calls)) = bytes.split_first() else { return };
    let shared = shared();
    let mut session = Session {
        c: shared.resources.instantiate(),
        model: Model { phase: Instantiated, time: 0.0, stop: None },
        snapshots: [(null_mut(), None); 2],
        only_legal: first % 2 == 1,
    };
    calls.chunks_exact(2).take(MOST_CALLS).for_each(|call| session.call(call[0], call[1]));
    // SAFETY: alive, and not used after its end.
    unsafe {
        assert_eq!(fmi2Reset(session.c), OK);
        assert!(run(session.c, &shared.table) == shared.reference, "after a reset: not the bits of a fresh instance");
        fmi2FreeInstance(session.c);
    }
}

impl Session {
    fn is_in(&self, phases: &[Phase]) -> c_int {
        if phases.contains(&self.model.phase) { OK } else { ERROR }
    }

    /// Makes a call if it may be made; its status has to be the expected one. After an error little is allowed.
    fn expect(&mut self, what: &str, expected: c_int, call: impl FnOnce(Component) -> c_int) -> bool {
        if self.only_legal && expected == ERROR {
            return false;
        }
        let status = call(self.c);
        assert_eq!(status, expected, "{what} in {:?}", self.model);
        if status == ERROR {
            self.model.phase = Error;
        }
        status == OK
    }

    #[rustfmt::skip] // a table
    fn call(&mut self, call: u8, argument: u8) {
        let slot = usize::from(argument % 2);
        match call % 20 {
            0 => self.setup(argument),
            1 => self.change("enter", &[Instantiated], Initialization, fmi2EnterInitializationMode),
            2 => self.change("exit", &[Initialization], StepComplete, fmi2ExitInitializationMode),
            3 if argument.is_multiple_of(4) => self.change("terminate", &[StepComplete], Terminated, fmi2Terminate),
            3 => {}
            4 if argument.is_multiple_of(4) => self.reset(),
            4 => self.change("cancel", &[], Error, fmi2CancelStep),
            5 => self.get(argument),
            6 | 7 => self.set_real(argument, call),
            8 => self.set_others(argument),
            9..=11 => self.step(argument),
            12 => self.status(argument),
            13 => self.record(slot),
            14 => self.restore(slot),
            15 => self.free(slot),
            16 => self.copy(slot),
            17 => self.derivatives(argument),
            18 => self.directional(argument),
            _ => self.logging(argument),
        }
    }

    fn setup(&mut self, argument: u8) {
        let (start, stop, is_good) = match argument % 6 {
            0 => (0.0, None, true),
            1 => (1.5, Some(2.5), true),
            2 => (-3.0, None, true),
            3 => (f64::NAN, None, false),
            4 => (1.0, Some(0.5), false),
            _ => (0.0, Some(f64::INFINITY), false),
        };
        let expected = if is_good { self.is_in(&[Instantiated]) } else { ERROR };
        let with_stop = c_int::from(stop.is_some());
        // SAFETY: a live component.
        let call = |c| unsafe { fmi2SetupExperiment(c, 0, 0.0, start, with_stop, stop.unwrap_or_default()) };
        if self.expect("setup", expected, call) {
            (self.model.time, self.model.stop) = (start, stop);
        }
    }

    fn change(&mut self, what: &str, from: &[Phase], to: Phase, function: unsafe extern "C" fn(Component) -> c_int) {
        // SAFETY: a live component.
        if self.expect(what, self.is_in(from), |c| unsafe { function(c) }) {
            self.model.phase = to;
        }
    }

    fn reset(&mut self) {
        // SAFETY: a live component.
        self.expect("reset", OK, |c| unsafe { fmi2Reset(c) });
        self.model = Model { phase: Instantiated, time: 0.0, stop: None };
    }

    /// One variable, or none, by the function of one of the types.
    fn get(&mut self, argument: u8) {
        let vr = u32::from(argument / 4);
        let ty = shared().table.row(vr).map(|row| row.ty.name(pounding::FmiVersion::V2));
        let name = ["Real", "Integer", "Boolean", "String"][usize::from(argument % 4)];
        let is_good = ty == Some(name);
        let allowed = self.is_in(&[Initialization, StepComplete, Terminated, Error]);
        let n = usize::from(argument != 255);
        let expected = if is_good || n == 0 { allowed } else { ERROR };
        self.expect(&format!("get {name} {vr}"), expected, |c| {
            let (mut real, mut integer, mut text) = (f64::NAN, -1, null());
            // SAFETY: a live component, room for one element.
            let status = unsafe {
                match name {
                    "Real" => fmi2GetReal(c, &raw const vr, n, &raw mut real),
                    "Integer" => fmi2GetInteger(c, &raw const vr, n, &raw mut integer),
                    "Boolean" => fmi2GetBoolean(c, &raw const vr, n, &raw mut integer),
                    _ => fmi2GetString(c, &raw const vr, n, &raw mut text),
                }
            };
            assert!(status != OK || n == 0 || name != "Real" || real.is_finite());
            status
        });
    }

    fn set_real(&mut self, argument: u8, how: u8) {
        let shared = shared();
        let vr = u32::from(argument) % (shared.table.rows.len() as u32 + 1);
        let is_finite = how < 240;
        let factor = if is_finite { 1.0 + f64::from(how / 20) / 100.0 } else { f64::NAN };
        let (value, phases): (f64, &[Phase]) = match shared.table.row(vr).map(|row| row.slot) {
            Some(Slot::Input(_)) => (3.0 * factor, &[Instantiated, Initialization, StepComplete]),
            Some(Slot::Parameter(parameter)) => match shared.defaults.read(parameter) {
                // Restitutions and tolerances have little room.
                Value::Real(default) => (default / factor, &[Instantiated, Initialization]),
                _ => (0.0, &[]),
            },
            _ => (0.0, &[]),
        };
        let expected = if is_finite { self.is_in(phases) } else { ERROR };
        // SAFETY: a live component, one element.
        let call = |c| unsafe { fmi2SetReal(c, &raw const vr, 1, &raw const value) };
        self.expect(&format!("set {vr} to {value}"), expected, call);
    }

    /// No variable of these types can be set here; nothing can be set to nothing.
    fn set_others(&mut self, argument: u8) {
        let (vr, n) = (u32::from(argument / 8), usize::from(argument / 4 % 2));
        let expected = if n == 0 { self.is_in(&[Instantiated, Initialization, StepComplete]) } else { ERROR };
        self.expect("set others", expected, |c| {
            // SAFETY: a live component, one element.
            unsafe {
                match argument % 4 {
                    0 => fmi2SetInteger(c, &raw const vr, n, &0),
                    1 => fmi2SetBoolean(c, &raw const vr, n, &1),
                    2 => fmi2SetString(c, &raw const vr, n, &c"x".as_ptr()),
                    _ => fmi2SetReal(c, null(), n, &0.0),
                }
            }
        });
    }

    fn step(&mut self, argument: u8) {
        let Model { time, stop, .. } = self.model;
        let length = 0.001 * f64::from(1 + argument / 8);
        let (current, length, is_good) = match argument % 8 {
            0..=3 => (time, length, true),
            4 => (time + 1e-10, length, true),
            5 => (time + 0.5, length, false),
            6 => (time, -length, false),
            _ => (time, f64::NAN, false),
        };
        let target = current + length;
        let is_good = is_good && stop.is_none_or(|stop| target <= stop);
        let expected = if is_good { self.is_in(&[StepComplete]) } else { ERROR };
        // SAFETY: a live component.
        if self.expect("step", expected, |c| unsafe { fmi2DoStep(c, current, length, 0) }) {
            self.model.time = target;
        }
    }

    fn status(&mut self, argument: u8) {
        let kind = c_int::from(argument / 8 % 6) - 1;
        let allowed = self.is_in(&[StepComplete, Terminated]);
        let time = self.model.time;
        let function = argument % 5;
        let expected = match (allowed, function, kind) {
            (OK, 1, 2) | (OK, 3, 3) => OK,
            (OK, _, 0..=3) => DISCARD,
            _ => ERROR,
        };
        self.expect(&format!("status {function} {kind}"), expected, |c| {
            let (mut real, mut integer, mut text) = (f64::NAN, -1, null());
            // SAFETY: a live component, room for one element.
            let status = unsafe {
                match function {
                    0 => fmi2GetStatus(c, kind, &raw mut integer),
                    1 => fmi2GetRealStatus(c, kind, &raw mut real),
                    2 => fmi2GetIntegerStatus(c, kind, &raw mut integer),
                    3 => fmi2GetBooleanStatus(c, kind, &raw mut integer),
                    _ => fmi2GetStringStatus(c, kind, &raw mut text),
                }
            };
            assert!(status != OK || real.to_bits() == time.to_bits() || integer == 0, "{real} at {time}");
            status
        });
    }

    fn record(&mut self, slot: usize) {
        let place = &raw mut self.snapshots[slot].0;
        // SAFETY: a live component, a place with a state of it or none.
        self.expect("record", OK, |c| unsafe { fmi2GetFMUstate(c, place) });
        self.snapshots[slot].1 = Some(self.model);
    }

    fn restore(&mut self, slot: usize) {
        let (state, model) = self.snapshots[slot];
        let expected = if model.is_some() { OK } else { ERROR };
        // SAFETY: a live component.
        if self.expect("restore", expected, |c| unsafe { fmi2SetFMUstate(c, state) })
            && let Some(model) = model
        {
            self.model = model;
        }
    }

    fn free(&mut self, slot: usize) {
        let place = &raw mut self.snapshots[slot].0;
        // SAFETY: a live component, a place with a state of it or none.
        self.expect("free", OK, |c| unsafe { fmi2FreeFMUstate(c, place) });
        assert!(self.snapshots[slot].0.is_null());
        self.snapshots[slot].1 = None;
    }

    /// Through bytes into the other place.
    fn copy(&mut self, slot: usize) {
        let (state, model) = self.snapshots[slot];
        let expected = if model.is_some() { OK } else { ERROR };
        let mut size = 0;
        // SAFETY: a live component, a place for a size.
        let call = |c| unsafe { fmi2SerializedFMUstateSize(c, state, &raw mut size) };
        if !self.expect("size", expected, call) {
            return;
        }
        let mut bytes = vec![0; size];
        let place = &raw mut self.snapshots[1 - slot].0;
        // SAFETY: a live component, room for as many bytes as it has asked for.
        let call = |c| unsafe { fmi2SerializeFMUstate(c, state, bytes.as_mut_ptr(), size) };
        self.expect("serialize", OK, call);
        // SAFETY: a live component, as many bytes as it says, a place with a state of it or none.
        let call = |c| unsafe { fmi2DeSerializeFMUstate(c, bytes.as_ptr(), size, place) };
        self.expect("deserialize", OK, call);
        self.snapshots[1 - slot].1 = model;
    }

    fn derivatives(&mut self, argument: u8) {
        let table = &shared().table;
        let vr = u32::from(argument / 4) % (table.rows.len() as u32 + 1);
        let (slot, order) = (table.row(vr).map(|row| (row.slot, row.name.as_str())), c_int::from(argument % 2));
        if (argument / 2).is_multiple_of(2) {
            let is_good = matches!(slot, Some((Slot::Input(_), _))) && order == 1;
            let expected = if is_good { self.is_in(&[Instantiated, Initialization, StepComplete]) } else { ERROR };
            // SAFETY: a live component, one element.
            let call = |c| unsafe { fmi2SetRealInputDerivatives(c, &raw const vr, 1, &raw const order, &5.0) };
            self.expect("input derivative", expected, call);
        } else {
            let is_real = table.row(vr).is_some_and(|row| matches!(row.ty, Type::Real(_)));
            let is_good = matches!(slot, Some((Slot::Output(_), _))) && is_real && order == 1;
            let allowed = self.is_in(&[StepComplete, Terminated, Error]);
            let expected = if is_good || allowed == ERROR { allowed } else { DISCARD };
            let mut rate = f64::NAN;
            // SAFETY: a live component, one element.
            let call =
                |c| unsafe { fmi2GetRealOutputDerivatives(c, &raw const vr, 1, &raw const order, &raw mut rate) };
            self.expect(&format!("output derivative of {slot:?}"), expected, call);
        }
    }

    fn directional(&mut self, argument: u8) {
        let table = &shared().table;
        let find = |name: &str| table.iter().find(|(_, row)| row.name == name).map_or(u32::MAX, |(vr, _)| vr);
        let (unknown, is_unknown) = match argument % 3 {
            0 => (find("left.acceleration[1]"), true),
            1 => (find("contact[1].force"), true),
            _ => (find("left.force[1]"), false),
        };
        let (known, is_known) = match argument / 3 % 3 {
            0 => (find("left.force[1]"), true),
            1 => (find("ground.acceleration"), true),
            _ => (find("left.displacement[1]"), false),
        };
        let allowed = self.is_in(&[Initialization, StepComplete, Terminated, Error]);
        let expected = if is_unknown && is_known || allowed == ERROR { allowed } else { DISCARD };
        let mut change = f64::NAN;
        // SAFETY: a live component, one element each.
        let call = |c| unsafe {
            fmi2GetDirectionalDerivative(c, &raw const unknown, 1, &raw const known, 1, &1.0, &raw mut change)
        };
        self.expect("directional derivative", expected, call);
    }

    fn logging(&mut self, argument: u8) {
        let (category, expected) = match argument % 3 {
            0 => (c"logAll", OK),
            1 => (c"logEvents", OK),
            _ => (c"logNothingThatThereIs", ERROR),
        };
        // SAFETY: a live component, one string.
        let call = |c| unsafe { fmi2SetDebugLogging(c, c_int::from(argument / 4 % 2), 1, &category.as_ptr()) };
        self.expect("logging", expected, call);
    }
}
