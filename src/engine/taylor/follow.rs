//! The course of a contact through a Taylor step.

use crate::contact::taylor::{BlockReading, ForceReading, PairBlock};
use crate::engine::base::contact::{Contact, Passage};
use crate::engine::follow::{Course, Nodes, Reached};
use crate::engine::system::System;
use crate::engine::taylor::solution::Solution;
use crate::numerics::polynomial::Coefficients;
use crate::numerics::powers::{Evaluation, Powers};
use crate::numerics::quadrature::TWELVE_POINTS;
use crate::numerics::roots;

/// A step at whose end a pair has less than this share of its first penetration is integrated as one that ends with a
/// release.
const NEARLY_RELEASED: f64 = 0.1;

impl Solution {
    /// Moves the contacts to the end of the step, which began at the time `start`, s.
    pub fn follow(&self, system: &System, contacts: &mut [Contact], start: f64) {
        for ((block, members), reading) in self.closed.packed.all().zip(&self.closed.readings) {
            let end = BlockReached::of(block, *reading, &self.end);
            for (lane, p) in members.lanes() {
                let course = LaneCourse { block, lane, solution: self, end: &end };
                contacts[p].follow(&course, course.reached(&end, self.end.x), start);
            }
        }
        for (terms, &p) in self.reactions.iter().zip(&system.rigid.pairs) {
            if contacts[p].is_held() {
                contacts[p].follow_reaction(terms, self.reaction_order, self.series.scale, start, &self.end);
            }
        }
    }

    /// Moves one contact to the x of the powers.
    pub fn follow_one(&self, system: &System, contact: &mut Contact, start: f64, powers: &Powers) {
        let p = contact.episode.contact;
        if !contact.is_held() {
            let (block, lane) = self.closed.packed.of(p);
            let [end, now] = [&self.end, powers].map(|at| BlockReached::of(block, block.read(at), at));
            let course = LaneCourse { block, lane, solution: self, end: &end };
            return contact.follow(&course, course.reached(&now, powers.x), start);
        }
        if let Some(k) = system.rigid.pairs.iter().position(|&pair| pair == p) {
            contact.follow_reaction(&self.reactions[k], self.reaction_order, self.series.scale, start, powers);
        }
    }

    /// Writes bounds on the magnitudes of the contact forces up to the x of the powers, N.
    pub fn bound_forces(&self, system: &System, contacts: &[Contact], powers: &Powers, out: &mut [f64]) {
        self.closed.bound_forces(contacts, (powers, powers.x == self.end.x), out);
        for (terms, &p) in self.reactions.iter().zip(&system.rigid.pairs) {
            if contacts[p].is_held() {
                let powers = powers.all().0.iter();
                out[p] = terms.iter().zip(powers).take(self.reaction_order + 1).map(|(c, x)| c.abs() * x).sum();
            }
        }
    }
}

/// A block at some x: penetrations, m, forces, N, their derivatives by x, and impulses.
struct BlockReached {
    motion: BlockReading,
    /// Of elastic forces, which are largest where the penetration is, the impulse alone.
    force: ForceReading,
}

impl BlockReached {
    fn of(block: &PairBlock, motion: BlockReading, powers: &Powers) -> BlockReached {
        let force = match block.is_elastic() {
            true => ForceReading { impulse: block.elastic_impulses(powers), ..Default::default() },
            false => block.read_force(powers),
        };
        BlockReached { motion, force }
    }
}

/// One pair of a block in a Taylor step.
struct LaneCourse<'a> {
    block: &'a PairBlock,
    lane: usize,
    solution: &'a Solution,
    /// The block at the end of the step.
    end: &'a BlockReached,
}

impl LaneCourse<'_> {
    /// Where the pair is at x.
    fn reached(&self, BlockReached { motion, force }: &BlockReached, x: f64) -> Reached {
        let (series, lane) = (&self.solution.series, self.lane);
        let (penetration, rate) = (motion.value[lane], motion.slope[lane] / series.time_rate(x));
        Reached { time: series.time(x), penetration, rate, impulse: series.scale * force.impulse[lane] }
    }
}

impl Course<12> for LaneCourse<'_> {
    fn last(&self) -> Reached {
        self.reached(self.end, self.solution.end.x)
    }

    fn near(&self, time: f64) -> [f64; 3] {
        let series = &self.solution.series;
        let x = series.x_at(time);
        let ([[depth], [slope], [half]], per_x) = (self.block.derivatives(self.lane, &[x]), series.time_rate(x));
        let rate = slope / per_x;
        [depth, rate, (2.0 * half - rate * series.time_bend()) / (per_x * per_x)]
    }

    fn nodes(&self, until: &Reached) -> Nodes<12> {
        let series = &self.solution.series;
        let x = if until.time == self.last().time { self.solution.end.x } else { series.x_at(until.time) };
        // Near a release the damping force of a power law goes as a root of the time left: it is smoother in the square
        // root of that time.
        let least = NEARLY_RELEASED * self.block.penetration[0][self.lane];
        let is_released = self.block.has_roots() && until.penetration < least;
        let nodes = TWELVE_POINTS.map(|(node, weight)| match is_released {
            true => (x * (1.0 - (1.0 - node) * (1.0 - node)), x * 2.0 * (1.0 - node) * weight),
            false => (x * node, x * weight),
        });
        let (xs, weights) = (nodes.map(|(x, _)| x), nodes.map(|(x, weight)| weight * series.time_rate(x)));
        let [depths, mut rates] = self.block.derivatives(self.lane, &xs);
        rates.iter_mut().zip(&xs).for_each(|(rate, x)| *rate /= series.time_rate(*x));
        Nodes { count: 12, times: xs.map(|x| series.time(x)), weights, depths, rates }
    }

    fn may_turn(&self, contact: &Contact) -> [bool; 2] {
        let (lane, x) = (self.lane, self.solution.end.x);
        let may_turn = |first: f64, slope: f64, end: Evaluation, known: f64| {
            roots::may_turn_above((first, slope), (end.value, end.slope), (x, end.fourth), known)
        };
        let PairBlock { penetration: [depth, slope, ..], force: [force, force_slope, ..], .. } = self.block;
        [
            may_turn(depth[lane], slope[lane], self.end.motion.of(lane), contact.episode.peak_penetration),
            !self.block.is_elastic()
                && may_turn(force[lane], force_slope[lane], self.end.force.of(lane), contact.episode.peak_force),
        ]
    }
}

impl Contact {
    /// Impulse and peaks of floors that are held together, by the series of their reaction, N, up to the x of the
    /// powers.
    pub fn follow_reaction(&mut self, terms: &Coefficients, order: usize, scale: f64, start: f64, powers: &Powers) {
        let impulse = scale * powers.integral(terms);
        let force = powers.read(terms);
        let copy = |out: &mut Coefficients| {
            *out = *terms;
            order + 1
        };
        let known = self.episode.peak_force;
        let found = roots::maximum_above((terms[0], terms[1]), powers.x, &force, known, copy);
        let strongest = found.map(|(at, peak)| (peak, start + at * scale));
        self.book(Passage { impulse, strongest, ..Passage::default() });
        self.reaction = force.value;
    }
}
