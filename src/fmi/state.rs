//! Functions of all kinds of FMU: recording states, coming back to them, and their bytes.

use super::arguments::{load, slice_in, slice_out, store};
use super::fence::with_instance;
use super::types::{Component, FmuState};
use crate::slave::{Call, Handle, Refusal};
use std::ffi::c_int;
use std::num::NonZeroUsize;
use std::ptr::{null_mut, without_provenance_mut};

#[cfg_attr(fmi_exports, unsafe(no_mangle))]
pub unsafe extern "C" fn fmi2GetFMUstate(c: Component, state: *mut FmuState) -> c_int {
    // SAFETY: as the module says.
    unsafe {
        with_instance(c, Call::GetFMUstate, |instance| {
            let recorded = instance.slave.record_state(handle(load("FMUstate", state)?))?;
            store("FMUstate", state, pointer(recorded))
        })
    }
}

#[cfg_attr(fmi_exports, unsafe(no_mangle))]
pub unsafe extern "C" fn fmi2SetFMUstate(c: Component, state: FmuState) -> c_int {
    // SAFETY: as the module says.
    unsafe { with_instance(c, Call::SetFMUstate, |instance| instance.slave.restore_state(handle(state))) }
}

/// No place for a pointer is nothing to free, like a place without one.
#[cfg_attr(fmi_exports, unsafe(no_mangle))]
pub unsafe extern "C" fn fmi2FreeFMUstate(c: Component, state: *mut FmuState) -> c_int {
    // SAFETY: as the module says.
    unsafe {
        with_instance(c, Call::FreeFMUstate, |instance| {
            if state.is_null() {
                return Ok(());
            }
            instance.slave.free_state(handle(load("FMUstate", state)?))?;
            store("FMUstate", state, null_mut())
        })
    }
}

#[cfg_attr(fmi_exports, unsafe(no_mangle))]
pub unsafe extern "C" fn fmi2SerializedFMUstateSize(c: Component, state: FmuState, size: *mut usize) -> c_int {
    // SAFETY: as the module says.
    unsafe {
        with_instance(c, Call::SerializedFMUstateSize, |instance| {
            store("size", size, instance.slave.serialized_size(handle(state))?)
        })
    }
}

#[cfg_attr(fmi_exports, unsafe(no_mangle))]
pub unsafe extern "C" fn fmi2SerializeFMUstate(c: Component, state: FmuState, bytes: *mut u8, size: usize) -> c_int {
    // SAFETY: as the module says.
    unsafe {
        with_instance(c, Call::SerializeFMUstate, |instance| {
            let serialized = instance.slave.serialize_state(handle(state))?;
            if serialized.len() != size {
                return Err(Refusal::from(format!("size = {size}: expected {}", serialized.len())));
            }
            for (place, byte) in slice_out("serializedState", bytes, size)?.iter_mut().zip(serialized) {
                place.write(byte);
            }
            Ok(())
        })
    }
}

#[cfg_attr(fmi_exports, unsafe(no_mangle))]
pub unsafe extern "C" fn fmi2DeSerializeFMUstate(
    c: Component,
    bytes: *const u8,
    size: usize,
    state: *mut FmuState,
) -> c_int {
    // SAFETY: as the module says.
    unsafe {
        with_instance(c, Call::DeSerializeFMUstate, |instance| {
            let earlier = handle(load("FMUstate", state)?);
            let recorded = instance.slave.deserialize_state(slice_in("serializedState", bytes, size)?, earlier)?;
            store("FMUstate", state, pointer(recorded))
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
