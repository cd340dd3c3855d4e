//! Functions that depend on a capability which the description does not declare: they are there and refuse.

use super::fence::with_instance;
use super::types::{Component, FmuState};
use crate::slave::{Call, Refusal};
use std::ffi::c_int;

#[unsafe(no_mangle)]
unsafe extern "C" fn fmi2GetFMUstate(c: Component, _state: *mut FmuState) -> c_int {
    // SAFETY: as the module says.
    unsafe { unsupported(c, Call::GetFMUstate, "canGetAndSetFMUstate") }
}

#[unsafe(no_mangle)]
unsafe extern "C" fn fmi2SetFMUstate(c: Component, _state: FmuState) -> c_int {
    // SAFETY: as the module says.
    unsafe { unsupported(c, Call::SetFMUstate, "canGetAndSetFMUstate") }
}

#[unsafe(no_mangle)]
unsafe extern "C" fn fmi2FreeFMUstate(c: Component, _state: *mut FmuState) -> c_int {
    // SAFETY: as the module says.
    unsafe { unsupported(c, Call::FreeFMUstate, "canGetAndSetFMUstate") }
}

#[unsafe(no_mangle)]
unsafe extern "C" fn fmi2SerializedFMUstateSize(c: Component, _state: FmuState, _size: *mut usize) -> c_int {
    // SAFETY: as the module says.
    unsafe { unsupported(c, Call::SerializedFMUstateSize, "canSerializeFMUstate") }
}

#[unsafe(no_mangle)]
unsafe extern "C" fn fmi2SerializeFMUstate(c: Component, _state: FmuState, _bytes: *mut u8, _size: usize) -> c_int {
    // SAFETY: as the module says.
    unsafe { unsupported(c, Call::SerializeFMUstate, "canSerializeFMUstate") }
}

#[unsafe(no_mangle)]
unsafe extern "C" fn fmi2DeSerializeFMUstate(
    c: Component,
    _bytes: *const u8,
    _size: usize,
    _state: *mut FmuState,
) -> c_int {
    // SAFETY: as the module says.
    unsafe { unsupported(c, Call::DeSerializeFMUstate, "canSerializeFMUstate") }
}

#[unsafe(no_mangle)]
unsafe extern "C" fn fmi2CancelStep(c: Component) -> c_int {
    // SAFETY: as the module says.
    unsafe { unsupported(c, Call::CancelStep, "canRunAsynchronuously") }
}

/// # Safety
/// As the module says.
unsafe fn unsupported(c: Component, call: Call, capability: &str) -> c_int {
    let refusal = || Refusal::from(format!("this FMU does not declare {capability}"));
    // SAFETY: the caller's promise.
    unsafe { with_instance::<()>(c, call, |_| Err(refusal())) }
}
