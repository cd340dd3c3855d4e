//! Derivatives of initial unknowns with respect to parameters. Those of outputs with respect to time and to inputs are
//! the engine's.

use super::slot::{Calculated, Parameter, Slot};
use crate::engine::{ContactOutput, Model, Output};
use crate::scene::Scene;

/// The highest order of the derivatives of outputs with respect to time. An FMU of numbers only gives the first alone:
/// importers for which it is made take the number for true or false.
pub const fn highest_output_derivative(scene: &Scene) -> u8 {
    if scene.numbers_only { 1 } else { 2 }
}

/// The derivative of an initial unknown with respect to a parameter that it depends on, where there is a closed form of it.
pub fn by_parameter(model: &Model, unknown: Slot, parameter: Parameter) -> Option<f64> {
    match (unknown, parameter) {
        (Slot::Calculated(Calculated::Frequency(id, mode)), Parameter::Mass(_, floor)) => {
            model.frequency_by_mass(id, mode, floor)
        }
        (Slot::Calculated(Calculated::Frequency(id, mode)), Parameter::Stiffness(_, storey)) => {
            model.frequency_by_stiffness(id, mode, storey)
        }
        (Slot::Output(Output::Contact(_, ContactOutput::Penetration)), Parameter::Gap(_)) => Some(-1.0),
        _ => None,
    }
}
