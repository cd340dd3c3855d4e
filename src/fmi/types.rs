//! The C types of `fmi2TypesPlatform.h` and `fmi2FunctionTypes.h`.
//!
//! Enumerations and Booleans are plain integers here: a Rust enum with a number that it does not know would be undefined
//! behaviour.

use std::ffi::{c_char, c_int, c_void};

/// `fmi2Component`: an `Instance` (`instance.rs`).
pub type Component = *mut c_void;
/// `fmi2ComponentEnvironment`: the master's, opaque.
pub(super) type ComponentEnvironment = *mut c_void;
/// `fmi2FMUstate`: the name of a snapshot of one instance, not an address.
pub type FmuState = *mut c_void;
/// `fmi2ValueReference`
pub(super) type ValueReference = u32;
/// `fmi2String`
pub(super) type Text = *const c_char;
/// `fmi2Boolean`: 0 or 1.
pub(super) type Boolean = c_int;

/// `fmi2CoSimulation` of `fmi2Type`.
pub(super) const CO_SIMULATION: c_int = 1;

/// `fmi2CallbackLogger`: environment, instance name, status, category, message as a `printf` format.
pub(super) type LoggerFunction = unsafe extern "C" fn(ComponentEnvironment, Text, c_int, Text, Text, ...);

/// `fmi2CallbackFunctions`. The memory functions and `stepFinished` are never called, so their types do not matter.
#[repr(C)]
#[derive(Debug)]
pub struct CallbackFunctions {
    pub logger: Option<LoggerFunction>,
    pub allocate_memory: *const c_void,
    pub free_memory: *const c_void,
    pub step_finished: *const c_void,
    pub component_environment: ComponentEnvironment,
}
