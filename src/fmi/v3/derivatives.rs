//! Derivatives of outputs with respect to time, and of unknowns with respect to knowns: by knowns and by unknowns.

use crate::fmi::common::derivatives::{Direction, Sensitivity, output_derivatives, sensitivity};
use crate::fmi::common::fence::functions;
use crate::fmi::common::types::ValueReference;
use crate::fmi::common::values::Pairs;

functions! { v3:
    fmi3GetOutputDerivatives = GetRealOutputDerivatives(
        vr: *const ValueReference, n: usize, orders: *const i32, values: *mut f64, n_values: usize
    ) |instance| output_derivatives(instance, Pairs { vr, n, values, n_values }, orders);
    fmi3GetDirectionalDerivative = GetDirectionalDerivative(
        unknowns: *const ValueReference, n_unknowns: usize, knowns: *const ValueReference, n_knowns: usize,
        seed: *const f64, n_seed: usize, sensitivities: *mut f64, n_sensitivity: usize
    ) |instance| sensitivity(instance, Direction::Forward, &Sensitivity {
        unknowns: (unknowns, n_unknowns),
        knowns: (knowns, n_knowns),
        seed: (seed, n_seed),
        sensitivity: (sensitivities, n_sensitivity),
    });
    /// The lengths are the other way round: a seed for each unknown, a sensitivity to each known.
    fmi3GetAdjointDerivative = GetAdjointDerivative(
        unknowns: *const ValueReference, n_unknowns: usize, knowns: *const ValueReference, n_knowns: usize,
        seed: *const f64, n_seed: usize, sensitivities: *mut f64, n_sensitivity: usize
    ) |instance| sensitivity(instance, Direction::Adjoint, &Sensitivity {
        unknowns: (unknowns, n_unknowns),
        knowns: (knowns, n_knowns),
        seed: (seed, n_seed),
        sensitivity: (sensitivities, n_sensitivity),
    });
}
