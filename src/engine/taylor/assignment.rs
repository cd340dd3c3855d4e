//! Assignment of the pairs in contact to blocks, by kind of force, and to lanes.

use crate::contact::taylor::{Kind, PairBlock};
use crate::engine::base::Base;
use crate::engine::base::contact::Contact;
use crate::engine::pairs::packing::LanePlace;
use crate::engine::pairs::pair::Pair;
use crate::engine::taylor::closed_pairs::ClosedPairs;

impl ClosedPairs {
    /// Starts the series of all pairs in contact, except those held together; `scale` is the time unit, s.
    pub fn start(&mut self, base: &Base, pairs: &[Pair], scale: f64) {
        if !self.start_again(base, scale) {
            self.assign(base, pairs);
            self.start_again(base, scale);
        }
    }

    /// Assigns a block and a lane to each closed pair.
    fn assign(&mut self, base: &Base, pairs: &[Pair]) {
        self.used = 0;
        self.assigned.clear();
        self.coordinates = base.coordinates;
        let has_roots = closed(base).any(|(_, contact)| Kind::of(&contact.starting_force()) == Kind::Root);
        for (p, contact) in closed(base) {
            let force = contact.starting_force();
            let kind = Kind::of(&force);
            // A root law without damping includes an undamped power law of the same exponent: so both share a block.
            let joint = if has_roots && force.is_like_root() { Kind::Root } else { kind };
            let (b, lane) = self.room_for(joint, LanePlace::of(&pairs[p], base.coordinates));
            self.members[b].set(lane, p, &pairs[p], base.coordinates);
            self.blocks[b].count = self.blocks[b].count.max(lane + 1);
            self.places[p] = (b, lane);
            self.assigned.push((p, kind));
        }
    }

    /// Enters the closed pairs at their assigned lanes; returns whether the closed pairs are those that were assigned.
    fn start_again(&mut self, base: &Base, scale: f64) -> bool {
        self.at_surface.fill(false);
        self.waits = false;
        let mut assigned = self.assigned.iter();
        for (p, contact) in closed(base) {
            let force = contact.starting_force();
            if assigned.next() != Some(&(p, Kind::of(&force))) {
                return false;
            }
            let (b, lane) = self.places[p];
            self.blocks[b].add(lane, &force, scale, contact.penetration, contact.rate * scale);
            let at_surface = contact.at_surface && contact.rate == 0.0;
            self.at_surface[b] |= at_surface;
            self.waits |= at_surface || self.neighbours[p].iter().any(|&q| is_closed(&base.contacts[q]));
        }
        assigned.next().is_none() && self.coordinates == base.coordinates
    }

    /// Block and lane for a pair of a kind of force: a free lane, of the newest block if possible, or a new block.
    fn room_for(&mut self, kind: Kind, place: LanePlace) -> (usize, usize) {
        for b in (0..self.used).rev() {
            if self.blocks[b].kind() == kind
                && let Some(lane) = self.members[b].free_lane(place)
            {
                return (b, lane);
            }
        }
        let b = self.used;
        if b == self.blocks.len() {
            self.blocks.push(PairBlock::default());
        }
        self.blocks[b].start(kind);
        self.used += 1;
        (b, self.members[b].start(place))
    }
}

/// The closed pairs, each with its number.
fn closed(base: &Base) -> impl Iterator<Item = (usize, &Contact)> {
    base.contacts.iter().enumerate().filter(|(_, contact)| is_closed(contact))
}

fn is_closed(contact: &Contact) -> bool {
    contact.in_contact() && !contact.is_held()
}
