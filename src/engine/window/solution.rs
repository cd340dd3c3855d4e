//! The dense solution over a window (see [`crate::collocation`]), and its evaluation.

use crate::collocation::{
    AtNodes, Equation, Kernel, MOST_PAIRS, NODES, NodeCount, Nodes, POWERS, SolvedWindow, Tables, dot, fours, nodes,
};
use crate::engine::base::contact::Contact;
use crate::engine::follow::NEARLY;
use crate::engine::system::System;
use crate::numerics::polynomial::{each, larger, value_and_slope};
use crate::numerics::powers::Powers;
use crate::structure::{MotionMut, MotionSeries};

/// Integrals of (time left)^k times the force of each pair of a window, k = 0, 1, ..., N s^(k+1).
pub type Moments = [[f64; POWERS]; MOST_PAIRS];

/// A window: the pairs in it, their integral equation and its solution.
#[derive(Clone, Debug, Default)]
pub struct Window {
    /// Numbers of the contacts in the window: the closed ones, then the open ones that are watched.
    pub contacts: [usize; MOST_PAIRS],
    /// The integral equation of the penetrations.
    pub equation: Equation,
    /// Penetrations, rates and forces at the nodes.
    pub solution: SolvedWindow,
    /// Bounds on the magnitudes of the forces, N, also between the nodes.
    pub greatest: [f64; MOST_PAIRS],
    /// Moments of the forces over the whole window.
    whole: Moments,
}

/// The part of a window up to some time, with quadrature nodes of its own.
pub(super) struct WindowPart {
    /// Times of the nodes since the start of the window, s.
    pub times: AtNodes,
    /// Weights for integrals over time, s.
    pub weights: AtNodes,
    /// The nodes in the window's x.
    pub x: AtNodes,
}

impl Window {
    /// Index of a contact in the window.
    pub fn place(&self, contact: usize) -> Option<usize> {
        self.contacts[..self.equation.pairs].iter().position(|&p| p == contact)
    }

    /// The part until `elapsed`, s, with the nodes of a rule.
    pub(super) fn part(&self, elapsed: f64, rule: NodeCount) -> WindowPart {
        let SolvedWindow { map, length, .. } = self.solution;
        let end = map.inverse((elapsed / length).min(1.0));
        let nodes = nodes(rule);
        let x = nodes.x.map(|x| x * end);
        let mut part = WindowPart { times: [0.0; NODES], weights: [0.0; NODES], x };
        for (i, (x, weight)) in x.iter().zip(&nodes.weight).enumerate().take(nodes.count) {
            let (theta, rate) = map.at(*x);
            part.times[i] = length * theta;
            part.weights[i] = length * rate * (end * weight);
        }
        part
    }

    /// Times, s, and weights, s, of a quadrature until `elapsed` for the whole motion. It may be faster than the
    /// contact's, for which the window's own nodes are made: these would be too few.
    pub fn nodes(&self, elapsed: f64) -> impl Iterator<Item = (f64, f64)> + use<> {
        let part = self.part(elapsed, NodeCount::Sixteen);
        part.times.into_iter().zip(part.weights)
    }

    /// Works out the moments over the whole window and the bounds on the forces, once a solution has been found.
    pub fn close(&mut self) {
        let Equation { closed, powers, .. } = self.equation;
        let SolvedWindow { map, rule, length, ref force, .. } = self.solution;
        let whole = &Tables::of(map, rule).whole;
        for ((moments, greatest), force) in self.whole.iter_mut().zip(&mut self.greatest).zip(force).take(closed) {
            weigh_whole(&whole[..powers], force, length, moments);
            *greatest = 2.0 * largest(force);
        }
    }

    /// The moments until `elapsed`; worked out in `room` unless they are those of the whole window.
    pub fn moments<'a>(&'a self, elapsed: f64, room: &'a mut Option<Moments>) -> &'a Moments {
        let Equation { closed, powers, .. } = self.equation;
        let SolvedWindow { rule, length, ref force, .. } = self.solution;
        if elapsed == length {
            return &self.whole;
        }
        let part = self.part(elapsed, rule);
        let all = room.insert(Moments::default());
        for (moments, force) in all.iter_mut().zip(force).take(closed) {
            weigh(nodes(rule), force, &part, elapsed, &mut moments[..powers]);
        }
        all
    }

    /// Writes bounds on the magnitudes of the forces, N, one per contact.
    pub fn bound_forces(&self, contacts: &[Contact], out: &mut [f64]) {
        for (place, &p) in self.contacts.iter().enumerate().take(self.equation.closed) {
            // Between nodes a force is at most slightly larger than at them.
            let (d, v) = self.solution.end[place];
            let end = contacts[p].branch().value(d, v);
            out[p] = larger(largest(&self.solution.force[place]) / NEARLY, end.abs());
        }
    }

    /// Penetration, m, and rate, m/s, of a pair in the window, `elapsed` seconds into it, from the moments until then.
    pub(super) fn depth(&self, place: usize, elapsed: f64, moments: &Moments) -> (f64, f64) {
        let Equation { terms, ref free, ref kernels, .. } = self.equation;
        self.depth_of((&free[place][..terms], &kernels[place].each_ref()), elapsed, moments)
    }

    /// Penetration, m, and rate, m/s, of any pair, from the terms of its motion without contact forces and its kernels.
    pub fn depth_of(
        &self,
        (free, kernels): (&[f64], &[&Kernel; MOST_PAIRS]),
        elapsed: f64,
        moments: &Moments,
    ) -> (f64, f64) {
        let Equation { closed, powers, scale, .. } = self.equation;
        let (d, v) = value_and_slope(free, elapsed / scale);
        let (mut taken, mut slowed) = (0.0, 0.0);
        for (kernel, moments) in kernels.iter().zip(moments).take(closed) {
            for k in (1..powers).rev() {
                taken += kernel[k] * moments[k];
                slowed += k as f64 * kernel[k] * moments[k - 1];
            }
        }
        (d - taken, v / scale - slowed)
    }
}

/// The largest magnitude of a number at the nodes.
pub(super) fn largest(row: &AtNodes) -> f64 {
    let sizes = fours(row).iter().fold([0.0; 4], |most, row| each(|i| larger(most[i], row[i].abs())));
    sizes.into_iter().fold(0.0, larger)
}

/// The moments of one force over its window.
#[multiversion::multiversion(targets("x86_64+avx2"))]
fn weigh_whole(whole: &[AtNodes], force: &AtNodes, length: f64, moments: &mut [f64; POWERS]) {
    let mut power = length;
    for (moment, whole) in moments.iter_mut().zip(whole) {
        *moment = power * dot(whole, force);
        power *= length;
    }
}

/// The moments of one force over a part of its window.
#[multiversion::multiversion(targets("x86_64+avx2"))]
fn weigh(nodes: &Nodes, force: &AtNodes, part: &WindowPart, elapsed: f64, moments: &mut [f64]) {
    let (mut pushed, left) = (nodes.interpolant(force).at(&part.x), part.times.map(|time| elapsed - time));
    for (pushed, weight) in pushed.iter_mut().zip(&part.weights) {
        *pushed *= weight;
    }
    for moment in moments {
        *moment = dot(&pushed, &[1.0; NODES]);
        for (pushed, left) in pushed.iter_mut().zip(&left) {
            *pushed *= left;
        }
    }
}

impl Window {
    /// Displacements and velocities, `elapsed` seconds into the window, from the series of the motion without contact
    /// forces; the powers are memory.
    pub fn evaluate(&self, system: &System, free: (&MotionSeries, &mut Powers), elapsed: f64, motion: MotionMut) {
        self.evaluate_with_pairs(system, free, elapsed, motion, &mut []);
    }

    /// The same motion, from the moments until then.
    pub fn evaluate_by(
        &self,
        moments: &Moments,
        system: &System,
        (free, powers): (&MotionSeries, &mut Powers),
        elapsed: f64,
        MotionMut { q, v }: MotionMut,
    ) {
        let Some(response) = &system.impulse_response else {
            return debug_assert!(false, "a window has a response to impulses");
        };
        powers.set(elapsed / free.scale, free.order);
        free.evaluate(powers, q, v);
        for (p, moments) in self.contacts.iter().zip(moments).take(self.equation.closed) {
            response.push(&system.pairs[*p].row.modes, &moments[..self.equation.powers], MotionMut { q, v });
        }
    }

    /// The same motion, and the (penetration, m, rate, m/s) of each closed pair, by its number, where `pairs` has room for all.
    pub fn evaluate_with_pairs(
        &self,
        system: &System,
        (free, powers): (&MotionSeries, &mut Powers),
        elapsed: f64,
        MotionMut { q, v }: MotionMut,
        pairs: &mut [(f64, f64)],
    ) {
        let mut room = None;
        let moments = self.moments(elapsed, &mut room);
        self.evaluate_by(moments, system, (free, powers), elapsed, MotionMut { q, v });
        for (place, &p) in self.contacts.iter().enumerate().take(self.equation.closed) {
            if let Some(pair) = pairs.get_mut(p) {
                *pair = if elapsed == self.solution.length {
                    self.solution.end[place]
                } else {
                    self.depth(place, elapsed, moments)
                };
            }
        }
    }
}
