//! Functions for derivatives: of inputs and outputs with respect to time, of outputs with respect to inputs.

use crate::fmi::common::arguments::slice_in;
use crate::fmi::common::derivatives::{Direction, Sensitivity, output_derivatives, sensitivity};
use crate::fmi::common::fence::functions;
use crate::fmi::common::types::ValueReference;
use crate::fmi::common::values::Pairs;
use std::ffi::c_int;

functions! { v2:
    fmi2SetRealInputDerivatives = SetRealInputDerivatives(
        vr: *const ValueReference, n: usize, orders: *const c_int, values: *const f64
    ) |instance| {
        let (vr, orders) = (slice_in("vr", vr, n)?, slice_in("order", orders, n)?);
        instance.slave.set_input_derivatives(vr, orders, slice_in("value", values, n)?)
    };
    fmi2GetRealOutputDerivatives = GetRealOutputDerivatives(
        vr: *const ValueReference, n: usize, orders: *const c_int, values: *mut f64
    ) |instance| output_derivatives(instance, Pairs::new(vr, n, values), orders);
    fmi2GetDirectionalDerivative = GetDirectionalDerivative(
        unknowns: *const ValueReference, n_unknowns: usize, knowns: *const ValueReference, n_knowns: usize,
        seed: *const f64, sensitivities: *mut f64
    ) |instance| sensitivity(instance, Direction::Forward, &Sensitivity {
        unknowns: (unknowns, n_unknowns),
        knowns: (knowns, n_knowns),
        seed: (seed, n_knowns),
        sensitivity: (sensitivities, n_unknowns),
    });
}
