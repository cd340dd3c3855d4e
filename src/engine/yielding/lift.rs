//! How the plastic drift of an element moves the position of rest.
//!
//! In a shear building by itself it moves the floors above the storey by (1 - r) of it. Where links or soil act on a body, it
//! moves all of its floors, by
//!
//! ```text
//! L = (1 - r) k K^-1 row      row of the other element . L = how far that moves the other's drift at rest
//! ```
//!
//! with K the stiffness of the body with all of its links and soil, of which the modes are.

use crate::engine::base::Coordinates;
use crate::engine::base::element::ElementState;
use crate::structure::{Storey, Structure, dot};
use std::ops::Range;

#[derive(Clone, Debug)]
pub(super) enum Lift {
    /// The floors above a storey, by a share of its plastic drift.
    Above {
        /// The share, 1 - r'.
        kept: f64,
        /// Modal displacements of a building whose floors above the storey have moved by 1 m.
        modes: Vec<f64>,
        /// The lanes of these floors.
        lanes: Range<usize>,
    },
    /// All floors of a body with links.
    All {
        /// Modal displacements per unit of plastic drift, kg^1/2.
        modes: Vec<f64>,
        /// Displacements of all floors per unit of plastic drift.
        floors: Vec<f64>,
        /// The drift of the element itself at rest per unit of its own plastic drift.
        own: f64,
        /// The same per unit of that of each element.
        by: Vec<f64>,
    },
}

impl Lift {
    /// Of a storey in a building by itself.
    pub(super) fn above(structure: &Structure, (id, storey): Storey, kept: f64) -> Lift {
        let count = structure.floors(id);
        let lifted: Vec<f64> = (0..count).map(|floor| f64::from(u8::from(floor >= storey))).collect();
        let mut modes = vec![0.0; structure.lanes];
        structure.add_modal(id, &lifted, &mut modes);
        let lane = |floor: usize| structure.floors.lane(id, floor);
        Lift::Above { kept, modes, lanes: lane(storey)..lane(count - 1) + 1 }
    }

    /// Of an element in a body with links, on a row over its modes; `lost` is the stiffness that yielding takes away, N/m.
    pub(super) fn all(lost: f64, row: &[f64], structure: &Structure) -> Lift {
        let of_mode = |(row, omega2): (&f64, &f64)| if *row == 0.0 { 0.0 } else { lost * row / omega2 };
        let modes: Vec<f64> = row.iter().zip(&structure.omega2).map(of_mode).collect();
        let mut floors = vec![0.0; structure.lanes];
        structure.to_floors(&modes, &mut floors);
        Lift::All { own: dot(row, &modes), modes, floors, by: Vec::new() }
    }

    /// Works out how far the plastic drifts of all elements move the drift of this one, which has that row over the modes.
    pub(super) fn join(&mut self, row: &[f64], lifts: &[Lift]) {
        if let Lift::All { by, .. } = self {
            *by = lifts.iter().map(|lift| dot(row, lift.modes())).collect();
        }
    }

    fn modes(&self) -> &[f64] {
        let (Lift::Above { modes, .. } | Lift::All { modes, .. }) = self;
        modes
    }

    /// Adds the displacements at rest by a plastic drift, m.
    pub(super) fn add(&self, coordinates: Coordinates, plastic: f64, displacements: &mut [f64]) {
        let add_all = |lift: &[f64], by: f64, displacements: &mut [f64]| {
            displacements.iter_mut().zip(lift).for_each(|(displacement, lift)| *displacement += lift * by);
        };
        match (self, coordinates) {
            (Lift::Above { kept, modes, .. }, Coordinates::Modes) => add_all(modes, kept * plastic, displacements),
            (Lift::Above { kept, lanes, .. }, Coordinates::Floors) => {
                displacements[lanes.clone()].iter_mut().for_each(|floor| *floor += kept * plastic);
            }
            (Lift::All { modes, .. }, Coordinates::Modes) => add_all(modes, plastic, displacements),
            (Lift::All { floors, .. }, Coordinates::Floors) => add_all(floors, plastic, displacements),
        }
    }

    /// The displacement of a floor at rest per unit of plastic drift.
    pub(super) fn of_floor(&self, lane: usize) -> f64 {
        match self {
            Lift::Above { kept, lanes, .. } => {
                if lanes.contains(&lane) {
                    *kept
                } else {
                    0.0
                }
            }
            Lift::All { floors, .. } => floors[lane],
        }
    }

    /// A quantity of the element's own drift at rest, by that quantity of the plastic drift of each element: the drift from
    /// plastic drifts, its rate from their rates.
    pub(super) fn at_rest(&self, own: f64, all: impl Iterator<Item = f64>) -> f64 {
        match self {
            Lift::Above { kept, .. } => kept * own,
            Lift::All { by, .. } => by.iter().zip(all).map(|(by, of)| by * of).sum(),
        }
    }

    /// Stiffness against the drift of the element while it yields over that before, all other elements elastic: below 0 where
    /// gravity pushes it on whatever holds it. `alone` is its post-yield ratio.
    pub(super) fn ratio(&self, alone: f64) -> f64 {
        match self {
            Lift::Above { .. } => alone,
            Lift::All { own, .. } => 1.0 - own,
        }
    }

    /// The drift, m, from which an element that has a ratio below 0 does not come back. Of one by itself `alone`, in the sense
    /// of its plastic drift; in a body with links where it would rest just at the limit of its elastic range, on the side
    /// away from the `centre` of the one that it has now.
    pub(super) fn critical(&self, alone: f64, (plastic, centre): (f64, f64), limit: f64) -> f64 {
        match self {
            Lift::Above { .. } => alone.copysign(plastic),
            Lift::All { own, .. } => plastic + (centre - own * limit.copysign(centre)) / (own - 1.0),
        }
    }

    /// Its rate, from those of the plastic drift and of the centre.
    pub(super) fn critical_rate(&self, (plastic, centre): (f64, f64)) -> f64 {
        match self {
            Lift::Above { .. } => 0.0,
            Lift::All { own, .. } => plastic + centre / (own - 1.0),
        }
    }

    /// The middle of the range in which the element is elastic, as a drift relative to the position of rest, m: its own
    /// plastic drift less the drift at rest. `ratio` is its post-yield ratio.
    pub(super) fn centre(&self, ratio: f64, element: &ElementState, all: &[ElementState]) -> f64 {
        match self {
            Lift::Above { .. } => ratio * element.plastic,
            Lift::All { by, .. } => {
                by.iter().zip(all).fold(element.plastic, |centre, (by, other)| centre - by * other.plastic)
            }
        }
    }

    /// Whether its element is in a body with links.
    pub(super) fn is_of_all(&self) -> bool {
        matches!(self, Lift::All { .. })
    }
}
