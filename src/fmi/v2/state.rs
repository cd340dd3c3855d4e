//! Functions of all kinds of FMU: recording states, coming back to them, and their bytes.

use crate::fmi::common::fence::v2;
use crate::fmi::common::state::{
    deserialize_state, free_state, get_state, serialize_state, serialized_size, set_state,
};
use crate::fmi::common::types::{Component, FmuState};
use crate::slave::Call;
use std::ffi::c_int;

#[cfg_attr(fmi_exports, unsafe(no_mangle))]
pub unsafe extern "C" fn fmi2GetFMUstate(c: Component, state: *mut FmuState) -> c_int {
    // SAFETY: as the module says.
    unsafe { get_state(c, v2(Call::GetFMUstate), state) }
}

#[cfg_attr(fmi_exports, unsafe(no_mangle))]
pub unsafe extern "C" fn fmi2SetFMUstate(c: Component, state: FmuState) -> c_int {
    // SAFETY: as the module says.
    unsafe { set_state(c, v2(Call::SetFMUstate), state) }
}

#[cfg_attr(fmi_exports, unsafe(no_mangle))]
pub unsafe extern "C" fn fmi2FreeFMUstate(c: Component, state: *mut FmuState) -> c_int {
    // SAFETY: as the module says.
    unsafe { free_state(c, v2(Call::FreeFMUstate), state) }
}

#[cfg_attr(fmi_exports, unsafe(no_mangle))]
pub unsafe extern "C" fn fmi2SerializedFMUstateSize(c: Component, state: FmuState, size: *mut usize) -> c_int {
    // SAFETY: as the module says.
    unsafe { serialized_size(c, v2(Call::SerializedFMUstateSize), state, size) }
}

#[cfg_attr(fmi_exports, unsafe(no_mangle))]
pub unsafe extern "C" fn fmi2SerializeFMUstate(c: Component, state: FmuState, bytes: *mut u8, size: usize) -> c_int {
    // SAFETY: as the module says.
    unsafe { serialize_state(c, v2(Call::SerializeFMUstate), state, (bytes, size)) }
}

#[cfg_attr(fmi_exports, unsafe(no_mangle))]
pub unsafe extern "C" fn fmi2DeSerializeFMUstate(
    c: Component,
    bytes: *const u8,
    size: usize,
    state: *mut FmuState,
) -> c_int {
    // SAFETY: as the module says.
    unsafe { deserialize_state(c, v2(Call::DeSerializeFMUstate), (bytes, size), state) }
}
