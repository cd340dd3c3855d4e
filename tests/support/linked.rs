//! The exported functions, linked: those that both versions have under one name each, and instances without a logger.
//!
//! What counts memory or coverage sees inside them too, and nothing has to be compiled a second time for them.
#![allow(dead_code, clippy::unwrap_used, clippy::panic)] // each test uses its share

#[path = "steps_3.rs"]
mod steps_3;

use pounding::FmiVersion;
use pounding::description::Package;
pub use pounding::fmi::*;
use std::ffi::{CString, c_char, c_int, c_void};
use std::path::Path;
use std::ptr::{null, null_mut};
pub use steps_3::*;
use tempfile::TempDir;

pub const OK: c_int = 0;
pub const WARNING: c_int = 1;
pub const DISCARD: c_int = 2;
pub const ERROR: c_int = 3;

pub type State = FmuState;

/// A function that takes the instance alone.
pub type Plain = unsafe extern "C" fn(Component) -> c_int;

/// Unknowns, knowns, seed, sensitivity.
pub type Directional = fn(Component, &[u32], &[u32], &[f64], &mut [f64]) -> c_int;

/// `fmi3IntermediateUpdateCallback`
pub type Update = unsafe extern "C" fn(*mut c_void, f64, u8, u8, u8, u8, *mut u8, *mut f64);

/// Functions that both versions have, under names of their own and with one type each.
#[derive(Clone, Copy)]
pub struct Common {
    pub version: FmiVersion,
    pub exit_initialization: Plain,
    pub terminate: Plain,
    pub reset: Plain,
    pub free_instance: unsafe extern "C" fn(Component),
    pub log: fn(Component, bool, &[*const c_char]) -> c_int,
    pub get_reals: fn(Component, &[u32], &mut [f64]) -> c_int,
    pub get_integers: fn(Component, &[u32], &mut [c_int]) -> c_int,
    pub get_booleans: fn(Component, &[u32], &mut [u8]) -> c_int,
    pub get_strings: fn(Component, &[u32], &mut [*const c_char]) -> c_int,
    pub set_reals: fn(Component, &[u32], &[f64]) -> c_int,
    pub set_strings: fn(Component, &[u32], &[*const c_char]) -> c_int,
    pub directional: Directional,
    pub output_derivatives: fn(Component, &[u32], &[c_int], &mut [f64]) -> c_int,
    pub record: unsafe extern "C" fn(Component, *mut State) -> c_int,
    pub restore: unsafe extern "C" fn(Component, State) -> c_int,
    pub free: unsafe extern "C" fn(Component, *mut State) -> c_int,
    pub size: unsafe extern "C" fn(Component, State, *mut usize) -> c_int,
    pub serialize: unsafe extern "C" fn(Component, State, *mut u8, usize) -> c_int,
    pub deserialize: unsafe extern "C" fn(Component, *const u8, usize, *mut State) -> c_int,
}

impl Common {
    pub const fn of(version: FmiVersion) -> &'static Common {
        match version {
            FmiVersion::V2 => &COMMON_2,
            FmiVersion::V3 => &COMMON_3,
        }
    }

    /// The bytes of a snapshot.
    pub fn bytes(&self, c: Component, state: State) -> Vec<u8> {
        let mut size = 0;
        // SAFETY: a live component, a place for a size.
        assert_eq!(unsafe { (self.size)(c, state, &raw mut size) }, OK);
        let mut bytes = vec![0; size];
        // SAFETY: a live component, room for as many bytes as it says.
        assert_eq!(unsafe { (self.serialize)(c, state, bytes.as_mut_ptr(), size) }, OK);
        bytes
    }

    /// Brings another component to where one is, through bytes.
    pub fn hand_over(&self, from: Component, to: Component) {
        let (mut state, mut copy) = (null_mut(), null_mut());
        // SAFETY: live components, places without a state, as many bytes as it says.
        unsafe {
            assert_eq!((self.record)(from, &raw mut state), OK);
            let bytes = self.bytes(from, state);
            assert_eq!((self.deserialize)(to, bytes.as_ptr(), bytes.len(), &raw mut copy), OK);
            assert_eq!((self.restore)(to, copy), OK);
            assert_eq!((self.free)(to, &raw mut copy), OK);
            assert_eq!((self.free)(from, &raw mut state), OK);
        }
    }
}

// SAFETY: of each call below: a live component, and slices of as many elements as the call says.
pub const COMMON_2: Common = Common {
    version: FmiVersion::V2,
    exit_initialization: fmi2ExitInitializationMode,
    terminate: fmi2Terminate,
    reset: fmi2Reset,
    free_instance: fmi2FreeInstance,
    // SAFETY: as above.
    log: |c, on, categories| unsafe { fmi2SetDebugLogging(c, on.into(), categories.len(), categories.as_ptr()) },
    // SAFETY: as above.
    get_reals: |c, vr, values| unsafe { fmi2GetReal(c, vr.as_ptr(), vr.len(), values.as_mut_ptr()) },
    // SAFETY: as above.
    get_integers: |c, vr, values| unsafe { fmi2GetInteger(c, vr.as_ptr(), vr.len(), values.as_mut_ptr()) },
    get_booleans: get_booleans_of_2,
    // SAFETY: as above.
    get_strings: |c, vr, values| unsafe { fmi2GetString(c, vr.as_ptr(), vr.len(), values.as_mut_ptr()) },
    // SAFETY: as above.
    set_reals: |c, vr, values| unsafe { fmi2SetReal(c, vr.as_ptr(), vr.len(), values.as_ptr()) },
    // SAFETY: as above.
    set_strings: |c, vr, values| unsafe { fmi2SetString(c, vr.as_ptr(), vr.len(), values.as_ptr()) },
    // SAFETY: as above.
    directional: |c, unknowns, knowns, seed, found| unsafe {
        let (u, k) = (unknowns.as_ptr(), knowns.as_ptr());
        fmi2GetDirectionalDerivative(c, u, unknowns.len(), k, knowns.len(), seed.as_ptr(), found.as_mut_ptr())
    },
    // SAFETY: as above.
    output_derivatives: |c, vr, orders, values| unsafe {
        fmi2GetRealOutputDerivatives(c, vr.as_ptr(), vr.len(), orders.as_ptr(), values.as_mut_ptr())
    },
    record: fmi2GetFMUstate,
    restore: fmi2SetFMUstate,
    free: fmi2FreeFMUstate,
    size: fmi2SerializedFMUstateSize,
    serialize: fmi2SerializeFMUstate,
    deserialize: fmi2DeSerializeFMUstate,
};

// SAFETY: of each call below: as for FMI 2.0; and each array has its own length.
pub const COMMON_3: Common = Common {
    version: FmiVersion::V3,
    exit_initialization: fmi3ExitInitializationMode,
    terminate: fmi3Terminate,
    reset: fmi3Reset,
    free_instance: fmi3FreeInstance,
    // SAFETY: as above.
    log: |c, on, categories| unsafe { fmi3SetDebugLogging(c, on.into(), categories.len(), categories.as_ptr()) },
    // SAFETY: as above.
    get_reals: |c, vr, values| unsafe { fmi3GetFloat64(c, vr.as_ptr(), vr.len(), values.as_mut_ptr(), values.len()) },
    // SAFETY: as above.
    get_integers: |c, vr, values| unsafe { fmi3GetInt32(c, vr.as_ptr(), vr.len(), values.as_mut_ptr(), values.len()) },
    // SAFETY: as above.
    get_booleans: |c, vr, values| unsafe {
        fmi3GetBoolean(c, vr.as_ptr(), vr.len(), values.as_mut_ptr(), values.len())
    },
    // SAFETY: as above.
    get_strings: |c, vr, values| unsafe { fmi3GetString(c, vr.as_ptr(), vr.len(), values.as_mut_ptr(), values.len()) },
    // SAFETY: as above.
    set_reals: |c, vr, values| unsafe { fmi3SetFloat64(c, vr.as_ptr(), vr.len(), values.as_ptr(), values.len()) },
    // SAFETY: as above.
    set_strings: |c, vr, values| unsafe { fmi3SetString(c, vr.as_ptr(), vr.len(), values.as_ptr(), values.len()) },
    // SAFETY: as above.
    directional: |c, unknowns, knowns, seed, found| unsafe {
        let ((u, nu), (k, nk)) = ((unknowns.as_ptr(), unknowns.len()), (knowns.as_ptr(), knowns.len()));
        fmi3GetDirectionalDerivative(c, u, nu, k, nk, seed.as_ptr(), seed.len(), found.as_mut_ptr(), found.len())
    },
    // SAFETY: as above.
    output_derivatives: |c, vr, orders, values| unsafe {
        fmi3GetOutputDerivatives(c, vr.as_ptr(), vr.len(), orders.as_ptr(), values.as_mut_ptr(), values.len())
    },
    record: fmi3GetFMUState,
    restore: fmi3SetFMUState,
    free: fmi3FreeFMUState,
    size: fmi3SerializedFMUStateSize,
    serialize: fmi3SerializeFMUState,
    deserialize: fmi3DeserializeFMUState,
};

/// Booleans of FMI 2.0 are integers.
fn get_booleans_of_2(c: Component, vr: &[u32], values: &mut [u8]) -> c_int {
    let mut integers: Vec<c_int> = values.iter().map(|value| (*value).into()).collect();
    // SAFETY: a live component, room for as many values as references.
    let status = unsafe { fmi2GetBoolean(c, vr.as_ptr(), vr.len(), integers.as_mut_ptr()) };
    values.iter_mut().zip(integers).for_each(|(value, integer)| *value = integer.try_into().unwrap());
    status
}
/// What a master of FMI 3.0 chooses when it makes an instance.
#[derive(Clone, Debug)]
pub struct Choices {
    pub event_mode_used: bool,
    pub early_return_allowed: bool,
    /// Variables for the sake of which steps have turns.
    pub required: Vec<u32>,
    /// The function for turns, and what it gets back.
    pub update: Option<Update>,
    pub environment: *mut c_void,
}

impl Choices {
    /// Two flags, and no turns.
    pub fn flags(event_mode_used: bool, early_return_allowed: bool) -> Choices {
        Choices { event_mode_used, early_return_allowed, required: Vec::new(), update: None, environment: null_mut() }
    }
}

/// The unpacked resources of a scene without a record, to make instances of.
pub struct Resources {
    guid: CString,
    token: CString,
    location: CString,
    pub package: Package,
    _directory: TempDir,
}

impl Resources {
    pub fn new(scene: &str) -> Resources {
        let directory = TempDir::new().unwrap();
        std::fs::write(directory.path().join("scene.toml"), scene).unwrap();
        let package = Package::from_resources(directory.path()).unwrap();
        let guid = |version| CString::new(package.guid(version)).unwrap();
        let text = |path: &Path| CString::new(path.to_str().unwrap()).unwrap();
        Resources {
            guid: guid(FmiVersion::V2),
            token: guid(FmiVersion::V3),
            location: text(directory.path()),
            package,
            _directory: directory,
        }
    }

    /// A new component, without a logger.
    pub fn instantiate(&self) -> Component {
        let callbacks = CallbackFunctions {
            logger: None,
            allocate_memory: null(),
            free_memory: null(),
            step_finished: null(),
            component_environment: null_mut(),
        };
        // SAFETY: strings that end with a zero, callbacks that are none.
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

    /// A new component of FMI 3.0, without a logger.
    pub fn instantiate_3(&self, choices: &Choices) -> Component {
        let Choices { event_mode_used, early_return_allowed, required, update, environment } = choices;
        // SAFETY: strings that end with a zero, and as many references as is said.
        let component = unsafe {
            fmi3InstantiateCoSimulation(
                c"linked".as_ptr(),
                self.token.as_ptr(),
                self.location.as_ptr(),
                0,
                0,
                u8::from(*event_mode_used),
                u8::from(*early_return_allowed),
                required.as_ptr(),
                required.len(),
                *environment,
                None,
                *update,
            )
        };
        assert!(!component.is_null());
        component
    }
}
