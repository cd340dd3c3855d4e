//! Power series: what their terms, each as large as it is, allow up to the end of a step.
//!
//! A quantity with the terms c0 + c1 x + c2 x^2 + ... is at most c0 + x max(c1, 0) + |c2| x^2 + |c3| x^3 + ..., which
//! needs no more than the sizes of the terms of the motion ([`Horizon`]). With its own terms its fourth derivative is
//! bounded, and both ends tell as they do in a flight ([`PenetrationBounds`], [`super::certificate`]).

use crate::contact::taylor::{Each, PAIRS};
use crate::numerics::polynomial::{MAX_TERMS, each};
use crate::numerics::powers::Powers;
use crate::numerics::roots::deviation;
use crate::structure::MotionSeries;

/// How far the motion can get in a step, in the coordinates of its series.
pub struct Horizon<'a> {
    /// Number of terms of power 1, rates times the series' scale, by which the motion goes on at most: x, or the time
    /// there if that is more.
    reach: f64,
    /// Sums of the magnitudes of all further terms, coordinate by coordinate, m.
    pub wandered: &'a [f64],
}

impl<'a> Horizon<'a> {
    /// For a step up to x; `room` is memory for as many numbers as there are coordinates.
    ///
    /// With t = x + b x^2, a term of a series in time, re-expanded in x and truncated after the last power, is never
    /// larger at x than the same term in time at x + |b| x^2.
    pub fn of(series: &MotionSeries, x: f64, room: &'a mut [f64]) -> Horizon<'a> {
        let reach = x + series.time_map.curvature.abs() * (x * x);
        series.sum_sizes(2, reach, room);
        Horizon { reach, wandered: room }
    }

    /// Whether a quantity stays below 0 that starts at `start` with the term `step` of power 1, and of which the row
    /// has `wandered` in the magnitudes of all further terms.
    pub fn is_beyond(&self, start: f64, step: f64, wandered: f64) -> bool {
        start + self.reach * step.max(0.0) + wandered < 0.0
    }
}

/// Penetrations of a block of pairs at both ends of a step, in the x of its series.
#[derive(Clone, Debug, Default)]
pub struct PenetrationBounds {
    /// Penetrations at the start, m, and their derivatives with respect to x.
    pub start: [Each; 2],
    /// Penetrations at the end, m, and their derivatives with respect to x.
    pub end: [Each; 2],
    /// Bounds on their fourth derivatives with respect to x.
    pub fourth: Each,
}

impl PenetrationBounds {
    /// For block `i` of `width`, from the first `count` terms of its relative displacements; `terms` holds those of all
    /// blocks for one power, then for the next.
    #[inline(always)]
    pub fn of(
        terms: &[Each],
        (i, width): (usize, usize),
        count: usize,
        powers: &Powers,
        gap: &Each,
    ) -> PenetrationBounds {
        let ((values, slopes, fourths), term) = (powers.all(), |n: usize| &terms[n * width + i]);
        let (first, rate) = (term(0), *term(1));
        let (mut later, mut slope, mut fourth) = ([0.0; PAIRS], [0.0; PAIRS], [0.0; PAIRS]);
        for n in 2..count.min(MAX_TERMS) {
            let term = term(n);
            later = each(|i| later[i] + term[i] * values[n]);
            slope = each(|i| slope[i] + term[i] * slopes[n]);
            fourth = each(|i| fourth[i] + term[i].abs() * fourths[n]);
        }
        let start = each(|i| first[i] - gap[i]);
        let end = each(|i| start[i] + (rate[i] * powers.x + later[i]));
        PenetrationBounds { start: [start, rate], end: [end, each(|i| rate[i] + slope[i])], fourth }
    }

    /// Whether each pair certainly stays apart up to x: its penetration differs from its cubic interpolant by no more
    /// than its fourth derivative allows, and the interpolant is at most its largest control value.
    pub fn stays_apart(&self, x: f64) -> [bool; PAIRS] {
        let ([start, rate], [end, slope]) = (&self.start, &self.end);
        let larger = |a: f64, b: f64| if a > b { a } else { b };
        let third = x / 3.0;
        let highest = each(|i| {
            let control = larger(start[i] + third * rate[i], end[i] - third * slope[i]);
            larger(larger(start[i], end[i]), control) + deviation(x, self.fourth[i])
        });
        // Written so that a NaN never counts as apart.
        highest.map(|highest| highest < 0.0)
    }
}
