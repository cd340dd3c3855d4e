//! One pair of facing floors and its penetration.

use crate::contact::{EpisodeForce, Force, ImpactLaw};
use crate::engine::base::Coordinates;
use crate::engine::base::contact::{Contact, Episode, Phase};
use crate::scene::Scene;
use crate::structure::{FEW_BLOCKS, LANES, Lane, Side, Structure};

/// One pair of facing floors, left and right.
#[derive(Clone, Debug)]
pub struct Pair {
    /// Row of the modal Jacobian, kg^-1/2: penetration = row . q - gap, and a contact force F loads the modes with -row
    /// F.
    pub row: Vec<f64>,
    /// Gap at rest, m.
    pub gap: f64,
    pub law: ImpactLaw,
    /// Reduced mass of the two floors, kg.
    pub mass: f64,
    /// Numbers of the left and the right floor, from 0.
    pub floors: [usize; 2],
    /// Masses of these floors, kg.
    pub masses: [f64; 2],
    /// Their inverses, 1/kg.
    pub inverse_masses: [f64; 2],
    /// Indices of the two floors in a vector of all floors.
    pub lanes: [usize; 2],
    /// The first blocks of `row`: all of it where modes are few.
    pub first_blocks: [Lane; FEW_BLOCKS],
}

impl Pair {
    /// A contact of the scene, with its masses and its row of the modal Jacobian.
    pub fn new(pair: &crate::scene::ContactPair, scene: &Scene, structure: &Structure) -> Pair {
        let (left, right) = (pair.left_floor - 1, pair.right_floor - 1);
        let mut row = vec![0.0; structure.lanes];
        structure.add_floor_force(Side::Left, left, 1.0, &mut row);
        structure.add_floor_force(Side::Right, right, -1.0, &mut row);
        let (m1, m2) = (scene.left.mass[left], scene.right.mass[right]);
        let lanes = [structure.floors.lane(0, left), structure.floors.lane(1, right)];
        let mut first_blocks = [[0.0; LANES]; FEW_BLOCKS];
        for (first, row) in first_blocks.as_flattened_mut().iter_mut().zip(&row) {
            *first = *row;
        }
        Pair {
            row,
            gap: pair.gap,
            law: pair.law,
            mass: m1 * m2 / (m1 + m2),
            floors: [left, right],
            masses: [m1, m2],
            inverse_masses: [1.0 / m1, 1.0 / m2],
            lanes,
            first_blocks,
        }
    }

    /// Whether its force is a power of the penetration with a fractional exponent.
    pub fn has_power_law(&self) -> bool {
        matches!(EpisodeForce::new(&self.law, self.mass, None).engaged, Force::Power { .. } | Force::Root { .. })
    }

    /// Whether its force is a power of the penetration throughout, from the entry to the release.
    pub fn has_one_power_law(&self) -> bool {
        matches!(EpisodeForce::new(&self.law, self.mass, None).engaged, Force::Power { .. })
    }

    /// Penetration, m, and its rate, m/s, for a modal motion.
    pub fn penetration(&self, q: &[f64], v: &[f64]) -> (f64, f64) {
        use crate::structure::dot;
        (dot(&self.row, q) - self.gap, dot(&self.row, v))
    }

    /// Rounding error, m, of a penetration that is a sum of terms of that total `size`, m: a smaller excess is no
    /// contact.
    pub fn noise(&self, size: f64) -> f64 {
        2.0 * f64::EPSILON * (size + self.gap.abs())
    }

    /// The contact at the start of a run, for a modal motion. A pair that overlaps there begins an episode without
    /// approach velocity.
    pub fn at_start(&self, index: usize, time: f64, q: &[f64], v: &[f64]) -> Contact {
        let (penetration, rate) = self.penetration(q, v);
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

    /// Motion (displacement, velocity, ...) of the left floor less that of the right floor.
    #[inline(always)]
    pub fn relative(&self, coordinates: Coordinates, motion: &[f64]) -> f64 {
        let Pair { row, lanes: [left, right], .. } = self;
        match coordinates {
            Coordinates::Modes => crate::structure::dot(row, motion),
            Coordinates::Floors => motion[*left] - motion[*right],
        }
    }

    /// (left minus right, size): the relative motion, set to 0 where the floors' motions agree within rounding, and the
    /// size of the numbers that were subtracted.
    pub fn difference(&self, coordinates: Coordinates, motion: &[f64]) -> (f64, f64) {
        let Pair { row, lanes: [left, right], .. } = self;
        match coordinates {
            Coordinates::Modes => crate::structure::difference(row, motion),
            Coordinates::Floors => {
                let (left, right) = (motion[*left], motion[*right]);
                (apart(left, right), left.abs() + right.abs())
            }
        }
    }
}

/// Difference of the motions of two floors, set to 0 where they agree within rounding.
pub fn apart(left: f64, right: f64) -> f64 {
    let difference = left - right;
    if difference.abs() <= 4.0 * f64::EPSILON * (left.abs() + right.abs()) { 0.0 } else { difference }
}
