//! A block of quantities over a stretch of exact motion, from both of its ends: the cubic through values and slopes,
//! and the bound on its error, h^4/384 max|y''''| \[BirkhoffPriver1967\].

use crate::engine::bounds::stretch::{ModeBounds, Stretch};
use crate::engine::quantities::rows::{RowBlock, sums_of, values_of};
use crate::numerics::polynomial::{each, larger};
use crate::numerics::roots;
use crate::structure::{LANES, Lane};
use std::ops::Range;

/// The quantities of a block over a flight.
#[derive(Clone, Copy)]
pub struct Course {
    /// Values and slopes at the start.
    pub start: [Lane; 2],
    /// Values and slopes at the end.
    pub end: [Lane; 2],
    /// Bounds on their fourth derivatives.
    pub fourth: Lane,
}

/// Values, with those at rest, and slopes of the quantities of a block at both ends of a flight; the values may be known.
pub fn course_of(
    (block, at_rest): (&RowBlock, &Lane),
    (flight, known_ends): (&Stretch, Option<[Lane; 2]>),
    bounds: &ModeBounds,
    modes: Range<usize>,
) -> Course {
    let [q, rate] = [flight.start.q, flight.start.v].map(|vector| &vector[modes.clone()]);
    let [end_q, end_rate] = [flight.end.q, flight.end.v].map(|vector| &vector[modes.clone()]);
    let [first, last, on_q, on_v] =
        [&bounds.first, &bounds.last, &bounds.fourth_on_q, &bounds.fourth_on_v].map(|vector| &vector[modes.clone()]);
    let [start, end] = known_ends.unwrap_or_else(|| {
        let ends = [values_of(block, q, rate), values_of(block, end_q, end_rate)];
        ends.map(|values| each(|i| values[i] + at_rest[i]))
    });
    let [slope, end_slope, fourth] = sums_of(block, [(rate, first), (end_rate, last)], (on_q, on_v));
    Course { start: [start, slope], end: [end, end_slope], fourth }
}

impl Course {
    /// Adds to the values numbers that are linear in time, given by their values at the start and their rates.
    pub fn add_values(&mut self, direct: &[[f64; 2]], h: f64) {
        for (i, [value, rate]) in direct.iter().enumerate().take(LANES) {
            self.start[0][i] += value;
            self.end[0][i] += value + rate * h;
        }
    }

    /// Adds their rates to the slopes.
    pub fn add_rates(&mut self, direct: &[[f64; 2]]) {
        for (i, [_, rate]) in direct.iter().enumerate().take(LANES) {
            self.start[1][i] += rate;
            self.end[1][i] += rate;
        }
    }

    /// Upper bounds on the magnitudes over the flight.
    pub fn highest(&self, h: f64) -> Lane {
        let ([start, rate], [end, end_rate]) = (&self.start, &self.end);
        let (third, share) = (h / 3.0, (h * h) * (h * h) / 384.0);
        each(|i| {
            let controls = larger((start[i] + third * rate[i]).abs(), (end[i] - third * end_rate[i]).abs());
            larger(larger(start[i].abs(), end[i].abs()), controls) + share * self.fourth[i]
        })
    }

    /// Whether quantity `i` may have a turning point in between, above its peak.
    pub fn may_turn_above(&self, i: usize, h: f64, peak: f64) -> bool {
        let (start, rate, end, end_rate) = (self.start[0][i], self.start[1][i], self.end[0][i], self.end[1][i]);
        roots::may_turn_above((start, rate), (end, end_rate), (h, self.fourth[i]), peak)
            || roots::may_turn_above((-start, -rate), (-end, -end_rate), (h, self.fourth[i]), peak)
    }
}
