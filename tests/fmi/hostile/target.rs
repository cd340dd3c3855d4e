//! What a hostile call is aimed at: a component in some state, or none, and the functions with the types of the standard.

use crate::support::*;
use pounding::FmiVersion;
use std::ffi::{c_char, c_int};
use std::ptr::null_mut;

pub type Text = *const c_char;

/// The states of the standards that an instance can be in, and the null pointer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Phase {
    Instantiated,
    Initialization,
    /// Event Mode of FMI 3.0.
    Event,
    /// Step Mode of FMI 3.0.
    StepComplete,
    Terminated,
    Error,
    NoInstance,
}

use Phase::{Error, Event, Initialization, Instantiated, NoInstance, StepComplete, Terminated};

impl Phase {
    /// In the order of the columns of the rows.
    pub const fn all(version: FmiVersion) -> &'static [Phase] {
        match version {
            FmiVersion::V2 => &[Instantiated, Initialization, StepComplete, Terminated, Error, NoInstance],
            FmiVersion::V3 => &[Instantiated, Initialization, Event, StepComplete, Terminated, Error, NoInstance],
        }
    }
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
    /// In FMI 3.0 with Event Mode.
    pub fn new(fmu: &'f Fmu, phase: Phase) -> Target<'f> {
        let instance = fmu.with_flags(true, false);
        match phase {
            Instantiated | NoInstance => (),
            Initialization => instance.enter(),
            Event => instance.initialize(),
            StepComplete => instance.start(),
            Terminated => {
                instance.start();
                assert_eq!(instance.terminate(), OK);
            }
            Error => {
                instance.enter();
                assert_eq!(instance.enter_from(0.0, None), ERROR, "a second time");
            }
        }
        instance.log();
        let component = if phase == NoInstance { null_mut() } else { instance.component };
        Target { fmu, instance, component }
    }

    pub fn vr(&self, name: &str) -> u32 {
        self.fmu.vr(name)
    }

    /// A function that takes the component alone.
    pub fn alone(&self, function: Plain) -> c_int {
        // SAFETY: the master of these tests promises nothing; what it passes beside the component is never dangling.
        unsafe { function(self.component) }
    }

    pub fn free(&self) {
        // SAFETY: as above.
        unsafe { fmi2FreeInstance(self.component) }
    }

    pub fn get<T>(&self, function: &str, vr: *const u32, n: usize, values: *mut T) -> c_int {
        let c = self.component;
        // SAFETY: as above, and the places have room for what the function writes.
        unsafe {
            match function {
                "fmi2GetReal" => fmi2GetReal(c, vr, n, values.cast()),
                "fmi2GetInteger" => fmi2GetInteger(c, vr, n, values.cast()),
                "fmi2GetBoolean" => fmi2GetBoolean(c, vr, n, values.cast()),
                "fmi2GetString" => fmi2GetString(c, vr, n, values.cast()),
                _ => panic!("{function}"),
            }
        }
    }

    pub fn set<T>(&self, function: &str, vr: *const u32, n: usize, values: *const T) -> c_int {
        let c = self.component;
        // SAFETY: as above.
        unsafe {
            match function {
                "fmi2SetReal" => fmi2SetReal(c, vr, n, values.cast()),
                "fmi2SetInteger" => fmi2SetInteger(c, vr, n, values.cast()),
                "fmi2SetBoolean" => fmi2SetBoolean(c, vr, n, values.cast()),
                "fmi2SetString" => fmi2SetString(c, vr, n, values.cast()),
                _ => panic!("{function}"),
            }
        }
    }

    pub fn logging(&self, on: c_int, n: usize, categories: *const Text) -> c_int {
        // SAFETY: as above.
        unsafe { fmi2SetDebugLogging(self.component, on, n, categories) }
    }

    /// Tolerance, start and stop, each optional value with its flag.
    pub fn setup(&self, tolerance: (c_int, f64), start: f64, stop: (c_int, f64)) -> c_int {
        // SAFETY: as above.
        unsafe { fmi2SetupExperiment(self.component, tolerance.0, tolerance.1, start, stop.0, stop.1) }
    }

    pub fn step(&self, current: f64, step: f64) -> c_int {
        // SAFETY: as above.
        unsafe { fmi2DoStep(self.component, current, step, 1) }
    }

    pub fn status<T>(&self, function: &str, kind: c_int, value: *mut T) -> c_int {
        let c = self.component;
        // SAFETY: as above.
        unsafe {
            match function {
                "fmi2GetStatus" => fmi2GetStatus(c, kind, value.cast()),
                "fmi2GetRealStatus" => fmi2GetRealStatus(c, kind, value.cast()),
                "fmi2GetIntegerStatus" => fmi2GetIntegerStatus(c, kind, value.cast()),
                "fmi2GetBooleanStatus" => fmi2GetBooleanStatus(c, kind, value.cast()),
                "fmi2GetStringStatus" => fmi2GetStringStatus(c, kind, value.cast()),
                _ => panic!("{function}"),
            }
        }
    }

    pub fn derivatives(&self, function: &str, vr: *const u32, n: usize, orders: *const c_int, v: *mut f64) -> c_int {
        let c = self.component;
        // SAFETY: as above.
        unsafe {
            match function {
                "fmi2SetRealInputDerivatives" => fmi2SetRealInputDerivatives(c, vr, n, orders, v),
                "fmi2GetRealOutputDerivatives" => fmi2GetRealOutputDerivatives(c, vr, n, orders, v),
                _ => panic!("{function}"),
            }
        }
    }

    pub fn directional(
        &self,
        (unknowns, n_unknowns): (*const u32, usize),
        (knowns, n_knowns): (*const u32, usize),
        seed: *const f64,
        sensitivity: *mut f64,
    ) -> c_int {
        let c = self.component;
        // SAFETY: as above.
        unsafe { fmi2GetDirectionalDerivative(c, unknowns, n_unknowns, knowns, n_knowns, seed, sensitivity) }
    }

    /// A function that takes a place for a state.
    pub fn of_place(&self, function: unsafe extern "C" fn(Component, *mut State) -> c_int, place: *mut State) -> c_int {
        // SAFETY: as above.
        unsafe { function(self.component, place) }
    }

    pub fn set_state(&self, state: State) -> c_int {
        // SAFETY: as above; states are known by their number alone.
        unsafe { fmi2SetFMUstate(self.component, state) }
    }

    pub fn size(&self, state: State, size: *mut usize) -> c_int {
        // SAFETY: as above.
        unsafe { fmi2SerializedFMUstateSize(self.component, state, size) }
    }

    pub fn serialize(&self, state: State, bytes: *mut u8, size: usize) -> c_int {
        // SAFETY: as above.
        unsafe { fmi2SerializeFMUstate(self.component, state, bytes, size) }
    }

    pub fn deserialize(&self, bytes: *const u8, size: usize, place: *mut State) -> c_int {
        // SAFETY: as above.
        unsafe { fmi2DeSerializeFMUstate(self.component, bytes, size, place) }
    }
}
