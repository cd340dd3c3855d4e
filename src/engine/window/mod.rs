//! A step in contact over a whole window (see [`crate::collocation`]), as long as few pairs are in contact.
//!
//! Two windows take a Hertz contact from its entry to its release, if no sample of the record comes between, where power
//! series need twenty steps. A window is taken only if bounds show that nothing else happens in it (see
//! [`certificate`]). Where that cannot be shown power series in time go on.

pub mod certificate;
pub mod solution;
pub mod trial;

use crate::collocation::{Ending, Kernel, MOST_PAIRS, Tables};
use crate::contact::Force;
use crate::engine::base::contact::Contact;
use crate::engine::base::planned::Event;
use crate::engine::base::touching;
use crate::engine::base::{Base, Coordinates};
use crate::engine::model::Model;
use crate::engine::pairs::pair::Pair;
use crate::engine::state::{State, Workspace};
use crate::engine::step::{Step, StepKind};
use crate::engine::window::certificate::keeps_off;
use crate::engine::window::solution::Window;
use crate::engine::window::trial::{Draft, Spring, patience};
use crate::structure::{EXACT, ImpulseResponse, Structure, dot, flight_order};

/// How far a kernel may be off, relative to what one step may.
const KERNEL_SHARE: f64 = 0.03;

/// How far the series of the motion without contact forces may be off, relative to what one step may: it is of the whole
/// motion, of which a contact is a small part.
const FREE_SHARE: f64 = 1e-3;

/// How far the iteration may be off, relative to what one step may.
const SWEEP_SHARE: f64 = 0.3;

/// Error between the nodes of a window, relative to the power 2/3 of what one step may leave: at its end a Gauss rule is
/// far better than between its nodes.
const BETWEEN_NODES: f64 = 10.0;

/// Share of a contact's force that moves it, and of its speed, below which it is at rest.
const AT_REST: f64 = 0.1;

/// Pairs with dashpots that a window is for: of two, series by a clock cost about as much; found by trying.
const MOST_DAMPED: usize = 1;

/// Pairs of which all kernels are kept: 64 kB.
const MOST_KNOWN: usize = 20;

/// Windows that are tried for one step.
const MOST_TRIES: usize = 5;

/// What windows need to know of a scene.
#[derive(Clone, Debug)]
pub(in crate::engine) struct Windows {
    pub response: ImpulseResponse,
    /// G_pq of pairs p and q, one row after the other, where they are few.
    kernels: Vec<Kernel>,
    /// Error between nodes that a window may have, relative to what one step may.
    allowed: f64,
    /// Length of windows relative to the usual.
    pub patience: f64,
    /// Of each pair whose law has a root.
    pub springs: Vec<Option<Spring>>,
}

impl Windows {
    /// `None` where no law needs them, or damping couples the modes.
    pub fn of(structure: &Structure, pairs: &[Pair], step_tolerance: f64) -> Option<Windows> {
        let springs: Vec<Option<Spring>> = pairs.iter().map(Spring::of).collect();
        if springs.iter().all(Option::is_none) {
            return None;
        }
        let response = ImpulseResponse::of(structure)?;
        Tables::prepare();
        let known = if pairs.len() <= MOST_KNOWN { pairs } else { &[] };
        let kernels = known.iter().flat_map(|p| known.iter().map(|q| response.kernel(&p.row, &q.row))).collect();
        let allowed = BETWEEN_NODES / libm::cbrt(step_tolerance);
        Some(Windows { response, kernels, allowed, patience: patience(step_tolerance), springs })
    }
}

impl Windows {
    /// G_pq of two pairs, for which there is `room` where it is not kept.
    pub fn kernel<'a>(&'a self, pairs: &[Pair], p: usize, q: usize, room: &'a mut Option<Kernel>) -> &'a Kernel {
        match self.kernels.get(p * pairs.len() + q) {
            Some(known) => known,
            None => room.insert(self.response.kernel(&pairs[p].row, &pairs[q].row)),
        }
    }
}

/// What has been found of a solved window.
enum Verdict {
    /// Nothing else happens in it, and its forces are right.
    Good,
    /// To be tried again.
    Another(Draft),
    /// Not to be tried again.
    Hopeless,
}

impl Model {
    /// Works out a window from the base on, over `remaining` seconds at most; `false` where power series have to do it.
    pub(in crate::engine) fn plan_window(&self, state: &mut State, remaining: f64) -> bool {
        let Some(windows) = &self.windows else { return false };
        let State { base, step, inputs, counters, work, .. } = state;
        if base.coordinates != Coordinates::Modes || !self.gather(base, &mut step.window) {
            return false;
        }
        self.load(base, inputs, &mut work.load, &mut work.slope);
        let Some(mut draft) = self.draft(base, &mut step.window, remaining) else { return false };
        if !self.set_equation(windows, base, step, work, draft.room()) {
            return false;
        }
        if (0..step.window.equation.closed).any(|place| self.is_at_rest(base, &step.window, place)) {
            return false;
        }
        self.watch(windows, base, step, draft.length);
        let tolerance = self.step_tolerance * base.velocity_scale;
        for _ in 0..MOST_TRIES {
            let Window { equation, solution, .. } = &mut *step.window;
            if !solution.solve(equation, &mut work.windows, draft.frame(), SWEEP_SHARE * tolerance * draft.length) {
                // An event that is not where it was expected may be late.
                draft = match draft.ending {
                    Ending::Given => draft.shorter(0.5),
                    _ => draft.shorter(1.0).until(Ending::Given, draft.longest.min(equation.scale)),
                };
                continue;
            }
            if solution.length > remaining {
                draft = draft.shorter(1.0).until(Ending::Given, remaining.min(equation.scale));
                continue;
            }
            step.window.close();
            match self.judge(base, step, work, draft, tolerance) {
                Verdict::Good => {
                    counters.contact_steps += 1;
                    counters.law_evaluations += base.count_forces(Contact::branch);
                    self.commit_window(step, work, draft.ending, remaining);
                    return true;
                }
                Verdict::Another(next) => draft = next,
                Verdict::Hopeless => return false,
            }
        }
        false
    }

    /// The pairs in contact, if they are few enough and of laws that windows are for.
    fn gather(&self, base: &Base, window: &mut Window) -> bool {
        window.equation.closed = 0;
        for (p, contact) in touching(base) {
            let force = contact.branch();
            let fits = match force {
                Force::Power { exponent, .. } => (2.0 * exponent).fract() == 0.0,
                Force::Root { .. } => true,
                Force::None | Force::Linear { .. } => false,
            };
            // An entry whose speed is rounding is for the other kinds of step.
            let enters = contact.penetration > 0.0 || contact.rate > 0.0;
            let place = window.equation.closed;
            if place == MOST_PAIRS || contact.is_held() || !fits || !enters {
                return false;
            }
            window.contacts[place] = p;
            window.equation.forces[place] = force;
            window.equation.closed += 1;
        }
        let closed = window.equation.closed;
        window.equation.pairs = closed;
        closed <= MOST_DAMPED || window.equation.forces[..closed].iter().all(|force| !force.is_damped())
    }

    /// Fills in the free motion and the kernels for windows up to `longest`, s; whether series reach that far.
    fn set_equation(&self, windows: &Windows, base: &Base, step: &mut Step, work: &Workspace, longest: f64) -> bool {
        let Step { window, series, .. } = step;
        let equation = &mut window.equation;
        let remainder = (KERNEL_SHARE * self.step_tolerance).max(1e-17);
        let powers = windows.response.powers(longest, remainder);
        let exact = (FREE_SHARE * self.step_tolerance).max(EXACT);
        let (Some(powers), Some(order)) = (powers, flight_order(self.structure.fastest * longest, exact)) else {
            return false;
        };
        series.expand_flight(&self.structure, (&base.q, &base.v), (&work.load, &work.slope), (longest, order));
        equation.remainder = remainder;
        (equation.scale, equation.powers, equation.terms) = (longest, powers, series.order + 1);
        for place in 0..equation.closed {
            self.set_pair(windows, base, step, place);
        }
        true
    }

    /// Fills in what belongs to one pair of the window.
    fn set_pair(&self, windows: &Windows, base: &Base, step: &mut Step, place: usize) {
        let Step { window, series, .. } = step;
        let Window { equation, contacts, .. } = &mut **window;
        let p = contacts[place];
        let (contact, row) = (&base.contacts[p], &self.pairs[p].row);
        let free = &mut equation.free[place];
        free[0] = if contact.in_contact() { contact.penetration.max(0.0) } else { contact.flight_start() };
        free[1] = contact.rate * equation.scale;
        series.dot_each(row, 2, free);
        equation.kernels[place][place] = *windows.kernel(&self.pairs, p, p, &mut None);
        for (other, q) in contacts.iter().enumerate().take(equation.closed).filter(|(other, _)| *other != place) {
            equation.kernels[place][other] = *windows.kernel(&self.pairs, p, *q, &mut None);
        }
    }

    /// Whether a pair leans on another without moving much: its force and all that it holds off cancel, and a window adds
    /// them up apart, over and over; a power series adds up what is left of them.
    fn is_at_rest(&self, base: &Base, window: &Window, place: usize) -> bool {
        let Window { equation, contacts, .. } = window;
        let (p, force) = (contacts[place], equation.forces[place]);
        let (d, rate) = (base.contacts[p].penetration, base.contacts[p].rate);
        let pushed = equation.kernels[place][place][1] * force.value(d, rate);
        let left = 2.0 * equation.free[place][2] / (equation.scale * equation.scale) - pushed;
        let stored = force.stored_energy(d) / self.pairs[p].mass;
        left.abs() < AT_REST * pushed && 0.5 * rate * rate < AT_REST * AT_REST * stored
    }

    /// Adds the pairs that may come into contact over `length` seconds, as far as there is room.
    fn watch(&self, windows: &Windows, base: &Base, step: &mut Step, length: f64) {
        for (p, contact) in base.contacts.iter().enumerate().filter(|(_, contact)| !contact.in_contact()) {
            let place = step.window.equation.pairs;
            if place == MOST_PAIRS || self.pairs[p].law.is_rigid() {
                return;
            }
            let (row, scale) = (&self.pairs[p].row, step.series.scale);
            let bend = 2.0 * dot(row, step.series.term(2)).max(0.0) / (scale * scale);
            if keeps_off(contact, 2.0 * bend, length) {
                continue;
            }
            step.window.contacts[place] = p;
            step.window.equation.pairs += 1;
            self.set_pair(windows, base, step, place);
        }
    }

    /// Whether a solved window is right and certain, or what to try instead.
    fn judge(&self, base: &Base, step: &Step, work: &mut Workspace, draft: Draft, tolerance: f64) -> Verdict {
        let Some(windows) = &self.windows else { return Verdict::Hopeless };
        let Window { equation, solution, .. } = &*step.window;
        if let Some(next) = step.window.passed(draft) {
            return Verdict::Another(next);
        }
        // What still approaches is not released: its depth is below what the iteration leaves open.
        if let Ending::Release(place) = draft.ending
            && solution.end[place].1 >= 0.0
        {
            return Verdict::Hopeless;
        }
        let error = solution.velocity_error(equation) / tolerance;
        let allowed = windows.allowed;
        if error > allowed {
            if let Some(least) = solution.rule.next() {
                return Verdict::Another(Draft { least, ..draft });
            }
            let share = libm::pow(allowed / error, 0.1);
            return Verdict::Another(draft.shorter((0.9 * share).max(0.3)));
        }
        match self.is_certain(base, step, work, draft.ending) {
            true => Verdict::Good,
            // Near an event that bounds cannot tell: power series find it.
            false if draft.ending != Ending::Given || draft.halved => Verdict::Hopeless,
            false => Verdict::Another(Draft { halved: true, ..draft.shorter(0.5) }),
        }
    }

    fn commit_window(&self, step: &mut Step, work: &mut Workspace, ending: Ending, remaining: f64) {
        let (length, contacts) = (step.window.solution.length, step.window.contacts);
        step.kind = StepKind::Window;
        step.carried.fill(None);
        step.ends.clear();
        step.length = length;
        step.reaches_limit = length == remaining && ending == Ending::Given;
        step.event = match ending {
            Ending::Given => None,
            Ending::Release(place) => Some(Event::Release(contacts[place])),
            Ending::Turn(place) => Some(Event::Branch(contacts[place])),
            Ending::Touch(place) => Some(Event::Entry(contacts[place])),
        };
        let (mut q, mut v) = (std::mem::take(&mut step.q), std::mem::take(&mut step.v));
        self.read_window(step, length, &mut work.powers, (&mut q, &mut v));
        (step.q, step.v) = (q, v);
        step.next_length = Some(length);
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
    /// The window up to the first event that a solved one has passed.
    fn passed(&self, draft: Draft) -> Option<Draft> {
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
            let beyond = beyond.filter(|i| *i < theta.len() || draft.ending != event).map(|i| (i, event));
            let turns = is_closed && matches!(equation.forces[place], Force::Root { .. });
            let turned = if turns { first_node(&rate[..count], v, |v| v <= 0.0) } else { None };
            let turn = Ending::Turn(place);
            let turned = turned.filter(|i| *i < theta.len() || draft.ending != turn).map(|i| (i, turn));
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
            Ending::Release(_) => Some(Draft { map: draft.map.with_end(), ..draft.until(event, time) }),
            _ => Some(Draft { map: draft.map.without_end(), ..draft.until(event, time) }),
        }
    }
}
