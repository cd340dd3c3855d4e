//! The position in which the buildings would come to rest: plastic drifts move it, and all motion is relative to it.

use crate::engine::base::storey::Storey;
use crate::engine::base::{Coordinates, Rest};
use crate::engine::system::System;
use crate::structure::Side;

impl System {
    /// The position of rest of some storeys.
    pub fn rest_of(&self, storeys: &[Storey]) -> Rest {
        let mut rest = Rest::default();
        self.set_rest(storeys, &mut rest);
        rest
    }

    /// Sets a position of rest to that of some storeys, in the same order of sums whatever it was.
    pub fn set_rest(&self, storeys: &[Storey], rest: &mut Rest) {
        // A position of rest that has been read from bytes has no numbers yet.
        rest.floors.resize(self.structure.lanes, 0.0);
        rest.gaps.resize(self.pairs.len(), 0.0);
        self.set_rest_of_floors(storeys, &mut rest.floors);
        for (gap, pair) in rest.gaps.iter_mut().zip(&self.pairs) {
            *gap = pair.gap_at(&rest.floors);
        }
    }

    /// Sets the displacements of all floors at rest, m.
    pub fn set_rest_of_floors(&self, storeys: &[Storey], floors: &mut [f64]) {
        floors.fill(0.0);
        for (of, storey) in self.storeys.iter().zip(storeys) {
            of.lift(Coordinates::Floors, of.kept() * storey.plastic, floors);
        }
    }

    /// Adds to accelerations by stiffness (or their rates) what storeys that yield do not resist with, for displacements (or
    /// velocities) since they began to.
    pub fn yield_to(&self, coordinates: Coordinates, storeys: &[Storey], motion: &[f64], accelerations: &mut [f64]) {
        for (of, _) in self.storeys.iter().zip(storeys).filter(|(_, storey)| storey.yields.is_some()) {
            of.push_apart(coordinates, of.lost * of.drift(coordinates, motion), accelerations);
        }
    }

    /// The same for the base shear of a building, N.
    pub fn yielded_base_shear(&self, coordinates: Coordinates, storeys: &[Storey], side: Side, motion: &[f64]) -> f64 {
        let lowest = self.storeys.iter().zip(storeys).find(|(of, _)| of.side == side && of.storey == 0);
        let yielding = lowest.filter(|(_, storey)| storey.yields.is_some());
        yielding.map_or(0.0, |(of, _)| of.lost * of.drift(coordinates, motion))
    }

    /// The number of a storey of a building, counted from 0, among those that can yield.
    pub fn number_of_storey(&self, (side, storey): (Side, usize)) -> Option<usize> {
        self.storeys.binary_search_by_key(&(side as usize, storey), |of| (of.side as usize, of.storey)).ok()
    }

    /// What the strain energy exceeds that of the motion relative to the position of rest by, J.
    pub fn locked_energy(&self, storeys: &[Storey]) -> f64 {
        self.storeys.iter().zip(storeys).map(|(of, storey)| of.locked_energy(storey)).sum()
    }

    /// The storeys on whose lean gravity acts, with g, N/m.
    pub fn leaning(&self) -> impl Iterator<Item = ((Side, usize), f64)> {
        let of =
            |side: Side| self.gravity[side as usize].iter().enumerate().map(move |(storey, g)| ((side, storey), *g));
        [Side::Left, Side::Right].into_iter().flat_map(of).filter(|(_, g)| *g != 0.0)
    }

    /// Potential energy of the weights, J, in a motion relative to the position of rest: -1/2 sum of g drift^2.
    pub fn gravity_energy(&self, (coordinates, storeys): (Coordinates, &[Storey]), q: &[f64]) -> f64 {
        let of = |(place, g): ((Side, usize), f64)| {
            let plastic = self.number_of_storey(place).map_or(0.0, |i| self.storeys[i].kept() * storeys[i].plastic);
            let drift = self.drift(coordinates, place, q) + plastic;
            -0.5 * g * (drift * drift)
        };
        self.leaning().map(of).sum()
    }

    /// Drift of a storey in a motion.
    fn drift(&self, coordinates: Coordinates, (side, storey): (Side, usize), motion: &[f64]) -> f64 {
        let of = |floor: usize| self.displacement(coordinates, (side, floor), motion);
        of(storey) - storey.checked_sub(1).map_or(0.0, of)
    }

    fn displacement(&self, coordinates: Coordinates, (side, floor): (Side, usize), motion: &[f64]) -> f64 {
        match coordinates {
            Coordinates::Modes => {
                let body = self.structure.body(side);
                let shape = body.modes.shape.row(body.row(side, floor));
                shape.iter().zip(&motion[body.range.clone()]).map(|(shape, q)| shape * q).sum::<f64>()
            }
            Coordinates::Floors => motion[self.structure.floors.lane(side as usize, floor)],
        }
    }

    /// Energy dissipated by all storeys that have yielded, J.
    pub fn hysteretic_energy(&self, storeys: &[Storey]) -> f64 {
        self.storeys.iter().zip(storeys).map(|(of, storey)| of.hysteretic_energy(storey)).sum()
    }
}
