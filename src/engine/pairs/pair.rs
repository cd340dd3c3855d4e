//! One contact: the row of weights that gives its penetration from the floors' displacements.

use crate::contact::{EpisodeForce, Force, ImpactLaw};
use crate::engine::base::contact::{Contact, Episode, Phase};
use crate::engine::base::{Base, Coordinates};
use crate::engine::quantities::flight_row::{FlightRow, OscillatorRows};
use crate::scene::Scene;
use crate::structure::{FEW_BLOCKS, LANES, Lane, Structure};

/// One contact, between two floors or a floor and columns or a wall: a row of weights over the floors of both buildings.
#[derive(Clone, Debug)]
pub(crate) struct Pair {
    /// Row of the modal Jacobian, kg^-1/2: penetration = row . q - gap, and a contact force F loads the modes with -row
    /// F.
    pub row: Vec<f64>,
    /// The penetration over oscillators, where these move in flights.
    oscillating: Option<OscillatorRows>,
    /// Gap at rest, m.
    pub gap: f64,
    pub law: ImpactLaw,
    /// Reduced mass, kg.
    pub mass: f64,
    /// The same row floor by floor; what is beyond its floors has no weight.
    pub floors: RowOfFloors,
    share_of_ground: f64,
    /// The first blocks of `row`: all of it where modes are few.
    pub first_blocks: [Lane; FEW_BLOCKS],
}

/// A floor and columns between two others, or on a foundation that rocks.
pub(crate) type RowOfFloors = [FloorShare; 4];

/// The part of a floor in the row of a contact.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct FloorShare {
    /// Index in a vector of all floors.
    pub lane: usize,
    /// How far a displacement of the floor goes into the penetration.
    pub weight: f64,
    /// Acceleration of the floor per unit of contact force, 1/kg: minus the weight over its mass.
    pub push: f64,
}

impl Pair {
    /// A contact of the scene, with its masses and its row of the modal Jacobian.
    pub(crate) fn new(pair: &crate::scene::ContactPair, scene: &Scene, structure: &Structure) -> Pair {
        let mut row = vec![0.0; structure.lanes];
        let mut floors = RowOfFloors::default();
        for (share, floor) in pair.row(scene).zip(&mut floors) {
            structure.add_force(share.side, share.place, share.weight, &mut row);
            let lane = structure.floors.lane_of(share.side, share.place).unwrap_or_default();
            *floor =
                FloorShare { lane, weight: share.weight, push: -share.weight * structure.floors.inverse_mass(lane) };
        }
        let mut first_blocks = [[0.0; LANES]; FEW_BLOCKS];
        for (first, row) in first_blocks.as_flattened_mut().iter_mut().zip(&row) {
            *first = *row;
        }
        let oscillating = OscillatorRows::of(structure, &row);
        let share_of_ground = share_of_ground(&floors, structure);
        let mass = pair.reduced_mass(scene);
        Pair { row, oscillating, gap: pair.gap, law: pair.law, mass, floors, share_of_ground, first_blocks }
    }

    /// Whether its force is a power of the penetration with a fractional exponent.
    pub(crate) fn has_power_law(&self) -> bool {
        matches!(EpisodeForce::new(&self.law, self.mass, None).engaged, Force::Power { .. } | Force::Root { .. })
    }

    /// Whether its force is a power of the penetration throughout, from the entry to the release.
    pub(crate) fn has_one_power_law(&self) -> bool {
        matches!(EpisodeForce::new(&self.law, self.mass, None).engaged, Force::Power { .. })
    }

    /// The row of its penetration in flights.
    pub(crate) fn in_flight(&self) -> FlightRow<'_> {
        FlightRow::of(&self.row, self.oscillating.as_ref())
    }

    /// Penetration, m, and its rate, m/s, for the motion in a flight relative to a position of rest in which it has that gap.
    pub(crate) fn penetration(&self, gap: f64, motion: (&[f64], &[f64])) -> (f64, f64) {
        let row = self.in_flight();
        (row.value(motion) - gap, row.rate(motion))
    }

    /// Penetration at the base of a step, m.
    pub(crate) fn penetration_at(&self, gap: f64, base: &Base) -> f64 {
        match base.oscillates {
            true => self.in_flight().value((&base.q, &base.v)) - gap,
            false => self.relative(base.coordinates, &base.q) - gap,
        }
    }

    /// Its rate, m/s.
    pub(crate) fn rate_at(&self, base: &Base) -> f64 {
        match base.oscillates {
            true => self.in_flight().rate((&base.q, &base.v)),
            false => self.relative(base.coordinates, &base.v),
        }
    }

    /// The gap in another position of rest, in which all floors have those displacements, m.
    pub(crate) fn gap_at(&self, rest: &[f64]) -> f64 {
        self.gap - relative(&self.floors, rest)
    }

    /// Rounding error, m, of a penetration that is a sum of terms of that total `size`, m: a smaller excess is no
    /// contact.
    pub(crate) fn noise(&self, size: f64) -> f64 {
        2.0 * f64::EPSILON * (size + self.gap.abs())
    }

    /// The contact at the start of a run, for a modal motion and the gap in its position of rest. A pair that overlaps there begins an episode without
    /// approach velocity.
    pub(crate) fn at_start(&self, index: usize, time: f64, gap: f64, (q, v): (&[f64], &[f64])) -> Contact {
        let (penetration, rate) = (crate::structure::dot(&self.row, q) - gap, crate::structure::dot(&self.row, v));
        let force = EpisodeForce::new(&self.law, self.mass, None);
        let mut contact = Contact {
            phase: Phase::Apart,
            force,
            penetration,
            rate,
            at_surface: penetration == 0.0,
            tracked: false,
            let_go: false,
            undecided: false,
            reaction: 0.0,
            impacts: 0,
            impulse: 0.0,
            work: 0.0,
            stored_reference: 0.0,
            peak_force: 0.0,
            episode: Episode { contact: index, ..Episode::default() },
            work_before: 0.0,
            age: 0.0,
        };
        let noise = self.noise(crate::structure::difference(&self.row, q).1);
        if self.law.is_rigid() {
            // Overlaps by rounding at most: otherwise the scene is refused.
            contact.at_surface = penetration >= -noise;
            contact.penetration = penetration.min(0.0);
        } else if penetration > noise {
            contact.begin(time, 0.0);
        } else if penetration > 0.0 {
            (contact.penetration, contact.at_surface) = (0.0, true);
        }
        contact
    }

    /// Motion (displacement, velocity, ...) of the left face less that of the right one.
    #[inline(always)]
    pub(crate) fn relative(&self, coordinates: Coordinates, motion: &[f64]) -> f64 {
        match coordinates {
            Coordinates::Modes => crate::structure::dot(&self.row, motion),
            Coordinates::Floors => relative(&self.floors, motion),
        }
    }

    /// (left minus right, size): the relative motion, set to 0 where the faces' motions agree within rounding, and the
    /// size of the numbers that were subtracted.
    pub(crate) fn difference(&self, coordinates: Coordinates, motion: &[f64]) -> (f64, f64) {
        match coordinates {
            Coordinates::Modes => crate::structure::difference(&self.row, motion),
            Coordinates::Floors => difference(&self.floors, motion),
        }
    }

    /// Minus the relative acceleration by that of the ground: 0 between two floors.
    pub(crate) fn share_of_ground(&self) -> f64 {
        self.share_of_ground
    }

    /// Whether it is between two floors, so that their motions are subtracted as they are.
    pub(crate) fn is_of_floors(&self) -> bool {
        self.floors.map(|floor| floor.weight) == [1.0, -1.0, 0.0, 0.0]
    }

    /// Sum of the products of its weights with its own accelerations by a unit force of another contact, 1/kg: minus what
    /// that force adds to its relative acceleration. 0 where they have no floor in common.
    pub(crate) fn softness(&self, other: &Pair) -> f64 {
        let products = self.floors.iter().flat_map(|own| {
            let same = other.floors.iter().filter(|floor| floor.lane == own.lane);
            same.map(|floor| -own.weight * floor.push)
        });
        products.sum()
    }
}

/// Relative motion from that of all floors.
#[inline(always)]
pub(crate) fn relative([one, two, three, four]: &RowOfFloors, motion: &[f64]) -> f64 {
    let of_three = one.weight * motion[one.lane] + two.weight * motion[two.lane] + three.weight * motion[three.lane];
    of_three + four.weight * motion[four.lane]
}

/// Minus the acceleration of a row of floors by that of the ground.
pub(crate) fn share_of_ground(row: &[FloorShare], structure: &Structure) -> f64 {
    row.iter().map(|floor| floor.weight * structure.floors.share_of_ground(floor.lane)).sum()
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
pub(crate) fn beyond_rounding(sum: f64, size: f64) -> f64 {
    if sum.abs() <= 4.0 * f64::EPSILON * size { 0.0 } else { sum }
}
