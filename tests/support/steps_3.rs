//! What a step of FMI 3.0 comes back with, and the step that leads to a time.
#![allow(dead_code)] // each test uses its share

use pounding::fmi::{Component, fmi3DoStep};
use std::ffi::c_int;

/// What `fmi3DoStep` has written.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stepped {
    pub event: u8,
    pub terminate: u8,
    pub early: u8,
    pub last: f64,
}

/// What is written nowhere by itself.
pub const UNTOUCHED: Stepped = Stepped { event: 77, terminate: 77, early: 77, last: -77.0 };

/// The step from one time to another, to the last bit.
pub fn step_to(now: f64, end: f64) -> f64 {
    let mut step = end - now;
    while now + step < end {
        step = step.next_up();
    }
    while now + step > end {
        step = step.next_down();
    }
    step
}

/// Makes a step.
pub fn step(c: Component, current: f64, length: f64) -> (c_int, Stepped) {
    let mut all = UNTOUCHED;
    let Stepped { event, terminate, early, last } = &mut all;
    // SAFETY: a live component, places for the results.
    let status = unsafe { fmi3DoStep(c, current, length, 1, event, terminate, early, last) };
    (status, all)
}
