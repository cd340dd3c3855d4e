//! Reactions between rigid floors that are held together: they keep the relative acceleration 0 until one would be
//! negative.

use crate::engine::base::{Base, Coordinates, touching};
use crate::engine::excitation::inputs::Inputs;
use crate::engine::pairs::touching::Rounding;
use crate::engine::system::System;
use crate::engine::system::buffers::Buffers;
use crate::numerics::complementarity::Complementarity;
use crate::structure::{difference, dot};

impl System {
    /// Removes from the motion the relative displacements and velocities that rounding gives to floors held together.
    pub(crate) fn project_constraints(&self, base: &mut Base, work: &mut Buffers) {
        if !self.rigid.pairs.iter().any(|&p| base.contacts[p].is_held()) {
            return;
        }
        let gaps = &base.rest.gaps;
        self.select_held(base, work);
        for (motion, is_displacement) in [(&mut base.q, true), (&mut base.v, false)] {
            let gap = |p: usize| if is_displacement { gaps[p] } else { 0.0 };
            self.solve_for(&mut work.rigid, |p| dot(&self.pairs[p].row.modes, motion) - gap(p));
            self.push_apart(&work.rigid, motion);
        }
    }

    /// Lists the pairs that are held together in `work.rigid` and makes them all active.
    fn select_held(&self, base: &Base, work: &mut Buffers) {
        work.rigid.clear();
        for (k, _) in self.rigid.pairs.iter().enumerate().filter(|&(_, &p)| base.contacts[p].is_held()) {
            work.rigid.add(k, 0.0, 0.0);
        }
        work.rigid.close_all(&self.rigid.matrix);
    }

    /// Works out the modal accelerations at the base, with all contact forces, in `work.q`, and the reactions in
    /// `work.rigid`. Returns a pair that is held together although its floors move apart.
    pub(crate) fn solve_reactions(&self, base: &Base, inputs: &Inputs, work: &mut Buffers) -> Option<usize> {
        self.load(base, inputs, &mut work.load, &mut work.slope);
        self.solve_reactions_to_load(base, work)
    }

    /// The same under the inputs as they are now: the ground's acceleration may have been set since the base began its
    /// segment, which matters where the ground has a share in a contact.
    pub(crate) fn solve_present_reactions(&self, base: &Base, inputs: &Inputs, work: &mut Buffers) {
        self.load(base, inputs, &mut work.load, &mut work.slope);
        let has_ground = |p: &usize| self.pairs[*p].row.share_of_ground != 0.0;
        if self.ground.is_none() && self.rigid.pairs.iter().any(has_ground) {
            let change = inputs.ground_acceleration.at(base.time()) - base.segment.acceleration_at(base.elapsed);
            for (load, share) in work.load.iter_mut().zip(self.participation(base.coordinates)) {
                *load -= share * change;
            }
        }
        self.solve_reactions_to_load(base, work);
    }

    fn solve_reactions_to_load(&self, base: &Base, work: &mut Buffers) -> Option<usize> {
        self.react(base, work, |k| base.contacts[self.rigid.pairs[k]].is_held());
        let Buffers { rigid, q: acceleration, .. } = work;
        let pairs = rigid.pairs.iter().enumerate().map(|(i, &k)| (i, self.rigid.pairs[k]));
        let decided = pairs.filter(|&(_, p)| !base.contacts[p].undecided);
        decided.filter(|&(i, p)| self.moves_apart(rigid, i, p, acceleration)).map(|(_, p)| p).next()
    }

    /// Which of the rigid pairs that touch and stay would move apart at once, by the load in `work`: `work.parts`.
    pub(super) fn find_parting(&self, base: &Base, work: &mut Buffers) {
        work.parts.clear();
        work.parts.resize(self.rigid.pairs.len(), false);
        let rests = |rounding: &[Rounding], k: usize| {
            let contact = &base.contacts[self.rigid.pairs[k]];
            contact.rate == 0.0 && rounding[k].touches(contact)
        };
        let is_held = |k: usize| base.contacts[self.rigid.pairs[k]].is_held();
        if (0..self.rigid.pairs.len()).all(|k| is_held(k) || !rests(&work.rounding, k)) {
            return;
        }
        let rounding = std::mem::take(&mut work.rounding);
        self.react(base, work, |k| rests(&rounding, k));
        work.rounding = rounding;
        let Buffers { rigid, parts, q: acceleration, .. } = work;
        for (i, &k) in rigid.pairs.iter().enumerate() {
            parts[k] = !is_held(k) && self.moves_apart(rigid, i, self.rigid.pairs[k], acceleration);
        }
    }

    /// Works out, to the load in `work`, the modal accelerations with all contact forces in `work.q` and the reactions in
    /// `work.rigid`, of the rigid pairs that `may_react`.
    fn react(&self, base: &Base, work: &mut Buffers, may_react: impl Fn(usize) -> bool) {
        work.node_q.copy_from_slice(&work.load);
        for (p, contact) in touching(base) {
            if !contact.is_held() {
                self.push_apart_by(p, base.coordinates, contact.present_force(), &mut work.node_q);
            }
        }
        self.structure.accelerate(&base.q, &base.v, &work.node_q, &mut work.q);
        let Buffers { rigid, q: acceleration, .. } = work;
        rigid.clear();
        for (k, &p) in self.rigid.pairs.iter().enumerate().filter(|&(k, _)| may_react(k)) {
            let (pressing, size) = difference(&self.pairs[p].row.modes, acceleration);
            rigid.add(k, pressing, 8.0 * f64::EPSILON * size);
        }
        rigid.push(&self.rigid.matrix);
        self.push_apart(rigid, acceleration);
    }

    /// Whether pair `p`, at place `i` of the problem, has no reaction and moves apart.
    fn moves_apart(&self, rigid: &Complementarity, i: usize, p: usize, acceleration: &[f64]) -> bool {
        rigid.found[i] == 0.0 && dot(&self.pairs[p].row.modes, acceleration) < -rigid.noise[i]
    }

    /// Adds to one power of the modal accelerations the part of the reactions that keeps held floors together; their
    /// terms of that power stay in `rigid.found`.
    pub(crate) fn constrain(&self, rigid: &mut Complementarity, acceleration: &mut [f64]) {
        if rigid.pairs.is_empty() {
            return;
        }
        self.solve_for(rigid, |p| difference(&self.pairs[p].row.modes, acceleration).0);
        self.push_apart(rigid, acceleration);
    }

    /// Solves for the pairs in `rigid` that are active, from the known number of each.
    fn solve_for(&self, rigid: &mut Complementarity, of: impl Fn(usize) -> f64) {
        let known = rigid.pairs.iter().zip(&mut rigid.known);
        known.for_each(|(&k, known)| *known = of(self.rigid.pairs[k]));
        rigid.solve();
    }

    /// Whether the pairs in `rigid`, which are held together, hold the drift of storey `i` as well, so that it does not move
    /// but for rounding: whether its row is made of theirs.
    pub(crate) fn holds_storey(&self, i: usize, rigid: &mut Complementarity) -> bool {
        const LEFT: f64 = 1e-12;
        if rigid.pairs.is_empty() {
            return false;
        }
        let row = &self.elements[i].row.modes;
        self.solve_for(rigid, |p| dot(&self.pairs[p].row.modes, row));
        let whole = dot(row, row);
        let made_of_theirs: f64 = rigid.found.iter().zip(&rigid.known).map(|(share, known)| share * known).sum();
        whole - made_of_theirs <= LEFT * whole
    }

    /// Adds to modal accelerations (velocities, displacements) the effect of the forces (impulses, shifts) in
    /// `rigid.found`.
    pub(crate) fn push_apart(&self, rigid: &Complementarity, modal: &mut [f64]) {
        for (&k, found) in rigid.pairs.iter().zip(&rigid.found) {
            self.pairs[self.rigid.pairs[k]].row.push(Coordinates::Modes, -found, modal);
        }
    }
}
