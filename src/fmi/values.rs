//! Functions of all kinds of FMU: getting and setting values.

use super::arguments::{slice_in, slice_out, strs_in};
use super::fence::with_instance;
use super::logger::c_string;
use super::types::{Boolean, Component, Text, ValueReference};
use crate::slave::Call;
use crate::variables::Value;
use std::ffi::c_int;

#[cfg_attr(fmi_exports, unsafe(no_mangle))]
pub unsafe extern "C" fn fmi2GetReal(c: Component, vr: *const ValueReference, n: usize, values: *mut f64) -> c_int {
    // SAFETY: as the module says.
    unsafe { get(c, Call::GetReal, (vr, n, values), "Real", |value| value.real()) }
}

#[cfg_attr(fmi_exports, unsafe(no_mangle))]
pub unsafe extern "C" fn fmi2GetInteger(
    c: Component,
    vr: *const ValueReference,
    n: usize,
    values: *mut c_int,
) -> c_int {
    // SAFETY: as the module says.
    unsafe { get(c, Call::GetInteger, (vr, n, values), "Integer", |value| value.integer()) }
}

#[cfg_attr(fmi_exports, unsafe(no_mangle))]
pub unsafe extern "C" fn fmi2GetBoolean(
    c: Component,
    vr: *const ValueReference,
    n: usize,
    values: *mut Boolean,
) -> c_int {
    // SAFETY: as the module says.
    unsafe { get(c, Call::GetBoolean, (vr, n, values), "Boolean", |value| value.boolean().map(Boolean::from)) }
}

/// The strings belong to the instance and live until the next call of this function.
#[cfg_attr(fmi_exports, unsafe(no_mangle))]
pub unsafe extern "C" fn fmi2GetString(c: Component, vr: *const ValueReference, n: usize, values: *mut Text) -> c_int {
    // SAFETY: as the module says.
    unsafe {
        with_instance(c, Call::GetString, |instance| {
            let (vr, values) = (slice_in("vr", vr, n)?, slice_out("value", values, n)?);
            let mut strings = Vec::new();
            instance.slave.get(vr, "String", |_, value| {
                strings.push(c_string(value.string()?));
                Some(())
            })?;
            for (place, string) in values.iter_mut().zip(&strings) {
                place.write(string.as_ptr());
            }
            instance.strings = strings;
            Ok(())
        })
    }
}

#[cfg_attr(fmi_exports, unsafe(no_mangle))]
pub unsafe extern "C" fn fmi2SetReal(c: Component, vr: *const ValueReference, n: usize, values: *const f64) -> c_int {
    // SAFETY: as the module says.
    unsafe { set(c, Call::SetReal, (vr, n, values), Value::Real) }
}

#[cfg_attr(fmi_exports, unsafe(no_mangle))]
pub unsafe extern "C" fn fmi2SetInteger(
    c: Component,
    vr: *const ValueReference,
    n: usize,
    values: *const c_int,
) -> c_int {
    // SAFETY: as the module says.
    unsafe { set(c, Call::SetInteger, (vr, n, values), Value::Integer) }
}

#[cfg_attr(fmi_exports, unsafe(no_mangle))]
pub unsafe extern "C" fn fmi2SetBoolean(
    c: Component,
    vr: *const ValueReference,
    n: usize,
    values: *const Boolean,
) -> c_int {
    // SAFETY: as the module says.
    unsafe { set(c, Call::SetBoolean, (vr, n, values), |value| Value::Boolean(value != 0)) }
}

#[cfg_attr(fmi_exports, unsafe(no_mangle))]
pub unsafe extern "C" fn fmi2SetString(
    c: Component,
    vr: *const ValueReference,
    n: usize,
    values: *const Text,
) -> c_int {
    // SAFETY: as the module says.
    unsafe {
        with_instance(c, Call::SetString, |instance| {
            let (vr, values) = (slice_in("vr", vr, n)?, strs_in("value", values, n)?);
            instance.slave.set(vr, |i| Value::String(values[i]))
        })
    }
}

/// # Safety
/// As the module says, with `n` elements in both arrays.
unsafe fn get<T>(
    c: Component,
    call: Call,
    (vr, n, values): (*const ValueReference, usize, *mut T),
    wanted: &str,
    pick: impl Fn(Value<'_>) -> Option<T>,
) -> c_int {
    // SAFETY: the caller's promise.
    unsafe {
        with_instance(c, call, |instance| {
            let (vr, values) = (slice_in("vr", vr, n)?, slice_out("value", values, n)?);
            instance.slave.get(vr, wanted, |i, value| {
                values[i].write(pick(value)?);
                Some(())
            })
        })
    }
}

/// # Safety
/// As the module says, with `n` elements in both arrays.
unsafe fn set<T: Copy>(
    c: Component,
    call: Call,
    (vr, n, values): (*const ValueReference, usize, *const T),
    wrap: impl Fn(T) -> Value<'static>,
) -> c_int {
    // SAFETY: the caller's promise.
    unsafe {
        with_instance(c, call, |instance| {
            let (vr, values) = (slice_in("vr", vr, n)?, slice_in("value", values, n)?);
            instance.slave.set(vr, |i| wrap(values[i]))
        })
    }
}
