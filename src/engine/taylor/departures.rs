//! Departures, the events of pairs in contact that end a step: release, change of branch, or detachment of floors held
//! together.

use crate::contact::Guard;
use crate::contact::taylor::BlockReading;
use crate::engine::base::Base;
use crate::engine::base::contact::{Contact, ContactPhase};
use crate::engine::base::planned::{Event, First};
use crate::engine::system::System;
use crate::engine::system::buffers::Buffers;
use crate::engine::taylor::closed_pairs::ClosedPairs;
use crate::engine::taylor::solution::Solution;
use crate::numerics::polynomial::{Coefficients, MAX_TERMS};
use crate::numerics::roots;
use crate::structure::{MotionSeries, difference};

/// Rate, as a share of the largest velocity so far, below which it may be rounding.
const ALIKE: f64 = 1e-12;

impl System {
    /// Looks for the first departure up to the end of the step's series.
    pub fn first_leaving(&self, base: &Base, solution: &mut Solution, _: &mut Buffers, first: &mut First) {
        for ((_, members), reading) in solution.closed.packed.all().zip(&solution.closed.readings) {
            for (lane, p) in members.lanes() {
                self.leaving(base, solution, (p, lane), reading, first);
            }
        }
        for &p in self.rigid.pairs.iter().filter(|&&p| base.contacts[p].is_held() && !base.contacts[p].undecided) {
            self.first_detachment(p, solution, first);
        }
    }

    /// Looks for the release or change of branch of one pair in contact, whichever is first.
    fn leaving(
        &self,
        base: &Base,
        solution: &Solution,
        (p, lane): (usize, usize),
        reading: &BlockReading,
        first: &mut First,
    ) {
        let contact = &base.contacts[p];
        // A pair that entered with a velocity of 0, so that its first terms may be rounding, is released only beyond
        // their rounding error.
        let depth = match contact.at_surface && contact.rate == 0.0 {
            true => self.pairs[p].noise(self.size_of(p, base, solution, solution.end.in_time().0)),
            false => 0.0,
        };
        let ends = (solution.end.x, first.until);
        let released = released(&solution.closed, (p, lane), reading, ends, depth);
        let until = released.unwrap_or(first.until);
        let passed = contact.force.guard.and_then(|guard| {
            let noise = self.noise_of_guard(contact, &guard, base, solution);
            self.passes_guard(contact, &guard, solution, (lane, reading), (until, noise))
        });
        match (passed, released) {
            (Some(x), _) if x < until || released.is_none() => first.set(x, Event::Branch(p)),
            (_, Some(x)) => first.set(x, Event::Release(p)),
            _ => {}
        }
    }

    /// The excess, in the guard's unit, by which a guard has to be passed: above 0 where the rate is only rounding, as
    /// otherwise the contact would pass back and forth for ever.
    fn noise_of_guard(&self, contact: &Contact, guard: &Guard, base: &Base, solution: &Solution) -> f64 {
        let rate = contact.rate.abs();
        if rate > ALIKE * base.velocity_scale {
            return 0.0;
        }
        let size = self.size_of(contact.episode.contact, base, solution, solution.end.in_time().1);
        let noise = 2.0 * f64::EPSILON * size / solution.series.scale;
        if rate <= noise { guard.damping.abs() * noise } else { 0.0 }
    }

    /// The x at which a contact passes to the other side of its guard, by more than `noise`.
    fn passes_guard(
        &self,
        contact: &Contact,
        guard: &Guard,
        solution: &Solution,
        (lane, reading): (usize, &BlockReading),
        (until, noise): (f64, f64),
    ) -> Option<f64> {
        let (MotionSeries { scale, time_map, .. }, end) = (&solution.series, solution.end.x);
        let sense = if contact.phase == ContactPhase::Engaged { -1.0 } else { 1.0 };
        let (moved, stretch) = (end * (contact.rate.abs() * scale + reading.turn[lane]), time_map.rate(end));
        // The polynomial is the guard times dt/dx, which is positive and so keeps the sign.
        let at_rest = guard.value(contact.penetration, 0.0).abs() * (stretch - 1.0).abs();
        let change = at_rest
            + guard.stiffness.abs() * moved * stretch.max(1.0)
            + guard.damping.abs() * reading.turn[lane] / scale;
        if sense * guard.value(contact.penetration, contact.rate) + change < 0.0 {
            return None;
        }
        let (block, lane) = solution.closed.packed.of(contact.episode.contact);
        let mut scalar = [0.0; MAX_TERMS];
        let terms = block.copy_penetration(lane, &mut scalar) - 2;
        let (stiffness, rate) = (sense * guard.stiffness, sense * guard.damping / scale);
        let mut previous = 0.0;
        for n in 0..terms {
            let spring = stiffness * scalar[n];
            let constant = if n == 0 { sense * guard.constant - noise } else { 0.0 };
            scalar[n] =
                (spring + rate * (n + 1) as f64 * scalar[n + 1]) + (constant + 2.0 * time_map.curvature * previous);
            previous = spring + constant;
        }
        roots::first_upcrossing(&mut scalar[..terms], until, 0.0)
    }

    /// Rounding error of a pair's relative acceleration in 0..=x of a series, m/s2.
    fn acceleration_noise(&self, p: usize, series: &MotionSeries, x: f64) -> f64 {
        let (mut sum, mut power) = (0.0, 1.0 / (series.scale * series.scale));
        for n in 2..=series.order {
            sum += (n * (n - 1)) as f64 * difference(&self.pairs[p].row.modes, series.term(n)).1 * power;
            power *= x;
        }
        8.0 * f64::EPSILON * sum
    }

    /// Looks for the instant at which the reaction of a held pair falls to 0.
    fn first_detachment(&self, p: usize, solution: &Solution, first: &mut First) {
        let Some(k) = self.rigid.pairs.iter().position(|&pair| pair == p) else {
            return debug_assert!(false, "a held pair is a rigid one");
        };
        let noise = self.acceleration_noise(p, &solution.series, first.until) / self.rigid.matrix[(k, k)];
        let force = &solution.reactions[k][..=solution.reaction_order];
        let pull = &mut [0.0; MAX_TERMS][..force.len()];
        for (pull, force) in pull.iter_mut().zip(force) {
            *pull = -force;
        }
        first.search(pull, noise, Event::Release(p));
    }

    /// Sum of the magnitudes of the terms of a pair's relative motion, m, each times its factor at the end of the step.
    fn size_of(&self, p: usize, base: &Base, solution: &Solution, factors: &Coefficients) -> f64 {
        self.pairs[p].row.project(base.coordinates, &solution.series, factors, &mut [0.0; MAX_TERMS])
    }
}

/// The x at which a penetration returns to 0, or to -`depth`, in 0..=`until`; `reading` is the penetration at `end`.
fn released(
    closed: &ClosedPairs,
    (p, lane): (usize, usize),
    reading: &BlockReading,
    (end, until): (f64, f64),
    depth: f64,
) -> Option<f64> {
    let (block, _) = closed.packed.of(p);
    let first = (-(block.penetration[0][lane] + depth).max(0.0), -block.penetration[1][lane]);
    let last = (-reading.value[lane] - depth, -reading.slope[lane]);
    if roots::upper_bound(first, last, end, reading.fourth[lane]) <= 0.0 {
        return None;
    }
    let mut distance = [0.0; MAX_TERMS];
    let terms = block.copy_penetration(lane, &mut distance);
    // The distance of the floors: positive once the penetration has passed 0 downwards.
    for d in &mut distance[..terms] {
        *d = -*d;
    }
    distance[0] -= depth;
    roots::first_upcrossing(&mut distance[..terms], until, 0.0)
}
