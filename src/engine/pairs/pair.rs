//! One contact: the row that gives its penetration, its gap and its law.

use crate::contact::{EpisodeForce, Force, ImpactLaw};
use crate::engine::base::Coordinates;
use crate::engine::base::contact::{Contact, ContactPhase, Episode};
use crate::engine::pairs::row::{WeightRow, relative};
use crate::engine::quantities::flight_row::FlightRow;
use crate::scene::{Scene, Share};
use crate::structure::{Motion, Structure};

/// One contact, between two floors or a floor and columns or a wall: a row of weights over the floors of the buildings.
#[derive(Clone, Debug)]
pub(crate) struct Pair {
    /// Row of the Jacobian: penetration = row . q - gap, and a contact force F loads the motion with -row F.
    pub row: WeightRow,
    /// Gap at rest, m.
    pub gap: f64,
    pub law: ImpactLaw,
    /// Reduced mass, kg.
    pub mass: f64,
}

impl Pair {
    /// A contact of the scene, with its masses and its row of the modal Jacobian.
    pub(crate) fn new(pair: &crate::scene::ContactPair, scene: &Scene, structure: &Structure) -> Pair {
        let shares: Vec<Share> = pair.row(scene).collect();
        let row = WeightRow::of(structure, shares.iter().map(|share| (share.building, share.place, share.weight)));
        Pair { row, gap: pair.gap, law: pair.law, mass: pair.reduced_mass(scene) }
    }

    /// The force of its law while the guard is positive, but for the part that goes with the approach velocity.
    pub(crate) fn force(&self) -> Force {
        EpisodeForce::new(&self.law, self.mass, None).engaged
    }

    /// Whether its force is a power of the penetration with a fractional exponent.
    pub(crate) fn has_power_law(&self) -> bool {
        !self.force().is_regular()
    }

    /// The row of its penetration in flights.
    pub(crate) fn in_flight(&self) -> FlightRow<'_> {
        self.row.in_flight()
    }

    /// Penetration, m, and its rate, m/s, for the motion in a flight relative to a position of rest in which it has that gap.
    pub(crate) fn penetration(&self, gap: f64, motion: Motion) -> (f64, f64) {
        let row = self.in_flight();
        (row.value(motion) - gap, row.rate(motion))
    }

    /// The gap in another position of rest, in which all floors have those displacements, m.
    pub(crate) fn gap_at(&self, rest: &[f64]) -> f64 {
        self.gap - relative(&self.row.floors, rest)
    }

    /// Rounding error, m, of a penetration that is a sum of terms of that total `size`, m: a smaller excess is no
    /// contact.
    pub(crate) fn noise(&self, size: f64) -> f64 {
        2.0 * f64::EPSILON * (size + self.gap.abs())
    }

    /// The contact at the start of a run, for a modal motion and the gap in its position of rest. A pair that overlaps there begins an episode without
    /// approach velocity.
    pub(crate) fn at_start(&self, index: usize, time: f64, gap: f64, Motion { q, v }: Motion) -> Contact {
        let (penetration, rate) = (self.relative(Coordinates::Modes, q) - gap, self.relative(Coordinates::Modes, v));
        let force = EpisodeForce::new(&self.law, self.mass, None);
        let mut contact = Contact {
            phase: ContactPhase::Apart,
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
        let noise = self.noise(self.row.difference(Coordinates::Modes, q).1);
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
        self.row.value(coordinates, motion)
    }

    /// Whether it is between two floors, so that their motions are subtracted as they are.
    pub(crate) fn is_of_floors(&self) -> bool {
        self.row.floors.map(|floor| floor.weight) == [1.0, -1.0, 0.0, 0.0]
    }

    /// Sum of the products of its weights with its own accelerations by a unit force of another contact, 1/kg: minus what
    /// that force adds to its relative acceleration. 0 where they have no floor in common.
    pub(crate) fn softness(&self, other: &Pair) -> f64 {
        let products = self.row.floors.iter().flat_map(|own| {
            let same = other.row.floors.iter().filter(|floor| floor.lane == own.lane);
            same.map(|floor| -own.weight * floor.push)
        });
        products.sum()
    }
}
