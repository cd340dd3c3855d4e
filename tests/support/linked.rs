//! The exported functions, linked rather than loaded: what counts memory or coverage sees inside them too.
#![allow(dead_code, clippy::unwrap_used, clippy::panic)] // each test uses its share

use pounding::description::Package;
pub use pounding::fmi::*;
use std::ffi::{CString, c_int};
use std::path::Path;
use std::ptr::{null, null_mut};
use tempfile::TempDir;

pub const OK: c_int = 0;
pub const DISCARD: c_int = 2;
pub const ERROR: c_int = 3;

pub type State = FmuState;

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
            guid: CString::new(package.guid(pounding::FmiVersion::V2)).unwrap(),
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
}
