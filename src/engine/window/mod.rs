//! A step in contact over a whole window (see [`crate::collocation`]), as long as few pairs are in contact.
//!
//! Two windows take a Hertz contact from its entry to its release, if no sample of the record comes between, where power
//! series need twenty steps. A window is taken only if bounds show that nothing else happens in it (see
//! [`certificate`]). Where that cannot be shown power series in time go on.

pub mod certificate;
pub mod kernels;
pub mod solution;
pub mod spring;
pub mod trial;

use crate::collocation::{Ending, MOST_PAIRS, Tables, Workspace as WindowWorkspace};
use crate::contact::Force;
use crate::engine::base::contact::Contact;
use crate::engine::base::planned::{At, Event, Planned};
use crate::engine::base::{Base, Coordinates, touching};
use crate::engine::system::System;
use crate::engine::system::buffers::Buffers;
use crate::engine::window::certificate::keeps_off;
use crate::engine::window::kernels::Windows;
use crate::engine::window::solution::Window;
use crate::engine::window::trial::Trial;
use crate::structure::{EXACT, MotionSeries, dot, flight_order};

/// How far a kernel may be off, relative to what one step may.
const KERNEL_SHARE: f64 = 0.03;

/// How far the series of the motion without contact forces may be off, relative to what one step may: it is of the whole
/// motion, of which a contact is a small part.
const FREE_SHARE: f64 = 1e-3;

/// How far the iteration may be off, relative to what one step may.
const SWEEP_SHARE: f64 = 0.3;

/// Share of a contact's force that moves it, and of its speed, below which it is at rest.
const AT_REST: f64 = 0.1;

/// Pairs with dashpots that a window is for: of two, series by a time map cost about as much; found by trying.
const MOST_DAMPED: usize = 1;

/// Windows that are tried for one step.
const MOST_TRIES: usize = 5;

/// What has been found of a solved window.
enum Verdict {
    /// Nothing else happens in it, and its forces are right.
    Good,
    /// To be tried again.
    Another(Trial),
    /// Not to be tried again.
    Reject,
}

impl Windows {
    /// Works out a window from the base on, over `remaining` seconds at most and under a load that is in `work`;
    /// `false` where power series have to do it. `series` is for the motion without contact forces.
    pub fn plan(
        &self,
        system: &System,
        at: &mut At,
        remaining: f64,
        planned: &mut Planned,
        (window, series): (&mut Window, &mut MotionSeries),
        (room, work): (&mut WindowWorkspace, &mut Buffers),
    ) -> bool {
        let base = &*at.base;
        if base.coordinates != Coordinates::Modes || !window.gather(base) {
            return false;
        }
        let Some(mut trial) = self.trial(system, base, window, remaining) else { return false };
        if !self.set_equation(system, base, (window, series), work, trial.room()) {
            return false;
        }
        if (0..window.equation.closed).any(|place| window.is_at_rest(system, base, place)) {
            return false;
        }
        self.watch(system, base, (window, series), trial.length);
        let tolerance = system.tolerance.step * base.velocity_scale;
        for _ in 0..MOST_TRIES {
            let Window { equation, solution, .. } = window;
            if !solution.solve(equation, room, trial.frame(), SWEEP_SHARE * tolerance * trial.length) {
                // An event that is not where it was expected may be late.
                trial = match trial.ending {
                    Ending::Given => trial.shorter(0.5),
                    _ => trial.shorter(1.0).until(Ending::Given, trial.longest.min(equation.scale)),
                };
                continue;
            }
            if solution.length > remaining {
                trial = trial.shorter(1.0).until(Ending::Given, remaining.min(equation.scale));
                continue;
            }
            window.close();
            match self.assess(system, base, (window, series), work, trial, tolerance) {
                Verdict::Good => {
                    at.counters.contact_steps += 1;
                    at.counters.law_evaluations += base.count_forces(Contact::branch);
                    window.commit(system, series, planned, work, trial.ending, remaining);
                    return true;
                }
                Verdict::Another(next) => trial = next,
                Verdict::Reject => return false,
            }
        }
        false
    }

    /// Fills in the free motion and the kernels for windows up to `longest`, s; whether series reach that far.
    fn set_equation(
        &self,
        system: &System,
        base: &Base,
        (window, series): (&mut Window, &mut MotionSeries),
        work: &Buffers,
        longest: f64,
    ) -> bool {
        let System { structure, tolerance, impulse_response, .. } = system;
        let equation = &mut window.equation;
        let remainder = (KERNEL_SHARE * tolerance.step).max(1e-17);
        let powers = impulse_response.as_ref().and_then(|response| response.powers(longest, remainder));
        let exact = (FREE_SHARE * tolerance.step).max(EXACT);
        let (Some(powers), Some(order)) = (powers, flight_order(structure.fastest * longest, exact)) else {
            return false;
        };
        series.expand_flight(structure, (&base.q, &base.v), (&work.load, &work.slope), (longest, order));
        equation.remainder = remainder;
        (equation.scale, equation.powers, equation.terms) = (longest, powers, series.order + 1);
        for place in 0..equation.closed {
            self.set_pair(system, base, (window, series), place);
        }
        true
    }

    /// Fills in what belongs to one pair of the window.
    fn set_pair(&self, system: &System, base: &Base, (window, series): (&mut Window, &MotionSeries), place: usize) {
        let Window { equation, contacts, .. } = window;
        let p = contacts[place];
        let (contact, row) = (&base.contacts[p], &system.pairs[p].row);
        let free = &mut equation.free[place];
        free[0] = if contact.in_contact() { contact.penetration.max(0.0) } else { contact.flight_start() };
        free[1] = contact.rate * equation.scale;
        series.dot_each(row, 2, free);
        equation.kernels[place][place] = *self.kernel(system, p, p, &mut None);
        for (other, q) in contacts.iter().enumerate().take(equation.closed).filter(|(other, _)| *other != place) {
            equation.kernels[place][other] = *self.kernel(system, p, *q, &mut None);
        }
    }

    /// Adds the pairs that may come into contact over `length` seconds, as far as there is room.
    fn watch(&self, system: &System, base: &Base, (window, series): (&mut Window, &MotionSeries), length: f64) {
        for (p, contact) in base.contacts.iter().enumerate().filter(|(_, contact)| !contact.in_contact()) {
            let place = window.equation.pairs;
            if place == MOST_PAIRS || system.pairs[p].law.is_rigid() {
                return;
            }
            let (row, scale) = (&system.pairs[p].row, series.scale);
            let bend = 2.0 * dot(row, series.term(2)).max(0.0) / (scale * scale);
            if keeps_off(contact, 2.0 * bend, length) {
                continue;
            }
            window.contacts[place] = p;
            window.equation.pairs += 1;
            self.set_pair(system, base, (window, series), place);
        }
    }

    /// Whether a solved window is right and certain, or what to try instead.
    fn assess(
        &self,
        system: &System,
        base: &Base,
        (window, series): (&Window, &MotionSeries),
        work: &mut Buffers,
        trial: Trial,
        tolerance: f64,
    ) -> Verdict {
        let Window { equation, solution, .. } = window;
        if let Some(next) = window.passed(trial) {
            return Verdict::Another(next);
        }
        // What still approaches is not released: its depth is below what the iteration leaves open.
        if let Ending::Release(place) = trial.ending
            && solution.end[place].1 >= 0.0
        {
            return Verdict::Reject;
        }
        let error = solution.velocity_error(equation) / tolerance;
        let allowed = self.allowed;
        if error > allowed {
            if let Some(least) = solution.rule.next() {
                return Verdict::Another(Trial { least, ..trial });
            }
            let share = libm::pow(allowed / error, 0.1);
            return Verdict::Another(trial.shorter((0.9 * share).max(0.3)));
        }
        match self.is_certain(system, base, (window, series), work, trial.ending) {
            true => Verdict::Good,
            // Near an event that bounds cannot tell: power series find it.
            false if trial.ending != Ending::Given || trial.halved => Verdict::Reject,
            false => Verdict::Another(Trial { halved: true, ..trial.shorter(0.5) }),
        }
    }
}

/// Which of some numbers at nodes, by fours, and of that at the end is the first of a kind.
#[inline(always)]
fn first_node(at_nodes: &[f64], end: f64, is_it: impl Fn(f64) -> bool) -> Option<usize> {
    let mut is_any = [false; 4];
    for four in at_nodes.as_chunks::<4>().0 {
        is_any = std::array::from_fn(|i| is_any[i] | is_it(four[i]));
    }
    match is_any.contains(&true) {
        true => at_nodes.iter().position(|number| is_it(*number)),
        false => is_it(end).then_some(at_nodes.len()),
    }
}

impl Window {
    /// The pairs in contact, if they are few enough and of laws that windows are for.
    fn gather(&mut self, base: &Base) -> bool {
        self.equation.closed = 0;
        for (p, contact) in touching(base) {
            let force = contact.branch();
            let fits = match force {
                Force::Power { exponent, .. } => (2.0 * exponent).fract() == 0.0,
                Force::Root { .. } => true,
                Force::None | Force::Linear { .. } => false,
            };
            // An entry whose speed is rounding is for the other kinds of step.
            let enters = contact.penetration > 0.0 || contact.rate > 0.0;
            let place = self.equation.closed;
            if place == MOST_PAIRS || contact.is_held() || !fits || !enters {
                return false;
            }
            self.contacts[place] = p;
            self.equation.forces[place] = force;
            self.equation.closed += 1;
        }
        let closed = self.equation.closed;
        self.equation.pairs = closed;
        closed <= MOST_DAMPED || self.equation.forces[..closed].iter().all(|force| !force.is_damped())
    }

    /// Whether a pair leans on another without moving much: its force and all that it holds off cancel, and a window adds
    /// them up apart, over and over; a power series adds up what is left of them.
    fn is_at_rest(&self, system: &System, base: &Base, place: usize) -> bool {
        let Window { equation, contacts, .. } = self;
        let (p, force) = (contacts[place], equation.forces[place]);
        let (d, rate) = (base.contacts[p].penetration, base.contacts[p].rate);
        let pushed = equation.kernels[place][place][1] * force.value(d, rate);
        let left = 2.0 * equation.free[place][2] / (equation.scale * equation.scale) - pushed;
        let stored = force.stored_energy(d) / system.pairs[p].mass;
        left.abs() < AT_REST * pushed && 0.5 * rate * rate < AT_REST * AT_REST * stored
    }

    /// Makes a solved window the planned planned.
    fn commit(
        &self,
        system: &System,
        series: &MotionSeries,
        planned: &mut Planned,
        work: &mut Buffers,
        ending: Ending,
        remaining: f64,
    ) {
        let (length, contacts) = (self.solution.length, self.contacts);
        planned.tracked.fill(None);
        planned.ends.clear();
        planned.length = length;
        planned.reaches_limit = length == remaining && ending == Ending::Given;
        planned.event = match ending {
            Ending::Given => None,
            Ending::Release(place) => Some(Event::Release(contacts[place])),
            Ending::Turn(place) => Some(Event::Branch(contacts[place])),
            Ending::Touch(place) => Some(Event::Entry(contacts[place])),
        };
        self.evaluate(system, series, length, &mut work.powers, (&mut planned.q, &mut planned.v));
        planned.next_length = Some(length);
    }

    /// The window up to the first event that a solved one has passed.
    fn passed(&self, trial: Trial) -> Option<Trial> {
        let Window { equation, solution, .. } = self;
        let count = solution.rule.count();
        let theta = &Tables::of(solution.map, solution.rule).theta[..count];
        let mut first = (f64::INFINITY, Ending::Given);
        for place in 0..equation.pairs {
            let (depth, rate, (d, v)) = (&solution.depth[place], &solution.rate[place], solution.end[place]);
            let is_closed = place < equation.closed;
            let event = if is_closed { Ending::Release(place) } else { Ending::Touch(place) };
            let is_beyond = |d: f64| if is_closed { d <= 0.0 } else { d > 0.0 };
            // Right after a release or entry it is at the surface.
            let beyond = first_node(&depth[..count], d, is_beyond);
            let beyond = beyond.filter(|i| *i < theta.len() || trial.ending != event).map(|i| (i, event));
            let turns = is_closed && matches!(equation.forces[place], Force::Root { .. });
            let turned = if turns { first_node(&rate[..count], v, |v| v <= 0.0) } else { None };
            let turn = Ending::Turn(place);
            let turned = turned.filter(|i| *i < theta.len() || trial.ending != turn).map(|i| (i, turn));
            for (i, event) in [beyond, turned].into_iter().flatten() {
                let time = theta.get(i).unwrap_or(&1.0) * solution.length;
                if time < first.0 {
                    first = (time, event);
                }
            }
        }
        let (time, event) = first;
        match event {
            Ending::Given => None,
            Ending::Release(_) => Some(Trial { map: trial.map.with_end(), ..trial.until(event, time) }),
            _ => Some(Trial { map: trial.map.without_end(), ..trial.until(event, time) }),
        }
    }
}
