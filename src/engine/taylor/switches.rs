//! The instants at which elements that yield turn or collapse, while the motion is a power series.

use crate::engine::base::element::{ElementState, Sense};
use crate::engine::base::planned::{Event, First};
use crate::engine::base::{Base, Coordinates};
use crate::engine::system::System;
use crate::engine::system::buffers::Buffers;
use crate::engine::taylor::solution::Solution;
use crate::engine::yielding::element::Element;
use crate::numerics::polynomial::{ALL, COUNT, MAX_TERMS};
use crate::structure::Motion;

/// A rate of a drift below this share of the velocities that it is made of is rounding: what comes next decides. Larger
/// than the rounding of a rate at its root, so that a storey does not turn and yield again for ever.
const STILL: f64 = 1e-13;

impl System {
    /// The number of a yielding element whose drift has the wrong sense at the base, by an impulse or by rounding: it
    /// turns at once.
    pub fn turned_at_once(&self, base: &Base) -> Option<usize> {
        let goes_back = |(of, element): (&Element, &ElementState)| {
            let still = STILL * self.size_of_rate(of, base.coordinates, base.motion(), 1.0);
            element.yields.is_some_and(|sense| sense.sign() * of.drift(base.coordinates, &base.v) < -still)
        };
        self.elements.iter().zip(&base.elements).position(goes_back)
    }

    /// Sum of the magnitudes that the rate of a drift is made of, from displacements and velocities times a
    /// time, s: where oscillators move in
    /// flights, velocities have the rounding of both.
    fn size_of_rate(&self, of: &Element, coordinates: Coordinates, Motion { q, v }: Motion, scale: f64) -> f64 {
        let of_rates = of.row.difference(coordinates, v).1;
        match self.structure.oscillators() {
            Some(_) => of_rates + self.structure.fastest * scale * of.row.difference(coordinates, q).1,
            None => of_rates,
        }
    }

    /// Looks for the first instant up to the end of the step at which an element that yields turns or collapses: at
    /// once where rigid pairs hold it.
    pub fn first_turning(&self, base: &Base, solution: &mut Solution, work: &mut Buffers, first: &mut First) {
        for &(i, sense) in &solution.drifts.yielding {
            if self.holds_storey(i, &mut work.rigid) {
                first.set(0.0, Event::Turn(i));
                continue;
            }
            self.first_turn(base, solution, (i, sense), first);
            self.first_collapse(base, solution, (i, sense), first);
        }
    }

    /// Looks for the first instant at which the drift of an element that yields is that of its collapse.
    fn first_collapse(
        &self,
        base: &Base,
        Solution { series, drifts, substitution, .. }: &Solution,
        (i, sense): (usize, Sense),
        first: &mut First,
    ) {
        let Some(collapse) = self.elements[i].collapse else { return };
        let count = series.order + 1;
        let mut terms = drifts.drifts[i].map(|term| sense.sign() * term);
        terms[0] = (sense.sign() * base.elements[i].plastic + self.elements[i].limit - collapse).min(0.0);
        if series.time_map.is_curved() {
            substitution.apply_to_one(&mut terms[..count]);
        }
        let noise = 4.0 * f64::EPSILON * collapse;
        first.search(&mut terms[..count], noise, Event::Collapse(i));
    }

    /// Looks for the first instant at which the drift of an element that yields turns: at once where it does not go on in its
    /// sense by more than rounding, as that of a floor that is held.
    fn first_turn(&self, base: &Base, solution: &Solution, (i, sense): (usize, Sense), first: &mut First) {
        let Solution { series, drifts, substitution, .. } = solution;
        let mut terms = [0.0; MAX_TERMS];
        let count = series.order;
        for n in 0..count {
            terms[n] = -sense.sign() * (COUNT[n + 1] * drifts.drifts[i][n + 1]);
        }
        let [q, step] = [0, 1].map(|n| series.term(n));
        let of = &self.elements[i];
        let still = STILL * self.size_of_rate(of, base.coordinates, Motion { q, v: step }, series.scale);
        if terms[0] >= -still {
            // What is rounding shall not decide.
            let mut drift = [0.0; MAX_TERMS];
            of.row.project_at(base, series, &ALL, &mut drift);
            drift[1] = if drift[1].abs() <= still { 0.0 } else { drift[1] };
            self.clear_curvature(base, (&of.row, of.limit), series, &mut drift);
            let leading = drift[1..=count].iter().find(|term| **term != 0.0);
            if leading.is_none_or(|term| sense.sign() * term < 0.0) {
                return first.set(0.0, Event::Turn(i));
            }
            for n in 0..2 {
                terms[n] = -sense.sign() * (COUNT[n + 1] * drift[n + 1]);
            }
        }
        if series.time_map.is_curved() {
            substitution.apply_to_one(&mut terms[..count]);
        }
        first.search(&mut terms[..count], 0.0, Event::Turn(i));
    }
}
