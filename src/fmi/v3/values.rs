//! Getting and setting values of the types that variables have here.

use super::types::Boolean;
use crate::fmi::common::fence::v3;
use crate::fmi::common::types::{Component, Text, ValueReference};
use crate::fmi::common::values::{Pairs, get, get_strings, set, set_strings};
use crate::slave::Call;
use crate::variables::Value;
use std::ffi::c_int;

#[cfg_attr(fmi_exports, unsafe(no_mangle))]
pub unsafe extern "C" fn fmi3GetFloat64(
    c: Component,
    vr: *const ValueReference,
    n: usize,
    values: *mut f64,
    n_values: usize,
) -> c_int {
    let pairs = Pairs { vr, n, values, n_values };
    // SAFETY: as the module says.
    unsafe { get(c, v3(Call::GetReal), pairs, "Float64", |value| value.real()) }
}

#[cfg_attr(fmi_exports, unsafe(no_mangle))]
pub unsafe extern "C" fn fmi3GetInt32(
    c: Component,
    vr: *const ValueReference,
    n: usize,
    values: *mut i32,
    n_values: usize,
) -> c_int {
    let pairs = Pairs { vr, n, values, n_values };
    // SAFETY: as the module says.
    unsafe { get(c, v3(Call::GetInteger), pairs, "Int32", |value| value.integer()) }
}

#[cfg_attr(fmi_exports, unsafe(no_mangle))]
pub unsafe extern "C" fn fmi3GetBoolean(
    c: Component,
    vr: *const ValueReference,
    n: usize,
    values: *mut Boolean,
    n_values: usize,
) -> c_int {
    let pairs = Pairs { vr, n, values, n_values };
    // SAFETY: as the module says.
    unsafe { get(c, v3(Call::GetBoolean), pairs, "Boolean", |value| value.boolean().map(Boolean::from)) }
}

/// The strings belong to the instance and live until the next call of this function.
#[cfg_attr(fmi_exports, unsafe(no_mangle))]
pub unsafe extern "C" fn fmi3GetString(
    c: Component,
    vr: *const ValueReference,
    n: usize,
    values: *mut Text,
    n_values: usize,
) -> c_int {
    // SAFETY: as the module says.
    unsafe { get_strings(c, v3(Call::GetString), Pairs { vr, n, values, n_values }) }
}

#[cfg_attr(fmi_exports, unsafe(no_mangle))]
pub unsafe extern "C" fn fmi3SetFloat64(
    c: Component,
    vr: *const ValueReference,
    n: usize,
    values: *const f64,
    n_values: usize,
) -> c_int {
    // SAFETY: as the module says.
    unsafe { set(c, v3(Call::SetReal), Pairs { vr, n, values, n_values }, Value::Real) }
}

#[cfg_attr(fmi_exports, unsafe(no_mangle))]
pub unsafe extern "C" fn fmi3SetString(
    c: Component,
    vr: *const ValueReference,
    n: usize,
    values: *const Text,
    n_values: usize,
) -> c_int {
    // SAFETY: as the module says.
    unsafe { set_strings(c, v3(Call::SetString), Pairs { vr, n, values, n_values }) }
}
