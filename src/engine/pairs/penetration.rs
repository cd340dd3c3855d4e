//! The power series of one pair's penetration, and its rounding error.

use crate::engine::base::Coordinates;
use crate::engine::base::contact::Contact;
use crate::engine::pairs::pair::Pair;
use crate::structure::MotionSeries;

impl Pair {
    /// Writes the terms of a pair's relative motion to `out[n]`, as a series in time. Returns the sum of the magnitudes
    /// of all that was added up, each term times its `factor`, m.
    pub(crate) fn project(
        &self,
        coordinates: Coordinates,
        series: &MotionSeries,
        factors: &[f64],
        out: &mut [f64],
    ) -> f64 {
        if coordinates == Coordinates::Modes {
            return series.project(&self.row, factors, out);
        }
        let mut sum = 0.0;
        for (n, (out, factor)) in out.iter_mut().zip(factors).enumerate().take(series.order + 1) {
            let (value, size) = self.difference(coordinates, series.term(n));
            *out = value;
            sum += size * factor.abs();
        }
        sum
    }
}

impl Contact {
    /// Replaces the first terms of an open pair's penetration by the contact's own numbers, which are more accurate;
    /// returns the rounding error that remains, m.
    pub(crate) fn begin_flight(&self, terms: &mut [f64], scale: f64, noise: f64) -> f64 {
        terms[0] = self.flight_start();
        if !self.tracked {
            return noise;
        }
        terms[1] = self.rate * scale;
        if self.let_go {
            terms[2] = terms[2].min(0.0);
        }
        // A pair at rest at the surface is pressed together or not according to its acceleration, which is 0 if it is
        // rounding; if pressed, it meets at once. If its penetration had first to exceed the rounding error of the gap,
        // the pair would meet with a velocity that it cannot have, and pairs on the same floor would keep each other
        // bouncing.
        let is_pressed = terms[2] > 0.0;
        if terms[0] == 0.0 && self.rate == 0.0 && !is_pressed { noise } else { 0.0 }
    }
}
