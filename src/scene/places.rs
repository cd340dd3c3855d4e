//! The displacements that a building has with its foundation, and what storeys and floors do in them.
//!
//! Displacements of floors are those relative to the ground far away, so that a foundation with the displacement u_0 and
//! the rotation phi (positive: the building leans to the right) leaves of the storeys the drifts that strain them:
//!
//! ```text
//! drift of storey i = u_i - u_(i-1) - h_i phi        its lean, on which gravity acts: u_i - u_(i-1)
//! ```

use super::data::Building;
use super::place::Place;

/// The displacements of a building in their order: those of its floors, and of the ways in which its foundation moves.
#[derive(Clone, Debug, PartialEq)]
pub struct Places {
    /// Number of floors.
    pub floors: usize,
    sways: bool,
    /// m, of the storeys of a building that rocks.
    heights: Option<Vec<f64>>,
}

impl Places {
    /// Those of a building.
    pub fn of(building: &Building) -> Places {
        let foundation = building.foundation.as_ref();
        let rocking = foundation.and_then(|foundation| foundation.rocking);
        let heights = building.heights.as_ref().filter(|_| rocking.is_some());
        Places {
            floors: building.mass.len(),
            sways: foundation.is_some_and(|foundation| foundation.sway.is_some()),
            heights: heights.map(|heights| heights.storeys.clone()),
        }
    }

    /// Whether there is no foundation that moves.
    pub fn are_of_floors(&self) -> bool {
        self.count() == self.floors
    }

    /// How many there are.
    pub fn count(&self) -> usize {
        self.floors + usize::from(self.sways) + usize::from(self.heights.is_some())
    }

    /// The number of one of them; `None` where the foundation does not move so.
    pub fn number(&self, place: Place) -> Option<usize> {
        match place {
            Place::Floor(floor) => Some(floor),
            Place::Foundation => self.sways.then_some(self.floors),
            Place::Rotation => self.heights.is_some().then(|| self.floors + usize::from(self.sways)),
        }
    }

    /// The lean of a storey, counted from 0, as weights of displacements.
    pub fn lean(&self, storey: usize) -> impl Iterator<Item = (Place, f64)> {
        let below = storey.checked_sub(1).map(Place::Floor).or(self.sways.then_some(Place::Foundation));
        [Some((Place::Floor(storey), 1.0)), below.map(|below| (below, -1.0))].into_iter().flatten()
    }

    /// Its drift, likewise.
    pub fn drift(&self, storey: usize) -> impl Iterator<Item = (Place, f64)> {
        self.lean(storey).chain(self.tilt(storey).map(|height| (Place::Rotation, -height)))
    }

    /// What a floor, counted from 0, does beyond the motion of its foundation, likewise.
    pub fn beyond_foundation(&self, floor: usize) -> impl Iterator<Item = (Place, f64)> {
        let height = self.heights.as_ref().map(|heights| heights.iter().take(floor + 1).sum::<f64>());
        let sway = self.sways.then_some((Place::Foundation, -1.0));
        [Some((Place::Floor(floor), 1.0)), sway, height.map(|height| (Place::Rotation, -height))].into_iter().flatten()
    }

    /// m, by how much a storey leans to the right per radian of its foundation.
    pub fn tilt(&self, storey: usize) -> Option<f64> {
        self.heights.as_ref()?.get(storey).copied()
    }
}

impl Building {
    /// The mass, kg, or the moment of inertia, kg m2, that one of its displacements moves; infinite where there is none.
    pub fn inertia(&self, place: Place) -> f64 {
        let of = match place {
            Place::Floor(floor) => self.mass.get(floor).copied(),
            Place::Foundation => self.foundation.as_ref().filter(|of| of.sway.is_some()).map(|of| of.mass),
            Place::Rotation => self.foundation.as_ref().filter(|of| of.rocking.is_some()).map(|of| of.inertia),
        };
        of.unwrap_or(f64::INFINITY)
    }

    /// A displacement, or velocity, at the start, from those of its floors: the foundation begins at rest.
    pub fn at_start(of_floors: &[f64], place: Place) -> f64 {
        match place {
            Place::Floor(floor) => of_floors.get(floor).copied().unwrap_or(0.0),
            Place::Foundation | Place::Rotation => 0.0,
        }
    }

    /// N m per radian: the stiffness against rocking below which gravity pushes the building over,
    /// sum of P h / (1 - theta) over its storeys.
    pub fn overturning_stiffness(&self) -> f64 {
        let Some(heights) = &self.heights else { return 0.0 };
        let moment = |(storey, g): (usize, &f64)| {
            let (height, k) = (heights.storeys.get(storey)?, self.stiffness.of_storey(storey)?);
            Some(g * height * height / (1.0 - g / k))
        };
        self.gravity_stiffness().iter().enumerate().filter_map(moment).sum()
    }
}
