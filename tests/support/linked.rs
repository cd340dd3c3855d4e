//! The exported functions, linked rather than loaded: what counts memory or coverage sees inside them too.
#![allow(dead_code, clippy::unwrap_used, clippy::panic)] // each test uses its share

#[path = "steps_3.rs"]
mod steps_3;

use pounding::FmiVersion;
use pounding::description::Package;
pub use pounding::fmi::*;
use std::ffi::{CString, c_int, c_void};
use std::path::Path;
use std::ptr::{null, null_mut};
pub use steps_3::*;
use tempfile::TempDir;

pub const OK: c_int = 0;
pub const DISCARD: c_int = 2;
pub const ERROR: c_int = 3;

pub type State = FmuState;

/// `fmi3IntermediateUpdateCallback`
pub type Update = unsafe extern "C" fn(*mut c_void, f64, u8, u8, u8, u8, *mut u8, *mut f64);

/// Functions of the same types in both versions, under names of their own.
#[derive(Clone, Copy)]
pub struct Common {
    pub version: FmiVersion,
    pub reset: unsafe extern "C" fn(Component) -> c_int,
    pub free_instance: unsafe extern "C" fn(Component),
    pub record: unsafe extern "C" fn(Component, *mut State) -> c_int,
    pub restore: unsafe extern "C" fn(Component, State) -> c_int,
    pub free: unsafe extern "C" fn(Component, *mut State) -> c_int,
    pub size: unsafe extern "C" fn(Component, State, *mut usize) -> c_int,
    pub serialize: fn(Component, State, &mut [u8]) -> c_int,
    pub deserialize: unsafe extern "C" fn(Component, *const u8, usize, *mut State) -> c_int,
}

impl Common {
    /// The bytes of a snapshot.
    pub fn bytes(&self, c: Component, state: State) -> Vec<u8> {
        let mut size = 0;
        // SAFETY: a live component, a place for a size.
        assert_eq!(unsafe { (self.size)(c, state, &raw mut size) }, OK);
        let mut bytes = vec![0; size];
        assert_eq!((self.serialize)(c, state, &mut bytes), OK);
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

pub const COMMON_2: Common = Common {
    version: FmiVersion::V2,
    reset: fmi2Reset,
    free_instance: fmi2FreeInstance,
    record: fmi2GetFMUstate,
    restore: fmi2SetFMUstate,
    free: fmi2FreeFMUstate,
    size: fmi2SerializedFMUstateSize,
    // SAFETY: a live component, room for as many bytes as it says.
    serialize: |c, state, bytes| unsafe { fmi2SerializeFMUstate(c, state, bytes.as_mut_ptr(), bytes.len()) },
    deserialize: fmi2DeSerializeFMUstate,
};

pub const COMMON_3: Common = Common {
    version: FmiVersion::V3,
    reset: fmi3Reset,
    free_instance: fmi3FreeInstance,
    record: fmi3GetFMUState,
    restore: fmi3SetFMUState,
    free: fmi3FreeFMUState,
    size: fmi3SerializedFMUStateSize,
    // SAFETY: a live component, room for as many bytes as it says.
    serialize: |c, state, bytes| unsafe { fmi3SerializeFMUState(c, state, bytes.as_mut_ptr(), bytes.len()) },
    deserialize: fmi3DeserializeFMUState,
};

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
