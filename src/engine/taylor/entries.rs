//! The first entry of an open pair while others are in contact.

use crate::engine::base::Base;
use crate::engine::base::contact::Contact;
use crate::engine::base::planned::{Event, First};
use crate::engine::system::System;
use crate::engine::system::buffers::Buffers;
use crate::engine::taylor::solution::Solution;
use crate::numerics::polynomial::Coefficients;
use crate::numerics::powers::Powers;
use crate::numerics::substitution::Substitution;
use crate::structure::MotionSeries;

impl System {
    /// Looks for the first entry of an open pair up to the end of the step.
    pub fn first_entry(&self, base: &Base, solution: &mut Solution, work: &mut Buffers, first: &mut First) {
        if base.contacts.iter().all(Contact::in_contact) {
            return;
        }
        let Solution { open, series, end, substitution, .. } = solution;
        open.assign(&self.pairs, base.coordinates);
        open.follow(base, &self.pairs, (series, substitution), end, &mut work.node_q);
        for (block, bounds) in open.apart.iter().zip(&open.bounds) {
            let stays_apart = bounds.stays_apart(end.x);
            // The stored penetration of a pair at the surface, or tracked, is more accurate than the one that the motion
            // gives: bounds by the motion do not exclude it.
            let is_sure = |lane: usize, contact: &Contact| stays_apart[lane] && !contact.at_surface && !contact.tracked;
            let may_meet = |&(lane, p): &(usize, usize)| {
                let contact = &base.contacts[p];
                !contact.in_contact() && !is_sure(lane, contact)
            };
            for (_, p) in open.packed.members(*block).lanes().filter(may_meet) {
                self.first_entry_of(base, p, ((series, substitution), &mut *end), &mut work.scalar, first);
            }
        }
    }

    /// Looks for the entry of one open pair.
    pub fn first_entry_of(
        &self,
        base: &Base,
        p: usize,
        ((series, substitution), end): ((&MotionSeries, &Substitution), &mut Powers),
        scalar: &mut Coefficients,
        first: &mut First,
    ) {
        let terms = &mut scalar[..=series.order];
        end.set_in_time(&series.time_map);
        let size = self.pairs[p].row.project(base.coordinates, series, end.in_time().0, terms);
        let contact = &base.contacts[p];
        let noise = contact.begin_flight(terms, series.scale, self.pairs[p].noise(size));
        if series.time_map.is_curved() {
            substitution.apply_to_one(terms);
        }
        first.search(terms, noise, Event::Entry(p));
    }
}
