//! A step in contact: power series in time of the motion, with the forces of the pairs that are in contact.
//!
//! Each power follows from the ones before at the cost of a few vector operations; only the contact forces need products
//! of series. The step is as long as the last terms allow. The motion is that of the floors where they are many and feel
//! their neighbours only, else that of the modes, as always near rigid contacts.
//!
//! Under a power law the last terms tell of the root of the time since the entry, or until the release: there the terms in
//! time are weighed as those by a [`Clock`] have them, which knows no such root and goes several times as far.

use super::closed_pairs::ClosedPairs;
use super::complementarity::Complementarity;
use super::linear_pairs::LinearPairs;
use super::meeting::{OnFewModes, OnFloors, OnModes};
use super::model::Model;
use super::pair_forces::with_forces;
use super::state::*;
use crate::clock::Clock;
use crate::contact::Force;
use crate::contact::taylor::PAIRS;
use crate::polynomial::{MAX_ORDER, ROOM, rough_root};
use crate::structure::{FEW_BLOCKS, LANES, MotionSeries, difference, dot};

/// Share of `relative_tolerance` that one step may use: an episode takes some thirty steps and an earthquake some
/// hundred episodes, whose errors add up. With this share the golden scenes of `tests/golden.rs` come out within
/// `relative_tolerance`; with ten times as much, `hertz` is ten times worse for hardly fewer steps.
const STEP_SHARE: f64 = 0.002;

/// Velocity that a force may cause which is left out at the singular start of a power law, as a share of a step's
/// tolerance.
const START_SHARE: f64 = 0.1;

/// Velocity error of one step relative to the velocity scale, and the order of the series, for a scene's tolerance.
pub(super) fn accuracy(relative_tolerance: f64) -> (f64, usize) {
    let tolerance = STEP_SHARE * relative_tolerance;
    // 1.5 for each digit is about cheapest: with 1.2 single masses took 5 to 15 % more instructions, tall frames as many.
    let order = (-1.5 * libm::log10(tolerance)).round().clamp(8.0, (MAX_ORDER - 2) as f64);
    (tolerance, order as usize)
}

/// Phase of its swing, rad, that a contact under a linear law goes through from entry to release, over the share of its
/// reach that a series is used for.
const WHOLE_CONTACT: f64 = 3.5;

/// The order at which one series takes a linear contact from entry to release: there each power costs a few products only,
/// where each step costs its events and its end.
pub(super) fn linear_order(tolerance: f64, order: usize) -> usize {
    let (mut term, mut powers) = (1.0, 0);
    while term > tolerance && powers < MAX_ORDER - 2 {
        powers += 1;
        term *= WHOLE_CONTACT / powers as f64;
    }
    powers.max(order)
}

/// Share of the time left for which floors are held together that rounding cannot tell from free ones.
const SHORT_WHILE: f64 = 1e-3;

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

impl Model {
    /// Works out the step in contact from the base until `limit` (s since the segment's start) or the next event.
    pub(super) fn plan_contact(&self, state: &mut State, limit: f64) {
        let is_near_rigid = self.has_close_rigid_pair(&state.base);
        let coordinates = if is_near_rigid { Coordinates::Modes } else { self.contact_coordinates };
        self.convert(&mut state.base, coordinates, &mut state.work.q);
        state.base.velocity_scale = state.base.velocity_scale.max(self.present_velocity(&state.base));
        let (remaining, cut) = match self.time_for_rigid_pairs(state, limit - state.base.elapsed) {
            Ok(time) => time,
            Err(event) => return happen_now(state, event),
        };
        if let Some(p) = self.entry_at_once(&state.base) {
            return happen_now(state, Event::Entry(p));
        }
        if !is_near_rigid && self.plan_window(state, remaining) {
            return;
        }
        let is_singular = touching(&state.base).any(|(_, contact)| contact.is_singular());
        if is_singular && !is_near_rigid && self.plan_onset(state, remaining) {
            return;
        }
        let State { base, step, inputs, counters, work, .. } = state;
        counters.contact_steps += 1;
        step.ends.clear();
        step.kind = StepKind::Contact;
        self.load(base, inputs, &mut work.load, &mut work.slope);
        let scale = self.series_scale(base, remaining);
        self.expand(base, step, work, scale);
        counters.law_evaluations += step.closed.count_forces();
        let mut reach = self.accurate_reach(base, step, is_singular, remaining / scale);
        if reach < remaining / scale && self.expand_further(base, step, work, reach) {
            reach = self.accurate_reach(base, step, is_singular, remaining / scale);
        }
        if reach < remaining / scale && !is_near_rigid && !is_singular {
            reach = self.reach_by_clock(base, step, work, (reach, remaining));
        }
        let whole = step.series.place(remaining) <= reach;
        let end = if whole { step.series.place(remaining) } else { reach };
        step.end.set_by(&step.series.clock, end, step.series.order);
        step.closed.read(&step.end);
        let leaving = self.first_leaving(base, step, work);
        if let Some((x, _)) = leaving {
            step.end.set_by(&step.series.clock, x, step.series.order);
            step.closed.read(&step.end);
        }
        // Only an entry is looked for in the motion, and no further than to what ends the step anyway.
        let entry = self.first_entry(base, step, work);
        if let Some((x, _)) = entry {
            step.end.set_by(&step.series.clock, x, step.series.order);
            step.closed.read(&step.end);
        }
        step.end.set_in_time(&step.series.clock);
        step.series.evaluate(&step.end, &mut step.q, &mut step.v);
        let event = entry.or(leaving);
        step.event = event.map(|(_, event)| event);
        step.reaches_limit = whole && !cut && event.is_none();
        step.length = if step.reaches_limit { remaining } else { step.series.time(step.end.x) };
        self.carry(base, &step.series, &step.end, &mut work.scalar, &mut step.carried);
        for (reaction, &p) in step.reactions.iter().zip(&self.rigid.pairs) {
            if base.contacts[p].is_held() {
                base.contacts[p].reaction = reaction[0];
            }
        }
        base.last_length = step.series.time(reach);
    }

    /// How long a step may be near rigid contacts, of the `remaining` time, s, and whether it is cut; or the release that
    /// comes first. Leaves the pairs that are held together in `work.rigid`, all active.
    fn time_for_rigid_pairs(&self, state: &mut State, remaining: f64) -> Result<(f64, bool), Event> {
        let State { base, inputs, work, .. } = state;
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
    fn has_close_rigid_pair(&self, base: &Base) -> bool {
        self.rigid.pairs.iter().any(|&p| base.contacts[p].is_held() || base.contacts[p].carried)
    }

    /// The unit of time of the next series, s: near the length of the step, so that its terms neither overflow nor
    /// vanish. A power law's series reaches no further than to its singularity at d = 0.
    pub(super) fn series_scale(&self, base: &Base, remaining: f64) -> f64 {
        let last = if base.last_length > 0.0 { base.last_length } else { remaining };
        let reach = touching(base)
            .filter(|(_, contact)| contact.penetration > 0.0 && !contact.branch().is_regular() && contact.rate != 0.0)
            .map(|(_, contact)| contact.penetration / contact.rate.abs())
            .fold(last.min(remaining), f64::min);
        power_of_two_below(reach)
    }

    /// A pair that stands at the surface and approaches, by more than rounding: it enters now, together with another.
    fn entry_at_once(&self, base: &Base) -> Option<usize> {
        let at_surface = |contact: &Contact| contact.at_surface || contact.penetration >= 0.0;
        let meets = |(p, contact): (usize, &Contact)| {
            let stands = !contact.in_contact() && at_surface(contact) && contact.rate > 0.0;
            stands && self.pairs[p].difference(base.coordinates, &base.v).0 > 0.0
        };
        base.contacts.iter().enumerate().position(meets)
    }

    /// The series of the motion, of penetrations and forces from the base on.
    fn expand(&self, base: &Base, step: &mut Step, work: &mut Workspace, scale: f64) {
        step.series.start(scale, &base.q, &base.v);
        let are_few = base.coordinates == Coordinates::Modes && base.q.len() <= FEW_BLOCKS * LANES;
        let may_ride = are_few && self.structure.is_classical() && self.rigid.pairs.is_empty();
        step.closed.start(base, &self.pairs, scale, may_ride);
        self.expand_to(base, step, work, self.order + 1);
    }

    /// Expands the started series to `order`, or goes on with it.
    fn expand_to(&self, base: &Base, step: &mut Step, work: &mut Workspace, order: usize) {
        let (structure, loads) = (&self.structure, (&work.load[..], &work.slope[..]));
        let Step { series, closed, .. } = step;
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
                while step.series.order < order {
                    self.extend_together(step, (&work.load, &work.slope), &mut work.rigid);
                }
            }
        }
    }

    /// More powers of the series where these are cheap and it does not reach the release of any pair yet, within
    /// `reach`; whether there are more now.
    fn expand_further(&self, base: &Base, step: &mut Step, work: &mut Workspace, reach: f64) -> bool {
        let is_on_few_modes = base.coordinates == Coordinates::Modes
            && base.q.len() <= FEW_BLOCKS * LANES
            && self.structure.is_classical()
            && work.rigid.pairs.is_empty();
        let are_cheap = is_on_few_modes && self.linear_order > self.order && step.closed.count_linear().is_some();
        if !are_cheap || step.closed.are_some_nearly_released(reach) {
            return false;
        }
        self.expand_to(base, step, work, self.linear_order + 1);
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
    fn extend_together(&self, step: &mut Step, (load, slope): (&[f64], &[f64]), rigid: &mut Complementarity) {
        let Step { series, closed, reactions, reaction_order, .. } = step;
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
        step: &mut Step,
        work: &mut Workspace,
        (reach, remaining): (f64, f64),
    ) -> f64 {
        let Some((clock, furthest)) = self.clock(base, step, reach) else { return reach };
        step.bend(clock, &mut work.bend);
        let reach = self.reach_of_rates(base, &step.series, work);
        self.cautious(reach, furthest.min(clock.place(remaining / step.series.scale)))
    }

    /// The clock for series that reach so far in time, if one takes them further, and how far that is good for.
    fn clock(&self, base: &Base, step: &Step, reach: f64) -> Option<(Clock, f64)> {
        let is_behind = |(_, contact): &(usize, &Contact)| {
            contact.phase == Phase::Engaged && !contact.branch().is_regular() && contact.age > 0.0
        };
        let ages = touching(base).filter(is_behind).map(|(_, contact)| contact.age);
        let since = ages.fold(f64::INFINITY, f64::min) / step.series.scale;
        let release = (1.0 + LATE) * step.closed.first_release(reach / NEAR);
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
    fn reach_of_rates(&self, base: &Base, series: &MotionSeries, work: &mut Workspace) -> f64 {
        let allowed = self.step_tolerance * base.velocity_scale * series.scale;
        let (last, before) = (&mut work.node_q, &mut work.node_v);
        let powers = series.last_rates(last, before);
        let sizes = [last, before].map(|term| self.worst_floor(base.coordinates, term));
        let reaches = powers.iter().zip(sizes).filter(|(_, size)| *size > 0.0);
        reaches.map(|(power, size)| rough_root(allowed / size, *power)).fold(f64::INFINITY, f64::min)
    }

    /// Share of the way to the end of a clock that a step may take.
    fn boldness(&self) -> f64 {
        if self.step_tolerance < NEAR_ROUNDING { KEEPING_AWAY } else { 1.0 }
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
    fn accurate_reach(&self, base: &Base, step: &Step, is_singular: bool, whole: f64) -> f64 {
        let series = &step.series;
        let mut reach = self.reach_of_terms(base, series, self.step_tolerance * base.velocity_scale * series.scale);
        reach = self.cautious(reach, whole);
        if !is_singular {
            return reach.min(FURTHEST);
        }
        for (p, contact) in touching(base).filter(|(_, contact)| contact.is_singular()) {
            let law = contact.branch();
            let mut terms = [0.0; ROOM];
            let (block, lane) = step.closed.of(p);
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
                libm::pow(self.step_tolerance * term / last_term, 1.0 / (last - n) as f64)
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
            if left_out(x) <= START_SHARE * self.step_tolerance * (speed + gained) {
                break;
            }
            x *= 0.5;
        }
        x
    }

    /// Largest floor displacement, velocity ... of a vector of motion; of modes, that any one of them stands for.
    pub(super) fn worst_floor(&self, coordinates: Coordinates, motion: &[f64]) -> f64 {
        match coordinates {
            Coordinates::Floors => largest_of(motion, |_, size| size),
            Coordinates::Modes => {
                let weights = self.structure.weight.as_chunks::<LANES>().0;
                largest_of(motion, |(c, i), size| size * weights[c][i])
            }
        }
    }

    /// The velocity that contact errors are measured against: of the floors, or what the springs can give them.
    fn present_velocity(&self, base: &Base) -> f64 {
        let floors = self.worst_floor(base.coordinates, &base.v);
        // What is stored later comes from the motion that has been seen.
        if base.last_length > 0.0 {
            return floors;
        }
        let springs = base.contacts.iter().zip(&self.pairs).map(|(contact, pair)| {
            (2.0 * contact.branch().stored_energy(contact.penetration.max(0.0)) / pair.mass).sqrt()
        });
        springs.fold(floors, f64::max)
    }
}

/// The largest of the sizes of a motion, each as `weighed` by its block and lane.
#[inline(always)]
fn largest_of(motion: &[f64], weighed: impl Fn((usize, usize), f64) -> f64) -> f64 {
    let mut largest = [0.0_f64; LANES];
    for (c, motion) in motion.as_chunks::<LANES>().0.iter().enumerate() {
        for i in 0..LANES {
            // Not `max`, which has to look for a NaN in both.
            let size = weighed((c, i), motion[i].abs());
            largest[i] = if size > largest[i] { size } else { largest[i] };
        }
    }
    largest.iter().fold(0.0, |a, b| a.max(*b))
}

/// The power of two at or below x > 0: a scale that costs no rounding.
fn power_of_two_below(x: f64) -> f64 {
    const MANTISSA: u64 = (1 << 52) - 1;
    let power = f64::from_bits(x.to_bits() & !MANTISSA);
    if power > 0.0 { power } else { x }
}

/// An event that needs no step.
fn happen_now(state: &mut State, event: Event) {
    let State { base, step, .. } = state;
    step.kind = StepKind::Contact;
    step.event = Some(event);
    step.reaches_limit = false;
    step.length = 0.0;
    step.series.scale = 1.0;
    step.carried.fill(None);
    step.ends.clear();
    step.q.copy_from_slice(&base.q);
    step.v.copy_from_slice(&base.v);
}

/// The contacts that are in contact, with their number.
pub(super) fn touching(base: &Base) -> impl Iterator<Item = (usize, &Contact)> {
    base.contacts.iter().enumerate().filter(|(_, contact)| contact.in_contact())
}

impl Contact {
    /// Just entered under a force that has no power series at d = 0.
    pub(super) fn is_singular(&self) -> bool {
        self.in_contact() && self.penetration <= 0.0 && !self.branch().is_regular()
    }

    /// The force that the series of the next step uses.
    pub(super) fn starting_force(&self) -> Force {
        if self.is_singular() { Force::None } else { self.branch() }
    }
}
