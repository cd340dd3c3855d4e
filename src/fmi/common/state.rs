//! Recording states, coming back to them, and their bytes.

use super::arguments::{check_length, load, slice_in, slice_out, store};
use super::instance::Instance;
use super::types::FmuState;
use crate::slave::{Handle, Refusal};
use std::num::NonZeroUsize;
use std::ptr::{null_mut, without_provenance_mut};

/// # Safety
/// As `fmi/mod.rs` says.
pub(in crate::fmi) unsafe fn get_state(instance: &mut Instance, state: *mut FmuState) -> Result<(), Refusal> {
    let name = instance.slave.version().state_name();
    // SAFETY: the caller's promise.
    unsafe {
        let recorded = instance.slave.record_state(handle(load(name, state)?))?;
        store(name, state, pointer(recorded))
    }
}

pub(in crate::fmi) fn set_state(instance: &mut Instance, state: FmuState) -> Result<(), Refusal> {
    instance.slave.restore_state(handle(state))
}

/// No place for a pointer is nothing to free, like a place without one.
///
/// # Safety
/// As `fmi/mod.rs` says.
pub(in crate::fmi) unsafe fn free_state(instance: &mut Instance, state: *mut FmuState) -> Result<(), Refusal> {
    if state.is_null() {
        return Ok(());
    }
    let name = instance.slave.version().state_name();
    // SAFETY: the caller's promise.
    unsafe {
        instance.slave.free_state(handle(load(name, state)?))?;
        store(name, state, null_mut())
    }
}

/// # Safety
/// As `fmi/mod.rs` says.
pub(in crate::fmi) unsafe fn serialized_size(
    instance: &Instance,
    state: FmuState,
    size: *mut usize,
) -> Result<(), Refusal> {
    // SAFETY: the caller's promise.
    unsafe { store("size", size, instance.slave.serialized_size(handle(state))?) }
}

/// # Safety
/// As `fmi/mod.rs` says, with room for `size` bytes.
pub(in crate::fmi) unsafe fn serialize_state(
    instance: &Instance,
    state: FmuState,
    (bytes, size): (*mut u8, usize),
) -> Result<(), Refusal> {
    let serialized = instance.slave.serialize_state(handle(state))?;
    check_length("size", size, serialized.len())?;
    // SAFETY: the caller's promise.
    let places = unsafe { slice_out("serializedState", bytes, size) }?;
    for (place, byte) in places.iter_mut().zip(serialized) {
        place.write(byte);
    }
    Ok(())
}

/// # Safety
/// As `fmi/mod.rs` says, with `size` bytes.
pub(in crate::fmi) unsafe fn deserialize_state(
    instance: &mut Instance,
    (bytes, size): (*const u8, usize),
    state: *mut FmuState,
) -> Result<(), Refusal> {
    let name = instance.slave.version().state_name();
    // SAFETY: the caller's promise.
    unsafe {
        let earlier = handle(load(name, state)?);
        let recorded = instance.slave.deserialize_state(slice_in("serializedState", bytes, size)?, earlier)?;
        store(name, state, pointer(recorded))
    }
}

/// The pointer is a name, which nobody follows.
fn pointer(handle: Handle) -> FmuState {
    without_provenance_mut(handle.0.get())
}

fn handle(pointer: FmuState) -> Option<Handle> {
    NonZeroUsize::new(pointer.addr()).map(Handle)
}
