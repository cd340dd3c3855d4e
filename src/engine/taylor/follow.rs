//! What a Taylor step does to contacts.

use crate::engine::base::contact::Contact;
use crate::numerics::polynomial::Coefficients;
use crate::numerics::powers::Powers;
use crate::numerics::roots;
impl Contact {
    /// Impulse and peaks of floors that are held together, over a series up to the x of the powers.
    pub(in crate::engine) fn follow_reaction(
        &mut self,
        terms: &Coefficients,
        order: usize,
        scale: f64,
        start: f64,
        powers: &Powers,
    ) {
        let impulse = scale * powers.integral(terms);
        self.impulse += impulse;
        self.episode.impulse += impulse;
        let force = powers.read(terms);
        let copy = |out: &mut Coefficients| {
            *out = *terms;
            order + 1
        };
        let known = self.episode.peak_force;
        if let Some((at, peak)) = roots::maximum_above((terms[0], terms[1]), powers.x, &force, known, copy) {
            self.episode.peak_force = peak;
            self.episode.peak_time = start + at * scale;
            self.peak_force = self.peak_force.max(peak);
        }
        self.reaction = force.value;
    }
}
