//! The C types of `fmi3PlatformTypes.h` and `fmi3FunctionTypes.h` that FMI 2.0 does not have.
//!
//! Enumerations and Booleans are plain integers here: a Rust enum or `bool` with a number that it does not know would be
//! undefined behaviour.

use crate::fmi::common::types::ComponentEnvironment;
use std::ffi::c_int;

/// `fmi3Boolean`, a `bool` of C: one byte, 0 or 1.
pub(super) type Boolean = u8;
/// `fmi3Clock`, alike.
pub(super) type Clock = u8;
/// `fmi3Binary`
pub(super) type Binary = *const u8;
/// `fmi3DependencyKind`
pub(super) type DependencyKind = c_int;
/// `fmi3IntervalQualifier`
pub(super) type IntervalQualifier = c_int;

/// `fmi3ClockUpdateCallback`, which is never called.
pub(super) type ClockUpdate = unsafe extern "C" fn(ComponentEnvironment);
/// `fmi3LockPreemptionCallback` and `fmi3UnlockPreemptionCallback`, which are never called.
pub(super) type Preemption = unsafe extern "C" fn();
