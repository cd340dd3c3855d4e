//! The power series of one penetration, and how far it is off by rounding.

use crate::engine::base::Coordinates;
use crate::engine::base::contact::Contact;
use crate::engine::pairs::pair::Pair;
use crate::structure::MotionSeries;

impl Pair {
    /// The scalar series in time of a pair's relative motion, written to `out[n]`. Returns the sum of the sizes of all that
    /// is added up, each term times its `factor`.
    pub fn project(&self, coordinates: Coordinates, series: &MotionSeries, factors: &[f64], out: &mut [f64]) -> f64 {
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
    /// Makes the first terms of the penetration's series, for a pair that is apart, those that are known best; returns
    /// the rounding error that is left.
    pub fn begin_flight(&self, terms: &mut [f64], scale: f64, noise: f64) -> f64 {
        terms[0] = self.flight_start();
        if !self.tracked {
            return noise;
        }
        terms[1] = self.rate * scale;
        if self.let_go {
            terms[2] = terms[2].min(0.0);
        }
        // A pair that rests at the surface is pressed or not by its acceleration, which is 0 where it is rounding: what
        // presses it brings it together at once. Had it first to pass the rounding of its gap, it would meet with a
        // speed that it cannot have, and pairs of the same floor would keep each other bouncing.
        let is_pressed = terms[2] > 0.0;
        if terms[0] == 0.0 && self.rate == 0.0 && !is_pressed { noise } else { 0.0 }
    }
}
