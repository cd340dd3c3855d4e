//! Expansion of motion and contact forces into power series in time, power by power together.

use crate::engine::base::{Base, Coordinates};
use crate::engine::pairs::jacobian::{FloorJacobian, ModalJacobian};
use crate::engine::system::System;
use crate::engine::system::buffers::Buffers;
use crate::engine::taylor::drifts::WithYielding;
use crate::engine::taylor::pair_forces::ClosedForces;
use crate::engine::taylor::solution::Solution;
use crate::numerics::polynomial::MAX_ORDER;
use crate::structure::{difference, dot, flight_order};

/// Remainder of a series, relative to its terms, that is less than their rounding.
const ROUNDING: f64 = 1e-17;

impl System {
    /// Expands motion, penetrations and forces from the base on; `scale` is the time unit, s.
    pub fn expand(&self, base: &Base, solution: &mut Solution, work: &mut Buffers, scale: f64) {
        self.start_series(base, solution, scale);
        self.expand_to(base, solution, work, self.tolerance.order + 1);
    }

    /// Expands a linear motion so that its series is exact up to `length`, s, its time unit; returns its x there, 1.
    pub fn expand_exactly(&self, base: &Base, solution: &mut Solution, work: &mut Buffers, length: f64) -> f64 {
        self.start_series(base, solution, length);
        let order = flight_order(self.fastest * length, ROUNDING).unwrap_or(MAX_ORDER);
        self.expand_to(base, solution, work, order);
        1.0
    }

    fn start_series(&self, base: &Base, solution: &mut Solution, scale: f64) {
        solution.series.start(scale, &base.q, &base.v);
        solution.closed.start(base, &self.pairs, scale);
        solution.drifts.start(base, &self.elements, scale);
    }

    /// Extends the started series to `order`.
    fn expand_to(&self, base: &Base, solution: &mut Solution, work: &mut Buffers, order: usize) {
        let (structure, loads) = (&self.structure, work.loads());
        let Solution { series, closed, drifts, .. } = solution;
        let elements = &self.elements[..];
        match base.coordinates {
            Coordinates::Floors => {
                let pairs = &mut ClosedForces { closed, jacobian: FloorJacobian };
                series.expand_floors(&structure.floors, order, loads, &mut WithYielding { elements, drifts, pairs });
            }
            Coordinates::Modes if work.rigid.pairs.is_empty() => {
                let pairs = &mut ClosedForces { closed, jacobian: ModalJacobian(&self.pairs) };
                series.expand_modes(structure, order, loads, &mut WithYielding { elements, drifts, pairs });
            }
            Coordinates::Modes => {
                while solution.series.order < order {
                    self.extend_together(solution, work);
                }
            }
        }
    }

    /// Extends the series by more powers, if these are cheap and no pair is released within `reach`; returns whether it
    /// did.
    pub fn expand_further(&self, base: &Base, solution: &mut Solution, work: &mut Buffers, reach: f64) -> bool {
        let are_cheap = base.coordinates == Coordinates::Modes
            && self.structure.is_classical()
            && work.rigid.pairs.is_empty()
            && self.tolerance.linear_order > self.tolerance.order
            && solution.closed.are_linear();
        if !are_cheap || solution.closed.are_some_nearly_released(reach) {
            return false;
        }
        self.expand_to(base, solution, work, self.tolerance.linear_order + 1);
        true
    }

    /// Extends the series on modes by one power, with the reactions between floors that are held together.
    fn extend_together(&self, solution: &mut Solution, Buffers { load, slope, rigid, .. }: &mut Buffers) {
        let Solution { series, closed, drifts, reactions, reaction_order, .. } = solution;
        let n = series.order - 1;
        let scale = series.scale;
        closed.extend_forces(n);
        let load_of_power = |out: &mut [f64]| {
            match n {
                0 => out.copy_from_slice(load),
                1 => out.iter_mut().zip(&*slope).for_each(|(out, slope)| *out = slope * scale),
                _ => {}
            }
            closed.each_force(n, |p, force| self.push_apart_by(p, Coordinates::Modes, force, out));
            drifts.push(&self.elements, n, 1.0, out);
        };
        series.extend(&self.structure, load_of_power, |acceleration| self.constrain(rigid, acceleration));
        for (&k, reaction) in rigid.pairs.iter().zip(&rigid.found) {
            reactions[k][n] = *reaction;
        }
        *reaction_order = n;
        let term = series.term(n + 2);
        drifts.read(&self.elements, n + 2, term);
        closed.set_penetrations(n + 2, |p, at_surface| {
            let row = &self.pairs[p].row.modes;
            if at_surface { difference(row, term).0 } else { dot(row, term) }
        });
    }
}
