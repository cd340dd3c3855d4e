//! The position in which the buildings would come to rest: plastic drifts move it, and all motion is relative to it.

use crate::engine::base::element::ElementState;
use crate::engine::base::{Coordinates, Rest};
use crate::engine::system::System;
use crate::engine::yielding::element::{Element, ElementOf, Present};
use crate::scene::Place;
use crate::structure::{BuildingId, Storey};

impl System {
    /// The position of rest of some storeys.
    pub fn rest_of(&self, elements: &[ElementState]) -> Rest {
        let mut rest = Rest::default();
        self.set_rest(elements, &mut rest);
        rest
    }

    /// Sets a position of rest to that of some storeys, in the same order of sums whatever it was.
    pub fn set_rest(&self, elements: &[ElementState], rest: &mut Rest) {
        // A position of rest that has been read from bytes has no numbers yet.
        rest.floors.resize(self.structure.lanes, 0.0);
        rest.gaps.resize(self.pairs.len(), 0.0);
        self.set_rest_of_floors(elements, &mut rest.floors);
        for (gap, pair) in rest.gaps.iter_mut().zip(&self.pairs) {
            *gap = pair.gap_at(&rest.floors);
        }
    }

    /// Sets the displacements of all floors at rest, m.
    pub fn set_rest_of_floors(&self, elements: &[ElementState], floors: &mut [f64]) {
        floors.fill(0.0);
        for (of, element) in self.elements.iter().zip(elements) {
            of.lift(Coordinates::Floors, element.plastic, floors);
        }
    }

    /// Adds to accelerations by stiffness (or their rates) what elements that yield do not resist with, for displacements (or
    /// velocities) since they began to.
    pub fn yield_to(
        &self,
        coordinates: Coordinates,
        elements: &[ElementState],
        motion: &[f64],
        accelerations: &mut [f64],
    ) {
        for (of, _) in self.elements.iter().zip(elements).filter(|(_, element)| element.yields.is_some()) {
            of.row.push(coordinates, of.lost * of.drift(coordinates, motion), accelerations);
        }
    }

    /// The same for the base shear of a building, N.
    pub fn yielded_base_shear(
        &self,
        coordinates: Coordinates,
        elements: &[ElementState],
        id: BuildingId,
        motion: &[f64],
    ) -> f64 {
        let yielding = self.number_of_storey((id, 0)).filter(|i| elements[*i].yields.is_some());
        yielding.map_or(0.0, |i| self.elements[i].lost * self.elements[i].drift(coordinates, motion))
    }

    /// The elements, each with its state and the middle of its elastic range.
    pub fn elements_at<'a>(&'a self, elements: &'a [ElementState]) -> impl Iterator<Item = (&'a Element, Present<'a>)> {
        self.elements.iter().zip(elements).map(|(of, element)| (of, (element, of.centre(element, elements))))
    }

    /// One of them.
    pub fn element_at<'s>(&self, i: usize, elements: &'s [ElementState]) -> (&Element, Present<'s>) {
        let (of, element) = (&self.elements[i], &elements[i]);
        (of, (element, of.centre(element, elements)))
    }

    /// The number of a storey of a building, counted from 0, among those that can yield.
    pub fn number_of_storey(&self, (id, storey): Storey) -> Option<usize> {
        self.number_of(ElementOf::Storey(id, storey))
    }

    /// The number of an element among those that can yield.
    pub fn number_of(&self, place: ElementOf) -> Option<usize> {
        self.elements.binary_search_by_key(&place.order(), |of| of.place.order()).ok()
    }

    /// What the strain energy exceeds that of the motion relative to the position of rest by, J.
    pub fn locked_energy(&self, elements: &[ElementState]) -> f64 {
        self.elements_at(elements).map(|(of, present)| of.locked_energy(present)).sum()
    }

    /// Potential energy of the weights, J, in a motion relative to the position of rest: -1/2 sum of g lean^2.
    pub fn gravity_energy(&self, (coordinates, elements): (Coordinates, &[ElementState]), q: &[f64]) -> f64 {
        let of = |&(place, g): &(Storey, f64)| {
            let lean = self.lean(coordinates, place, q) + self.lean_at_rest(place, elements);
            -0.5 * g * (lean * lean)
        };
        self.leaning.iter().map(of).sum()
    }

    /// Lean of a storey in the position of rest, m.
    fn lean_at_rest(&self, (id, storey): Storey, elements: &[ElementState]) -> f64 {
        if !self.structure.body(id).is_linked {
            let own = self.number_of_storey((id, storey));
            return own.map_or(0.0, |i| self.elements[i].kept() * elements[i].plastic);
        }
        let floors = &self.structure.floors;
        let moved = |(of, state): (&Element, &ElementState)| {
            let of_place = |(place, weight)| Some(weight * of.moves_floor(floors.lane_of(id, place)?));
            floors.places(id).lean(storey).filter_map(of_place).sum::<f64>() * state.plastic
        };
        self.elements.iter().zip(elements).map(moved).sum()
    }

    /// Lean of a storey in a motion: its drift, and by how much its foundation has turned.
    fn lean(&self, coordinates: Coordinates, (id, storey): Storey, motion: &[f64]) -> f64 {
        let places = self.structure.floors.places(id);
        let of_place = |(place, weight)| Some(weight * self.displacement(coordinates, (id, place), motion)?);
        places.lean(storey).filter_map(of_place).sum()
    }

    fn displacement(&self, coordinates: Coordinates, (id, place): (BuildingId, Place), motion: &[f64]) -> Option<f64> {
        Some(match coordinates {
            Coordinates::Modes => {
                let body = self.structure.body(id);
                let shape = body.modes.shape.row(body.row_of(id, place)?);
                shape.iter().zip(&motion[body.range.clone()]).map(|(shape, q)| shape * q).sum::<f64>()
            }
            Coordinates::Floors => motion[self.structure.floors.lane_of(id, place)?],
        })
    }

    /// Energy dissipated by all elements that have yielded, J.
    pub fn hysteretic_energy(&self, elements: &[ElementState]) -> f64 {
        self.elements.iter().zip(elements).map(|(of, element)| of.hysteretic_energy(element)).sum()
    }
}
