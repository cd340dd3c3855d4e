//! Impulses between rigid floors (`stereomechanical`), until the rebounds have died out and the floors stay together.
//!
//! An impulse p between two floors changes the approach velocity from V to -e V at once (seed paper, eqs. 1 and 2).
//! Pairs that meet at the same instant are solved together: p >= 0, w = v + e V <= 0, p . w = 0 \[Moreau1988\]. As only
//! approaching pairs take part, each of them dissipates p (1 - e) V / 2 >= 0. The rebounds of a pair that is pressed
//! together follow each other ever faster and end after a finite time. They are followed until the rebound velocity is
//! below rounding; from then on the floors stay together, and a reaction keeps their relative acceleration 0, power by
//! power of the series.
//!
//! Where an impulse at one pair closes another, as between two walls, the pairs of a floor that is squeezed hit in turn at
//! intervals that shrink faster than their velocities. Infinitely many impulses leave no velocity in any of them, in no
//! time: pairs that are closed to rounding and would close each other are solved together without restitution.

use crate::engine::base::Base;
use crate::engine::base::contact::{ContactPhase, Episode};
use crate::engine::base::element::Sense;
use crate::engine::system::System;
use crate::engine::system::buffers::Buffers;
use crate::numerics::complementarity::Complementarity;

/// A relative velocity below this share of the floors' velocities is rounding: some hundred rounding errors.
const STILL: f64 = 3e-14;

impl System {
    /// Handles the contact of a rigid pair: an impulse, or where its approach velocity is rounding, the floors stay
    /// together.
    pub(crate) fn resolve_contact(
        &self,
        base: &mut Base,
        first: usize,
        work: &mut Buffers,
        on_episode: &mut dyn FnMut(&Episode),
    ) {
        let (approach, still) = self.approach(base, first);
        let contact = &mut base.contacts[first];
        contact.penetration = 0.0;
        contact.at_surface = true;
        if approach > still {
            self.apply_impulses(base, first, work, on_episode);
        } else {
            self.begin_persistent(base, first, work);
        }
    }

    /// (rate, noise): the approach velocity of a rigid pair and its rounding error, m/s.
    fn approach(&self, base: &Base, p: usize) -> (f64, f64) {
        let contact = &base.contacts[p];
        let (rate, size) = self.pairs[p].row.difference(base.coordinates, &base.v);
        let rate = if contact.tracked || contact.is_held() { contact.rate } else { rate };
        (rate, STILL * size)
    }

    /// Finds and applies the impulses of all rigid pairs that meet now, given that pair `first` does.
    fn apply_impulses(&self, base: &mut Base, first: usize, work: &mut Buffers, on_episode: &mut dyn FnMut(&Episode)) {
        let rigid = &mut work.rigid;
        rigid.clear();
        for (k, &p) in self.rigid.pairs.iter().enumerate() {
            let (rate, still) = self.approach(base, p);
            let rate = if p != first && rate.abs() <= still { 0.0 } else { rate };
            base.contacts[p].rate = rate;
            if rate >= 0.0 && self.is_closed(base, p) {
                rigid.add(k, (1.0 + self.returned_share(base, p)) * rate, 0.0);
            }
        }
        rigid.push(&self.rigid.matrix);
        let is_squeezed = self.close_squeezed(base, rigid);
        let share = |&k: &usize| if is_squeezed { 0.0 } else { self.returned_share(base, self.rigid.pairs[k]) };
        let shares = rigid.pairs.iter().map(share);
        rigid.known.clear();
        rigid.known.extend(shares);
        self.push_apart(rigid, &mut base.v);
        for (k, &p) in self.rigid.pairs.iter().enumerate() {
            let taken = rigid.pairs.iter().position(|&other| other == k).filter(|&i| rigid.found[i] > 0.0);
            match taken {
                Some(i) if base.contacts[p].is_held() => base.contacts[p].pass_on(rigid.found[i]),
                Some(i) => self.book_impulse(base, p, rigid.known[i], rigid.found[i], on_episode),
                None => {
                    let change = self.change_of_rate(rigid, k);
                    let contact = &mut base.contacts[p];
                    contact.rate -= change;
                    if contact.is_held() && change > 0.0 {
                        base.release(p, on_episode);
                    }
                }
            }
        }
        self.update_soft_rates(base);
        self.turn_storeys(base);
    }

    /// Storeys whose drift an impulse has turned back are elastic again.
    fn turn_storeys(&self, base: &mut Base) {
        let velocities = &base.v;
        for (of, element) in self.elements.iter().zip(&mut base.elements) {
            let goes_back = |sense: &Sense| sense.sign() * of.row.difference(base.coordinates, velocities).0 < 0.0;
            if element.yields.as_ref().is_some_and(goes_back) {
                element.yields = None;
            }
            element.turned = None;
        }
    }

    /// Where the impulses found would close pairs that are apart by rounding only, finds those of all such pairs together,
    /// without restitution; returns whether there are any.
    fn close_squeezed(&self, base: &Base, rigid: &mut Complementarity) -> bool {
        let touches = |p: usize| {
            let contact = &base.contacts[p];
            contact.tracked && contact.penetration >= -self.noise_now(base, p)
        };
        let is_closed_by_others = |k: usize| {
            let p = self.rigid.pairs[k];
            let (rate, still) = self.approach(base, p);
            rate < 0.0 && rate - self.change_of_rate(rigid, k) > still && touches(p)
        };
        let count = self.rigid.pairs.len();
        if !(0..count).any(|k| !rigid.pairs.contains(&k) && is_closed_by_others(k)) {
            return false;
        }
        rigid.clear();
        for (k, &p) in self.rigid.pairs.iter().enumerate().filter(|&(_, &p)| self.is_closed(base, p) || touches(p)) {
            rigid.add(k, base.contacts[p].rate, 0.0);
        }
        rigid.push(&self.rigid.matrix);
        true
    }

    /// What the impulses found take from the rate of rigid pair `k`, m/s.
    fn change_of_rate(&self, rigid: &Complementarity, k: usize) -> f64 {
        rigid.pairs.iter().zip(&rigid.found).map(|(&other, impulse)| self.rigid.matrix[(k, other)] * impulse).sum()
    }

    /// Rounding error of a penetration now, m.
    fn noise_now(&self, base: &Base, p: usize) -> f64 {
        self.pairs[p].noise(self.pairs[p].row.difference(base.coordinates, &base.q).1)
    }

    /// Whether the floors of a rigid pair touch now.
    fn is_closed(&self, base: &Base, p: usize) -> bool {
        let contact = &base.contacts[p];
        let noise = if contact.tracked { 0.0 } else { self.noise_now(base, p) };
        contact.is_held() || contact.at_surface || contact.penetration >= -noise
    }

    /// The coefficient of restitution of an impact now; 0 where the rebound velocity would be rounding.
    fn returned_share(&self, base: &Base, p: usize) -> f64 {
        let restitution = self.pairs[p].law.restitution;
        let (rate, still) = self.approach(base, p);
        if restitution * rate > still { restitution } else { 0.0 }
    }

    /// Records an impulse, N s, as an episode without duration.
    fn book_impulse(
        &self,
        base: &mut Base,
        p: usize,
        restitution: f64,
        impulse: f64,
        on_episode: &mut dyn FnMut(&Episode),
    ) {
        let time = base.time();
        let contact = &mut base.contacts[p];
        // A pair that is squeezed may have been on its way apart.
        let approach = contact.rate;
        let lost = 0.5 * impulse * (1.0 - restitution) * approach;
        contact.rate = -restitution * approach;
        contact.penetration = 0.0;
        contact.at_surface = true;
        contact.tracked = true;
        contact.impacts += 1;
        contact.impulse += impulse;
        contact.work += lost;
        contact.episode = Episode {
            contact: p,
            start: time,
            end: Some(time),
            approach_velocity: approach.max(0.0),
            separation_velocity: restitution * approach.max(0.0),
            peak_time: time,
            impulse,
            dissipated_energy: lost,
            ..Episode::default()
        };
        base.impacts += 1;
        on_episode(&base.contacts[p].episode);
    }

    /// Updates the rates of the soft pairs: an impulse changes that of every pair with a common floor at once.
    fn update_soft_rates(&self, base: &mut Base) {
        for (p, contact) in base.contacts.iter_mut().enumerate().filter(|&(p, _)| !self.pairs[p].law.is_rigid()) {
            contact.rate = self.pairs[p].row.difference(base.coordinates, &base.v).0;
            let engaged = contact.force.is_engaged(contact.penetration, contact.rate);
            if contact.in_contact() && engaged != (contact.phase == ContactPhase::Engaged) {
                contact.change_branch();
            }
        }
    }

    /// Holds the two floors of a rigid pair together from now on.
    fn begin_persistent(&self, base: &mut Base, p: usize, work: &mut Buffers) {
        let time = base.time();
        let contact = &mut base.contacts[p];
        contact.rate = 0.0;
        contact.begin(time, 0.0);
        contact.phase = ContactPhase::Held;
        contact.reaction = 0.0;
        contact.tracked = false;
        contact.undecided = contact.let_go;
        contact.let_go = false;
        base.impacts += 1;
        base.last_length = 0.0;
        self.project_constraints(base, work);
    }
}
