//! Functions that depend on a capability which the description does not declare: they are there and refuse.

use super::fence::with_instance;
use super::types::{Component, ValueReference};
use crate::slave::{Call, Refusal};
use std::ffi::c_int;

#[unsafe(no_mangle)]
unsafe extern "C" fn fmi2GetDirectionalDerivative(
    c: Component,
    _unknowns: *const ValueReference,
    _n_unknowns: usize,
    _knowns: *const ValueReference,
    _n_knowns: usize,
    _seed: *const f64,
    _sensitivity: *mut f64,
) -> c_int {
    // SAFETY: as the module says.
    unsafe { unsupported(c, Call::GetDirectionalDerivative, "providesDirectionalDerivative") }
}

#[unsafe(no_mangle)]
unsafe extern "C" fn fmi2SetRealInputDerivatives(
    c: Component,
    _vr: *const ValueReference,
    _n: usize,
    _orders: *const c_int,
    _values: *const f64,
) -> c_int {
    // SAFETY: as the module says.
    unsafe { unsupported(c, Call::SetRealInputDerivatives, "canInterpolateInputs") }
}

#[unsafe(no_mangle)]
unsafe extern "C" fn fmi2GetRealOutputDerivatives(
    c: Component,
    _vr: *const ValueReference,
    _n: usize,
    _orders: *const c_int,
    _values: *mut f64,
) -> c_int {
    // SAFETY: as the module says.
    unsafe { unsupported(c, Call::GetRealOutputDerivatives, "maxOutputDerivativeOrder") }
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
