//! Derivatives of outputs with respect to time, and of unknowns with respect to knowns: by knowns and by unknowns.

use crate::fmi::common::arguments::{check_length, slice_in, slice_out};
use crate::fmi::common::derivatives::output_derivatives;
use crate::fmi::common::fence::{v3, with_instance};
use crate::fmi::common::types::{Component, ValueReference};
use crate::fmi::common::values::Pairs;
use crate::slave::Call;
use std::ffi::c_int;

#[cfg_attr(fmi_exports, unsafe(no_mangle))]
pub unsafe extern "C" fn fmi3GetOutputDerivatives(
    c: Component,
    vr: *const ValueReference,
    n: usize,
    orders: *const i32,
    values: *mut f64,
    n_values: usize,
) -> c_int {
    // SAFETY: as the module says.
    unsafe { output_derivatives(c, v3(Call::GetRealOutputDerivatives), Pairs { vr, n, values, n_values }, orders) }
}

#[cfg_attr(fmi_exports, unsafe(no_mangle))]
pub unsafe extern "C" fn fmi3GetDirectionalDerivative(
    c: Component,
    unknowns: *const ValueReference,
    n_unknowns: usize,
    knowns: *const ValueReference,
    n_knowns: usize,
    seed: *const f64,
    n_seed: usize,
    sensitivity: *mut f64,
    n_sensitivity: usize,
) -> c_int {
    // SAFETY: as the module says.
    unsafe {
        with_instance(c, v3(Call::GetDirectionalDerivative), |instance| {
            check_length("nSeed", n_seed, n_knowns)?;
            check_length("nSensitivity", n_sensitivity, n_unknowns)?;
            let unknowns = slice_in("unknowns", unknowns, n_unknowns)?;
            let (knowns, seed) = (slice_in("knowns", knowns, n_knowns)?, slice_in("seed", seed, n_seed)?);
            let sensitivity = slice_out("sensitivity", sensitivity, n_sensitivity)?;
            instance.slave.directional_derivative(unknowns, knowns, seed, |i, value| {
                sensitivity[i].write(value);
            })
        })
    }
}

/// The lengths are the other way round: a seed for each unknown, a sensitivity to each known.
#[cfg_attr(fmi_exports, unsafe(no_mangle))]
pub unsafe extern "C" fn fmi3GetAdjointDerivative(
    c: Component,
    unknowns: *const ValueReference,
    n_unknowns: usize,
    knowns: *const ValueReference,
    n_knowns: usize,
    seed: *const f64,
    n_seed: usize,
    sensitivity: *mut f64,
    n_sensitivity: usize,
) -> c_int {
    // SAFETY: as the module says.
    unsafe {
        with_instance(c, v3(Call::GetAdjointDerivative), |instance| {
            check_length("nSeed", n_seed, n_unknowns)?;
            check_length("nSensitivity", n_sensitivity, n_knowns)?;
            let knowns = slice_in("knowns", knowns, n_knowns)?;
            let (unknowns, seed) = (slice_in("unknowns", unknowns, n_unknowns)?, slice_in("seed", seed, n_seed)?);
            let sensitivity = slice_out("sensitivity", sensitivity, n_sensitivity)?;
            instance.slave.adjoint_derivative(unknowns, knowns, seed, |k, value| {
                sensitivity[k].write(value);
            })
        })
    }
}
