//! Functions for derivatives: of inputs and outputs with respect to time, of outputs with respect to inputs.

use crate::fmi::common::arguments::{slice_in, slice_out};
use crate::fmi::common::derivatives::output_derivatives;
use crate::fmi::common::fence::{v2, with_instance};
use crate::fmi::common::types::{Component, ValueReference};
use crate::fmi::common::values::Pairs;
use crate::slave::Call;
use std::ffi::c_int;

#[cfg_attr(fmi_exports, unsafe(no_mangle))]
pub unsafe extern "C" fn fmi2SetRealInputDerivatives(
    c: Component,
    vr: *const ValueReference,
    n: usize,
    orders: *const c_int,
    values: *const f64,
) -> c_int {
    // SAFETY: as the module says.
    unsafe {
        with_instance(c, v2(Call::SetRealInputDerivatives), |instance| {
            let (vr, orders) = (slice_in("vr", vr, n)?, slice_in("order", orders, n)?);
            instance.slave.set_input_derivatives(vr, orders, slice_in("value", values, n)?)
        })
    }
}

#[cfg_attr(fmi_exports, unsafe(no_mangle))]
pub unsafe extern "C" fn fmi2GetRealOutputDerivatives(
    c: Component,
    vr: *const ValueReference,
    n: usize,
    orders: *const c_int,
    values: *mut f64,
) -> c_int {
    // SAFETY: as the module says.
    unsafe { output_derivatives(c, v2(Call::GetRealOutputDerivatives), Pairs::new(vr, n, values), orders) }
}

#[cfg_attr(fmi_exports, unsafe(no_mangle))]
pub unsafe extern "C" fn fmi2GetDirectionalDerivative(
    c: Component,
    unknowns: *const ValueReference,
    n_unknowns: usize,
    knowns: *const ValueReference,
    n_knowns: usize,
    seed: *const f64,
    sensitivity: *mut f64,
) -> c_int {
    // SAFETY: as the module says.
    unsafe {
        with_instance(c, v2(Call::GetDirectionalDerivative), |instance| {
            let unknowns = slice_in("vUnknown_ref", unknowns, n_unknowns)?;
            let (knowns, seed) = (slice_in("vKnown_ref", knowns, n_knowns)?, slice_in("dvKnown", seed, n_knowns)?);
            let sensitivity = slice_out("dvUnknown", sensitivity, n_unknowns)?;
            instance.slave.directional_derivative(unknowns, knowns, seed, |i, value| {
                sensitivity[i].write(value);
            })
        })
    }
}
