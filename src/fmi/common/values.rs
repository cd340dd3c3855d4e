//! Getting and setting values of any type.

use super::arguments::{check_length, slice_in, slice_out, strs_in};
use super::instance::Instance;
use super::logger::c_string;
use super::types::{Text, ValueReference};
use crate::FmiVersion;
use crate::slave::Refusal;
use crate::variables::Value;
use std::mem::MaybeUninit;

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

    /// The value references, and what the array of values is called.
    ///
    /// # Safety
    /// As `fmi/mod.rs` says, with as many elements in both arrays as they are counted.
    #[inline(always)]
    unsafe fn references<'a>(&self, instance: &Instance) -> Result<(&'a [ValueReference], &'static str), Refusal> {
        let (of_vr, of_values) = match instance.slave.version() {
            FmiVersion::V2 => ("vr", "value"),
            FmiVersion::V3 => ("valueReferences", "values"),
        };
        check_length("nValues", self.n_values, self.n)?;
        // SAFETY: the caller's promise.
        Ok((unsafe { slice_in(of_vr, self.vr, self.n) }?, of_values))
    }
}

impl<T> Pairs<*mut T> {
    /// The value references, and the places for the values.
    ///
    /// # Safety
    /// As for [`Pairs::references`].
    #[inline(always)]
    pub(super) unsafe fn out<'a>(
        &self,
        instance: &Instance,
    ) -> Result<(&'a [ValueReference], &'a mut [MaybeUninit<T>]), Refusal> {
        // SAFETY: the caller's promise.
        unsafe {
            let (vr, of_values) = self.references(instance)?;
            Ok((vr, slice_out(of_values, self.values, self.n)?))
        }
    }
}

/// Values that `pick` finds to be of the `wanted` type.
///
/// # Safety
/// As for [`Pairs::references`].
pub(in crate::fmi) unsafe fn get<T>(
    instance: &mut Instance,
    pairs: Pairs<*mut T>,
    wanted: &str,
    pick: impl Fn(Value<'_>) -> Option<T>,
) -> Result<(), Refusal> {
    // SAFETY: the caller's promise.
    let (vr, values) = unsafe { pairs.out(instance) }?;
    instance.slave.get(vr, wanted, |i, value| {
        values[i].write(pick(value)?);
        Some(())
    })
}

/// Values of the type that is called so in its version.
///
/// # Safety
/// As for [`Pairs::references`].
#[inline(always)]
pub(in crate::fmi) unsafe fn get_reals(
    instance: &mut Instance,
    pairs: Pairs<*mut f64>,
    wanted: &str,
) -> Result<(), Refusal> {
    // SAFETY: the caller's promise.
    let (vr, values) = unsafe { pairs.out(instance) }?;
    let read = instance.slave.read_outputs(vr, values);
    if read == vr.len() {
        return Ok(());
    }
    instance.slave.get(&vr[read..], wanted, |i, value| {
        values[read + i].write(value.real()?);
        Some(())
    })
}

/// Strings, which belong to the instance and live until the next call.
///
/// # Safety
/// As for [`Pairs::references`].
pub(in crate::fmi) unsafe fn get_strings(instance: &mut Instance, pairs: Pairs<*mut Text>) -> Result<(), Refusal> {
    // SAFETY: the caller's promise.
    let (vr, values) = unsafe { pairs.out(instance) }?;
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
}

/// Values, each of which `wrap` makes one of its type.
///
/// # Safety
/// As for [`Pairs::references`].
pub(in crate::fmi) unsafe fn set<T: Copy>(
    instance: &mut Instance,
    pairs: Pairs<*const T>,
    wrap: impl Fn(T) -> Value<'static>,
) -> Result<(), Refusal> {
    // SAFETY: the caller's promise.
    let (vr, values) = unsafe {
        let (vr, of_values) = pairs.references(instance)?;
        (vr, slice_in(of_values, pairs.values, pairs.n)?)
    };
    instance.slave.set(vr, |i| wrap(values[i]))
}

/// Strings.
///
/// # Safety
/// As for [`Pairs::references`], and of the strings that each ends with a zero.
pub(in crate::fmi) unsafe fn set_strings(instance: &mut Instance, pairs: Pairs<*const Text>) -> Result<(), Refusal> {
    // SAFETY: the caller's promise.
    let (vr, values) = unsafe {
        let (vr, of_values) = pairs.references(instance)?;
        (vr, strs_in(of_values, pairs.values, pairs.n)?)
    };
    instance.slave.set(vr, |i| Value::String(values[i]))
}
