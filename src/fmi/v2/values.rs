//! Functions of all kinds of FMU: getting and setting values.

use super::types::Boolean;
use crate::fmi::common::fence::v2;
use crate::fmi::common::types::{Component, Text, ValueReference};
use crate::fmi::common::values::{Pairs, get, get_strings, set, set_strings};
use crate::slave::Call;
use crate::variables::Value;
use std::ffi::c_int;

#[cfg_attr(fmi_exports, unsafe(no_mangle))]
pub unsafe extern "C" fn fmi2GetReal(c: Component, vr: *const ValueReference, n: usize, values: *mut f64) -> c_int {
    // SAFETY: as the module says.
    unsafe { get(c, v2(Call::GetReal), Pairs::new(vr, n, values), "Real", |value| value.real()) }
}

#[cfg_attr(fmi_exports, unsafe(no_mangle))]
pub unsafe extern "C" fn fmi2GetInteger(
    c: Component,
    vr: *const ValueReference,
    n: usize,
    values: *mut c_int,
) -> c_int {
    // SAFETY: as the module says.
    unsafe { get(c, v2(Call::GetInteger), Pairs::new(vr, n, values), "Integer", |value| value.integer()) }
}

#[cfg_attr(fmi_exports, unsafe(no_mangle))]
pub unsafe extern "C" fn fmi2GetBoolean(
    c: Component,
    vr: *const ValueReference,
    n: usize,
    values: *mut Boolean,
) -> c_int {
    let pick = |value: Value<'_>| value.boolean().map(Boolean::from);
    // SAFETY: as the module says.
    unsafe { get(c, v2(Call::GetBoolean), Pairs::new(vr, n, values), "Boolean", pick) }
}

/// The strings belong to the instance and live until the next call of this function.
#[cfg_attr(fmi_exports, unsafe(no_mangle))]
pub unsafe extern "C" fn fmi2GetString(c: Component, vr: *const ValueReference, n: usize, values: *mut Text) -> c_int {
    // SAFETY: as the module says.
    unsafe { get_strings(c, v2(Call::GetString), Pairs::new(vr, n, values)) }
}

#[cfg_attr(fmi_exports, unsafe(no_mangle))]
pub unsafe extern "C" fn fmi2SetReal(c: Component, vr: *const ValueReference, n: usize, values: *const f64) -> c_int {
    // SAFETY: as the module says.
    unsafe { set(c, v2(Call::SetReal), Pairs::new(vr, n, values), Value::Real) }
}

#[cfg_attr(fmi_exports, unsafe(no_mangle))]
pub unsafe extern "C" fn fmi2SetInteger(
    c: Component,
    vr: *const ValueReference,
    n: usize,
    values: *const c_int,
) -> c_int {
    // SAFETY: as the module says.
    unsafe { set(c, v2(Call::SetInteger), Pairs::new(vr, n, values), Value::Integer) }
}

#[cfg_attr(fmi_exports, unsafe(no_mangle))]
pub unsafe extern "C" fn fmi2SetBoolean(
    c: Component,
    vr: *const ValueReference,
    n: usize,
    values: *const Boolean,
) -> c_int {
    // SAFETY: as the module says.
    unsafe { set(c, v2(Call::SetBoolean), Pairs::new(vr, n, values), |value| Value::Boolean(value != 0)) }
}

#[cfg_attr(fmi_exports, unsafe(no_mangle))]
pub unsafe extern "C" fn fmi2SetString(
    c: Component,
    vr: *const ValueReference,
    n: usize,
    values: *const Text,
) -> c_int {
    // SAFETY: as the module says.
    unsafe { set_strings(c, v2(Call::SetString), Pairs::new(vr, n, values)) }
}
