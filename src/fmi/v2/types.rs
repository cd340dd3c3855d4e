//! The C types of `fmi2TypesPlatform.h` and `fmi2FunctionTypes.h` that FMI 3.0 does not have.
//!
//! Enumerations and Booleans are plain integers here: a Rust enum with a number that it does not know would be undefined
//! behaviour.

use crate::fmi::common::logger::LoggerFunction;
use crate::fmi::common::types::ComponentEnvironment;
use std::ffi::{c_int, c_void};

/// `fmi2Boolean`: 0 or 1.
pub(super) type Boolean = c_int;

/// `fmi2CoSimulation` of `fmi2Type`.
pub(super) const CO_SIMULATION: c_int = 1;

/// `fmi2EventInfo`, which nothing is written into.
pub(super) type EventInfo = c_void;

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
