//! What ends a step in contact: a release, a change of branch, an entry of another pair.

use super::closed_pairs::ClosedPairs;
use super::model::Model;
use super::roots;
use super::state::*;
use crate::contact::Guard;
use crate::contact::taylor::BlockReading;
use crate::polynomial::{Coefficients, Powers};
use crate::structure::MotionSeries;

/// Share of the velocities so far below which a rate may be rounding.
const ALIKE: f64 = 1e-12;

impl Model {
    /// The first event of a pair in contact up to the end of the step's series.
    pub(super) fn first_leaving(&self, base: &Base, step: &Step, work: &mut Workspace) -> Option<(f64, Event)> {
        let mut first = None;
        for block in 0..step.closed.len() {
            let stays = step.closed.stays_closed(block, step.end.x);
            for (lane, p) in step.closed.pairs_of(block) {
                if !stays[lane] || base.contacts[p].force.guard.is_some() {
                    let reading = step.closed.reading(block);
                    let place = (p, lane, stays[lane]);
                    first = self.leaving(base, step, work, place, reading, until(first, step)).or(first);
                }
            }
        }
        for &p in self.rigid.pairs.iter().filter(|&&p| base.contacts[p].is_held() && !base.contacts[p].undecided) {
            first = self.letting_go(p, step, work, until(first, step)).or(first);
        }
        first
    }

    /// Release or change of branch of a pair in contact; of one that certainly stays closed, of its branch only.
    fn leaving(
        &self,
        base: &Base,
        step: &Step,
        work: &mut Workspace,
        (p, lane, stays): (usize, usize, bool),
        reading: &BlockReading,
        until: f64,
    ) -> Option<(f64, Event)> {
        let contact = &base.contacts[p];
        // One that has entered without any speed, whose first terms may be rounding, leaves at that depth.
        let depth = if contact.at_surface && contact.rate == 0.0 { self.noise_of(p, base, step, work) } else { 0.0 };
        let released = match stays {
            true => None,
            false => released(&step.closed, (p, lane), reading, (step.end.x, until), depth, &mut work.scalar),
        };
        let first = released.map(|x| (x, Event::Release(p)));
        let Some(guard) = contact.force.guard else { return first };
        let until = released.unwrap_or(until);
        let noise = self.noise_of_guard(contact, &guard, base, step, work);
        match self.passes_guard(contact, &guard, step, (lane, reading), (until, noise), &mut work.scalar) {
            Some(x) if x < until || first.is_none() => Some((x, Event::Branch(p))),
            _ => first,
        }
    }

    /// By how much a guard has to be passed, in its unit: by more than rounding where the floors move alike but for that, else
    /// the contact would pass back and forth for ever.
    fn noise_of_guard(&self, contact: &Contact, guard: &Guard, base: &Base, step: &Step, work: &mut Workspace) -> f64 {
        let rate = contact.rate.abs();
        if rate > ALIKE * base.velocity_scale {
            return 0.0;
        }
        let size = self.size_of(contact.episode.contact, base, step, work, |powers| powers.in_time().1);
        let noise = 2.0 * f64::EPSILON * size / step.series.scale;
        if rate <= noise { guard.damping.abs() * noise } else { 0.0 }
    }

    /// Where a contact passes to the other side of its guard, by more than a `noise`.
    fn passes_guard(
        &self,
        contact: &Contact,
        guard: &Guard,
        step: &Step,
        (lane, reading): (usize, &BlockReading),
        (until, noise): (f64, f64),
        scalar: &mut Coefficients,
    ) -> Option<f64> {
        let (MotionSeries { scale, clock, .. }, end) = (&step.series, step.end.x);
        let sense = if contact.phase == Phase::Engaged { -1.0 } else { 1.0 };
        let (moved, stretch) = (end * (contact.rate.abs() * scale + reading.turn[lane]), clock.rate(end));
        // Of the guard times dt/dx, which changes no sign.
        let at_rest = guard.value(contact.penetration, 0.0).abs() * (stretch - 1.0).abs();
        let change = at_rest
            + guard.stiffness.abs() * moved * stretch.max(1.0)
            + guard.damping.abs() * reading.turn[lane] / scale;
        if sense * guard.value(contact.penetration, contact.rate) + change < 0.0 {
            return None;
        }
        let (block, lane) = step.closed.of(contact.episode.contact);
        let terms = block.copy_penetration(lane, scalar) - 2;
        let (stiffness, rate) = (sense * guard.stiffness, sense * guard.damping / scale);
        let mut previous = 0.0;
        for n in 0..terms {
            let spring = stiffness * scalar[n];
            let constant = if n == 0 { sense * guard.constant - noise } else { 0.0 };
            scalar[n] = (spring + rate * (n + 1) as f64 * scalar[n + 1]) + (constant + 2.0 * clock.bend * previous);
            previous = spring + constant;
        }
        roots::first_rise(&mut scalar[..terms], until, 0.0)
    }

    /// m, rounding error of a penetration within the step.
    fn noise_of(&self, p: usize, base: &Base, step: &Step, work: &mut Workspace) -> f64 {
        let size = self.size_of(p, base, step, work, |powers| powers.in_time().0);
        self.pairs[p].noise(size)
    }

    /// The sum of the sizes of all that a pair's relative motion is added up from, each term times its factor at the end of
    /// the step.
    fn size_of(
        &self,
        p: usize,
        base: &Base,
        step: &Step,
        work: &mut Workspace,
        factors: impl Fn(&Powers) -> &Coefficients,
    ) -> f64 {
        let series = &step.series;
        work.powers.set_by(&series.clock, step.end.x, series.order);
        work.powers.set_in_time(&series.clock);
        self.project(p, base.coordinates, series, factors(&work.powers), &mut work.scalar)
    }

    /// The scalar series in time of a pair's relative motion, written to `out[n]`. Returns the sum of the sizes of all that
    /// is added up, each term times its `factor`.
    pub(super) fn project(
        &self,
        p: usize,
        coordinates: Coordinates,
        series: &MotionSeries,
        factors: &[f64],
        out: &mut [f64],
    ) -> f64 {
        if coordinates == Coordinates::Modes {
            return series.project(&self.pairs[p].row, factors, out);
        }
        let mut sum = 0.0;
        for (n, (out, factor)) in out.iter_mut().zip(factors).enumerate().take(series.order + 1) {
            let (value, size) = self.pairs[p].difference(coordinates, series.term(n));
            *out = value;
            sum += size * factor.abs();
        }
        sum
    }
}

/// How far to look: to the first event that is known, or to the end.
fn until(first: Option<(f64, Event)>, step: &Step) -> f64 {
    first.map_or(step.end.x, |(x, _)| x)
}

/// Where a penetration is back at 0, or at -`depth`, up to `until`; its reading is that at the step's `end`.
fn released(
    closed: &ClosedPairs,
    (p, lane): (usize, usize),
    reading: &BlockReading,
    (end, until): (f64, f64),
    depth: f64,
    distance: &mut Coefficients,
) -> Option<f64> {
    let (block, _) = closed.of(p);
    let first = (-(block.penetration[0][lane] + depth).max(0.0), -block.penetration[1][lane]);
    let last = (-reading.penetration[lane] - depth, -reading.slope[lane]);
    if roots::ceiling(first, last, end, reading.fourth[lane]) <= 0.0 {
        return None;
    }
    let terms = block.copy_penetration(lane, distance);
    // Distance to the surface, positive once d has passed 0 downwards.
    for d in &mut distance[..terms] {
        *d = -*d;
    }
    distance[0] -= depth;
    roots::first_rise(&mut distance[..terms], until, 0.0)
}
