//! Moves the contacts along a Taylor step.

use crate::engine::base::contact::{Contact, Passage};
use crate::engine::system::System;
use crate::engine::taylor::solution::Solution;
use crate::numerics::polynomial::Coefficients;
use crate::numerics::powers::Powers;
use crate::numerics::roots;

impl Solution {
    /// Moves the contacts to the end of the step, which began at the time `start`, s.
    pub fn follow(&self, system: &System, contacts: &mut [Contact], start: f64) {
        self.closed.follow(contacts, &self.series, start, &self.end);
        for (terms, &p) in self.reactions.iter().zip(&system.rigid.pairs) {
            if contacts[p].is_held() {
                contacts[p].follow_reaction(terms, self.reaction_order, self.series.scale, start, &self.end);
            }
        }
    }

    /// Moves one contact to the x of the powers.
    pub fn follow_one(&self, system: &System, contact: &mut Contact, start: f64, powers: &Powers) {
        if !contact.is_held() {
            return self.closed.follow_one(contact, &self.series, start, (powers, &self.end));
        }
        let p = contact.episode.contact;
        if let Some(k) = system.rigid.pairs.iter().position(|&pair| pair == p) {
            contact.follow_reaction(&self.reactions[k], self.reaction_order, self.series.scale, start, powers);
        }
    }

    /// Writes bounds on the magnitudes of the contact forces up to the x of the powers, N.
    pub fn bound_forces(&self, system: &System, contacts: &[Contact], powers: &Powers, out: &mut [f64]) {
        self.closed.bound_forces(contacts, (powers, powers.x == self.end.x), out);
        for (terms, &p) in self.reactions.iter().zip(&system.rigid.pairs) {
            if contacts[p].is_held() {
                let powers = powers.all().0.iter();
                out[p] = terms.iter().zip(powers).take(self.reaction_order + 1).map(|(c, x)| c.abs() * x).sum();
            }
        }
    }
}

impl Contact {
    /// Impulse and peaks of floors that are held together, by the series of their reaction, N, up to the x of the
    /// powers.
    pub fn follow_reaction(&mut self, terms: &Coefficients, order: usize, scale: f64, start: f64, powers: &Powers) {
        let impulse = scale * powers.integral(terms);
        let force = powers.read(terms);
        let copy = |out: &mut Coefficients| {
            *out = *terms;
            order + 1
        };
        let known = self.episode.peak_force;
        let found = roots::maximum_above((terms[0], terms[1]), powers.x, &force, known, copy);
        let strongest = found.map(|(at, peak)| (peak, start + at * scale));
        self.book(Passage { impulse, strongest, ..Passage::default() });
        self.reaction = force.value;
    }
}
