//! What the motion must not pass unseen: the gap of each pair, and the yield drift of each element in either sense. The
//! rows of the pairs come first, then those of the elements; bounds are asked for each.

use crate::engine::base::Base;
use crate::engine::base::element::Sense;
use crate::engine::bounds::certificate::stays_below;
use crate::engine::bounds::oscillation::Oscillation;
use crate::engine::pairs::pair::Pair;
use crate::engine::quantities::flight_row::FlightRow;
use crate::engine::system::System;
use crate::engine::yielding::element::Element;
use crate::structure::{LinearLoad, Motion};

impl System {
    /// Number of all rows with limits.
    pub fn limits(&self) -> usize {
        self.pairs.len() + self.elements.len()
    }

    /// All rows with limits.
    pub fn limited_rows(&self) -> impl Iterator<Item = FlightRow<'_>> {
        self.pairs.iter().map(Pair::in_flight).chain(self.elements.iter().map(Element::in_flight))
    }

    /// Whether the quantity of row `i` stays within its limits for `h` seconds from one motion to another, if it is off
    /// its cubic by at most `deviation`. An element that has just turned at the base is at its limit.
    pub fn stays_within(&self, base: &Base, i: usize, [from, to]: [Motion; 2], h: (f64, f64)) -> bool {
        match i.checked_sub(self.pairs.len()) {
            None => {
                let [from, to] = [from, to].map(|motion| self.pairs[i].penetration(base.rest.gaps[i], motion));
                stays_below(from, to, h)
            }
            Some(element) => {
                let (of, present) = self.element_at(element, &base.elements);
                let [from, to] = [from, to].map(|motion| (of.in_flight().value(motion), of.in_flight().rate(motion)));
                of.stays_elastic(present, from, to, h)
            }
        }
    }

    /// Whether no quantity reaches a limit within `length` seconds from a modal motion on, under a load and its slope,
    /// by the envelopes of the oscillations. Gaps and limits are those of the base.
    pub fn envelopes_stay_within(&self, base: &Base, motion: Motion, loads: LinearLoad, length: f64) -> bool {
        let oscillation = Oscillation::of(self.structure.in_flight(), motion, loads, length);
        let Some(oscillation) = oscillation.filter(|_| !cfg!(without = "envelopes")) else { return false };
        let mut pairs = self.pairs.iter().zip(&base.rest.gaps);
        let mut elements = self.elements_at(&base.elements);
        pairs.all(|(pair, gap)| oscillation.stays_below(pair.in_flight(), 1.0, *gap))
            && elements.all(|(of, (_, centre))| {
                let limit = |sign: f64| of.limit + sign * centre;
                Sense::BOTH
                    .map(Sense::sign)
                    .iter()
                    .all(|sign| oscillation.stays_below(of.in_flight(), *sign, limit(*sign)))
            })
    }
}
