//! What a hostile call is aimed at: a component in some state, or none, and the functions with the types of the standard.

use crate::support::{ERROR, Fmu, Instance, OK, RECORD_SCENE, State};
use std::ffi::{c_char, c_int, c_void};
use std::ptr::null_mut;

pub type Component = *mut c_void;
pub type Text = *const c_char;

/// The states of the standard that an instance can be in, and the null pointer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Phase {
    Instantiated,
    Initialization,
    StepComplete,
    Terminated,
    Error,
    NoInstance,
}

impl Phase {
    /// In the order of the columns of the rows.
    pub const ALL: [Phase; 6] = [
        Phase::Instantiated,
        Phase::Initialization,
        Phase::StepComplete,
        Phase::Terminated,
        Phase::Error,
        Phase::NoInstance,
    ];
}

/// A scene with variables of every type: a record, which brings a String, and floor forces as inputs.
pub fn scene() -> String {
    format!("{RECORD_SCENE}\n[inputs]\nfloor_forces = true\n\n[outputs]\nenergy = true\n")
}

/// What a call is aimed at.
pub struct Target<'f> {
    pub fmu: &'f Fmu,
    pub instance: Instance<'f>,
    /// That of the instance, or null.
    pub component: Component,
}

impl<'f> Target<'f> {
    pub fn new(fmu: &'f Fmu, phase: Phase) -> Target<'f> {
        let instance = fmu.instance();
        let steps: &[(&str, c_int)] = match phase {
            Phase::Instantiated | Phase::NoInstance => &[],
            Phase::Initialization => &[("fmi2EnterInitializationMode", OK)],
            Phase::StepComplete => &[("fmi2EnterInitializationMode", OK), ("fmi2ExitInitializationMode", OK)],
            Phase::Terminated => {
                &[("fmi2EnterInitializationMode", OK), ("fmi2ExitInitializationMode", OK), ("fmi2Terminate", OK)]
            }
            Phase::Error => &[("fmi2EnterInitializationMode", OK), ("fmi2EnterInitializationMode", ERROR)],
        };
        for (function, status) in steps {
            assert_eq!(instance.call(function), *status, "{function}");
        }
        let component = if phase == Phase::NoInstance { null_mut() } else { instance.component };
        Target { fmu, instance, component }
    }

    pub fn vr(&self, name: &str) -> u32 {
        self.fmu.vr(name)
    }

    /// A function that takes the component alone.
    pub fn alone(&self, function: &str) -> c_int {
        // SAFETY: the type of the standard.
        unsafe { self.fmu.symbol::<unsafe extern "C" fn(Component) -> c_int>(function)(self.component) }
    }

    pub fn free(&self) {
        // SAFETY: the type of the standard.
        unsafe { self.fmu.symbol::<unsafe extern "C" fn(Component)>("fmi2FreeInstance")(self.component) }
    }

    pub fn get<T>(&self, function: &str, vr: *const u32, n: usize, values: *mut T) -> c_int {
        type Get<T> = unsafe extern "C" fn(Component, *const u32, usize, *mut T) -> c_int;
        // SAFETY: the type of the standard, and nothing that the callee may follow is dangling.
        unsafe { self.fmu.symbol::<Get<T>>(function)(self.component, vr, n, values) }
    }

    pub fn set<T>(&self, function: &str, vr: *const u32, n: usize, values: *const T) -> c_int {
        type Set<T> = unsafe extern "C" fn(Component, *const u32, usize, *const T) -> c_int;
        // SAFETY: as above.
        unsafe { self.fmu.symbol::<Set<T>>(function)(self.component, vr, n, values) }
    }

    pub fn logging(&self, on: c_int, n: usize, categories: *const Text) -> c_int {
        type Logging = unsafe extern "C" fn(Component, c_int, usize, *const Text) -> c_int;
        // SAFETY: as above.
        unsafe { self.fmu.symbol::<Logging>("fmi2SetDebugLogging")(self.component, on, n, categories) }
    }

    /// Tolerance, start and stop, each optional value with its flag.
    pub fn setup(&self, tolerance: (c_int, f64), start: f64, stop: (c_int, f64)) -> c_int {
        type Setup = unsafe extern "C" fn(Component, c_int, f64, f64, c_int, f64) -> c_int;
        let setup = self.fmu.symbol::<Setup>("fmi2SetupExperiment");
        // SAFETY: as above.
        unsafe { setup(self.component, tolerance.0, tolerance.1, start, stop.0, stop.1) }
    }

    pub fn step(&self, current: f64, step: f64) -> c_int {
        type DoStep = unsafe extern "C" fn(Component, f64, f64, c_int) -> c_int;
        // SAFETY: as above.
        unsafe { self.fmu.symbol::<DoStep>("fmi2DoStep")(self.component, current, step, 1) }
    }

    pub fn status<T>(&self, function: &str, kind: c_int, value: *mut T) -> c_int {
        // SAFETY: as above.
        unsafe {
            let get = self.fmu.symbol::<unsafe extern "C" fn(Component, c_int, *mut T) -> c_int>(function);
            get(self.component, kind, value)
        }
    }

    pub fn derivatives(&self, function: &str, vr: *const u32, n: usize, orders: *const c_int, v: *mut f64) -> c_int {
        type Derivatives = unsafe extern "C" fn(Component, *const u32, usize, *const c_int, *mut f64) -> c_int;
        // SAFETY: as above.
        unsafe { self.fmu.symbol::<Derivatives>(function)(self.component, vr, n, orders, v) }
    }

    pub fn directional(
        &self,
        (unknowns, n_unknowns): (*const u32, usize),
        (knowns, n_knowns): (*const u32, usize),
        seed: *const f64,
        sensitivity: *mut f64,
    ) -> c_int {
        type Directional =
            unsafe extern "C" fn(Component, *const u32, usize, *const u32, usize, *const f64, *mut f64) -> c_int;
        let get = self.fmu.symbol::<Directional>("fmi2GetDirectionalDerivative");
        // SAFETY: as above.
        unsafe { get(self.component, unknowns, n_unknowns, knowns, n_knowns, seed, sensitivity) }
    }

    pub fn of_place(&self, function: &str, place: *mut State) -> c_int {
        // SAFETY: as above.
        unsafe {
            let call = self.fmu.symbol::<unsafe extern "C" fn(Component, *mut State) -> c_int>(function);
            call(self.component, place)
        }
    }

    pub fn set_state(&self, state: State) -> c_int {
        // SAFETY: as above; the library knows states by their number alone.
        unsafe {
            let set = self.fmu.symbol::<unsafe extern "C" fn(Component, State) -> c_int>("fmi2SetFMUstate");
            set(self.component, state)
        }
    }

    pub fn size(&self, state: State, size: *mut usize) -> c_int {
        type Size = unsafe extern "C" fn(Component, State, *mut usize) -> c_int;
        // SAFETY: as above.
        unsafe { self.fmu.symbol::<Size>("fmi2SerializedFMUstateSize")(self.component, state, size) }
    }

    pub fn serialize(&self, state: State, bytes: *mut u8, size: usize) -> c_int {
        type Serialize = unsafe extern "C" fn(Component, State, *mut u8, usize) -> c_int;
        // SAFETY: as above.
        unsafe { self.fmu.symbol::<Serialize>("fmi2SerializeFMUstate")(self.component, state, bytes, size) }
    }

    pub fn deserialize(&self, bytes: *const u8, size: usize, place: *mut State) -> c_int {
        type Deserialize = unsafe extern "C" fn(Component, *const u8, usize, *mut State) -> c_int;
        // SAFETY: as above.
        unsafe { self.fmu.symbol::<Deserialize>("fmi2DeSerializeFMUstate")(self.component, bytes, size, place) }
    }
}
