//! The functions for states, as methods of an instance.

use super::{ERROR, Instance, OK, State};
use std::ffi::c_int;
use std::ptr::null_mut;

impl Instance<'_> {
    /// Null is a place without a state.
    pub fn get_state(&self, place: *mut State) -> c_int {
        // SAFETY: a live instance, and a place that is null or a pointer.
        unsafe { (self.functions().record)(self.component, place) }
    }

    /// A new snapshot.
    pub fn recorded(&self) -> State {
        let mut state = null_mut();
        assert_eq!(self.get_state(&raw mut state), OK, "{:?}", self.log());
        assert!(!state.is_null());
        state
    }

    pub fn set_state(&self, state: State) -> c_int {
        // SAFETY: a live instance; the library never follows the pointer.
        unsafe { (self.functions().restore)(self.component, state) }
    }

    pub fn free_state(&self, place: *mut State) -> c_int {
        // SAFETY: a live instance, and a place that is null or a pointer.
        unsafe { (self.functions().free)(self.component, place) }
    }

    pub fn serialized_size(&self, state: State, size: *mut usize) -> c_int {
        // SAFETY: a live instance, and a place that is null or a size.
        unsafe { (self.functions().size)(self.component, state, size) }
    }

    pub fn serialize_to(&self, state: State, bytes: *mut u8, size: usize) -> c_int {
        // SAFETY: a live instance, and null or room for so many bytes.
        unsafe { (self.functions().serialize)(self.component, state, bytes, size) }
    }

    /// The bytes of a snapshot.
    pub fn serialized(&self, state: State) -> Vec<u8> {
        self.functions().bytes(self.component, state)
    }

    pub fn deserialize_from(&self, bytes: *const u8, size: usize, place: *mut State) -> c_int {
        // SAFETY: a live instance, bytes that are there or null, and a place that is null or a pointer.
        unsafe { (self.functions().deserialize)(self.component, bytes, size, place) }
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
        self.only_error()
    }
}
