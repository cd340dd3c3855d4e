//! Derivatives of outputs with respect to time.

use super::arguments::{check_length, slice_in, slice_out};
use super::fence::{Function, with_instance};
use super::types::Component;
use super::values::{Pairs, names};
use crate::FmiVersion;
use std::ffi::c_int;

/// # Safety
/// As `fmi/mod.rs` says, with as many elements in all arrays as they are counted.
pub(in crate::fmi) unsafe fn output_derivatives(
    c: Component,
    function: Function,
    Pairs { vr, n, values, n_values }: Pairs<*mut f64>,
    orders: *const c_int,
) -> c_int {
    let (of_vr, of_values) = names(function.version);
    let of_orders = match function.version {
        FmiVersion::V2 => "order",
        FmiVersion::V3 => "orders",
    };
    // SAFETY: the caller's promise.
    unsafe {
        with_instance(c, function, |instance| {
            check_length("nValues", n_values, n)?;
            let (vr, orders) = (slice_in(of_vr, vr, n)?, slice_in(of_orders, orders, n)?);
            let values = slice_out(of_values, values, n)?;
            instance.slave.output_derivatives(vr, orders, |i, value| {
                values[i].write(value);
            })
        })
    }
}
