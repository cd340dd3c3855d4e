//! The C types that both versions have.

use std::ffi::{c_char, c_void};

/// `fmi2Component`, `fmi3Instance`: an `Instance` (`instance.rs`).
pub type Component = *mut c_void;
/// `fmi2ComponentEnvironment`, `fmi3InstanceEnvironment`: the master's, opaque.
pub(in crate::fmi) type ComponentEnvironment = *mut c_void;
/// `fmi2FMUstate`, `fmi3FMUState`: the name of a snapshot of one instance, not an address.
pub type FmuState = *mut c_void;
/// `fmi2ValueReference`, `fmi3ValueReference`
pub(in crate::fmi) type ValueReference = u32;
/// `fmi2String`, `fmi3String`
pub(in crate::fmi) type Text = *const c_char;
