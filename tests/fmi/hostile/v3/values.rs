//! Getting and setting values: pointers, lengths, numbers.

use super::super::edge::{edge, misaligned, text};
use super::super::rows::Row;
use super::super::target::Text;
use super::refused;
use crate::support::*;
use std::ptr::{null, null_mut};

const OUTPUT: &str = "left.displacement[1]";
const INPUT: &str = "left.force[1]";

pub fn rows() -> Vec<Row> {
    [getting(), setting(), integers_and_booleans(), strings()].into_iter().flatten().collect()
}

// SAFETY: of each call: arrays with room for what is announced, or null, or what is refused before anything is read.
fn getting() -> Vec<Row> {
    let name = "fmi3GetFloat64";
    let get = move |words: &str, vr: Option<usize>, n: usize, values: Option<usize>, n_values: usize| {
        refused(name, words, move |t, c| {
            let vr = vr.map_or(null(), |n| edge(&vec![t.vr(OUTPUT); n]).cast_const());
            let values = values.map_or(null_mut(), |n| edge(&vec![0.0; n]));
            // SAFETY: as above.
            unsafe { fmi3GetFloat64(c, vr, n, values, n_values) }
        })
    };
    vec![
        get("valueReferences = 0x0", None, 1, Some(1), 1),
        get("values = 0x0", Some(1), 1, None, 1),
        get("nValues = 2: expected 1", Some(1), 1, Some(2), 2),
        get("nValues = 1: expected 2", Some(2), 2, Some(1), 1),
        get("nValues = 0: expected 1", Some(1), 1, Some(0), 0),
        get("nValues = 1: expected 0", Some(0), 0, Some(1), 1),
        get("elements", Some(1), usize::MAX, Some(1), usize::MAX),
        // SAFETY: as above.
        refused("fmi3GetFloat64, misaligned values", "expected 1 elements", |t, c| unsafe {
            fmi3GetFloat64(c, edge(&[t.vr(OUTPUT)]), 1, misaligned(), 1)
        }),
    ]
}

fn setting() -> Vec<Row> {
    let set = |words: &str, has_references: bool, values: Option<Vec<f64>>, n_values: usize| {
        refused("fmi3SetFloat64", words, move |t, c| {
            let vr = if has_references { edge(&[t.vr(INPUT)]).cast_const() } else { null() };
            let values = values.as_ref().map_or(null(), |values| edge(values).cast_const());
            // SAFETY: as above.
            unsafe { fmi3SetFloat64(c, vr, 1, values, n_values) }
        })
    };
    vec![
        set("valueReferences = 0x0", false, Some(vec![0.0]), 1),
        set("values = 0x0", true, None, 1),
        set("nValues = 2: expected 1", true, Some(vec![0.0; 2]), 2),
        set("NaN", true, Some(vec![f64::NAN]), 1),
        set("inf", true, Some(vec![f64::INFINITY]), 1),
    ]
}

fn integers_and_booleans() -> Vec<Row> {
    let (count, flag) = ("impacts", "contact[1].active");
    let integers = move |words: &str, values: fn() -> *mut i32, n| {
        // SAFETY: as above.
        refused("fmi3GetInt32", words, move |t, c| unsafe { fmi3GetInt32(c, edge(&[t.vr(count)]), 1, values(), n) })
    };
    let booleans = move |words: &str, values: fn() -> *mut u8, n| {
        // SAFETY: as above.
        refused("fmi3GetBoolean", words, move |t, c| unsafe { fmi3GetBoolean(c, edge(&[t.vr(flag)]), 1, values(), n) })
    };
    vec![
        integers("nValues = 2: expected 1", || edge(&[0; 2]), 2),
        integers("values = 0x0", null_mut, 1),
        booleans("nValues = 2: expected 1", || edge(&[0; 2]), 2),
        booleans("values = 0x0", null_mut, 1),
    ]
}

fn strings() -> Vec<Row> {
    const RECORD: &str = "ground.record";
    let get = |words: &str, values: fn() -> *mut Text, n| {
        // SAFETY: as above.
        refused("fmi3GetString", words, move |t, c| unsafe { fmi3GetString(c, edge(&[t.vr(RECORD)]), 1, values(), n) })
    };
    let set = |words: &str, values: fn() -> *const Text, n| {
        // SAFETY: as above.
        refused("fmi3SetString", words, move |t, c| unsafe { fmi3SetString(c, edge(&[t.vr(RECORD)]), 1, values(), n) })
    };
    vec![
        get("values = 0x0", null_mut, 1),
        get("nValues = 2: expected 1", || edge(&[null(); 2]), 2),
        set("values = 0x0", null, 1),
        set("nValues = 2: expected 1", || edge(&[text(b""); 2]), 2),
        set("values[0] is null", || edge(&[null()]), 1),
        set("values[0]", || edge(&[text(b"\xff.csv")]), 1),
    ]
}
