//! The first instant at which an elastic storey yields, by a power series of the motion.

use crate::engine::base::Base;
use crate::engine::base::element::Sense;
use crate::engine::base::planned::{Event, First};
use crate::engine::system::System;
use crate::numerics::polynomial::{Coefficients, MAX_TERMS};
use crate::numerics::substitution::Substitution;
use crate::structure::MotionSeries;

/// A series of the motion with the factors of its terms, the substitution of its time map, and whether it begins at the base.
pub type Expanded<'a> = ((&'a MotionSeries, &'a Coefficients), Option<&'a Substitution>, bool);

impl System {
    /// Sets the power 2 of a drift to 0 where it is no more than rounding of the accelerations that it is made of: those of
    /// a motion with that highest rate, which has that size at the start.
    pub fn clear_curvature(
        &self,
        (fastest, size): (f64, f64),
        i: usize,
        series: &MotionSeries,
        drift: &mut Coefficients,
    ) {
        let of = &self.elements[i];
        let angle = fastest * series.scale;
        let rounding = 8.0 * f64::EPSILON * angle * angle * (size + of.limit);
        drift[2] = if drift[2].abs() <= rounding { 0.0 } else { drift[2] };
    }

    /// Looks for the first yield of storey `i` in a series, if before the first event known so far.
    ///
    /// `factors` are those of the terms at the end, for their rounding errors; `is_start` says whether the series begins at
    /// the base: there a storey whose drift has just turned is exactly at its limit, with the rate 0.
    pub fn first_yield(
        &self,
        base: &Base,
        i: usize,
        ((series, factors), substitution, is_start): Expanded,
        first: &mut First,
    ) {
        let (of, (element, centre)) = self.element_at(i, &base.elements);
        let mut drift = [0.0; MAX_TERMS];
        let size = match base.oscillates {
            true => of.in_flight().project(series, factors, &mut drift),
            false => of.row.project(base.coordinates, series, factors, &mut drift),
        };
        let noise = of.noise(centre, size);
        let count = series.order + 1;
        if is_start && element.turned.is_some() {
            let rate_and_size = match base.oscillates {
                true => (self.structure.in_flight().fastest, of.in_flight().size_at_start(series)),
                false => (self.structure.fastest, of.row.difference(base.coordinates, series.term(0)).1),
            };
            self.clear_curvature(rate_and_size, i, series, &mut drift);
        }
        for sense in Sense::BOTH {
            let mut terms = drift.map(|term| sense.sign() * term);
            terms[0] = of.excess(centre, sense, drift[0]).min(0.0);
            if is_start && element.turned == Some(sense) {
                (terms[0], terms[1]) = (0.0, 0.0);
            }
            if let Some(substitution) = substitution.filter(|_| series.time_map.is_curved()) {
                substitution.apply_to_one(&mut terms[..count]);
            }
            first.search(&mut terms[..count], noise, Event::Yield(i, sense));
        }
    }
}
