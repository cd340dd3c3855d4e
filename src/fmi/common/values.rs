//! Getting and setting values of any type.

use super::arguments::{check_length, slice_in, slice_out, strs_in};
use super::fence::{Function, with_instance};
use super::logger::c_string;
use super::types::{Component, Text, ValueReference};
use crate::FmiVersion;
use crate::variables::Value;
use std::ffi::c_int;

/// Value references and values of a call. FMI 3.0 counts both; each variable here has one value.
pub(in crate::fmi) struct Pairs<P> {
    pub vr: *const ValueReference,
    pub n: usize,
    pub values: P,
    pub n_values: usize,
}

impl<P> Pairs<P> {
    /// As FMI 2.0 counts them.
    pub(in crate::fmi) const fn new(vr: *const ValueReference, n: usize, values: P) -> Pairs<P> {
        Pairs { vr, n, values, n_values: n }
    }
}

/// What the two arrays are called in a version.
pub(super) const fn names(version: FmiVersion) -> (&'static str, &'static str) {
    match version {
        FmiVersion::V2 => ("vr", "value"),
        FmiVersion::V3 => ("valueReferences", "values"),
    }
}

/// Values that `pick` finds to be of the `wanted` type.
///
/// # Safety
/// As `fmi/mod.rs` says, with as many elements in both arrays as they are counted.
pub(in crate::fmi) unsafe fn get<T>(
    c: Component,
    function: Function,
    Pairs { vr, n, values, n_values }: Pairs<*mut T>,
    wanted: &str,
    pick: impl Fn(Value<'_>) -> Option<T>,
) -> c_int {
    let names = names(function.version);
    // SAFETY: the caller's promise.
    unsafe {
        with_instance(c, function, |instance| {
            check_length("nValues", n_values, n)?;
            let (vr, values) = (slice_in(names.0, vr, n)?, slice_out(names.1, values, n)?);
            instance.slave.get(vr, wanted, |i, value| {
                values[i].write(pick(value)?);
                Some(())
            })
        })
    }
}

/// Strings, which belong to the instance and live until the next call.
///
/// # Safety
/// As for [`get`].
pub(in crate::fmi) unsafe fn get_strings(
    c: Component,
    function: Function,
    Pairs { vr, n, values, n_values }: Pairs<*mut Text>,
) -> c_int {
    let names = names(function.version);
    // SAFETY: the caller's promise.
    unsafe {
        with_instance(c, function, |instance| {
            check_length("nValues", n_values, n)?;
            let (vr, values) = (slice_in(names.0, vr, n)?, slice_out(names.1, values, n)?);
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

/// Values, each of which `wrap` makes one of its type.
///
/// # Safety
/// As for [`get`].
pub(in crate::fmi) unsafe fn set<T: Copy>(
    c: Component,
    function: Function,
    Pairs { vr, n, values, n_values }: Pairs<*const T>,
    wrap: impl Fn(T) -> Value<'static>,
) -> c_int {
    let names = names(function.version);
    // SAFETY: the caller's promise.
    unsafe {
        with_instance(c, function, |instance| {
            check_length("nValues", n_values, n)?;
            let (vr, values) = (slice_in(names.0, vr, n)?, slice_in(names.1, values, n)?);
            instance.slave.set(vr, |i| wrap(values[i]))
        })
    }
}

/// Strings.
///
/// # Safety
/// As for [`get`], and of the strings that each ends with a zero.
pub(in crate::fmi) unsafe fn set_strings(
    c: Component,
    function: Function,
    Pairs { vr, n, values, n_values }: Pairs<*const Text>,
) -> c_int {
    let names = names(function.version);
    // SAFETY: the caller's promise.
    unsafe {
        with_instance(c, function, |instance| {
            check_length("nValues", n_values, n)?;
            let (vr, values) = (slice_in(names.0, vr, n)?, strs_in(names.1, values, n)?);
            instance.slave.set(vr, |i| Value::String(values[i]))
        })
    }
}
