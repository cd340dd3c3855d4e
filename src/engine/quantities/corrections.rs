//! What a master can correct: what a building resists with, storey by storey, or floor by floor where its stiffness is
//! a matrix.
//!
//! A correction is for a building that only another program can model. That one resists with f, the one here with K u;
//! the master sets K u - f. The motion knows it as a force along the row of the storey's drift, on its upper floor and
//! against its lower one or the foundation; shears are less by it.

use crate::scene::{Place, Scene};
use crate::structure::{BuildingId, Storey, Structure};

/// A storey of a shear building, or a floor of one with a stiffness matrix.
#[derive(Clone, Debug)]
pub(crate) struct Correction {
    pub building: BuildingId,
    /// Of the storey or floor, counted from 0.
    pub number: usize,
    /// N/m, of a storey; `None` for a floor.
    pub stiffness: Option<f64>,
}

impl Correction {
    /// All of a scene, in the order of the inputs.
    pub(crate) fn all(scene: &Scene, structure: &Structure) -> Vec<Correction> {
        let buildings = structure.ids().filter(|_| scene.restoring_corrections);
        let numbers = buildings.flat_map(|id| (0..structure.floors(id)).map(move |number| (id, number)));
        let of = |(id, number): Storey| {
            let stiffness = scene.building(id).stiffness.of_storey(number);
            Correction { building: id, number, stiffness }
        };
        numbers.map(of).collect()
    }

    /// The row of the storey's drift, or of the floor's displacement.
    pub(crate) fn places(&self, structure: &Structure) -> Vec<(BuildingId, Place, f64)> {
        let with_building = |(place, weight)| (self.building, place, weight);
        match self.stiffness {
            Some(_) => structure.floors.places(self.building).drift(self.number).map(with_building).collect(),
            None => vec![(self.building, Place::Floor(self.number), 1.0)],
        }
    }

    /// The part of it by which the base shear is less: all of that of the lowest storey, or of any floor.
    pub(crate) fn on_base(&self) -> f64 {
        if self.stiffness.is_none() || self.number == 0 { 1.0 } else { 0.0 }
    }
}
