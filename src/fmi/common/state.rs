//! Recording states, coming back to them, and their bytes.

use super::arguments::{check_length, load, slice_in, slice_out, store};
use super::fence::{Function, with_instance};
use super::types::{Component, FmuState};
use crate::slave::Handle;
use std::ffi::c_int;
use std::num::NonZeroUsize;
use std::ptr::{null_mut, without_provenance_mut};

/// # Safety
/// As `fmi/mod.rs` says.
pub(in crate::fmi) unsafe fn get_state(c: Component, function: Function, state: *mut FmuState) -> c_int {
    let name = function.version.state_name();
    // SAFETY: the caller's promise.
    unsafe {
        with_instance(c, function, |instance| {
            let recorded = instance.slave.record_state(handle(load(name, state)?))?;
            store(name, state, pointer(recorded))
        })
    }
}

/// # Safety
/// As `fmi/mod.rs` says.
pub(in crate::fmi) unsafe fn set_state(c: Component, function: Function, state: FmuState) -> c_int {
    // SAFETY: the caller's promise.
    unsafe { with_instance(c, function, |instance| instance.slave.restore_state(handle(state))) }
}

/// No place for a pointer is nothing to free, like a place without one.
///
/// # Safety
/// As `fmi/mod.rs` says.
pub(in crate::fmi) unsafe fn free_state(c: Component, function: Function, state: *mut FmuState) -> c_int {
    let name = function.version.state_name();
    // SAFETY: the caller's promise.
    unsafe {
        with_instance(c, function, |instance| {
            if state.is_null() {
                return Ok(());
            }
            instance.slave.free_state(handle(load(name, state)?))?;
            store(name, state, null_mut())
        })
    }
}

/// # Safety
/// As `fmi/mod.rs` says.
pub(in crate::fmi) unsafe fn serialized_size(
    c: Component,
    function: Function,
    state: FmuState,
    size: *mut usize,
) -> c_int {
    // SAFETY: the caller's promise.
    unsafe {
        with_instance(c, function, |instance| store("size", size, instance.slave.serialized_size(handle(state))?))
    }
}

/// # Safety
/// As `fmi/mod.rs` says, with room for `size` bytes.
pub(in crate::fmi) unsafe fn serialize_state(
    c: Component,
    function: Function,
    state: FmuState,
    (bytes, size): (*mut u8, usize),
) -> c_int {
    // SAFETY: the caller's promise.
    unsafe {
        with_instance(c, function, |instance| {
            let serialized = instance.slave.serialize_state(handle(state))?;
            check_length("size", size, serialized.len())?;
            for (place, byte) in slice_out("serializedState", bytes, size)?.iter_mut().zip(serialized) {
                place.write(byte);
            }
            Ok(())
        })
    }
}

/// # Safety
/// As `fmi/mod.rs` says, with `size` bytes.
pub(in crate::fmi) unsafe fn deserialize_state(
    c: Component,
    function: Function,
    (bytes, size): (*const u8, usize),
    state: *mut FmuState,
) -> c_int {
    let name = function.version.state_name();
    // SAFETY: the caller's promise.
    unsafe {
        with_instance(c, function, |instance| {
            let earlier = handle(load(name, state)?);
            let recorded = instance.slave.deserialize_state(slice_in("serializedState", bytes, size)?, earlier)?;
            store(name, state, pointer(recorded))
        })
    }
}

/// The pointer is a name, which nobody follows.
fn pointer(handle: Handle) -> FmuState {
    without_provenance_mut(handle.0.get())
}

fn handle(pointer: FmuState) -> Option<Handle> {
    NonZeroUsize::new(pointer.addr()).map(Handle)
}
