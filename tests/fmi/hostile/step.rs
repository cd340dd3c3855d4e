//! Steps and their status.

use super::edge::{edge, misaligned};
use super::rows::{Row, row};
use crate::support::{fmi2EnterInitializationMode, fmi2ExitInitializationMode, fmi2Reset};
use std::ffi::{c_int, c_void};
use std::ptr::null_mut;

/// Columns: instantiated, initialization, step complete, terminated, error, no instance.
const STEP: &str = "eeoeee";
const STATUS: &str = "eeooee";
const NO_STATUS: &str = "eeddee";
const NEVER: &str = "eeeeee";

pub fn rows() -> Vec<Row> {
    steps().into_iter().chain(status()).collect()
}

fn steps() -> Vec<Row> {
    let step = |current: f64, step: f64, expected| {
        row(&format!("fmi2DoStep: from {current:e} by {step:e}"), expected, move |t| t.step(current, step))
    };
    vec![
        step(0.0, 0.1, STEP),
        step(5e-10, 0.1, STEP), // within the rounding of a master
        step(-0.0, 0.1, STEP),
        step(0.0, 5e-324, STEP),
        step(0.0, 0.0, NEVER),
        step(0.0, -0.0, NEVER),
        step(0.0, -0.1, NEVER),
        step(0.0, f64::NAN, NEVER),
        step(0.0, f64::INFINITY, NEVER),
        step(0.0, f64::NEG_INFINITY, NEVER),
        step(0.0, f64::MIN, NEVER),
        step(0.1, 0.1, NEVER),
        step(-1e-6, 0.1, NEVER),
        step(f64::NAN, 0.1, NEVER),
        step(f64::INFINITY, 0.1, NEVER),
        step(f64::MAX, 0.1, NEVER),
        step(f64::MAX, f64::MAX, NEVER),
        step(f64::NAN, f64::NAN, NEVER),
        // Times that double precision cannot tell from each other closely enough, and more work than any step is for.
        step(0.0, 1e300, NEVER),
        step(0.0, 1e11, NEVER),
        step(0.0, 1e-310, STEP),
        row("fmi2DoStep: past the stop time", NEVER, |t| {
            t.alone(fmi2Reset);
            t.setup((0, 0.0), 0.0, (1, 0.05));
            t.alone(fmi2EnterInitializationMode);
            t.alone(fmi2ExitInitializationMode);
            t.step(0.0, 0.1)
        }),
        row("fmi2DoStep: again from the same point", NEVER, |t| t.step(0.0, 0.1).max(t.step(0.0, 0.1))),
        row("fmi2DoStep: a thousand steps of a nanosecond", STEP, |t| {
            (0..1000).map(|k| t.step(f64::from(k) * 1e-9, 1e-9)).max().unwrap_or_default()
        }),
        row("fmi2DoStep: from a start time of 1e11 s", "oooooe", |t| {
            t.alone(fmi2Reset);
            t.setup((0, 0.0), 1e11, (0, 0.0));
            t.alone(fmi2EnterInitializationMode);
            t.alone(fmi2ExitInitializationMode);
            t.step(1e11, 0.01)
        }),
    ]
}

fn status() -> Vec<Row> {
    // Room for any of the types.
    let place = || edge(&[0_u64]).cast::<c_void>();
    let mut rows = Vec::new();
    // Nothing is ever pending; the only things to tell are a time and whether the FMU wants to end.
    for (function, kinds) in [
        ("fmi2GetStatus", [NO_STATUS; 4]),
        ("fmi2GetRealStatus", [NO_STATUS, NO_STATUS, STATUS, NO_STATUS]),
        ("fmi2GetIntegerStatus", [NO_STATUS; 4]),
        ("fmi2GetBooleanStatus", [NO_STATUS, NO_STATUS, NO_STATUS, STATUS]),
        ("fmi2GetStringStatus", [NO_STATUS; 4]),
    ] {
        for (kind, expected) in (0..).zip(kinds) {
            let name = format!("{function}: kind {kind}");
            rows.push(row(&name, expected, move |t| t.status(function, kind, place())));
            let name = format!("{name}, null place");
            rows.push(row(&name, "eennee", move |t| t.status::<c_void>(function, kind, null_mut())));
            let name = format!("{function}: kind {kind}, misaligned place");
            rows.push(row(&name, "eennee", move |t| t.status(function, kind, misaligned::<u64>())));
        }
        for kind in [-1, 4, c_int::MAX, c_int::MIN] {
            let name = format!("{function}: kind {kind}");
            rows.push(row(&name, NEVER, move |t| t.status(function, kind, place())));
        }
    }
    rows
}
