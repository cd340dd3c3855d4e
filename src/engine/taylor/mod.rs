//! A step in contact: power series in time of the motion, with the forces of the pairs that are in contact.
//!
//! Each power follows from the ones before at the cost of a few vector operations; only the contact forces need products
//! of series. The step is as long as the last terms allow. The motion is that of the floors where they are many and feel
//! their neighbours only, else that of the modes, as always near rigid contacts.
//!
//! Under a power law the last terms tell of the root of the time since the entry, or until the release: there the terms in
//! time are weighed as those by a [`Clock`] have them, which knows no such root and goes several times as far.

use crate::engine::base::planned::At;
use crate::engine::base::planned::Planned;
use crate::engine::base::touching;
use crate::engine::taylor::solution::Solution;
pub mod closed_pairs;
pub mod departures;
pub mod entries;
pub mod follow;
pub mod linear_pairs;
pub mod open_pairs;
pub mod pair_forces;
pub mod solution;

use crate::contact::series::PAIRS;
use crate::engine::base::contact::{Contact, Phase};
use crate::engine::base::planned::Event;
use crate::engine::base::{Base, Coordinates};
use crate::engine::pairs::jacobian::{OnFewModes, OnFloors, OnModes};
use crate::engine::system::System;
use crate::engine::system::buffers::Buffers;
use crate::engine::taylor::closed_pairs::ClosedPairs;
use crate::engine::taylor::linear_pairs::LinearPairs;
use crate::engine::taylor::pair_forces::with_forces;
use crate::numerics::complementarity::Complementarity;
use crate::numerics::polynomial::{ROOM, rough_root};
use crate::numerics::time_map::Clock;
use crate::structure::{FEW_BLOCKS, LANES, MotionSeries, difference, dot};

/// Velocity that a force may cause which is left out at the singular start of a power law, as a share of a step's
/// tolerance.
const START_SHARE: f64 = 0.1;

/// Furthest reach of a series, in units of its scale: beyond, terms that have vanished in a scale far too short would be
/// missed, and the powers of the step overflow. The next series has a better scale.
const FURTHEST: f64 = 1e9;

/// Share of the time to a singularity that a series reaches in time where the singularity is what limits it.
const NEAR: f64 = 0.35;

/// x up to which a series is used by the clock of an entry, in times since the entry: 25 times as long after it.
const FURTHEST_FROM_ENTRY: f64 = 8.0;

/// By how much longer than until a release its clock goes, which stands still at its end: about what the terms in time leave
/// open of when that is.
const LATE: f64 = 1e-3;

/// Tolerance of a step below which it keeps away from the end of a clock and of its reach: there the rounding of terms in
/// time weighs a thousand times as much in series of as high an order.
const NEAR_ROUNDING: f64 = 1e-13;

/// Share of the clock up to a release that a step takes then.
const KEEPING_AWAY: f64 = 0.9;

impl System {
    /// Works out the power series from the base over `remaining` seconds at most, under a load that is in `work`, and how
    /// far they are good for; `is_cut` where the remaining time is not all that there is.
    pub fn plan_taylor(
        &self,
        at: &mut At,
        (remaining, is_cut): (f64, bool),
        planned: &mut Planned,
        solution: &mut Solution,
        work: &mut Buffers,
    ) {
        let base = &mut *at.base;
        let is_singular = touching(base).any(|(_, contact)| contact.is_singular());
        let scale = self.series_scale(base, remaining);
        self.expand(base, solution, work, scale);
        at.counters.contact_steps += 1;
        at.counters.law_evaluations += solution.closed.count_forces();
        let reach = self.reach(base, solution, work, (is_singular, remaining));
        let is_whole = solution.series.place(remaining) <= reach;
        let end = if is_whole { solution.series.place(remaining) } else { reach };
        let event = self.first_event(base, solution, work, end);
        solution.end.set_in_time(&solution.series.clock);
        solution.series.evaluate(&solution.end, &mut planned.q, &mut planned.v);
        planned.event = event;
        planned.reaches_limit = is_whole && !is_cut && event.is_none();
        planned.length = if planned.reaches_limit { remaining } else { solution.series.time(solution.end.x) };
        planned.next_length = Some(solution.series.time(reach));
        planned.ends.clear();
        self.carry(base, &solution.series, &solution.end, &mut work.scalar, &mut planned.carried);
        for (reaction, &p) in solution.reactions.iter().zip(&self.rigid.pairs) {
            if base.contacts[p].is_held() {
                base.contacts[p].reaction = reaction[0];
            }
        }
    }

    /// How far the expanded series are good for, in x: with more powers where these are cheap, by a clock where that takes them
    /// further.
    fn reach(
        &self,
        base: &Base,
        solution: &mut Solution,
        work: &mut Buffers,
        (is_singular, remaining): (bool, f64),
    ) -> f64 {
        let whole = remaining / solution.series.scale;
        let mut reach = self.accurate_reach(base, solution, is_singular, whole);
        if reach < whole && self.expand_further(base, solution, work, reach) {
            reach = self.accurate_reach(base, solution, is_singular, whole);
        }
        if reach < whole && !self.has_close_rigid_pair(base) && !is_singular {
            reach = self.reach_by_clock(base, solution, work, (reach, remaining));
        }
        reach
    }

    /// The first event up to an x; leaves the end of the step, which is there or at the event, in the solution.
    fn first_event(&self, base: &Base, solution: &mut Solution, work: &mut Buffers, end: f64) -> Option<Event> {
        solution.end_at(end);
        let leaving = self.first_leaving(base, solution, work);
        if let Some((x, _)) = leaving {
            solution.end_at(x);
        }
        // Only an entry is looked for in the motion, and no further than to what ends the step anyway.
        let entry = self.first_entry(base, solution, work);
        if let Some((x, _)) = entry {
            solution.end_at(x);
        }
        entry.or(leaving).map(|(_, event)| event)
    }

    /// The series of the motion, of penetrations and forces from the base on.
    fn expand(&self, base: &Base, solution: &mut Solution, work: &mut Buffers, scale: f64) {
        solution.series.start(scale, &base.q, &base.v);
        let are_few = base.coordinates == Coordinates::Modes && base.q.len() <= FEW_BLOCKS * LANES;
        let may_ride = are_few && self.structure.is_classical() && self.rigid.pairs.is_empty();
        solution.closed.start(base, &self.pairs, scale, may_ride);
        self.expand_to(base, solution, work, self.tolerance.order + 1);
    }

    /// Expands the started series to `order`, or goes on with it.
    fn expand_to(&self, base: &Base, solution: &mut Solution, work: &mut Buffers, order: usize) {
        let (structure, loads) = (&self.structure, (&work.load[..], &work.slope[..]));
        let Solution { series, closed, .. } = solution;
        match base.coordinates {
            Coordinates::Floors => {
                with_forces!(closed, [Linear, Spring, Damped, Root], false, OnFloors, |forces| series.expand_floors(
                    &structure.floors,
                    order,
                    loads,
                    forces
                ));
            }
            Coordinates::Modes if structure.is_classical() && work.rigid.pairs.is_empty() => {
                if base.q.len() > FEW_BLOCKS * LANES {
                    with_forces!(closed, [], false, OnModes(&self.pairs), |forces| series
                        .expand_modes(structure, order, loads, forces));
                } else if !self.expand_linear(series, closed, order, loads) {
                    with_forces!(closed, [Spring, Damped, Root], true, OnFewModes, |forces| series
                        .expand_few_modes(structure, order, loads, forces));
                }
            }
            Coordinates::Modes => {
                while solution.series.order < order {
                    self.extend_together(solution, (&work.load, &work.slope), &mut work.rigid);
                }
            }
        }
    }

    /// More powers of the series where these are cheap and it does not reach the release of any pair yet, within
    /// `reach`; whether there are more now.
    fn expand_further(&self, base: &Base, solution: &mut Solution, work: &mut Buffers, reach: f64) -> bool {
        let is_on_few_modes = base.coordinates == Coordinates::Modes
            && base.q.len() <= FEW_BLOCKS * LANES
            && self.structure.is_classical()
            && work.rigid.pairs.is_empty();
        let are_cheap = is_on_few_modes
            && self.tolerance.linear_order > self.tolerance.order
            && solution.closed.count_linear().is_some();
        if !are_cheap || solution.closed.are_some_nearly_released(reach) {
            return false;
        }
        self.expand_to(base, solution, work, self.tolerance.linear_order + 1);
        true
    }

    /// Expands a started series of few modes to `order`, or goes on with it, where all pairs are under linear laws;
    /// whether they are.
    fn expand_linear(
        &self,
        series: &mut MotionSeries,
        closed: &mut ClosedPairs,
        order: usize,
        loads: (&[f64], &[f64]),
    ) -> bool {
        match closed.count_linear() {
            None => false,
            Some(1) => self.expand_linear_pairs::<1>(series, closed, order, loads),
            Some(2) => self.expand_linear_pairs::<2>(series, closed, order, loads),
            Some(_) => self.expand_linear_pairs::<PAIRS>(series, closed, order, loads),
        }
    }

    fn expand_linear_pairs<const COUNT: usize>(
        &self,
        series: &mut MotionSeries,
        closed: &mut ClosedPairs,
        order: usize,
        loads: (&[f64], &[f64]),
    ) -> bool {
        let forces = LinearPairs::<COUNT>::of(closed, &self.pairs, series.order - 1);
        forces.map(|mut forces| series.expand_few_modes(&self.structure, order, loads, &mut forces)).is_some()
    }

    /// One power of the modes, where floors are held together.
    fn extend_together(&self, solution: &mut Solution, (load, slope): (&[f64], &[f64]), rigid: &mut Complementarity) {
        let Solution { series, closed, reactions, reaction_order, .. } = solution;
        let n = series.order - 1;
        let scale = series.scale;
        closed.extend_forces(n);
        let load_of_power = |out: &mut [f64]| {
            match n {
                0 => out.copy_from_slice(load),
                1 => out.iter_mut().zip(slope).for_each(|(out, slope)| *out = slope * scale),
                _ => {}
            }
            closed.each_force(n, |p, force| self.push_apart_by(p, Coordinates::Modes, force, out));
        };
        series.extend(&self.structure, load_of_power, |acceleration| self.hold(rigid, acceleration));
        for (&k, reaction) in rigid.pairs.iter().zip(&rigid.found) {
            reactions[k][n] = *reaction;
        }
        *reaction_order = n;
        let term = series.term(n + 2);
        closed.set_penetrations(n + 2, |p, at_surface| {
            let row = &self.pairs[p].row;
            if at_surface { difference(row, term).0 } else { dot(row, term) }
        });
    }

    /// How far the series reach by a clock in which the nearest entry behind, or release before, is no singularity, from
    /// how far they do in time.
    fn reach_by_clock(
        &self,
        base: &Base,
        solution: &mut Solution,
        work: &mut Buffers,
        (reach, remaining): (f64, f64),
    ) -> f64 {
        let Some((clock, furthest)) = self.clock(base, solution, reach) else { return reach };
        solution.bend_by(clock);
        let reach = self.reach_of_rates(base, &solution.series, work);
        self.cautious(reach, furthest.min(clock.place(remaining / solution.series.scale)))
    }

    /// The clock for series that reach so far in time, if one takes them further, and how far that is good for.
    fn clock(&self, base: &Base, solution: &Solution, reach: f64) -> Option<(Clock, f64)> {
        let is_behind = |(_, contact): &(usize, &Contact)| {
            contact.phase == Phase::Engaged && !contact.branch().is_regular() && contact.age > 0.0
        };
        let ages = touching(base).filter(is_behind).map(|(_, contact)| contact.age);
        let since = ages.fold(f64::INFINITY, f64::min) / solution.series.scale;
        let release = (1.0 + LATE) * solution.closed.first_release(reach / NEAR);
        let (bend, furthest) = match () {
            // Reached or passed as it is, or in a scale far too long.
            _ if release < reach || reach > FURTHEST_FROM_ENTRY * since || reach < 1.0 / FURTHEST => return None,
            // Nothing to measure an error against.
            _ if base.velocity_scale == 0.0 => return None,
            _ if reach > NEAR * since => (0.25 / since, FURTHEST_FROM_ENTRY * since),
            _ if release.is_finite() => (-0.25 / release, 2.0 * release * self.boldness()),
            _ => return None,
        };
        Some((Clock { bend }, furthest))
    }

    /// How far, by its clock, the last two terms of the velocities of a series stay below the tolerance.
    fn reach_of_rates(&self, base: &Base, series: &MotionSeries, work: &mut Buffers) -> f64 {
        let allowed = self.tolerance.step * base.velocity_scale * series.scale;
        let (last, before) = (&mut work.node_q, &mut work.node_v);
        let powers = series.last_rates(last, before);
        let sizes = [last, before].map(|term| self.worst_floor(base.coordinates, term));
        let reaches = powers.iter().zip(sizes).filter(|(_, size)| *size > 0.0);
        reaches.map(|(power, size)| rough_root(allowed / size, *power)).fold(f64::INFINITY, f64::min)
    }

    /// Share of the way to the end of a clock that a step may take.
    fn boldness(&self) -> f64 {
        if self.tolerance.step < NEAR_ROUNDING { KEEPING_AWAY } else { 1.0 }
    }

    /// How far to go where terms show that something is accurate up to about `reach`: not quite as far, unless the rest of
    /// the way is within reach too.
    fn cautious(&self, reach: f64, whole: f64) -> f64 {
        if self.boldness() * reach >= whole { whole } else { 0.9 * reach }
    }

    /// How far, in units of the series' scale, its last two terms stay below the tolerance.
    ///
    /// It is the velocity that is controlled: over a contact of a millisecond a displacement error is a velocity error
    /// a thousand times larger.
    fn accurate_reach(&self, base: &Base, solution: &Solution, is_singular: bool, whole: f64) -> f64 {
        let series = &solution.series;
        let mut reach = self.reach_of_terms(base, series, self.tolerance.step * base.velocity_scale * series.scale);
        reach = self.cautious(reach, whole);
        if !is_singular {
            return reach.min(FURTHEST);
        }
        for (p, contact) in touching(base).filter(|(_, contact)| contact.is_singular()) {
            let law = contact.branch();
            let mut terms = [0.0; ROOM];
            let (block, lane) = solution.closed.of(p);
            block.copy_penetration(lane, &mut terms);
            let left_out = |x: f64| {
                let (penetration, rate) =
                    terms.iter().rev().fold((0.0, 0.0), |(value, slope), c| (value * x + c.abs(), slope * x + value));
                law.value(penetration, rate / series.scale) * x * series.scale / self.pairs[p].mass
            };
            reach = reach.min(self.forceless_reach(left_out, base, series, whole));
        }
        reach.min(FURTHEST)
    }

    /// How far the last two terms stay below what is `allowed`, m.
    fn reach_of_terms(&self, base: &Base, series: &MotionSeries, allowed: f64) -> f64 {
        let mut reach = f64::INFINITY;
        for n in [series.order - 1, series.order] {
            let term = n as f64 * self.worst_floor(base.coordinates, series.term(n));
            if term > 0.0 {
                reach = reach.min(match allowed {
                    0.0 => self.reach_from_rest(base.coordinates, series, n, term),
                    _ => rough_root(allowed / term, n - 1),
                });
            }
        }
        reach
    }

    /// How far a last term stays below the tolerance where nothing has moved yet: relative to the velocity that any of
    /// the terms before it brings about by then.
    fn reach_from_rest(&self, coordinates: Coordinates, series: &MotionSeries, last: usize, last_term: f64) -> f64 {
        (2..last / 2)
            .map(|n| {
                let term = n as f64 * self.worst_floor(coordinates, series.term(n));
                libm::pow(self.tolerance.step * term / last_term, 1.0 / (last - n) as f64)
            })
            .fold(0.0, f64::max)
    }

    /// How far a power law's force may be left out after an entry: the velocity that it would have caused, m/s, stays a
    /// small share of what there is and what the step brings about.
    fn forceless_reach(&self, left_out: impl Fn(f64) -> f64, base: &Base, series: &MotionSeries, whole: f64) -> f64 {
        let (speed, coordinates) = (base.velocity_scale, base.coordinates);
        let gained = [2, 3, 4].map(|n| n as f64 * self.worst_floor(coordinates, series.term(n)) / series.scale);
        let mut x = whole;
        while x > 1e-30 {
            let gained = x * (gained[0] + x * (gained[1] + x * gained[2]));
            if left_out(x) <= START_SHARE * self.tolerance.step * (speed + gained) {
                break;
            }
            x *= 0.5;
        }
        x
    }
}
