//! States: pointers that are none, and bytes that are too few or too many.

use super::super::edge::edge;
use super::super::rows::{Row, row_3};
use super::refused;
use crate::support::*;
use std::ptr::{null, null_mut, without_provenance_mut};

/// Columns: instantiated, initialization, event, step complete, terminated, error, no instance.
const ALWAYS: &str = "ooooooe";

fn unknown() -> State {
    without_provenance_mut(0x1267)
}

pub fn rows() -> Vec<Row> {
    pointers().into_iter().chain(bytes()).collect()
}

// SAFETY: of each call: places, or null, with room for as many bytes as announced; a state is never followed.
fn pointers() -> Vec<Row> {
    const UNKNOWN: &str = "FMUState = 0x1267: expected one";
    vec![
        // SAFETY: as above.
        refused("fmi3GetFMUState", "FMUState = 0x0", |_, c| unsafe { fmi3GetFMUState(c, null_mut()) }),
        // SAFETY: as above.
        refused("fmi3GetFMUState", UNKNOWN, |_, c| unsafe { fmi3GetFMUState(c, edge(&[unknown()])) }),
        // SAFETY: as above.
        refused("fmi3SetFMUState", "FMUState is null", |_, c| unsafe { fmi3SetFMUState(c, null_mut()) }),
        // SAFETY: as above.
        refused("fmi3SetFMUState", UNKNOWN, |_, c| unsafe { fmi3SetFMUState(c, unknown()) }),
        // SAFETY: as above.
        refused("fmi3FreeFMUState", UNKNOWN, |_, c| unsafe { fmi3FreeFMUState(c, edge(&[unknown()])) }),
        // SAFETY: as above.
        row_3("fmi3FreeFMUState: no place", ALWAYS, |t| unsafe { fmi3FreeFMUState(t.component, null_mut()) }),
        // SAFETY: as above.
        row_3("fmi3FreeFMUState: a place without a state", ALWAYS, |t| unsafe {
            fmi3FreeFMUState(t.component, edge(&[null_mut()]))
        }),
        // SAFETY: as above.
        row_3("fmi3FreeFMUState: a state", ALWAYS, |t| unsafe {
            let place = edge(&[t.instance.recorded()]);
            let status = fmi3FreeFMUState(t.component, place);
            assert_eq!((*place).is_null(), status == OK);
            status
        }),
        // SAFETY: as above.
        refused("fmi3SerializedFMUStateSize", "FMUState is null", |_, c| unsafe {
            fmi3SerializedFMUStateSize(c, null_mut(), edge(&[0]))
        }),
        // SAFETY: as above.
        refused("fmi3SerializedFMUStateSize", "size = 0x0: expected 1 elements", |t, c| unsafe {
            fmi3SerializedFMUStateSize(c, t.instance.recorded(), null_mut())
        }),
    ]
}

fn bytes() -> Vec<Row> {
    vec![
        // SAFETY: as above.
        refused("fmi3SerializeFMUState", "FMUState = 0x1267: expected one", |_, c| unsafe {
            fmi3SerializeFMUState(c, unknown(), edge(&[0; 4]), 4)
        }),
        refused("fmi3SerializeFMUState", "size = ", |t, c| {
            let state = t.instance.recorded();
            let n = t.instance.serialized(state).len() + 1;
            // SAFETY: as above.
            unsafe { fmi3SerializeFMUState(c, state, edge(&vec![0; n]), n) }
        }),
        refused("fmi3SerializeFMUState", "serializedState = 0x0", |t, c| {
            let state = t.instance.recorded();
            // SAFETY: as above.
            unsafe { fmi3SerializeFMUState(c, state, null_mut(), t.instance.serialized(state).len()) }
        }),
        refused("fmi3DeserializeFMUState", "FMUState = 0x0", |t, c| {
            let bytes = t.instance.serialized(t.instance.recorded());
            // SAFETY: as above.
            unsafe { fmi3DeserializeFMUState(c, edge(&bytes), bytes.len(), null_mut()) }
        }),
        // SAFETY: as above.
        refused("fmi3DeserializeFMUState", "serializedState = 0x0", |_, c| unsafe {
            fmi3DeserializeFMUState(c, null(), 4, edge(&[null_mut()]))
        }),
        // SAFETY: as above.
        refused("fmi3DeserializeFMUState", "damaged", |_, c| unsafe {
            fmi3DeserializeFMUState(c, edge(&[0; 4]), 4, edge(&[null_mut()]))
        }),
    ]
}
