//! A row of weights over the displacements of the buildings: how far two faces have come nearer, or the drift of what can
//! yield. A force along the row acts on each of them with the same weight.

use crate::engine::base::{Base, Coordinates};
use crate::engine::quantities::flight_row::{FlightRow, OscillatorRows};
use crate::scene::Place;
use crate::structure::{BuildingId, MotionSeries, Structure};

/// A row over modes, oscillators and floors alike. Its quantity is what it makes of a motion.
#[derive(Clone, Debug)]
pub(crate) struct WeightRow {
    /// Over the modes, kg^-1/2.
    pub modes: Vec<f64>,
    /// Over oscillators, where these move in flights.
    oscillating: Option<OscillatorRows>,
    /// Floor by floor; what is beyond its floors has no weight.
    pub floors: RowOfFloors,
    /// Minus the acceleration of the quantity by that of the ground: 0 between two floors.
    pub share_of_ground: f64,
}

/// A floor and columns between two others, or on a foundation that rocks.
pub(crate) type RowOfFloors = [FloorShare; 4];

/// The part of a floor in a row.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct FloorShare {
    /// Index in a vector of all floors.
    pub lane: usize,
    /// How far a displacement of the floor goes into the quantity.
    pub weight: f64,
    /// Acceleration of the floor per unit of a force against the row, such as that of a contact, 1/kg: minus the weight over
    /// its mass.
    pub push: f64,
}

impl WeightRow {
    /// Of displacements of buildings, each with its weight.
    pub(crate) fn of(
        structure: &Structure,
        places: impl Iterator<Item = (BuildingId, Place, f64)> + Clone,
    ) -> WeightRow {
        let mut modes = vec![0.0; structure.lanes];
        places.clone().for_each(|(id, place, weight)| structure.add_force(id, place, weight, &mut modes));
        let lane = |(id, place, weight)| Some((structure.floors.lane_of(id, place)?, weight));
        WeightRow::over(structure, modes, places.filter_map(lane))
    }

    /// From that over the modes, and lanes and weights of its floors.
    pub(crate) fn over(structure: &Structure, modes: Vec<f64>, lanes: impl Iterator<Item = (usize, f64)>) -> WeightRow {
        let mut floors = RowOfFloors::default();
        for (floor, (lane, weight)) in floors.iter_mut().zip(lanes) {
            *floor = FloorShare { lane, weight, push: -weight * structure.floors.inverse_mass(lane) };
        }
        let of_ground = |floor: &FloorShare| floor.weight * structure.floors.share_of_ground(floor.lane);
        let share_of_ground = floors.iter().map(of_ground).sum();
        WeightRow { oscillating: OscillatorRows::of(structure, &modes), modes, floors, share_of_ground }
    }

    /// The row of the quantity in flights.
    pub(crate) fn in_flight(&self) -> FlightRow<'_> {
        FlightRow::of(&self.modes, self.oscillating.as_ref())
    }

    /// The quantity of displacements, or its rate from velocities.
    #[inline(always)]
    pub(crate) fn value(&self, coordinates: Coordinates, motion: &[f64]) -> f64 {
        match coordinates {
            Coordinates::Modes => crate::structure::dot(&self.modes, motion),
            Coordinates::Floors => relative(&self.floors, motion),
        }
    }

    /// (value, size): the quantity, set to 0 where it is no more than rounding, and the sum of the magnitudes that it is made of.
    pub(crate) fn difference(&self, coordinates: Coordinates, motion: &[f64]) -> (f64, f64) {
        match coordinates {
            Coordinates::Modes => crate::structure::difference(&self.modes, motion),
            Coordinates::Floors => difference(&self.floors, motion),
        }
    }

    /// The quantity at the base of a step.
    pub(crate) fn value_at(&self, base: &Base) -> f64 {
        match base.oscillates {
            true => self.in_flight().value(base.motion()),
            false => self.value(base.coordinates, &base.q),
        }
    }

    /// Its rate.
    pub(crate) fn rate_at(&self, base: &Base) -> f64 {
        match base.oscillates {
            true => self.in_flight().rate(base.motion()),
            false => self.value(base.coordinates, &base.v),
        }
    }

    /// The sum of the magnitudes that it is made of.
    pub(crate) fn size_at(&self, base: &Base) -> f64 {
        match base.oscillates {
            true => self.in_flight().size(base.motion()),
            false => self.difference(base.coordinates, &base.q).1,
        }
    }

    /// Writes the terms of the quantity to `out[n]`, as a series in time. Returns the sum of the magnitudes of all that was
    /// added up, each term times its `factor`.
    pub(crate) fn project(
        &self,
        coordinates: Coordinates,
        series: &MotionSeries,
        factors: &[f64],
        out: &mut [f64],
    ) -> f64 {
        if coordinates == Coordinates::Modes {
            return series.project(&self.modes, factors, out);
        }
        let mut sum = 0.0;
        for (n, (out, factor)) in out.iter_mut().zip(factors).enumerate().take(series.order + 1) {
            let (value, size) = difference(&self.floors, series.term(n));
            *out = value;
            sum += size * factor.abs();
        }
        sum
    }

    /// The same of a motion as the base has it.
    pub(crate) fn project_at(&self, base: &Base, series: &MotionSeries, factors: &[f64], out: &mut [f64]) -> f64 {
        match base.oscillates {
            true => self.in_flight().project(series, factors, out),
            false => self.project(base.coordinates, series, factors, out),
        }
    }

    /// Adds to accelerations those by a force along the row, N.
    #[inline(always)]
    pub(crate) fn push(&self, coordinates: Coordinates, force: f64, accelerations: &mut [f64]) {
        match coordinates {
            Coordinates::Modes => {
                accelerations.iter_mut().zip(&self.modes).for_each(|(acceleration, row)| *acceleration += row * force);
            }
            Coordinates::Floors => self.floors.iter().for_each(|floor| accelerations[floor.lane] -= floor.push * force),
        }
    }
}

/// The quantity of a row from a motion of all floors.
#[inline(always)]
pub(crate) fn relative([one, two, three, four]: &RowOfFloors, motion: &[f64]) -> f64 {
    let of_three = one.weight * motion[one.lane] + two.weight * motion[two.lane] + three.weight * motion[three.lane];
    of_three + four.weight * motion[four.lane]
}

/// The same, 0 where it is no more than rounding, and the size of the numbers that it is made of.
pub(crate) fn difference(floors: &RowOfFloors, motion: &[f64]) -> (f64, f64) {
    let size = floors.iter().map(|floor| (floor.weight * motion[floor.lane]).abs()).sum();
    (beyond_rounding(relative(floors, motion), size), size)
}

/// Difference of the motions of two floors, set to 0 where they agree within rounding.
pub(crate) fn apart(left: f64, right: f64) -> f64 {
    beyond_rounding(left - right, left.abs() + right.abs())
}

/// A sum of terms of that total size, or 0 where it is no more than their rounding.
fn beyond_rounding(sum: f64, size: f64) -> f64 {
    if sum.abs() <= 4.0 * f64::EPSILON * size { 0.0 } else { sum }
}
