//! The dense solution over a window (see [`crate::collocation`]): its evaluation, and the contacts along it.

use crate::collocation::{
    AtNodes, Equation, Kernel, MOST_PAIRS, NODES, NodeCount, Nodes, POWERS, SolvedWindow, Tables, dot, fours, nodes,
};
use crate::engine::base::contact::{Contact, Passage};
use crate::engine::system::System;
use crate::numerics::polynomial::{each, larger, value_and_slope};
use crate::numerics::powers::Powers;
use crate::numerics::roots::{self, turning_point};
use crate::structure::{MotionMut, MotionSeries};

/// The node next to a peak has at least this share of it.
const NEARLY: f64 = 0.97;

/// Largest error of a polynomial through the nodes, relative to a peak.
const INTERPOLATED: f64 = 1e-6;

/// The same with which it tells the place of a peak, so that the value there has all digits.
const SHARP: f64 = 1e-7;

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
struct WindowPart {
    /// Times of the nodes since the start of the window, s.
    times: AtNodes,
    /// Weights for integrals over time, s.
    weights: AtNodes,
    /// The nodes in the window's x.
    x: AtNodes,
}

impl Window {
    /// Index of a contact in the window.
    pub fn place(&self, contact: usize) -> Option<usize> {
        self.contacts[..self.equation.pairs].iter().position(|&p| p == contact)
    }

    /// The part until `elapsed`, s, with the nodes of a rule.
    fn part(&self, elapsed: f64, rule: NodeCount) -> WindowPart {
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
    pub fn nodes(&self, elapsed: f64) -> impl Iterator<Item = (f64, f64)> {
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
    fn depth(&self, place: usize, elapsed: f64, moments: &Moments) -> (f64, f64) {
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
fn largest(row: &AtNodes) -> f64 {
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

    /// The same motion, and the (penetration, m, rate, m/s) of each closed pair, by its number, where `pairs` has room for all.
    pub fn evaluate_with_pairs(
        &self,
        system: &System,
        (free, powers): (&MotionSeries, &mut Powers),
        elapsed: f64,
        MotionMut { q, v }: MotionMut,
        pairs: &mut [(f64, f64)],
    ) {
        let Some(response) = &system.impulse_response else {
            return debug_assert!(false, "a window has a response to impulses");
        };
        powers.set(elapsed / free.scale, free.order);
        free.evaluate(powers, q, v);
        let mut room = None;
        let moments = self.moments(elapsed, &mut room);
        for (p, moments) in self.contacts.iter().zip(moments).take(self.equation.closed) {
            response.push(&system.pairs[*p].row.modes, &moments[..self.equation.powers], MotionMut { q, v });
        }
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

impl Contact {
    /// Moves the contact to `elapsed` seconds into a window that began at the time `start`, s: penetration, impulse,
    /// peaks and work.
    pub fn follow_window(&mut self, window: &Window, elapsed: f64, start: f64) {
        let Some(place) = window.place(self.episode.contact) else {
            return debug_assert!(false, "a closed contact is in the window");
        };
        let law = self.branch();
        let solution = &window.solution;
        let nodes = nodes(solution.rule);
        let is_whole = elapsed == solution.length;
        let mut room = None;
        let moments = window.moments(elapsed, &mut room);
        let mut passage = Passage { impulse: moments[place][0], ..Passage::default() };
        let (depth, rate) = (&solution.depth[place], &solution.rate[place]);
        if law.is_damped() {
            let sum = |weights: &AtNodes, d: &AtNodes, v: &AtNodes| dot(weights, &law.damping_powers(d, v));
            passage.work = if is_whole {
                solution.length * sum(&Tables::of(solution.map, solution.rule).weight, depth, rate)
            } else {
                let part = window.part(elapsed, solution.rule);
                let [d, v] = [depth, rate].map(|row| nodes.interpolant(row).at(&part.x));
                sum(&part.weights, &d, &v)
            };
        }
        let end = if is_whole { solution.end[place] } else { window.depth(place, elapsed, moments) };
        let last = if is_whole { 1.0 } else { solution.map.inverse(elapsed / solution.length) };
        let part = FollowedPart { nodes, last, rates: Some((self.rate, end.1)) };
        // Between nodes, penetrations and rates from the moments have more digits than interpolated ones.
        let read = |x: f64| {
            let elapsed = solution.length * solution.map.at(x).0;
            window.depth(place, elapsed, window.moments(elapsed, &mut None))
        };
        let at = |x: f64| (x, if x == last { end } else { read(x) });
        let deepest = part.highest(depth, end.0, self.episode.peak_penetration).map(at);
        passage.deepest = deepest.map(|(_, (peak, _))| peak);
        let strongest = match law.is_damped() {
            // A spring's force is largest where the penetration is.
            false => deepest,
            true => {
                let force = law.value(end.0, end.1);
                FollowedPart { rates: None, ..part }
                    .highest(&solution.force[place], force, self.episode.peak_force)
                    .map(at)
            }
        };
        if let Some((x, (d, v))) = strongest {
            // Interpolated forces have fewer digits, so that the maximum found between nodes may lie below the force at
            // the end.
            let (peak, last_force) = (law.value(d, v), law.value(end.0, end.1));
            let force_of = |(d, v): (f64, f64)| law.value(d, v);
            let (x, peak) = match law.is_damped() {
                true => part.sharpened(&solution.force[place], (x, peak), |x| force_of(read(x))),
                false => (x, peak),
            };
            let (x, peak) = if last_force > peak { (last, last_force) } else { (x, peak) };
            passage.strongest = Some((peak, start + solution.length * solution.map.at(x).0));
        }
        self.book(passage);
        (self.penetration, self.rate) = end;
    }
}

/// The part of a window along which a contact is moved, to find the maximum of one of its quantities.
struct FollowedPart {
    nodes: &'static Nodes,
    /// x of its end.
    last: f64,
    /// Rates of the quantity at its start and end, where they are known.
    rates: Option<(f64, f64)>,
}

impl FollowedPart {
    /// x of the maximum of a quantity with these `values` at the nodes and `end` at the end, if it exceeds `known`. The
    /// start is no candidate.
    fn highest(&self, values: &AtNodes, end: f64, known: f64) -> Option<f64> {
        let (nodes, last) = (&self.nodes.x[..self.nodes.count], self.last);
        let before = if last < 1.0 { nodes.iter().take_while(|x| **x < last).count() } else { nodes.len() };
        let (mut best, mut at) = (end, before);
        for (i, value) in values.iter().enumerate().take(before) {
            if *value > best {
                (best, at) = (*value, i);
            }
        }
        // Between nodes the quantity is at most slightly larger than at them.
        if best < NEARLY * known || at == 0 && self.rates.is_some_and(|(start, _)| start <= 0.0) {
            return None;
        }
        let x_of = |i: usize| if i < before { nodes[i] } else { last };
        let mut top = (x_of(at), best);
        if at < before || self.rates.is_none_or(|(_, end)| end < 0.0) {
            let low = if at == 0 { 0.0 } else { nodes[at - 1] };
            let found = summit(self.nodes, values, [low, x_of(at + 1)]);
            top = found.filter(|found| found.1 > best).unwrap_or(top);
        }
        (top.1 > known * (1.0 - INTERPOLATED)).then_some(top.0)
    }

    /// (x, value) of the maximum of a quantity near where the polynomial through its `values` at the nodes has one: searched by
    /// true values where the two differ between the nodes. A window resolves the motion; a force that hardly moves the floors
    /// may need more nodes.
    fn sharpened(&self, values: &AtNodes, (x, value): (f64, f64), true_value: impl Fn(f64) -> f64) -> (f64, f64) {
        let nodes = &self.nodes.x[..self.nodes.count];
        let next = nodes.iter().position(|node| *node > x).unwrap_or(nodes.len());
        let low = next.checked_sub(2).map_or(0.0, |i| nodes[i]);
        let high = nodes.get(next + 1).copied().unwrap_or(1.0).min(self.last);
        let interpolant = self.nodes.interpolant(values);
        let is_off = |x: f64| (interpolant.knot(x).value - true_value(x)).abs() > SHARP * value.abs();
        if x >= self.last || !(is_off(0.5 * (low + x)) || is_off(0.5 * (x + high))) {
            return (x, value);
        }
        let (at, peak) = roots::maximum_by_values([low, high], true_value);
        if peak > value { (at, peak) } else { (x, value) }
    }
}

/// (x, value) of the maximum of the polynomial through values at the nodes between two x.
#[multiversion::multiversion(targets("x86_64+avx2"))]
fn summit(nodes: &Nodes, values: &AtNodes, ends: [f64; 2]) -> Option<(f64, f64)> {
    let interpolant = nodes.interpolant(values);
    let read = |x: f64| interpolant.knot(x);
    let ends = ends.map(read);
    let turns = ends[0].slope > 0.0 && ends[1].slope < 0.0;
    turns.then(|| roots::roughly(turning_point(ends, read))).map(|x| (x, read(x).value))
}
