//! The functions for states, as methods of an instance.

use super::{ERROR, Instance, OK};
use std::ffi::{c_int, c_void};
use std::ptr::null_mut;

/// `fmi2FMUstate`
pub type State = *mut c_void;
type OfPlace = unsafe extern "C" fn(*mut c_void, *mut State) -> c_int;

impl Instance<'_> {
    /// `fmi2GetFMUstate`; null is a place without a state.
    pub fn get_state(&self, place: *mut State) -> c_int {
        // SAFETY: a live component, and a place that is null or a pointer.
        unsafe { self.fmu.symbol::<OfPlace>("fmi2GetFMUstate")(self.component, place) }
    }

    /// A new snapshot.
    pub fn recorded(&self) -> State {
        let mut state = null_mut();
        assert_eq!(self.get_state(&raw mut state), OK, "{:?}", self.log());
        assert!(!state.is_null());
        state
    }

    pub fn set_state(&self, state: State) -> c_int {
        type Set = unsafe extern "C" fn(*mut c_void, State) -> c_int;
        // SAFETY: a live component; the library never follows the pointer.
        unsafe { self.fmu.symbol::<Set>("fmi2SetFMUstate")(self.component, state) }
    }

    pub fn free_state(&self, place: *mut State) -> c_int {
        // SAFETY: a live component, and a place that is null or a pointer.
        unsafe { self.fmu.symbol::<OfPlace>("fmi2FreeFMUstate")(self.component, place) }
    }

    pub fn serialized_size(&self, state: State, size: *mut usize) -> c_int {
        type Size = unsafe extern "C" fn(*mut c_void, State, *mut usize) -> c_int;
        // SAFETY: a live component, and a place that is null or a size.
        unsafe { self.fmu.symbol::<Size>("fmi2SerializedFMUstateSize")(self.component, state, size) }
    }

    pub fn serialize_to(&self, state: State, bytes: *mut u8, size: usize) -> c_int {
        type Serialize = unsafe extern "C" fn(*mut c_void, State, *mut u8, usize) -> c_int;
        // SAFETY: a live component, and null or room for so many bytes.
        unsafe { self.fmu.symbol::<Serialize>("fmi2SerializeFMUstate")(self.component, state, bytes, size) }
    }

    /// The bytes of a snapshot.
    pub fn serialized(&self, state: State) -> Vec<u8> {
        let mut size = 0;
        assert_eq!(self.serialized_size(state, &raw mut size), OK, "{:?}", self.log());
        let mut bytes = vec![0; size];
        assert_eq!(self.serialize_to(state, bytes.as_mut_ptr(), size), OK, "{:?}", self.log());
        bytes
    }

    pub fn deserialize_from(&self, bytes: *const u8, size: usize, place: *mut State) -> c_int {
        type Deserialize = unsafe extern "C" fn(*mut c_void, *const u8, usize, *mut State) -> c_int;
        // SAFETY: a live component, bytes that are there or null, and a place that is null or a pointer.
        unsafe { self.fmu.symbol::<Deserialize>("fmi2DeSerializeFMUstate")(self.component, bytes, size, place) }
    }

    /// A snapshot of bytes that are whole.
    pub fn deserialized(&self, bytes: &[u8]) -> State {
        let mut state = null_mut();
        assert_eq!(self.deserialize_from(bytes.as_ptr(), bytes.len(), &raw mut state), OK, "{:?}", self.log());
        assert!(!state.is_null());
        state
    }

    /// The only message about bytes that must be refused.
    pub fn refused(&self, bytes: &[u8]) -> String {
        let mut state = null_mut();
        self.log();
        assert_eq!(self.deserialize_from(bytes.as_ptr(), bytes.len(), &raw mut state), ERROR, "{} bytes", bytes.len());
        assert!(state.is_null());
        let [line] = &self.log()[..] else { panic!("one message") };
        assert_eq!((line.status, line.category.as_str()), (ERROR, "logStatusError"));
        line.message.clone()
    }
}
