//! The power series of an open pair's penetration: its first terms, and its rounding error.

use crate::engine::base::contact::Contact;

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
