//! The first entry of an open pair while others are in contact.

use crate::engine::base::Base;
use crate::engine::base::contact::Contact;
use crate::engine::base::planned::Event;
use crate::engine::bounds::terms::PenetrationBounds;
use crate::engine::system::System;
use crate::engine::system::buffers::Buffers;
use crate::engine::taylor::solution::Solution;
use crate::numerics::polynomial::Coefficients;
use crate::numerics::powers::Powers;
use crate::numerics::roots;
use crate::numerics::substitution::Substitution;
use crate::structure::MotionSeries;

impl System {
    /// The first entry of an open pair up to the end of the step, as (x, event).
    pub fn first_entry(&self, base: &Base, solution: &mut Solution, work: &mut Buffers) -> Option<(f64, Event)> {
        if base.contacts.iter().all(Contact::in_contact) {
            return None;
        }
        let Solution { open, series, end, substitution, .. } = solution;
        open.assign(&self.pairs, base.coordinates);
        open.follow(base, &self.pairs, (series, substitution), end, &mut work.node_q);
        let mut first = None;
        for (block, bounds) in open.apart.iter().zip(&open.bounds) {
            first = self.first_of_lanes(
                base,
                open.members[*block].lanes(),
                bounds,
                ((series, substitution), end, work),
                first,
            );
        }
        first
    }

    /// The first entry among the open pairs of some lanes, or `first` if that is earlier.
    #[inline]
    fn first_of_lanes(
        &self,
        base: &Base,
        lanes: impl Iterator<Item = (usize, usize)>,
        bounds: &PenetrationBounds,
        ((series, substitution), end, work): ((&MotionSeries, &Substitution), &mut Powers, &mut Buffers),
        mut first: Option<(f64, Event)>,
    ) -> Option<(f64, Event)> {
        let stays_apart = bounds.stays_apart(end.x);
        // The stored penetration of a pair at the surface, or tracked, is more accurate than the one that the motion
        // gives: bounds by the motion do not exclude it.
        let is_sure = |lane: usize, contact: &Contact| stays_apart[lane] && !contact.at_surface && !contact.tracked;
        let may_meet = |&(lane, p): &(usize, usize)| {
            let contact = &base.contacts[p];
            !contact.in_contact() && !is_sure(lane, contact)
        };
        for (_, p) in lanes.filter(may_meet) {
            first =
                self.first_entry_of(base, p, ((series, substitution), &mut *end), &mut work.scalar, first).or(first);
        }
        first
    }

    /// The entry of one open pair, before the first event known so far or the end of the step, as (x, event).
    pub fn first_entry_of(
        &self,
        base: &Base,
        p: usize,
        ((series, substitution), end): ((&MotionSeries, &Substitution), &mut Powers),
        scalar: &mut Coefficients,
        first: Option<(f64, Event)>,
    ) -> Option<(f64, Event)> {
        let terms = &mut scalar[..=series.order];
        end.set_in_time(&series.time_map);
        let size = self.pairs[p].project(base.coordinates, series, end.in_time().0, terms);
        let contact = &base.contacts[p];
        let noise = contact.begin_flight(terms, series.scale, self.pairs[p].noise(size));
        if series.time_map.is_curved() {
            substitution.apply_to_one(terms);
        }
        let until = first.map_or(end.x, |(x, _)| x);
        roots::first_upcrossing(terms, until, noise).map(|x| (x, Event::Entry(p)))
    }
}
