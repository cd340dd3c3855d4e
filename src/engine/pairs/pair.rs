//! Two facing floors.

use crate::contact::{EpisodeForce, Force, ImpactLaw};
use crate::engine::base::Coordinates;
use crate::engine::base::contact::{Contact, Episode, Phase};
use crate::scene::Scene;
use crate::structure::{FEW_BLOCKS, LANES, Lane, Side, Structure};

/// Two facing floors.
#[derive(Clone, Debug)]
pub struct Pair {
    /// Penetration = row . q - gap; the force F loads the modes with -row F.
    pub row: Vec<f64>,
    /// m.
    pub gap: f64,
    pub law: ImpactLaw,
    /// kg, reduced mass of the two floors.
    pub mass: f64,
    /// Left and right floor, counted from 0.
    pub floors: [usize; 2],
    /// kg, of these floors.
    pub masses: [f64; 2],
    /// 1/kg.
    pub inverse_masses: [f64; 2],
    /// Their lanes in a vector of all floors.
    pub lanes: [usize; 2],
    /// `row` as far as it goes, where modes are few.
    pub first_blocks: [Lane; FEW_BLOCKS],
}

impl Pair {
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

    /// Whether its force goes as a power of the penetration, but for 1 and whole laws that do not.
    pub fn has_power_law(&self) -> bool {
        matches!(EpisodeForce::new(&self.law, self.mass, None).engaged, Force::Power { .. } | Force::Root { .. })
    }

    /// m and m/s.
    pub fn penetration(&self, q: &[f64], v: &[f64]) -> (f64, f64) {
        use crate::structure::dot;
        (dot(&self.row, q) - self.gap, dot(&self.row, v))
    }

    /// m, rounding error of a penetration that was added up from numbers of that size: a touch below it is none.
    pub fn noise(&self, size: f64) -> f64 {
        2.0 * f64::EPSILON * (size + self.gap.abs())
    }

    /// A pair that overlaps at the start is an episode without approach velocity.
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
            // Overlaps by rounding at most: the scene is refused otherwise.
            contact.at_surface = penetration >= -noise;
            contact.penetration = penetration.min(0.0);
        } else if penetration > noise {
            contact.begin(time, 0.0);
        } else if penetration > 0.0 {
            (contact.penetration, contact.at_surface) = (0.0, true);
        }
        contact
    }

    /// The rate or other motion of the pair: that of its left floor less that of its right floor.
    #[inline(always)]
    pub fn relative(&self, coordinates: Coordinates, motion: &[f64]) -> f64 {
        let Pair { row, lanes: [left, right], .. } = self;
        match coordinates {
            Coordinates::Modes => crate::structure::dot(row, motion),
            Coordinates::Floors => motion[*left] - motion[*right],
        }
    }

    /// The same, 0 where the floors move alike but for rounding, and the size of what it is the difference of.
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

/// The difference of two floors' motion, 0 where they move alike but for rounding.
pub fn apart(left: f64, right: f64) -> f64 {
    let difference = left - right;
    if difference.abs() <= 4.0 * f64::EPSILON * (left.abs() + right.abs()) { 0.0 } else { difference }
}
