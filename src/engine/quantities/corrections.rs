//! What a master can correct: what a building resists with, storey by storey, or floor by floor where its stiffness is
//! a matrix.
//!
//! A correction is for a building that only another program can model. That one resists with f, the one here with K u;
//! the master sets K u - f. The motion knows it as a force along the row of the storey's drift, on its upper floor and
//! against its lower one or the foundation; shears are less by it.

use crate::scene::{Place, Scene};
use crate::structure::{Side, Structure};

/// A storey of a shear building, or a floor of one with a stiffness matrix.
#[derive(Clone, Debug)]
pub(crate) struct Correction {
    pub side: Side,
    /// Of the storey or floor, counted from 0.
    pub number: usize,
    /// N/m, of a storey; `None` for a floor.
    pub stiffness: Option<f64>,
}

impl Correction {
    /// All of a scene, in the order of the inputs.
    pub(crate) fn all(scene: &Scene, structure: &Structure) -> Vec<Correction> {
        let sides = Side::BOTH.into_iter().filter(|_| scene.restoring_corrections);
        let numbers = sides.flat_map(|side| (0..structure.floors(side)).map(move |number| (side, number)));
        let of = |(side, number): (Side, usize)| {
            let stiffness = scene.building(side).stiffness.of_storey(number);
            Correction { side, number, stiffness }
        };
        numbers.map(of).collect()
    }

    /// The row of the storey's drift, or of the floor's displacement.
    pub(crate) fn places(&self, structure: &Structure) -> Vec<(Side, Place, f64)> {
        let with_side = |(place, weight)| (self.side, place, weight);
        match self.stiffness {
            Some(_) => structure.floors.places(self.side).drift(self.number).map(with_side).collect(),
            None => vec![(self.side, Place::Floor(self.number), 1.0)],
        }
    }

    /// The part of it by which the base shear is less: all of that of the lowest storey, or of any floor.
    pub(crate) fn on_base(&self) -> f64 {
        if self.stiffness.is_none() || self.number == 0 { 1.0 } else { 0.0 }
    }
}
