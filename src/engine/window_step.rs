//! A step in contact over a whole window (see [`crate::collocation`]), as long as few pairs are in contact.
//!
//! Two windows take a Hertz contact from its entry to its release, where power series need twenty steps. A window is taken
//! only if bounds show that nothing else happens in it: no pair apart comes into contact, none in contact is released or
//! passes its guard before the end. Where that cannot be shown power series in time go on.

use super::contact_step::touching;
use super::model::{Model, Pair};
use super::state::*;
use super::window::Window;
use crate::collocation::{Ending, MOST_PAIRS, Map, POWERS, Tables};
use crate::contact::force::power;
use crate::contact::{Force, Guard};
use crate::quadrature::{EIGHT, gauss};
use crate::structure::{EXACT, ImpulseResponse, Structure, dot, flight_order};

/// Relative accuracy of a step for which windows are as long as [`longest`] says.
const USUAL: f64 = 2e-11;

/// How far a kernel may be off, relative to what one step may.
const KERNEL_SHARE: f64 = 1e-3;

/// How far the iteration may be off, relative to what one step may.
const SWEEP_SHARE: f64 = 0.3;

/// Time since an entry, in units of the contact's, until which its root is felt.
const FRESH: f64 = 0.3;

/// What windows need to know of a scene.
#[derive(Clone, Debug)]
pub(super) struct Windows {
    pub response: ImpulseResponse,
    /// G of each pair by itself.
    kernels: Vec<[f64; POWERS]>,
}

impl Windows {
    /// `None` where no law needs them, or damping couples the modes.
    pub fn of(structure: &Structure, pairs: &[Pair], needed: bool) -> Option<Windows> {
        if !needed {
            return None;
        }
        let response = ImpulseResponse::of(structure)?;
        let kernels = pairs.iter().map(|pair| response.kernel(&pair.row, &pair.row)).collect();
        Some(Windows { response, kernels })
    }
}

/// A window that is to be tried.
#[derive(Clone, Copy, Debug)]
struct Draft {
    map: Map,
    /// s.
    length: f64,
    ending: Ending,
}

/// What has been found of a solved window.
enum Verdict {
    /// Nothing else happens in it, and its forces are right.
    Good,
    /// To be tried again.
    Another(Draft),
}

impl Model {
    /// Works out a window from the base on, over `remaining` seconds at most; `false` where power series have to do it.
    pub(super) fn plan_window(&self, state: &mut State, remaining: f64) -> bool {
        let Some(windows) = &self.windows else { return false };
        let State { base, step, inputs, counters, work, .. } = state;
        if base.coordinates != Coordinates::Modes || !self.gather(base, &mut step.window) {
            return false;
        }
        self.load(base, inputs, &mut work.load, &mut work.slope);
        let Some(mut draft) = self.draft(base, &mut step.window, remaining) else { return false };
        if !self.set_equation(windows, base, step, work, 1.5 * draft.length) {
            return false;
        }
        let tolerance = self.step_tolerance * base.velocity_scale;
        let mut tries = 0;
        loop {
            tries += 1;
            if tries > 5 {
                return false;
            }
            let Window { equation, solution, .. } = &mut *step.window;
            let how = (draft.map, draft.length, draft.ending);
            let is_solved = solution.solve(equation, &mut work.windows, how, SWEEP_SHARE * tolerance * draft.length);
            if !is_solved {
                draft = draft.shorter(0.5);
                continue;
            }
            if solution.length > remaining {
                draft = Draft { length: remaining, ..draft.shorter(1.0) };
                continue;
            }
            match self.judge(base, &step.window, work, draft, tolerance) {
                Verdict::Good => break,
                Verdict::Another(next) => draft = next,
            }
        }
        counters.contact_steps += 1;
        counters.law_evaluations += base.count_forces(Contact::branch);
        self.commit_window(base, step, work, draft.ending, remaining);
        true
    }

    /// The pairs in contact, if they are few enough and of laws that windows are for.
    fn gather(&self, base: &Base, window: &mut Window) -> bool {
        window.equation.pairs = 0;
        for (p, contact) in touching(base) {
            let force = contact.branch();
            let place = window.equation.pairs;
            let fits = match force {
                Force::Power { exponent, .. } => (2.0 * exponent).fract() == 0.0,
                Force::Root { .. } => true,
                Force::None | Force::Linear { .. } => false,
            };
            if place == MOST_PAIRS || contact.is_held() || !fits {
                return false;
            }
            // An entry whose speed is rounding is for the other kinds of step.
            if contact.penetration <= 0.0 && contact.rate <= 0.0 {
                return false;
            }
            window.contacts[place] = p;
            window.equation.forces[place] = force;
            window.equation.pairs += 1;
        }
        true
    }

    /// What to try first: up to the next event if it is near, half of the way to it otherwise.
    fn draft(&self, base: &Base, window: &mut Window, remaining: f64) -> Option<Draft> {
        let (mut longest, mut next) = (f64::INFINITY, (f64::INFINITY, Ending::Given));
        let mut map = Map::Plain;
        let patience = libm::pow(self.step_tolerance / USUAL, 0.055).clamp(0.4, 1.2);
        for place in 0..window.equation.pairs {
            let p = window.contacts[place];
            let (contact, force) = (&base.contacts[p], window.equation.forces[place]);
            let prospect = Prospect::of(&force, self.pairs[p].mass, contact.penetration.max(0.0), contact.rate)?;
            window.equation.omega[place] = 1.0 / prospect.unit;
            let is_root = matches!(force, Force::Root { .. });
            let since = if contact.penetration > 0.0 { base.time() - contact.episode.start } else { 0.0 };
            let is_fresh = since < FRESH * prospect.unit;
            longest = longest.min(longest_window(&force, is_fresh) * prospect.unit);
            map = match (is_fresh, is_root) {
                (true, true) => Map::FourthStart,
                (true, false) if map == Map::Plain => Map::SquareStart,
                _ => map,
            };
            let event = match is_root && contact.rate > 0.0 {
                true => (prospect.turn, Ending::Turn(place)),
                false => (prospect.release, Ending::Release(place)),
            };
            if event.0 < next.0 {
                next = event;
            }
        }
        let (time, ending) = next;
        longest *= patience;
        let draft = match ending {
            Ending::Turn(_) if time <= longest => Draft { map, length: time, ending },
            Ending::Release(_) if time <= longest && map == Map::Plain => {
                Draft { map: Map::SquareEnd, length: time, ending }
            }
            _ => {
                let parts = (time / longest).ceil().max(2.0);
                Draft { map, length: (time / parts).min(longest), ending: Ending::Given }
            }
        };
        if draft.length <= remaining {
            return Some(draft);
        }
        // Not up to just before a release: its root would be felt.
        let length = if matches!(ending, Ending::Release(_)) { remaining.min(0.8 * time) } else { remaining };
        Some(Draft { length, ..draft.shorter(1.0) })
    }

    /// Fills in the free motion and the kernels for windows up to `longest`, s; whether series reach that far.
    fn set_equation(&self, windows: &Windows, base: &Base, step: &mut Step, work: &Workspace, longest: f64) -> bool {
        let Step { window, series, .. } = step;
        let Window { equation, contacts, .. } = &mut **window;
        let scale = 2.0 * super::contact_step::power_of_two_below(longest);
        let remainder = (KERNEL_SHARE * self.step_tolerance).max(1e-17);
        let powers = windows.response.powers(longest, remainder);
        let (Some(powers), Some(order)) = (powers, flight_order(self.structure.fastest * scale, EXACT)) else {
            return false;
        };
        series.expand_flight(&self.structure, (&base.q, &base.v), (&work.load, &work.slope), (scale, order));
        (equation.scale, equation.powers, equation.terms) = (scale, powers, series.order + 1);
        for place in 0..equation.pairs {
            let p = contacts[place];
            let (contact, row) = (&base.contacts[p], &self.pairs[p].row);
            let free = &mut equation.free[place];
            (free[0], free[1]) = (contact.penetration.max(0.0), contact.rate * scale);
            for (n, term) in free.iter_mut().enumerate().take(series.order + 1).skip(2) {
                *term = dot(row, series.term(n));
            }
            for other in 0..equation.pairs {
                equation.kernels[place][other] = match other == place {
                    true => windows.kernels[p],
                    false => windows.response.kernel(row, &self.pairs[contacts[other]].row),
                };
            }
        }
        true
    }

    /// Whether a solved window is right and certain, or what to try instead.
    fn judge(&self, base: &Base, window: &Window, work: &mut Workspace, draft: Draft, tolerance: f64) -> Verdict {
        let Window { equation, solution, .. } = window;
        let theta = &Tables::of(solution.map).theta;
        // A node beyond a release: the window ends there.
        for place in 0..equation.pairs {
            if draft.ending == Ending::Release(place) {
                continue;
            }
            if let Some(i) = solution.depth[place].iter().position(|d| *d <= 0.0) {
                let length = theta[i] * solution.length;
                return Verdict::Another(match draft.map {
                    Map::Plain | Map::SquareEnd => {
                        Draft { map: Map::SquareEnd, length, ending: Ending::Release(place) }
                    }
                    _ => Draft { length: 0.5 * length, ..draft.shorter(1.0) },
                });
            }
        }
        // Rates beyond a turn: it ends there.
        for place in 0..equation.pairs {
            let is_root = matches!(equation.forces[place], Force::Root { .. });
            if is_root && draft.ending != Ending::Turn(place) {
                let rates = solution.rate[place].iter().chain([&solution.end[place].1]);
                if let Some(i) = rates.clone().position(|v| *v <= 0.0) {
                    let length = theta.get(i).unwrap_or(&1.0) * solution.length;
                    return Verdict::Another(Draft { map: draft.map, length, ending: Ending::Turn(place) });
                }
            }
        }
        let error = solution.velocity_error(equation) / tolerance;
        let allowed = 10.0 / libm::cbrt(self.step_tolerance);
        if error > allowed {
            let share = libm::pow(allowed / error, 0.1);
            return Verdict::Another(draft.shorter((0.9 * share).max(0.3)));
        }
        if !self.is_certain(base, window, work, draft.ending) {
            return Verdict::Another(draft.shorter(0.5));
        }
        Verdict::Good
    }

    /// Whether nothing but the ending happens in a window.
    fn is_certain(&self, base: &Base, window: &Window, work: &mut Workspace, ending: Ending) -> bool {
        self.bound_swings(base, window, work);
        let Window { contacts, equation, solution } = window;
        for place in 0..equation.pairs {
            let pair = &self.pairs[contacts[place]];
            let contact = &base.contacts[contacts[place]];
            let bend = bound(&pair.row, &work.node_q) + self.pushes(window, place, pair);
            if !stays(window, place, contact, bend, ending) {
                return false;
            }
        }
        let h = solution.length;
        for (r, contact) in base.contacts.iter().enumerate().filter(|(_, contact)| !contact.in_contact()) {
            let pair = &self.pairs[r];
            let bend = bound(&pair.row, &work.node_q) + self.pushes(window, MOST_PAIRS, pair);
            let start = contact.flight_start();
            // Below the parabola that leaves with the rate at the start and bends by as much as is possible.
            if start + h * contact.rate.max(-bend * h) + 0.5 * bend * h * h < 0.0 && contact.rate < -0.5 * bend * h
                || start + h * contact.rate.max(0.0) + 0.5 * bend * h * h < 0.0
            {
                continue;
            }
            return false;
        }
        true
    }

    /// Bounds on the accelerations of all modes but for contact forces within a window, in `work.node_q`.
    fn bound_swings(&self, base: &Base, window: &Window, work: &mut Workspace) {
        let h = window.solution.length;
        let Workspace { load, slope, node_q: bounds, .. } = work;
        let moments = window.moments(h);
        for (m, bound) in bounds.iter_mut().enumerate() {
            let push = load[m].abs() + slope[m].abs() * h;
            let (q, v, omega2) = (base.q[m], base.v[m], self.structure.omega2[m]);
            let mut size = (v * v + omega2 * q * q).sqrt() + push * h;
            for (p, moments) in window.contacts.iter().zip(&moments).take(window.equation.pairs) {
                size += (self.pairs[*p].row[m] * moments[0]).abs();
            }
            *bound = push + self.structure.quickness[m] * size;
        }
    }

    /// m/s^2, by how much the forces of the other pairs of a window may push a pair at once, where floors are shared.
    fn pushes(&self, window: &Window, place: usize, pair: &Pair) -> f64 {
        let mut push = 0.0;
        for other in (0..window.equation.pairs).filter(|other| *other != place) {
            let by = &self.pairs[window.contacts[other]];
            if by.lanes[0] == pair.lanes[0] || by.lanes[1] == pair.lanes[1] {
                let most = window.solution.force[other].iter().fold(0.0_f64, |most, force| most.max(force.abs()));
                push += 2.0 * most * (by.inverse_masses[0] + by.inverse_masses[1]);
            }
        }
        push
    }

    fn commit_window(&self, base: &mut Base, step: &mut Step, work: &mut Workspace, ending: Ending, remaining: f64) {
        let length = step.window.solution.length;
        step.kind = StepKind::Window;
        step.carried.fill(None);
        step.ends.clear();
        step.length = length;
        step.reaches_limit = length == remaining && ending == Ending::Given;
        step.event = match ending {
            Ending::Given => None,
            Ending::Release(place) => Some(Event::Release(step.window.contacts[place])),
            Ending::Turn(place) => Some(Event::Branch(step.window.contacts[place])),
        };
        let (mut q, mut v) = (std::mem::take(&mut step.q), std::mem::take(&mut step.v));
        self.read_window(step, length, &mut work.powers, (&mut q, &mut v));
        (step.q, step.v) = (q, v);
        base.last_length = length;
    }
}

impl Draft {
    /// A plain window of that share of the length.
    fn shorter(self, share: f64) -> Draft {
        let map = if self.map == Map::SquareEnd { Map::Plain } else { self.map };
        Draft { map, length: share * self.length, ending: Ending::Given }
    }
}

/// Longest window in units of the contact's time; half of a Hertz contact takes 1.61. Found by trying.
fn longest_window(force: &Force, is_fresh: bool) -> f64 {
    match (force, is_fresh) {
        (Force::Root { .. }, true) => 0.62,
        (Force::Root { .. }, false) => 1.0,
        (_, true) if force.is_damped() => 0.95,
        (_, false) if force.is_damped() => 1.3,
        _ => 1.65,
    }
}

/// Sum of sizes of products.
fn bound(row: &[f64], bounds: &[f64]) -> f64 {
    row.iter().zip(bounds).map(|(row, bound)| row.abs() * bound).sum()
}

/// Whether a pair certainly stays in contact and on its side of the guard until the end of a window, where all that is not
/// its own force, which pushes apart, bends its penetration by `bend` at most, m/s^2.
fn stays(window: &Window, place: usize, contact: &Contact, bend: f64, ending: Ending) -> bool {
    let solution = &window.solution;
    let theta = &Tables::of(solution.map).theta;
    let (mut time, mut depth) = (0.0, contact.penetration.max(0.0));
    let nodes = theta.iter().zip(&solution.depth[place]).map(|(theta, d)| (theta * solution.length, *d));
    for (next, d) in nodes.chain([(solution.length, solution.end[place].0)]) {
        let ends = ending == Ending::Release(place) && next == solution.length;
        let gone = next - time;
        // Forces that push apart bend it down: it is above the chord but for the rest.
        let sag = 0.5 * bend * gone;
        let stays = match () {
            _ if ends => depth / gone > sag,
            _ if depth == 0.0 => d / gone > sag,
            _ => depth.min(d) > 0.25 * sag * gone,
        };
        if !stays {
            return false;
        }
        (time, depth) = (next, d);
    }
    match contact.force.guard {
        None => true,
        Some(_) if contact.phase == Phase::Slack => recedes(window, place, contact, bend),
        Some(guard) => is_engaged(window, place, contact, &guard, bend, ending),
    }
}

/// Whether the guard of an engaged pair stays positive. Between two nodes the rate is at most that much below the one at
/// the second: forces only slow it down.
fn is_engaged(window: &Window, place: usize, contact: &Contact, guard: &Guard, bend: f64, ending: Ending) -> bool {
    let solution = &window.solution;
    let theta = &Tables::of(solution.map).theta;
    let mut time = 0.0;
    for (i, theta) in theta.iter().enumerate() {
        let next = theta * solution.length;
        let least = solution.rate[place][i] - bend * (next - time);
        if guard.value(solution.depth[place][i], least) <= 0.0 {
            return false;
        }
        time = next;
    }
    let (d, v) = solution.end[place];
    if ending == Ending::Turn(place) {
        // The force takes more off the rate than anything else can give.
        let spring = contact.branch().value(0.5 * d, 0.0);
        return spring * window.equation.kernels[place][place][1] > bend;
    }
    guard.value(d, v - bend * (solution.length - time)) > 0.0
}

/// Whether a pair goes apart all the time, of which only penetrations are known.
fn recedes(window: &Window, place: usize, contact: &Contact, bend: f64) -> bool {
    let solution = &window.solution;
    let theta = &Tables::of(solution.map).theta;
    let law = contact.branch();
    let softness = window.equation.kernels[place][place][1];
    let (mut time, mut depth, mut rate) = (0.0, contact.penetration, contact.rate);
    let nodes = theta.iter().zip(&solution.depth[place]).map(|(theta, d)| (theta * solution.length, *d));
    for (next, d) in nodes.chain([(solution.length, solution.end[place].0)]) {
        let gone = next - time;
        let spring = law.value(0.5 * depth.min(d).max(0.0), 0.0);
        if spring * softness <= bend && rate + bend * gone >= 0.0 {
            return false;
        }
        rate = rate.min((d - depth) / gone) + bend * gone;
        (time, depth) = (next, d);
    }
    true
}

/// What a spring alone would do with a pair.
struct Prospect {
    /// s, its time: (m V^(1-n) / k)^(1/(n+1)) for all of its energy.
    unit: f64,
    /// s, until it turns round.
    turn: f64,
    /// s, until it is released.
    release: f64,
}

impl Prospect {
    fn of(force: &Force, mass: f64, d: f64, rate: f64) -> Option<Prospect> {
        let (stiffness, n) = match *force {
            Force::Power { stiffness, exponent, .. } => (stiffness, exponent),
            Force::Root { stiffness, .. } => (stiffness, 1.5),
            Force::None | Force::Linear { .. } => return None,
        };
        let speed = (rate * rate + 2.0 * force.stored_energy(d) / mass).sqrt();
        let unit = libm::pow(mass * libm::pow(speed, 1.0 - n) / stiffness, 1.0 / (n + 1.0));
        let deepest = libm::pow(0.5 * (n + 1.0), 1.0 / (n + 1.0)) * unit * speed;
        let quarter = quarter(n, 0.0);
        let done = quarter - quarter_from(n, d / deepest, quarter);
        let time = deepest / speed;
        let (turn, release) = match rate >= 0.0 {
            true => ((quarter - done) * time, (2.0 * quarter - done) * time),
            false => (0.0, done * time),
        };
        (unit.is_finite() && unit > 0.0 && release > 0.0).then_some(Prospect { unit, turn, release })
    }
}

/// Integral of 1 / sqrt(1 - u^(n+1)) over from..1.
fn quarter(n: f64, from: f64) -> f64 {
    let width = 1.0 - from.min(1.0);
    gauss(EIGHT, 1.0)
        .map(|(y, weight)| {
            let left = width * y * y;
            let u = 1.0 - left;
            weight * 2.0 * width * y / (1.0 - power(u, n + 1.0)).max(1e-300).sqrt()
        })
        .sum()
}

fn quarter_from(n: f64, from: f64, all: f64) -> f64 {
    if from <= 0.0 { all } else { quarter(n, from) }
}
