//! The force on its base of a building on which links or soil act: not that of all of its body.

use super::bodies::Body;
use super::floors::Floors;
use super::modes::{ModalDamping, Modes};
use crate::scene::{Building, BuildingId, Place, Places};

/// Rows of the base shear, N, over displacements and velocities: the column sums of K and C of the floors of the building by
/// itself, which a foundation moves under.
#[derive(Clone, Debug)]
pub(super) struct BaseShear {
    /// Over those of its floors and its foundation, N/m and N s/m.
    pub of_floors: [Vec<f64>; 2],
    /// Over those of all modes, N/(m kg^1/2) and N s/(m kg^1/2).
    pub of_modes: [Vec<f64>; 2],
}

impl BaseShear {
    /// From the modes of the building on a fixed base, and its body.
    pub(super) fn of(
        (id, building): (BuildingId, &Building),
        modes: &Modes,
        body: &Body,
        floors: &Floors,
    ) -> BaseShear {
        let (count, shape) = (building.mass.len(), &modes.shape);
        let damped = |m: usize| match &modes.damping {
            ModalDamping::Diagonal(c) => c[m] * modes.participation[m],
            ModalDamping::Coupled(c) => (0..count).map(|k| c[(k, m)] * modes.participation[k]).sum(),
        };
        let pulled = |m: usize| modes.omega[m] * modes.omega[m] * modes.participation[m];
        let over_floors = |of_mode: &dyn Fn(usize) -> f64| -> Vec<f64> {
            let of_modes: Vec<f64> = (0..count).map(of_mode).collect();
            let force = |j: usize| building.mass[j] * (0..count).map(|m| of_modes[m] * shape[(j, m)]).sum::<f64>();
            (0..count).map(force).collect()
        };
        let places = floors.places(id);
        let of_floors = match building.foundation {
            None => [over_floors(&pulled), over_floors(&damped)],
            Some(_) => [of_first_storey(building, places), with_foundation(&over_floors(&damped), places)],
        };
        let of_modes = of_floors.each_ref().map(|row| {
            let mut modal = vec![0.0; floors.mass().len()];
            for (place, force) in row.iter().enumerate() {
                let shapes = body.modes.shape.row(body.row(id, 0) + place);
                let modal = modal[body.range.clone()].iter_mut();
                modal.zip(shapes.iter()).for_each(|(modal, shape)| *modal += shape * force);
            }
            modal
        });
        BaseShear { of_floors, of_modes }
    }
}

/// The shear of the first storey with gravity on its lean: that of a shear building.
fn of_first_storey(building: &Building, places: &Places) -> Vec<f64> {
    let mut row = vec![0.0; places.count()];
    let k = building.stiffness.of_storey(0).unwrap_or_default();
    let g = building.gravity_stiffness().first().copied().unwrap_or_default();
    for (place, weight) in places.drift(0) {
        let stiffness = if place == Place::Rotation { k } else { k - g };
        places.number(place).iter().for_each(|number| row[*number] = stiffness * weight);
    }
    row
}

/// A row over what the floors do beyond the motion of their foundation, over all displacements.
fn with_foundation(over_floors: &[f64], places: &Places) -> Vec<f64> {
    let mut row = vec![0.0; places.count()];
    for (floor, factor) in over_floors.iter().enumerate() {
        for (place, weight) in places.beyond_foundation(floor) {
            places.number(place).iter().for_each(|number| row[*number] += factor * weight);
        }
    }
    row
}
