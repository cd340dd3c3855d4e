//! What a master pushes on the buildings with, as loads: forces on floors, and corrections of what the buildings resist
//! with.

use crate::engine::base::Coordinates;
use crate::engine::excitation::inputs::{Inputs, LinearInput, Push};
use crate::engine::quantities::pushed::Pushes;
use crate::engine::system::System;
use crate::structure::{BuildingId, Storey};

impl System {
    /// What a master may push with.
    pub fn pushes(&self) -> Pushes<'_> {
        Pushes { floor_forces: self.floor_forces, corrections: &self.corrections }
    }

    /// Adds all that a master pushes with, or its rates, to a load per unit of mass.
    pub fn add_pushes(
        &self,
        inputs: &Inputs,
        coordinates: Coordinates,
        part: impl Fn(&LinearInput) -> f64,
        load: &mut [f64],
    ) {
        Push::BOTH.into_iter().for_each(|push| self.add_push(push, inputs, coordinates, &part, load));
    }

    /// The same of one kind of push.
    pub fn add_push(
        &self,
        push: Push,
        inputs: &Inputs,
        coordinates: Coordinates,
        part: impl Fn(&LinearInput) -> f64,
        load: &mut [f64],
    ) {
        let numbers = inputs.of_kind(push).iter().map(part);
        match push {
            Push::Force => self.add_forces(numbers, coordinates, load),
            Push::Correction => self.correct(numbers, coordinates, load),
        }
    }

    /// The same from the numbers of [`Inputs::pushes`], or from none.
    pub fn add_push_numbers(&self, mut numbers: impl Iterator<Item = f64>, coordinates: Coordinates, load: &mut [f64]) {
        if self.floor_forces {
            self.add_forces(numbers.by_ref(), coordinates, load);
        }
        self.correct(numbers, coordinates, load);
    }

    /// Adds forces on all floors, N, or on none.
    fn add_forces(&self, mut forces: impl Iterator<Item = f64>, coordinates: Coordinates, load: &mut [f64]) {
        for id in self.structure.ids() {
            let of_building = forces.by_ref().take(self.structure.floors(id)).enumerate();
            let acting = of_building.filter(|(_, force)| *force != 0.0);
            match coordinates {
                Coordinates::Modes => self.structure.add_floor_forces(id, acting, load),
                Coordinates::Floors => acting.for_each(|(floor, force)| {
                    let lane = self.structure.floors.lane(id, floor);
                    load[lane] += force * self.structure.floors.inverse_mass(lane);
                }),
            }
        }
    }

    /// Adds corrections of all that can be corrected, N, or of none.
    fn correct(&self, corrections: impl Iterator<Item = f64>, coordinates: Coordinates, load: &mut [f64]) {
        let acting = self.corrected_rows.iter().zip(corrections).filter(|(_, force)| *force != 0.0);
        acting.for_each(|(row, force)| row.push(coordinates, force, load));
    }

    /// What the base shear of a building is less by, N, or its rate.
    pub fn correction_of_base(&self, inputs: &Inputs, id: BuildingId, part: impl Fn(&LinearInput) -> f64) -> f64 {
        let all = self.corrections.iter().zip(&inputs.corrections).filter(|(of, _)| of.building == id);
        all.fold(0.0, |sum, (of, line)| sum + of.on_base() * part(line))
    }

    /// The number among the corrections of that of a storey or floor, if there are any.
    pub fn number_of_correction(&self, (id, number): Storey) -> Option<usize> {
        Some(self.structure.number(id, number)).filter(|number| *number < self.corrections.len())
    }
}
