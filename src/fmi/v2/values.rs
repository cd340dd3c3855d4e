//! Functions of all kinds of FMU: getting and setting values.

use super::types::Boolean;
use crate::fmi::common::fence::functions;
use crate::fmi::common::types::{Text, ValueReference};
use crate::fmi::common::values::{Pairs, get, get_reals, get_strings, set, set_strings};
use crate::variables::Value;
use std::ffi::c_int;

functions! { v2:
    fmi2GetReal = GetReal(vr: *const ValueReference, n: usize, values: *mut f64) |instance| {
        get_reals(instance, Pairs::new(vr, n, values), "Real")
    };
    fmi2GetInteger = GetInteger(vr: *const ValueReference, n: usize, values: *mut c_int) |instance| {
        get(instance, Pairs::new(vr, n, values), "Integer", |value| value.integer())
    };
    fmi2GetBoolean = GetBoolean(vr: *const ValueReference, n: usize, values: *mut Boolean) |instance| {
        get(instance, Pairs::new(vr, n, values), "Boolean", |value| value.boolean().map(Boolean::from))
    };
    /// The strings belong to the instance and live until the next call of this function.
    fmi2GetString = GetString(vr: *const ValueReference, n: usize, values: *mut Text) |instance| {
        get_strings(instance, Pairs::new(vr, n, values))
    };
    fmi2SetReal = SetReal(vr: *const ValueReference, n: usize, values: *const f64) |instance| {
        set(instance, Pairs::new(vr, n, values), Value::Real)
    };
    fmi2SetInteger = SetInteger(vr: *const ValueReference, n: usize, values: *const c_int) |instance| {
        set(instance, Pairs::new(vr, n, values), Value::Integer)
    };
    fmi2SetBoolean = SetBoolean(vr: *const ValueReference, n: usize, values: *const Boolean) |instance| {
        set(instance, Pairs::new(vr, n, values), |value| Value::Boolean(value != 0))
    };
    fmi2SetString = SetString(vr: *const ValueReference, n: usize, values: *const Text) |instance| {
        set_strings(instance, Pairs::new(vr, n, values))
    };
}
