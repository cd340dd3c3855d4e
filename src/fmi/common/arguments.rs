//! Pointers into slices, strings, flags.

use super::types::Text;
use crate::FmiVersion;
use crate::slave::Refusal;
use std::ffi::{CStr, c_int};
use std::mem::MaybeUninit;
use std::slice;

/// An array of the caller's; null is good enough for no elements.
///
/// # Safety
/// Where `array` is not null it points to `n` elements that nobody changes during `'a`.
pub(in crate::fmi) unsafe fn slice_in<'a, T>(name: &str, array: *const T, n: usize) -> Result<&'a [T], Refusal> {
    if n == 0 {
        return Ok(&[]);
    }
    check_array(name, array, n)?;
    // SAFETY: not null, aligned, of a size that exists, and the rest is the caller's promise.
    Ok(unsafe { slice::from_raw_parts(array, n) })
}

/// An array that the call fills; null is good enough for no elements.
///
/// # Safety
/// Where `array` is not null it points to room for `n` elements that nobody else uses during `'a`.
pub(in crate::fmi) unsafe fn slice_out<'a, T>(
    name: &str,
    array: *mut T,
    n: usize,
) -> Result<&'a mut [MaybeUninit<T>], Refusal> {
    if n == 0 {
        return Ok(&mut []);
    }
    check_array(name, array, n)?;
    // SAFETY: not null, aligned, of a size that exists, and the rest is the caller's promise.
    Ok(unsafe { slice::from_raw_parts_mut(array.cast(), n) })
}

/// One value that the call fills.
///
/// # Safety
/// As for [`slice_out`] with one element.
pub(in crate::fmi) unsafe fn store<T>(name: &str, place: *mut T, value: T) -> Result<(), Refusal> {
    // SAFETY: the caller's promise.
    unsafe { Place::new(name, place)?.write(value) };
    Ok(())
}

/// One value that the caller has filled.
///
/// # Safety
/// As for [`slice_in`] with one element.
pub(in crate::fmi) unsafe fn load<T: Copy>(name: &str, place: *const T) -> Result<T, Refusal> {
    check_array(name, place, 1)?;
    // SAFETY: not null, aligned, and the rest is the caller's promise.
    Ok(unsafe { place.read() })
}

/// Elements of any array: there are no more value references, and nothing else is larger. A count beyond is an error of
/// the caller's, and following it would be a crash.
const MOST_ELEMENTS: u64 = 1 << 32;

#[inline]
fn check_array<T>(name: &str, array: *const T, n: usize) -> Result<(), Refusal> {
    if has_possible_size::<T>(n) && !array.is_null() && array.is_aligned() {
        return Ok(());
    }
    Err(array_refusal(name, array, n))
}

fn has_possible_size<T>(n: usize) -> bool {
    n as u64 <= MOST_ELEMENTS && n.checked_mul(size_of::<T>()).is_some_and(|bytes| isize::try_from(bytes).is_ok())
}

#[cold]
fn array_refusal<T>(name: &str, array: *const T, n: usize) -> Refusal {
    Refusal::from(match has_possible_size::<T>(n) {
        false => format!("{n} elements of {name}: expected at most {MOST_ELEMENTS}"),
        true => format!("{name} = {array:?}: expected {n} elements"),
    })
}

/// A string of the caller's, verbatim.
///
/// # Safety
/// `text` is null or ends with a zero, and nobody changes it during `'a`.
pub(in crate::fmi) unsafe fn bytes_in<'a>(name: &str, text: Text) -> Result<&'a CStr, Refusal> {
    if text.is_null() {
        return Err(Refusal::from(format!("{name} is null: expected a string")));
    }
    // SAFETY: not null, and the rest is the caller's promise.
    Ok(unsafe { CStr::from_ptr(text) })
}

/// A string of the caller's.
///
/// # Safety
/// As for [`bytes_in`].
pub(in crate::fmi) unsafe fn str_in<'a>(name: &str, text: Text) -> Result<&'a str, Refusal> {
    // SAFETY: the caller's promise.
    let bytes = unsafe { bytes_in(name, text) }?;
    bytes.to_str().map_err(|error| Refusal::from(format!("{name} = {:?}: expected UTF-8 ({error})", bytes)))
}

/// An array of strings of the caller's, or everything that is wrong with them.
///
/// # Safety
/// As for [`slice_in`] and [`bytes_in`].
pub(in crate::fmi) unsafe fn strs_in<'a>(name: &str, array: *const Text, n: usize) -> Result<Vec<&'a str>, Refusal> {
    // SAFETY: the caller's promise.
    let texts = unsafe { slice_in(name, array, n) }?;
    let (mut strings, mut problems) = (Vec::new(), Vec::new());
    for (i, &text) in texts.iter().enumerate() {
        // SAFETY: the caller's promise.
        match unsafe { str_in(&format!("{name}[{i}]"), text) } {
            Ok(string) => strings.push(string),
            Err(refusal) => problems.extend(refusal.problems),
        }
    }
    Refusal::unless_empty(problems)?;
    Ok(strings)
}

/// `fmi2Boolean`, which is an `int`, or `fmi3Boolean`, which is one byte.
pub(in crate::fmi) fn boolean(version: FmiVersion, name: &str, value: impl Into<c_int>) -> Result<bool, Refusal> {
    let prefix = match version {
        FmiVersion::V2 => "fmi2",
        FmiVersion::V3 => "fmi3",
    };
    match value.into() {
        0 => Ok(false),
        1 => Ok(true),
        value => Err(Refusal::from(format!("{name} = {value}: expected {prefix}False (0) or {prefix}True (1)"))),
    }
}

/// Whether an array has as many elements as the call has things to fill or to take them.
#[inline]
pub(in crate::fmi) fn check_length(name: &str, n: usize, expected: usize) -> Result<(), Refusal> {
    if n == expected { Ok(()) } else { Err(length_refusal(name, n, expected)) }
}

#[cold]
fn length_refusal(name: &str, n: usize, expected: usize) -> Refusal {
    Refusal::from(format!("{name} = {n}: expected {expected}"))
}

/// A place for one value that has been looked at before anything happens.
#[derive(Debug)]
pub(in crate::fmi) struct Place<T>(*mut T);

impl<T> Place<T> {
    /// Nothing is written yet.
    pub(in crate::fmi) fn new(name: &str, place: *mut T) -> Result<Place<T>, Refusal> {
        check_array(name, place, 1)?;
        Ok(Place(place))
    }

    /// # Safety
    /// The place has room for a value, which nobody else uses now.
    pub(in crate::fmi) unsafe fn write(&self, value: T) {
        // SAFETY: not null, aligned, and the rest is the caller's promise.
        unsafe { self.0.write(value) };
    }
}
