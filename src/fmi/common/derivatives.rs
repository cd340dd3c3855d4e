//! Derivatives of outputs with respect to time, and of unknowns with respect to knowns.

use super::arguments::{check_length, slice_in, slice_out};
use super::instance::Instance;
use super::types::ValueReference;
use super::values::Pairs;
use crate::FmiVersion;
use crate::slave::{Refusal, Status};
use std::ffi::c_int;

/// # Safety
/// As `fmi/mod.rs` says, with as many elements in all arrays as they are counted.
pub(in crate::fmi) unsafe fn output_derivatives(
    instance: &mut Instance,
    pairs: Pairs<*mut f64>,
    orders: *const c_int,
) -> Result<Status, Refusal> {
    let of_orders = match instance.slave.version() {
        FmiVersion::V2 => "order",
        FmiVersion::V3 => "orders",
    };
    // SAFETY: the caller's promise.
    let ((vr, values), orders) = unsafe { (pairs.out(instance)?, slice_in(of_orders, orders, pairs.n)?) };
    instance.slave.output_derivatives(vr, orders, |i, value| {
        values[i].write(value);
    })
}

/// Which way the seed goes: one number for each known, or for each unknown.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(in crate::fmi) enum Direction {
    Forward,
    Adjoint,
}

/// The arrays of a question for such derivatives, each with its number of elements.
pub(in crate::fmi) struct Sensitivity {
    pub unknowns: (*const ValueReference, usize),
    pub knowns: (*const ValueReference, usize),
    pub seed: (*const f64, usize),
    pub sensitivity: (*mut f64, usize),
}

/// # Safety
/// As `fmi/mod.rs` says, with as many elements in all arrays as they are counted.
pub(in crate::fmi) unsafe fn sensitivity(
    instance: &mut Instance,
    direction: Direction,
    of: &Sensitivity,
) -> Result<Status, Refusal> {
    let names = match instance.slave.version() {
        FmiVersion::V2 => ["vUnknown_ref", "vKnown_ref", "dvKnown", "dvUnknown"],
        FmiVersion::V3 => ["unknowns", "knowns", "seed", "sensitivity"],
    };
    let (from, to) = match direction {
        Direction::Forward => (of.knowns.1, of.unknowns.1),
        Direction::Adjoint => (of.unknowns.1, of.knowns.1),
    };
    check_length("nSeed", of.seed.1, from)?;
    check_length("nSensitivity", of.sensitivity.1, to)?;
    // SAFETY: the caller's promise.
    let (unknowns, knowns, seed, places) = unsafe {
        (
            slice_in(names[0], of.unknowns.0, of.unknowns.1)?,
            slice_in(names[1], of.knowns.0, of.knowns.1)?,
            slice_in(names[2], of.seed.0, from)?,
            slice_out(names[3], of.sensitivity.0, to)?,
        )
    };
    let take = |i: usize, value: f64| {
        places[i].write(value);
    };
    match direction {
        Direction::Forward => instance.slave.directional_derivative(unknowns, knowns, seed, take),
        Direction::Adjoint => instance.slave.adjoint_derivative(unknowns, knowns, seed, take),
    }
}
