//! Rigid contacts (`stereomechanical`): impulses, rebounds that die out, floors held together by a reaction.
//!
//! An impulse p between two floors takes the approach velocity V to -e V at once (seed paper, eqs. 1 and 2). Pairs that
//! meet at the same instant are solved together, p >= 0, w = v + e V <= 0, p . w = 0 \[Moreau1988\]: since only pairs
//! that approach take part, each loses p (1 - e) V / 2 >= 0. The rebounds of a pair that is pressed together follow each
//! other ever faster and end after a finite time, which the engine follows until what returns is below rounding: there
//! the floors stay together, and the reaction is what keeps their relative acceleration 0, power by power of the series.

use crate::engine::base::contact::Episode;
use crate::engine::base::contact::{Contact, Phase};
use crate::engine::base::planned::{Carried, Event};
use crate::engine::base::touching;
use crate::engine::base::{Base, Coordinates};
use crate::engine::excitation::inputs::Inputs;
use crate::engine::pairs::pair::Pair;
use crate::engine::system::System;
use crate::engine::system::buffers::Buffers;
use crate::engine::taylor::solution::Solution;

use crate::numerics::complementarity::Complementarity;
use crate::numerics::powers::Powers;
use crate::numerics::roots;
use crate::structure::{MotionSeries, difference, dot};

/// A velocity below this share of the floors' velocities that it is the difference of is none: some hundred roundings.
const STILL: f64 = 3e-14;

/// A rigid pair is carried by its own increments up to this many rounding errors of its penetration from the surface.
const CLOSE: f64 = 1e6;

/// Share of the time left for which floors are held together that rounding cannot tell from free ones.
const SHORT_WHILE: f64 = 1e-3;

impl System {
    /// A rigid pair meets: an impulse, or where it has no speed left the floors stay together.
    pub fn meet(&self, base: &mut Base, first: usize, work: &mut Buffers, on_episode: &mut dyn FnMut(&Episode)) {
        let (approach, still) = self.approach(base, first);
        let contact = &mut base.contacts[first];
        contact.penetration = 0.0;
        contact.at_surface = true;
        if approach > still {
            self.collide(base, first, work, on_episode);
        } else {
            self.join(base, first, work);
        }
    }

    /// m/s, the rate of a rigid pair, and what is none but for rounding.
    fn approach(&self, base: &Base, p: usize) -> (f64, f64) {
        let contact = &base.contacts[p];
        let (rate, size) = self.pairs[p].difference(base.coordinates, &base.v);
        let rate = if contact.carried || contact.is_held() { contact.rate } else { rate };
        (rate, STILL * size)
    }

    /// The impulses of all rigid pairs that meet now, when one does.
    fn collide(&self, base: &mut Base, first: usize, work: &mut Buffers, on_episode: &mut dyn FnMut(&Episode)) {
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
        let shares = rigid.pairs.iter().map(|&k| self.returned_share(base, self.rigid.pairs[k]));
        rigid.known.clear();
        rigid.known.extend(shares);
        self.push_apart(rigid, &mut base.v);
        for (k, &p) in self.rigid.pairs.iter().enumerate() {
            let taken = rigid.pairs.iter().position(|&other| other == k).filter(|&i| rigid.found[i] > 0.0);
            match taken {
                Some(i) => self.book_impulse(base, p, rigid.known[i], rigid.found[i], on_episode),
                None => {
                    let change = |(&other, impulse): (&usize, &f64)| self.rigid.matrix[(k, other)] * impulse;
                    let change: f64 = rigid.pairs.iter().zip(&rigid.found).map(change).sum();
                    let contact = &mut base.contacts[p];
                    contact.rate -= change;
                    if contact.is_held() && change > 0.0 {
                        base.release(p, on_episode);
                    }
                }
            }
        }
        self.update_soft_rates(base);
    }

    /// Whether a rigid pair stands at the surface now.
    fn is_closed(&self, base: &Base, p: usize) -> bool {
        let (contact, pair) = (&base.contacts[p], &self.pairs[p]);
        let noise = if contact.carried { 0.0 } else { pair.noise(pair.difference(base.coordinates, &base.q).1) };
        contact.is_held() || contact.at_surface || contact.penetration >= -noise
    }

    /// The restitution of an impact now: none where what would return is rounding.
    fn returned_share(&self, base: &Base, p: usize) -> f64 {
        let restitution = self.pairs[p].law.restitution;
        let (rate, still) = self.approach(base, p);
        if restitution * rate > still { restitution } else { 0.0 }
    }

    /// An impulse as an episode without duration.
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
        let approach = contact.rate;
        let lost = 0.5 * impulse * (1.0 - restitution) * approach;
        contact.rate = -restitution * approach;
        contact.penetration = 0.0;
        contact.at_surface = true;
        contact.carried = true;
        contact.impacts += 1;
        contact.impulse += impulse;
        contact.work += lost;
        contact.episode = Episode {
            contact: p,
            start: time,
            end: Some(time),
            approach_velocity: approach,
            separation_velocity: restitution * approach,
            peak_time: time,
            impulse,
            dissipated_energy: lost,
            ..Episode::default()
        };
        base.impacts += 1;
        on_episode(&base.contacts[p].episode);
    }

    /// An impulse changes the rate of other pairs of the same floors at once, and with it their force.
    fn update_soft_rates(&self, base: &mut Base) {
        for (p, contact) in base.contacts.iter_mut().enumerate().filter(|&(p, _)| !self.pairs[p].law.is_rigid()) {
            contact.rate = self.pairs[p].difference(base.coordinates, &base.v).0;
            let engaged = contact.force.is_engaged(contact.penetration, contact.rate);
            if contact.in_contact() && engaged != (contact.phase == Phase::Engaged) {
                contact.change_branch();
            }
        }
    }

    /// Two rigid floors stay together from now on.
    fn join(&self, base: &mut Base, p: usize, work: &mut Buffers) {
        let time = base.time();
        let contact = &mut base.contacts[p];
        contact.rate = 0.0;
        contact.begin(time, 0.0);
        contact.phase = Phase::Held;
        contact.reaction = 0.0;
        contact.carried = false;
        contact.undecided = contact.let_go;
        contact.let_go = false;
        base.impacts += 1;
        base.last_length = 0.0;
        self.keep_together(base, work);
    }

    /// Takes out of the motion what rounding has moved floors apart that are held together.
    pub fn keep_together(&self, base: &mut Base, work: &mut Buffers) {
        if !self.rigid.pairs.iter().any(|&p| base.contacts[p].is_held()) {
            return;
        }
        let gap = |p: usize| self.pairs[p].gap;
        self.select_held(base, work);
        for (motion, is_displacement) in [(&mut base.q, true), (&mut base.v, false)] {
            let rigid = &mut work.rigid;
            for (&k, known) in rigid.pairs.iter().zip(&mut rigid.known) {
                let p = self.rigid.pairs[k];
                *known = dot(&self.pairs[p].row, motion) - if is_displacement { gap(p) } else { 0.0 };
            }
            rigid.solve();
            self.push_apart(rigid, motion);
        }
    }

    /// Lists the pairs that are held together and makes them all active.
    fn select_held(&self, base: &Base, work: &mut Buffers) {
        work.rigid.clear();
        for (k, _) in self.rigid.pairs.iter().enumerate().filter(|&(_, &p)| base.contacts[p].is_held()) {
            work.rigid.add(k, 0.0, 0.0);
        }
        work.rigid.close_all(&self.rigid.matrix);
    }

    /// The modal accelerations at the base, in `work.q`, with every contact force; the reactions stay in `work.rigid`.
    /// Returns a pair that is held together but moves apart.
    pub fn balance(&self, base: &Base, inputs: &Inputs, work: &mut Buffers) -> Option<usize> {
        self.load(base, inputs, &mut work.load, &mut work.slope);
        work.node_q.copy_from_slice(&work.load);
        for (p, contact) in touching(base) {
            if !contact.is_held() {
                self.push_apart_by(p, base.coordinates, contact.present_force(), &mut work.node_q);
            }
        }
        self.structure.accelerate(&base.q, &base.v, &work.node_q, &mut work.q);
        let Buffers { rigid, q: acceleration, .. } = work;
        rigid.clear();
        for (k, &p) in self.rigid.pairs.iter().enumerate().filter(|&(_, &p)| base.contacts[p].is_held()) {
            let (pressing, size) = difference(&self.pairs[p].row, acceleration);
            rigid.add(k, pressing, 8.0 * f64::EPSILON * size);
        }
        rigid.push(&self.rigid.matrix);
        self.push_apart(rigid, acceleration);
        let apart = (0..rigid.pairs.len()).find(|&i| {
            let p = self.rigid.pairs[rigid.pairs[i]];
            let moves_apart = dot(&self.pairs[p].row, acceleration) < -rigid.noise[i];
            rigid.found[i] == 0.0 && moves_apart && !base.contacts[p].undecided
        })?;
        Some(self.rigid.pairs[rigid.pairs[apart]])
    }

    /// Keeps floors together that are held: adds the reactions' part to the modal accelerations of one power. The
    /// reactions stay in `rigid.found`.
    pub fn hold(&self, rigid: &mut Complementarity, acceleration: &mut [f64]) {
        if rigid.pairs.is_empty() {
            return;
        }
        for (&k, known) in rigid.pairs.iter().zip(&mut rigid.known) {
            *known = difference(&self.pairs[self.rigid.pairs[k]].row, acceleration).0;
        }
        rigid.solve();
        self.push_apart(rigid, acceleration);
    }

    /// What the forces (impulses, shifts) that have been found do to the modal accelerations (velocities, displacements).
    fn push_apart(&self, rigid: &Complementarity, modal: &mut [f64]) {
        for (&k, found) in rigid.pairs.iter().zip(&rigid.found) {
            for (modal, row) in modal.iter_mut().zip(&self.pairs[self.rigid.pairs[k]].row) {
                *modal -= row * found;
            }
        }
    }

    /// How long a step may be, s, so that the next bounce of every pair near the surface is a good part of it; with the
    /// modal accelerations at the base.
    pub fn bounce_horizon(&self, base: &Base, acceleration: &[f64]) -> f64 {
        let apart = base.contacts.iter().zip(&self.pairs).filter(|(contact, _)| contact.carried);
        let bounce = |(contact, pair): (&Contact, &Pair)| {
            4.0 * time_to_surface(contact.penetration, contact.rate, dot(&pair.row, acceleration))
        };
        apart.map(bounce).fold(f64::INFINITY, f64::min)
    }

    /// How long a step may be near rigid contacts, of the `remaining` time, s, and whether it is cut; or the release that
    /// comes first. Leaves the pairs that are held together in `work.rigid`, all active.
    pub fn time_for_rigid_pairs(
        &self,
        base: &Base,
        inputs: &Inputs,
        work: &mut Buffers,
        remaining: f64,
    ) -> Result<(f64, bool), Event> {
        if !self.has_close_rigid_pair(base) {
            work.rigid.clear();
            return Ok((remaining, false));
        }
        if let Some(p) = self.balance(base, inputs, work) {
            return Err(Event::Release(p));
        }
        work.rigid.close_all(&self.rigid.matrix);
        let mut time = self.bounce_horizon(base, &work.q);
        if base.contacts.iter().any(|contact| contact.undecided) {
            time = time.min(SHORT_WHILE * remaining);
        }
        Ok((remaining.min(time), time < remaining))
    }

    /// Whether rigid floors are held together, or are about to meet again.
    pub fn has_close_rigid_pair(&self, base: &Base) -> bool {
        self.rigid.pairs.iter().any(|&p| base.contacts[p].is_held() || base.contacts[p].carried)
    }

    /// Where the pairs that are carried get to at the x of the powers of a series in time.
    pub fn carry(
        &self,
        base: &Base,
        series: &MotionSeries,
        powers: &Powers,
        scalar: &mut [f64],
        carried: &mut Carried,
    ) {
        carried.fill(None);
        for &p in &self.rigid.pairs {
            let (contact, pair) = (&base.contacts[p], &self.pairs[p]);
            carried[p] = contact.carried.then(|| {
                let terms = &mut scalar[..=series.order];
                let noise = pair.noise(self.project(p, base.coordinates, series, powers.in_time().0, terms));
                contact.begin_flight(terms, series.scale, noise);
                let (penetration, slope) = crate::numerics::polynomial::value_and_slope(terms, powers.x);
                (penetration, slope / series.scale)
            });
        }
    }

    /// Whether a pair at this penetration, m, is still to be carried.
    pub fn is_close(&self, p: usize, penetration: f64, coordinates: Coordinates, q: &[f64]) -> bool {
        penetration > -CLOSE * self.pairs[p].noise(self.pairs[p].difference(coordinates, q).1)
    }

    /// m/s2, rounding error of a pair's relative acceleration in 0..=x of a series.
    fn acceleration_noise(&self, p: usize, series: &MotionSeries, x: f64) -> f64 {
        let (mut sum, mut power) = (0.0, 1.0 / (series.scale * series.scale));
        for n in 2..=series.order {
            sum += (n * (n - 1)) as f64 * difference(&self.pairs[p].row, series.term(n)).1 * power;
            power *= x;
        }
        8.0 * f64::EPSILON * sum
    }

    /// Where the reaction of a pair that is held together falls to 0 in 0..=end of its series.
    pub fn letting_go(&self, p: usize, solution: &Solution, work: &mut Buffers, end: f64) -> Option<(f64, Event)> {
        let k = self.rigid.pairs.iter().position(|&pair| pair == p)?;
        let noise = self.acceleration_noise(p, &solution.series, end) / self.rigid.matrix[(k, k)];
        let force = &solution.reactions[k][..=solution.reaction_order];
        let pull = &mut work.scalar[..force.len()];
        for (pull, force) in pull.iter_mut().zip(force) {
            *pull = -force;
        }
        roots::first_rise(pull, end, noise).map(|x| (x, Event::Release(p)))
    }
}

/// s until d + v t + a t^2 / 2 is 0 for t > 0, from d <= 0.
fn time_to_surface(d: f64, v: f64, a: f64) -> f64 {
    let square = v * v - 2.0 * a * d;
    let time = match () {
        _ if square < 0.0 => f64::INFINITY,
        _ if v > 0.0 => -2.0 * d / (v + square.sqrt()),
        _ if a > 0.0 => (square.sqrt() - v) / a,
        _ => f64::INFINITY,
    };
    if time > 0.0 { time } else { f64::INFINITY }
}
