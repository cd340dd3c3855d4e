//! The exported functions, linked rather than loaded: what counts memory or coverage sees inside them too.
#![allow(dead_code, clippy::unwrap_used, clippy::panic)] // each test uses its share

use pounding::description::Package;
use std::ffi::{CString, c_char, c_int, c_void};
use std::path::Path;
use std::ptr::null;
use tempfile::TempDir;

pub type Component = *mut c_void;
pub type State = *mut c_void;

unsafe extern "C" {
    pub fn fmi2Instantiate(
        name: *const c_char,
        kind: c_int,
        guid: *const c_char,
        location: *const c_char,
        callbacks: *const [*const c_void; 5],
        visible: c_int,
        logging_on: c_int,
    ) -> Component;
    pub fn fmi2FreeInstance(c: Component);
    pub fn fmi2SetDebugLogging(c: Component, on: c_int, n: usize, categories: *const *const c_char) -> c_int;
    pub fn fmi2SetupExperiment(
        c: Component,
        with_tolerance: c_int,
        tolerance: f64,
        start: f64,
        with_stop: c_int,
        stop: f64,
    ) -> c_int;
    pub fn fmi2EnterInitializationMode(c: Component) -> c_int;
    pub fn fmi2ExitInitializationMode(c: Component) -> c_int;
    pub fn fmi2Terminate(c: Component) -> c_int;
    pub fn fmi2Reset(c: Component) -> c_int;
    pub fn fmi2GetReal(c: Component, vr: *const u32, n: usize, values: *mut f64) -> c_int;
    pub fn fmi2GetInteger(c: Component, vr: *const u32, n: usize, values: *mut c_int) -> c_int;
    pub fn fmi2GetBoolean(c: Component, vr: *const u32, n: usize, values: *mut c_int) -> c_int;
    pub fn fmi2GetString(c: Component, vr: *const u32, n: usize, values: *mut *const c_char) -> c_int;
    pub fn fmi2SetReal(c: Component, vr: *const u32, n: usize, values: *const f64) -> c_int;
    pub fn fmi2SetInteger(c: Component, vr: *const u32, n: usize, values: *const c_int) -> c_int;
    pub fn fmi2SetBoolean(c: Component, vr: *const u32, n: usize, values: *const c_int) -> c_int;
    pub fn fmi2SetString(c: Component, vr: *const u32, n: usize, values: *const *const c_char) -> c_int;
    pub fn fmi2GetFMUstate(c: Component, state: *mut State) -> c_int;
    pub fn fmi2SetFMUstate(c: Component, state: State) -> c_int;
    pub fn fmi2FreeFMUstate(c: Component, state: *mut State) -> c_int;
    pub fn fmi2SerializedFMUstateSize(c: Component, state: State, size: *mut usize) -> c_int;
    pub fn fmi2SerializeFMUstate(c: Component, state: State, bytes: *mut u8, size: usize) -> c_int;
    pub fn fmi2DeSerializeFMUstate(c: Component, bytes: *const u8, size: usize, state: *mut State) -> c_int;
    pub fn fmi2SetRealInputDerivatives(
        c: Component,
        vr: *const u32,
        n: usize,
        orders: *const c_int,
        values: *const f64,
    ) -> c_int;
    pub fn fmi2GetRealOutputDerivatives(
        c: Component,
        vr: *const u32,
        n: usize,
        orders: *const c_int,
        values: *mut f64,
    ) -> c_int;
    pub fn fmi2GetDirectionalDerivative(
        c: Component,
        unknowns: *const u32,
        n_unknowns: usize,
        knowns: *const u32,
        n_knowns: usize,
        seed: *const f64,
        sensitivity: *mut f64,
    ) -> c_int;
    pub fn fmi2DoStep(c: Component, current: f64, step: f64, no_set_state_before: c_int) -> c_int;
    pub fn fmi2CancelStep(c: Component) -> c_int;
    pub fn fmi2GetStatus(c: Component, kind: c_int, value: *mut c_int) -> c_int;
    pub fn fmi2GetRealStatus(c: Component, kind: c_int, value: *mut f64) -> c_int;
    pub fn fmi2GetIntegerStatus(c: Component, kind: c_int, value: *mut c_int) -> c_int;
    pub fn fmi2GetBooleanStatus(c: Component, kind: c_int, value: *mut c_int) -> c_int;
    pub fn fmi2GetStringStatus(c: Component, kind: c_int, value: *mut *const c_char) -> c_int;
}

/// The unpacked resources of a scene without a record, to make instances of.
pub struct Resources {
    guid: CString,
    location: CString,
    pub package: Package,
    _directory: TempDir,
}

impl Resources {
    pub fn new(scene: &str) -> Resources {
        let directory = TempDir::new().unwrap();
        std::fs::write(directory.path().join("scene.toml"), scene).unwrap();
        let package = Package::from_resources(directory.path()).unwrap();
        let text = |path: &Path| CString::new(path.to_str().unwrap()).unwrap();
        Resources {
            guid: CString::new(package.guid()).unwrap(),
            location: text(directory.path()),
            package,
            _directory: directory,
        }
    }

    /// A new component, without a logger.
    pub fn instantiate(&self) -> Component {
        let callbacks = [null(); 5];
        // SAFETY: strings that end with a zero, callbacks of the size that the standard gives them.
        let component = unsafe {
            fmi2Instantiate(
                c"linked".as_ptr(),
                1,
                self.guid.as_ptr(),
                self.location.as_ptr(),
                &raw const callbacks,
                0,
                0,
            )
        };
        assert!(!component.is_null());
        component
    }
}
