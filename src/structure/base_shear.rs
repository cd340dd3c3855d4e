//! The force on the ground of a building on which links act: not that of all of its body.

use super::bodies::Body;
use super::floors::Floors;
use super::modes::{ModalDamping, Modes};
use crate::scene::Side;

/// Rows of the base shear, N, over displacements and velocities: the column sums of K and C of the building by itself.
#[derive(Clone, Debug)]
pub(super) struct BaseShear {
    /// Over those of its floors, N/m and N s/m.
    pub of_floors: [Vec<f64>; 2],
    /// Over those of all modes, N/(m kg^1/2) and N s/(m kg^1/2).
    pub of_modes: [Vec<f64>; 2],
}

impl BaseShear {
    /// From the modes of the building by itself, and its body.
    pub(super) fn of((side, modes): (Side, &Modes), body: &Body, floors: &Floors) -> BaseShear {
        let mass = floors.of_building(side as usize, floors.mass());
        let (count, shape) = (mass.len(), &modes.shape);
        let damped = |m: usize| match &modes.damping {
            ModalDamping::Diagonal(c) => c[m] * modes.participation[m],
            ModalDamping::Coupled(c) => (0..count).map(|k| c[(k, m)] * modes.participation[k]).sum(),
        };
        let pulled = |m: usize| modes.omega[m] * modes.omega[m] * modes.participation[m];
        let over_floors = |of_mode: &dyn Fn(usize) -> f64| -> Vec<f64> {
            let of_modes: Vec<f64> = (0..count).map(of_mode).collect();
            (0..count).map(|j| mass[j] * (0..count).map(|m| of_modes[m] * shape[(j, m)]).sum::<f64>()).collect()
        };
        let of_floors = [over_floors(&pulled), over_floors(&damped)];
        let of_modes = of_floors.each_ref().map(|row| {
            let mut modal = vec![0.0; floors.mass().len()];
            for (floor, force) in row.iter().enumerate() {
                let shapes = body.modes.shape.row(body.row(side, floor));
                let modal = modal[body.range.clone()].iter_mut();
                modal.zip(shapes.iter()).for_each(|(modal, shape)| *modal += shape * force);
            }
            modal
        });
        BaseShear { of_floors, of_modes }
    }
}
