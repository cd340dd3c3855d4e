//! Impulses between rigid floors (`stereomechanical`), until the rebounds have died out and the floors stay together.
//!
//! An impulse p between two floors changes the approach velocity from V to -e V at once (seed paper, eqs. 1 and 2).
//! Pairs that meet at the same instant are solved together: p >= 0, w = v + e V <= 0, p . w = 0 \[Moreau1988\]. As only
//! approaching pairs take part, each of them dissipates p (1 - e) V / 2 >= 0. The rebounds of a pair that is pressed
//! together follow each other ever faster and end after a finite time. They are followed until the rebound velocity is
//! below rounding; from then on the floors stay together, and a reaction keeps their relative acceleration 0, power by
//! power of the series.
//!
//! Where the impulses of some pairs close others that touch, as between two walls, these hit in turn, at the same instant: round
//! after round on the velocities alone, until no pair that touches approaches by more than rounding. If that takes more than
//! [`MOST_ROUNDS`], what is left is little, and is taken without restitution.

use crate::engine::base::Base;
use crate::engine::base::contact::{Contact, ContactPhase, Episode};
use crate::engine::base::element::Sense;
use crate::engine::excitation::inputs::Inputs;
use crate::engine::pairs::touching::Rounding;
use crate::engine::system::System;
use crate::engine::system::buffers::Buffers;
use crate::numerics::complementarity::Complementarity;

/// Rounds of impulses at one instant: a mass between two others of a million times its mass that lose nothing takes a third.
const MOST_ROUNDS: usize = 10_000;

impl System {
    /// Handles the contact of a rigid pair: an impulse, or where its approach velocity is rounding, the floors stay
    /// together.
    pub(crate) fn resolve_contact(
        &self,
        base: &mut Base,
        first: usize,
        inputs: &Inputs,
        work: &mut Buffers,
        on_episode: &mut dyn FnMut(&Episode),
    ) {
        self.find_rounding(base, inputs, work);
        self.find_rates(base, work);
        let contact = &mut base.contacts[first];
        contact.penetration = 0.0;
        contact.at_surface = true;
        if contact.rate > 0.0 {
            self.apply_impulses(base, work, on_episode);
        } else {
            self.begin_persistent(base, first, work);
        }
    }

    /// Brings the approach velocities of all rigid pairs up to date, without what is rounding.
    fn find_rates(&self, base: &mut Base, work: &Buffers) {
        for (&p, rounding) in self.rigid.pairs.iter().zip(&work.rounding) {
            let contact = &base.contacts[p];
            let is_known = contact.tracked || contact.is_held();
            let rate = if is_known { contact.rate } else { self.pairs[p].row.value(base.coordinates, &base.v) };
            base.contacts[p].rate = if rate.abs() <= rounding.rate { 0.0 } else { rate };
        }
    }

    /// Finds and applies the impulses of all rigid pairs that meet now.
    fn apply_impulses(&self, base: &mut Base, work: &mut Buffers, on_episode: &mut dyn FnMut(&Episode)) {
        for round in 0..=MOST_ROUNDS {
            let returns = round < MOST_ROUNDS;
            if !self.select_touching(base, returns, work) {
                break;
            }
            work.rigid.push(&self.rigid.matrix);
            if work.rigid.found.iter().all(|&impulse| impulse == 0.0) {
                self.end_approach(base, work);
                break;
            }
            self.push_apart(&work.rigid, &mut base.v);
            self.book_round(base, returns, work, on_episode);
        }
        self.update_soft_rates(base);
        self.turn_storeys(base);
    }

    /// Ends the approach of pairs against which there is no impulse: those that depend on pairs that stay, as the last one of a row
    /// without room, approach by rounding alone.
    fn end_approach(&self, base: &mut Base, work: &Buffers) {
        for &k in &work.rigid.pairs {
            let contact = &mut base.contacts[self.rigid.pairs[k]];
            contact.rate = contact.rate.min(0.0);
        }
    }

    /// Lists in `work.rigid` the pairs that touch and approach, or stay: with restitution, or if not, also those that part.
    /// Returns whether any approaches.
    fn select_touching(&self, base: &Base, returns: bool, work: &mut Buffers) -> bool {
        self.find_parting(base, work);
        let Buffers { rigid, rounding, parts, .. } = work;
        rigid.clear();
        let mut approaches = false;
        for (k, (&p, rounding)) in self.rigid.pairs.iter().zip(&*rounding).enumerate() {
            let contact = &base.contacts[p];
            let is_closed = contact.rate > 0.0 || contact.rate == 0.0 && !parts[k];
            if rounding.touches(contact) && (is_closed || !returns) {
                approaches |= contact.rate > 0.0;
                rigid.add(k, (1.0 + self.returned_share(contact, p, returns, rounding)) * contact.rate, 0.0);
            }
        }
        approaches
    }

    /// Records the impulses found, and what they have changed of the approach velocities of the other pairs.
    fn book_round(&self, base: &mut Base, returns: bool, work: &Buffers, on_episode: &mut dyn FnMut(&Episode)) {
        let Buffers { rigid, rounding, .. } = work;
        for (k, (&p, rounding)) in self.rigid.pairs.iter().zip(rounding).enumerate() {
            let taken = rigid.pairs.iter().position(|&other| other == k).filter(|&i| rigid.found[i] > 0.0);
            let Some(i) = taken else {
                self.change_rate(base, k, rigid, rounding, on_episode);
                continue;
            };
            match base.contacts[p].is_held() {
                true => base.contacts[p].pass_on(rigid.found[i]),
                false => {
                    let restitution = self.returned_share(&base.contacts[p], p, returns, rounding);
                    book_impulse(base, p, restitution, rigid.found[i], on_episode);
                }
            }
        }
    }

    /// Takes from the rate of rigid pair `k` what the impulses of others have changed; floors that were held and now part are
    /// released.
    fn change_rate(
        &self,
        base: &mut Base,
        k: usize,
        rigid: &Complementarity,
        rounding: &Rounding,
        on_episode: &mut dyn FnMut(&Episode),
    ) {
        let p = self.rigid.pairs[k];
        let change: f64 =
            rigid.pairs.iter().zip(&rigid.found).map(|(&other, impulse)| self.rigid.matrix[(k, other)] * impulse).sum();
        let contact = &mut base.contacts[p];
        let rate = contact.rate - change;
        contact.rate = if rate.abs() <= rounding.rate { 0.0 } else { rate };
        // The floors' velocities have rounding of what they were before, which may be far more than what they are now.
        contact.tracked |= rounding.touches(contact) && !contact.is_held();
        if contact.is_held() && contact.rate < 0.0 {
            base.release(p, on_episode);
        }
    }

    /// The coefficient of restitution of an impact of pair `p` now; 0 where the rebound velocity would be rounding, or nothing
    /// `returns`.
    fn returned_share(&self, contact: &Contact, p: usize, returns: bool, rounding: &Rounding) -> f64 {
        let restitution = self.pairs[p].law.restitution;
        if returns && restitution * contact.rate > rounding.rate { restitution } else { 0.0 }
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

/// Records an impulse, N s, as an episode without duration.
fn book_impulse(base: &mut Base, p: usize, restitution: f64, impulse: f64, on_episode: &mut dyn FnMut(&Episode)) {
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
