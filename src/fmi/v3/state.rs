//! Functions of all kinds of FMU: recording states, coming back to them, and their bytes.

use crate::fmi::common::fence::functions;
use crate::fmi::common::state::{
    deserialize_state, free_state, get_state, serialize_state, serialized_size, set_state,
};
use crate::fmi::common::types::FmuState;

functions! { v3:
    fmi3GetFMUState = GetFMUstate(state: *mut FmuState) |instance| get_state(instance, state);
    fmi3SetFMUState = SetFMUstate(state: FmuState) |instance| set_state(instance, state);
    fmi3FreeFMUState = FreeFMUstate(state: *mut FmuState) |instance| free_state(instance, state);
    fmi3SerializedFMUStateSize = SerializedFMUstateSize(state: FmuState, size: *mut usize) |instance| {
        serialized_size(instance, state, size)
    };
    fmi3SerializeFMUState = SerializeFMUstate(state: FmuState, bytes: *mut u8, size: usize) |instance| {
        serialize_state(instance, state, (bytes, size))
    };
    fmi3DeserializeFMUState = DeSerializeFMUstate(bytes: *const u8, size: usize, state: *mut FmuState) |instance| {
        deserialize_state(instance, (bytes, size), state)
    };
}
