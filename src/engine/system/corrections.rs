//! What a master pushes on the buildings with: forces on floors, and corrections of what the buildings resist with.
//!
//! A correction is for a building that only another program can model. That one resists with f, the one here with K u; the
//! master sets K u - f, storey by storey, or floor by floor where K is a matrix. The motion knows it as a force along the row of
//! the storey's drift, on its upper floor and against its lower one or the foundation; shears are less by it.

use crate::engine::base::Coordinates;
use crate::engine::excitation::inputs::{Inputs, LinearInput};
use crate::engine::pairs::row::WeightRow;
use crate::engine::system::System;
use crate::scene::{Place, Scene};
use crate::structure::{Side, Structure};

/// What can be corrected: a storey of a shear building, or a floor of one with a stiffness matrix.
#[derive(Clone, Debug)]
pub struct Correction {
    pub side: Side,
    /// Of the storey or floor, counted from 0.
    pub number: usize,
    /// N/m, of a storey; `None` for a floor.
    pub stiffness: Option<f64>,
    /// The row of the storey's drift, or the floor's displacement.
    pub row: WeightRow,
}

impl Correction {
    /// All of a scene, in the order of the inputs.
    pub fn all(scene: &Scene, structure: &Structure) -> Vec<Correction> {
        let sides = Side::BOTH.into_iter().filter(|_| scene.restoring_corrections);
        let numbers = sides.flat_map(|side| (0..structure.floors(side)).map(move |number| (side, number)));
        numbers.map(|(side, number)| Correction::of(scene, structure, side, number)).collect()
    }

    fn of(scene: &Scene, structure: &Structure, side: Side, number: usize) -> Correction {
        let stiffness = scene.building(side).stiffness.of_storey(number);
        let places: Vec<(Place, f64)> = match stiffness {
            Some(_) => structure.floors.places(side).drift(number).collect(),
            None => vec![(Place::Floor(number), 1.0)],
        };
        let row = WeightRow::of(structure, places.iter().map(|&(place, weight)| (side, place, weight)));
        Correction { side, number, stiffness, row }
    }

    /// The part of it by which the base shear is less: all of that of the lowest storey, or of any floor.
    pub fn on_base(&self) -> f64 {
        if self.stiffness.is_none() || self.number == 0 { 1.0 } else { 0.0 }
    }
}

impl System {
    /// Adds all that a master pushes with, or its rates, to a load per unit of mass.
    pub fn add_pushes(
        &self,
        inputs: &Inputs,
        coordinates: Coordinates,
        part: impl Fn(&LinearInput) -> f64,
        load: &mut [f64],
    ) {
        self.add_floor_forces(inputs, coordinates, &part, load);
        self.add_corrections(inputs, coordinates, part, load);
    }

    /// The same from the numbers of [`Inputs::pushes`], or from none.
    pub fn add_push_numbers(&self, mut numbers: impl Iterator<Item = f64>, coordinates: Coordinates, load: &mut [f64]) {
        if self.floor_forces {
            self.add_forces(numbers.by_ref(), coordinates, load);
        }
        self.correct(numbers, coordinates, load);
    }

    /// Adds the external forces on the floors, or their rates, to a load per unit of mass.
    pub fn add_floor_forces(
        &self,
        inputs: &Inputs,
        coordinates: Coordinates,
        part: impl Fn(&LinearInput) -> f64,
        load: &mut [f64],
    ) {
        self.add_forces(inputs.floor_forces.iter().map(part), coordinates, load);
    }

    /// Adds the corrections, or their rates, to a load per unit of mass.
    pub fn add_corrections(
        &self,
        inputs: &Inputs,
        coordinates: Coordinates,
        part: impl Fn(&LinearInput) -> f64,
        load: &mut [f64],
    ) {
        self.correct(inputs.corrections.iter().map(part), coordinates, load);
    }

    /// Adds forces on all floors, N, or on none.
    fn add_forces(&self, mut forces: impl Iterator<Item = f64>, coordinates: Coordinates, load: &mut [f64]) {
        for side in Side::BOTH {
            let of_side = forces.by_ref().take(self.structure.floors(side)).enumerate();
            let acting = of_side.filter(|(_, force)| *force != 0.0);
            match coordinates {
                Coordinates::Modes => self.structure.add_floor_forces(side, acting, load),
                Coordinates::Floors => acting.for_each(|(floor, force)| {
                    let lane = self.structure.floors.lane(side as usize, floor);
                    load[lane] += force * self.structure.floors.inverse_mass(lane);
                }),
            }
        }
    }

    fn correct(&self, corrections: impl Iterator<Item = f64>, coordinates: Coordinates, load: &mut [f64]) {
        let acting = self.corrections.iter().zip(corrections).filter(|(_, force)| *force != 0.0);
        acting.for_each(|(of, force)| of.row.push(coordinates, force, load));
    }

    /// What the base shear of a building is less by, N, or its rate.
    pub fn correction_of_base(&self, inputs: &Inputs, side: Side, part: impl Fn(&LinearInput) -> f64) -> f64 {
        let all = self.corrections.iter().zip(&inputs.corrections).filter(|(of, _)| of.side == side);
        all.fold(0.0, |sum, (of, line)| sum + of.on_base() * part(line))
    }

    /// The number among the corrections of that of a storey or floor, if there are any.
    pub fn number_of_correction(&self, (side, number): (Side, usize)) -> Option<usize> {
        Some(self.structure.number(side, number)).filter(|number| *number < self.corrections.len())
    }

    /// N/m, of a storey that can be corrected.
    pub fn corrected_stiffness(&self, storey: (Side, usize)) -> f64 {
        self.number_of_correction(storey).and_then(|number| self.corrections[number].stiffness).unwrap_or(0.0)
    }
}
