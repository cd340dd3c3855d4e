//! A step in contact over a whole window by collocation (see [`crate::collocation`]), as long as few pairs are in
//! contact.
//!
//! Two windows take a Hertz contact from its entry to its release, if no sample of the record comes between, where
//! power series need twenty steps. A window is used only if bounds prove that no other event happens in it (see
//! [`certificate`]); otherwise the step is taken by power series in time.

pub mod certificate;
pub mod elastic;
pub mod follow;
pub mod kernels;
pub mod quantity;
pub mod solution;
pub mod spring;
pub mod trial;

use crate::collocation::{Ending, MOST_PAIRS, Tables, WindowWorkspace};
use crate::contact::Force;
use crate::engine::base::kinds::Refusal;
use crate::engine::base::planned::{Event, Planned};
use crate::engine::base::{Base, touching};
use crate::engine::system::System;
use crate::engine::system::buffers::Buffers;
use crate::engine::window::certificate::keeps_off;
use crate::engine::window::kernels::{Windows, are_for};
use crate::engine::window::solution::Window;
use crate::engine::window::trial::Trial;
use crate::structure::{EXACT, MotionSeries, dot, flight_order};

/// Allowed truncation error of a kernel, relative to the tolerance of one step.
const KERNEL_SHARE: f64 = 0.03;

/// Allowed error of the series of the motion without contact forces, relative to the tolerance of one step: it is the
/// whole motion's, of which the contact's is a small part.
const FREE_SHARE: f64 = 1e-3;

/// Allowed error of the iteration, relative to the tolerance of one step.
const SWEEP_SHARE: f64 = 0.3;

/// A contact is at rest if the part of its force that is not balanced, and its velocity, are below this share.
const AT_REST: f64 = 0.1;

/// Largest number of windows that are solved for one step.
const MOST_TRIES: usize = 5;

/// Assessment of a solved window.
enum Verdict {
    /// No other event happens in it, and its forces are accurate.
    Good,
    /// Another window is to be tried.
    Another(Trial),
    /// No window.
    Reject(Refusal),
}

impl Windows {
    /// Plans a window from the base, over `remaining` seconds at most and under the load in `work`, or says why there is
    /// none. `series` is for the motion without contact forces.
    pub fn plan(
        &self,
        system: &System,
        base: &Base,
        remaining: f64,
        planned: &mut Planned,
        (window, series): (&mut Window, &mut MotionSeries),
        (room, work): (&mut WindowWorkspace, &mut Buffers),
    ) -> Result<(), Refusal> {
        window.gather(base)?;
        let (whole, remaining) = (remaining, remaining.min(self.longest(system)));
        let mut trial = self.trial(system, base, window, remaining).ok_or(Refusal::StiffDashpot)?;
        let equation = self.set_equation(system, base, (window, series), work, trial.room());
        equation.ok_or(Refusal::QuickModes)?;
        let free = &*series;
        if (0..window.equation.closed).any(|place| window.is_at_rest(system, base, place)) {
            return Err(Refusal::AtRest);
        }
        self.watch(system, base, (window, free), trial.length);
        let tolerance = system.tolerance.step * base.velocity_scale;
        let mut is_known = false;
        for _ in 0..MOST_TRIES {
            let Window { equation, solution, .. } = window;
            is_known =
                solution.solve(equation, room, (trial.frame(), is_known), SWEEP_SHARE * tolerance * trial.length);
            if !is_known {
                // The expected event may come later than in this window, so one without an event is tried next.
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
            match self.assess(system, base, (window, free), work, trial, tolerance) {
                Verdict::Good => {
                    window.commit(system, free, planned, work, trial.ending, whole);
                    return Ok(());
                }
                Verdict::Another(next) => trial = next,
                Verdict::Reject(why) => return Err(why),
            }
        }
        Err(Refusal::Unsolved)
    }

    /// Sets the motion without contact forces and the kernels for windows up to `longest`, s, if series reach that far.
    fn set_equation(
        &self,
        system: &System,
        base: &Base,
        (window, series): (&mut Window, &mut MotionSeries),
        work: &Buffers,
        longest: f64,
    ) -> Option<()> {
        let System { structure, tolerance, impulse_response, .. } = system;
        let equation = &mut window.equation;
        equation.remainder = (KERNEL_SHARE * tolerance.step).max(1e-17);
        equation.powers = impulse_response.as_ref()?.powers(longest, equation.remainder)?;
        let order = flight_order(structure.fastest * longest, (FREE_SHARE * tolerance.step).max(EXACT))?;
        series.expand_flight(structure, base.motion(), work.loads(), (longest, order));
        (equation.scale, equation.terms) = (series.scale, series.order + 1);
        for place in 0..equation.closed {
            self.set_pair(system, base, (window, series), place);
        }
        Some(())
    }

    /// Sets the data of one pair of the window.
    fn set_pair(&self, system: &System, base: &Base, (window, series): (&mut Window, &MotionSeries), place: usize) {
        let Window { equation, contacts, .. } = window;
        let p = contacts[place];
        let contact = &base.contacts[p];
        let free = &mut equation.free[place];
        free[0] = if contact.in_contact() { contact.penetration.max(0.0) } else { contact.flight_start() };
        free[1] = contact.rate * equation.scale;
        series.dot_each(&system.pairs[p].row.modes, 2, free);
        equation.kernels[place][place] = *self.kernel(system, p, p, &mut None);
        for (other, q) in contacts.iter().enumerate().take(equation.closed).filter(|(other, _)| *other != place) {
            equation.kernels[place][other] = *self.kernel(system, p, *q, &mut None);
        }
    }

    /// Adds the open pairs that may come into contact within `length` seconds, as many as there is room for.
    fn watch(&self, system: &System, base: &Base, (window, free): (&mut Window, &MotionSeries), length: f64) {
        for (p, contact) in base.contacts.iter().enumerate().filter(|(_, contact)| !contact.in_contact()) {
            let place = window.equation.pairs;
            if place == MOST_PAIRS || system.pairs[p].law.is_rigid() {
                return;
            }
            let curvature = 2.0 * dot(&system.pairs[p].row.modes, free.term(2)).max(0.0) / (free.scale * free.scale);
            if keeps_off(contact, 2.0 * curvature, length) {
                continue;
            }
            window.contacts[place] = p;
            window.equation.pairs += 1;
            self.set_pair(system, base, (window, free), place);
        }
    }

    /// Assesses a solved window: accurate and certain, or the next one to try.
    fn assess(
        &self,
        system: &System,
        base: &Base,
        (window, free): (&Window, &MotionSeries),
        work: &mut Buffers,
        trial: Trial,
        tolerance: f64,
    ) -> Verdict {
        let Window { equation, solution, .. } = window;
        if let Some(next) = window.passed(trial) {
            return Verdict::Another(next);
        }
        // A pair that still approaches at the end is not released: its penetration is below the error of the iteration.
        if let Ending::Release(place) = trial.ending
            && solution.end[place].1 >= 0.0
        {
            return Verdict::Reject(Refusal::NotReleased);
        }
        let error = solution.velocity_error(equation) / tolerance;
        let allowed = self.allowed;
        if error > allowed {
            if let Some(least) = solution.rule.next() {
                return Verdict::Another(Trial { least, ..trial });
            }
            let share = libm::pow(allowed / error, 1.0 / trial.order());
            return Verdict::Another(trial.shorter((0.9 * share).max(0.3)));
        }
        match self.is_certain(system, base, (window, free), work, trial.ending) {
            true => Verdict::Good,
            // An event may be so near that bounds cannot exclude it: power series find it.
            false if trial.ending != Ending::Given || trial.halved => Verdict::Reject(Refusal::Uncertain),
            false => Verdict::Another(Trial { halved: true, ..trial.shorter(0.5) }),
        }
    }
}

/// Index of the first of some numbers, at the nodes and then at the end, for which `is_it` holds. Nodes are tested by
/// fours.
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
    /// Lists the pairs in contact, if they are few enough and under laws that windows are for.
    fn gather(&mut self, base: &Base) -> Result<(), Refusal> {
        self.equation.closed = 0;
        for (p, contact) in touching(base) {
            let force = contact.branch();
            // An entry with an approach velocity of only rounding is left to other kinds of step.
            let enters = contact.penetration > 0.0 || contact.rate > 0.0;
            let place = self.equation.closed;
            match () {
                _ if place == MOST_PAIRS => return Err(Refusal::ManyContacts),
                _ if contact.is_held() || !are_for(&force) => return Err(Refusal::OtherLaw),
                _ if !enters => return Err(Refusal::SlowEntry),
                _ => {}
            }
            self.contacts[place] = p;
            self.equation.forces[place] = force;
            self.equation.closed += 1;
        }
        self.equation.pairs = self.equation.closed;
        Ok(())
    }

    /// Whether a pair is pressed together almost without motion: its contact force and the forces that it balances
    /// nearly cancel. A window would add up both separately and lose digits; a power series adds up their small
    /// difference. Buildings that lean on each other do not lose any that the tolerance asks for.
    fn is_at_rest(&self, system: &System, base: &Base, place: usize) -> bool {
        let Window { equation, contacts, .. } = self;
        let (p, force) = (contacts[place], equation.forces[place]);
        let (d, rate) = (base.contacts[p].penetration, base.contacts[p].rate);
        let pushed = equation.kernels[place][place][1] * force.value(d, rate);
        let left = 2.0 * equation.free[place][2] / (equation.scale * equation.scale) - pushed;
        let stored = force.stored_energy(d) / system.pairs[p].mass;
        left.abs() < AT_REST * pushed && 0.5 * rate * rate < AT_REST * AT_REST * stored
    }

    /// Makes a solved window the planned step.
    fn commit(
        &self,
        system: &System,
        free: &MotionSeries,
        planned: &mut Planned,
        work: &mut Buffers,
        ending: Ending,
        remaining: f64,
    ) {
        let (length, contacts) = (self.solution.length, self.contacts);
        let event = match ending {
            Ending::Given => None,
            Ending::Release(place) => Some(Event::Release(contacts[place])),
            Ending::Turn(place) => Some(Event::Branch(contacts[place])),
            Ending::Touch(place) => Some(Event::Entry(contacts[place])),
        };
        planned.plan(length, event, length == remaining && event.is_none(), Some(length));
        self.evaluate(system, (free, &mut work.powers), length, planned.motion_mut());
    }

    /// A trial up to the first event that a solved window has passed; `None` if it has passed none.
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
            // At its ending, a release or entry, the pair is at the surface: only nodes before the end are tested for
            // that event.
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
