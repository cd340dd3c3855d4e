//! Assignment of the pairs in contact to blocks, by kind of force, and to lanes.

use crate::contact::taylor::{Kind, PairBlock};
use crate::engine::base::Base;
use crate::engine::base::contact::Contact;
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
        self.packed.clear();
        self.assigned.clear();
        self.coordinates = base.coordinates;
        let has_roots = closed(base).any(|(_, contact)| Kind::of(&contact.starting_force()) == Kind::Root);
        for (p, contact) in closed(base) {
            let force = contact.starting_force();
            let kind = Kind::of(&force);
            // A root law without damping includes an undamped power law of the same exponent: so both share a block.
            let joint = if has_roots && force.is_like_root() { Kind::Root } else { kind };
            let (is_of, start) =
                (|block: &PairBlock| block.kind() == joint, |block: &mut PairBlock| block.start(joint));
            let (block, _, lane) = self.packed.add((p, &pairs[p]), base.coordinates, is_of, start);
            block.count = block.count.max(lane + 1);
            self.assigned.push((p, kind));
        }
    }

    /// Enters the closed pairs at their assigned lanes; returns whether the closed pairs are those that were assigned.
    fn start_again(&mut self, base: &Base, scale: f64) -> bool {
        self.at_surface.fill(false);
        let mut assigned = self.assigned.iter();
        for (p, contact) in closed(base) {
            let force = contact.starting_force();
            if assigned.next() != Some(&(p, Kind::of(&force))) {
                return false;
            }
            let (b, lane) = self.packed.place(p);
            self.packed.block(b).add(lane, &force, scale, contact.penetration, contact.rate * scale);
            self.at_surface[b] |= contact.at_surface && contact.rate == 0.0;
        }
        assigned.next().is_none() && self.coordinates == base.coordinates
    }
}

/// The closed pairs, each with its number.
fn closed(base: &Base) -> impl Iterator<Item = (usize, &Contact)> {
    base.contacts.iter().enumerate().filter(|(_, contact)| contact.in_contact() && !contact.is_held())
}
