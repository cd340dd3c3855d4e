//! Power series: what their terms, each as large as it is, allow up to the end of a step.
//!
//! A quantity with the terms c0 + c1 x + c2 x^2 + ... is at most c0 + x max(c1, 0) + |c2| x^2 + |c3| x^3 + ..., which
//! needs no more than the sizes of the terms of the motion.

use crate::structure::MotionSeries;

/// How far the motion can get in a step, in the coordinates of its series.
pub struct TermSizes<'a> {
    /// Number of terms of power 1, rates times the series' scale, by which the motion goes on at most: x, or the time
    /// there if that is more.
    reach: f64,
    /// Sums of the magnitudes of all further terms, coordinate by coordinate, m.
    pub wandered: &'a [f64],
}

impl<'a> TermSizes<'a> {
    /// For a step up to x; `room` is memory for as many numbers as there are coordinates.
    ///
    /// With t = x + b x^2, a term of a series in time, re-expanded in x and truncated after the last power, is never
    /// larger at x than the same term in time at x + |b| x^2.
    pub fn of(series: &MotionSeries, x: f64, room: &'a mut [f64]) -> TermSizes<'a> {
        let reach = x + series.time_map.curvature.abs() * (x * x);
        series.sum_sizes(2, reach, room);
        TermSizes { reach, wandered: room }
    }

    /// Whether a quantity stays below 0 that starts at `start` with the term `step` of power 1, and of which the row
    /// has `wandered` in the magnitudes of all further terms.
    pub fn stays_below(&self, start: f64, step: f64, wandered: f64) -> bool {
        start + self.reach * step.max(0.0) + wandered < 0.0
    }
}
