//! Derivatives: pointers, and lengths that do not fit each other. Nothing is written.

use super::super::edge::edge;
use super::super::rows::Row;
use super::refused;
use crate::support::*;
use std::ptr::{null, null_mut};

const UNKNOWNS: [&str; 3] = ["left.displacement[1]", "left.acceleration[1]", "left.velocity[1]"];
const KNOWNS: [&str; 2] = ["left.force[2]", "left.force[1]"];

/// The array that is null, if there is one.
#[derive(Clone, Copy, PartialEq)]
enum Null {
    Nothing,
    Unknowns,
    Knowns,
    Seed,
    Sensitivity,
}

pub fn rows() -> Vec<Row> {
    partial().into_iter().chain(in_time()).collect()
}

type Partial =
    unsafe extern "C" fn(Component, *const u32, usize, *const u32, usize, *const f64, usize, *mut f64, usize) -> i32;

fn partial() -> Vec<Row> {
    let row = |adjoint: bool, words: &str, null_array: Null, n_seed: usize, n_sensitivity: usize| {
        let name = if adjoint { "fmi3GetAdjointDerivative" } else { "fmi3GetDirectionalDerivative" };
        let function: Partial = if adjoint { fmi3GetAdjointDerivative } else { fmi3GetDirectionalDerivative };
        refused(name, words, move |t, c| {
            let unless = |array, pointer: *mut u32| if null_array == array { null() } else { pointer.cast_const() };
            let unknowns = unless(Null::Unknowns, edge(&t.fmu.vrs(UNKNOWNS)));
            let knowns = unless(Null::Knowns, edge(&t.fmu.vrs(KNOWNS)));
            let seed = if null_array == Null::Seed { null_mut() } else { edge(&[1.0; 3]) };
            let places = edge(&[-77.0; 3]);
            let sensitivity = if null_array == Null::Sensitivity { null_mut() } else { places };
            // SAFETY: arrays with room for what is announced, or null.
            unsafe {
                let status = function(c, unknowns, 3, knowns, 2, seed, n_seed, sensitivity, n_sensitivity);
                assert_eq!(*places.cast::<[f64; 3]>(), [-77.0; 3], "something is written");
                status
            }
        })
    };
    // A seed for each known, a sensitivity of each unknown; of the adjoint the other way round.
    let mut rows = vec![
        row(false, "nSeed = 3: expected 2", Null::Nothing, 3, 3),
        row(false, "nSensitivity = 2: expected 3", Null::Nothing, 2, 2),
        row(true, "nSeed = 2: expected 3", Null::Nothing, 2, 2),
        row(true, "nSensitivity = 3: expected 2", Null::Nothing, 3, 3),
    ];
    for (adjoint, n_seed, n_sensitivity) in [(false, 2, 3), (true, 3, 2)] {
        rows.push(row(adjoint, "unknowns = 0x0", Null::Unknowns, n_seed, n_sensitivity));
        rows.push(row(adjoint, "knowns = 0x0", Null::Knowns, n_seed, n_sensitivity));
        rows.push(row(adjoint, "seed = 0x0", Null::Seed, n_seed, n_sensitivity));
        rows.push(row(adjoint, "sensitivity = 0x0", Null::Sensitivity, n_seed, n_sensitivity));
    }
    rows
}

fn in_time() -> Vec<Row> {
    let row = |words: &str, [has_references, has_orders, has_values]: [bool; 3], n_values: usize| {
        refused("fmi3GetOutputDerivatives", words, move |t, c| {
            let vr = if has_references { edge(&t.fmu.vrs(UNKNOWNS)) } else { null_mut() };
            let orders = if has_orders { edge(&[1; 3]) } else { null_mut() };
            let places = edge(&[-77.0; 3]);
            let values = if has_values { places } else { null_mut() };
            // SAFETY: as above.
            unsafe {
                let status = fmi3GetOutputDerivatives(c, vr, 3, orders, values, n_values);
                assert_eq!(*places.cast::<[f64; 3]>(), [-77.0; 3], "something is written");
                status
            }
        })
    };
    vec![
        row("nValues = 2: expected 3", [true; 3], 2),
        row("orders = 0x0", [true, false, true], 3),
        row("valueReferences = 0x0", [false, true, true], 3),
        row("values = 0x0", [true, true, false], 3),
    ]
}
