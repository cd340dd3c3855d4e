//! The power series of one penetration, and how far it is off by rounding.

use crate::engine::base::contact::Contact;

impl Contact {
    /// Makes the first terms of the penetration's series, for a pair that is apart, those that are known best; returns
    /// the rounding error that is left.
    pub fn begin_flight(&self, terms: &mut [f64], scale: f64, noise: f64) -> f64 {
        terms[0] = self.flight_start();
        if !self.carried {
            return noise;
        }
        terms[1] = self.rate * scale;
        if self.let_go {
            terms[2] = terms[2].min(0.0);
        }
        // A pair that rests at the surface is pressed or not by its acceleration, which is 0 where it is rounding: what presses it
        // brings it together at once. Had it first to pass the rounding of its gap, it would meet with a speed that it cannot
        // have, and pairs of the same floor would keep each other bouncing.
        let is_pressed = terms[2] > 0.0;
        if terms[0] == 0.0 && self.rate == 0.0 && !is_pressed { noise } else { 0.0 }
    }
}
