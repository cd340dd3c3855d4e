//! Getting and setting values of the types that variables have here.

use super::types::Boolean;
use crate::fmi::common::fence::functions;
use crate::fmi::common::types::{Text, ValueReference};
use crate::fmi::common::values::{Pairs, get, get_reals, get_strings, set, set_strings};
use crate::variables::Value;

functions! { v3:
    fmi3GetFloat64 = GetReal(vr: *const ValueReference, n: usize, values: *mut f64, n_values: usize) |instance| {
        get_reals(instance, Pairs { vr, n, values, n_values }, "Float64")
    };
    fmi3GetInt32 = GetInteger(vr: *const ValueReference, n: usize, values: *mut i32, n_values: usize) |instance| {
        get(instance, Pairs { vr, n, values, n_values }, "Int32", |value| value.integer())
    };
    fmi3GetBoolean = GetBoolean(vr: *const ValueReference, n: usize, values: *mut Boolean, n_values: usize) |instance| {
        get(instance, Pairs { vr, n, values, n_values }, "Boolean", |value| value.boolean().map(Boolean::from))
    };
    /// The strings belong to the instance and live until the next call of this function.
    fmi3GetString = GetString(vr: *const ValueReference, n: usize, values: *mut Text, n_values: usize) |instance| {
        get_strings(instance, Pairs { vr, n, values, n_values })
    };
    fmi3SetFloat64 = SetReal(vr: *const ValueReference, n: usize, values: *const f64, n_values: usize) |instance| {
        set(instance, Pairs { vr, n, values, n_values }, Value::Real)
    };
    fmi3SetString = SetString(vr: *const ValueReference, n: usize, values: *const Text, n_values: usize) |instance| {
        set_strings(instance, Pairs { vr, n, values, n_values })
    };
}
