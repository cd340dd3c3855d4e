//! A step in contact: power series in time of all modes, with the forces of the floors in contact.
//!
//! The modes are linear, so each power of their series follows from the ones before at the cost of a few vector
//! operations; only the contact forces need products of scalar series. The step is as long as the last terms allow.

use super::complementarity::Complementarity;
use super::model::{Model, Pair};
use super::roots;
use super::state::*;
use crate::contact::Force;
use crate::contact::series::PairSeries;
use crate::polynomial::{Coefficients, MAX_ORDER, Powers, rough_root};
use crate::structure::{LANES, ModalSeries, PairForces, difference, dot};

/// Share of `relative_tolerance` that one step may use: an episode takes some thirty steps and an earthquake some
/// hundred episodes, whose errors add up. With this share the golden scenes of `tests/golden.rs` come out within
/// `relative_tolerance`; with ten times as much, `hertz` is ten times worse for 4 % fewer steps.
const STEP_SHARE: f64 = 0.002;

/// Velocity that a force may cause which is left out at the singular start of a power law, as a share of a step's
/// tolerance.
const START_SHARE: f64 = 0.1;

/// Velocity error of one step relative to the velocity scale, and the order of the series, for a scene's tolerance.
pub(super) fn accuracy(relative_tolerance: f64) -> (f64, usize) {
    let tolerance = STEP_SHARE * relative_tolerance;
    // 1.2 for each digit is about cheapest: with 0.9 whole runs took 15 to 20 % longer, with 1.5 no less (one and three
    // storeys a side; hertz, jankowski, kelvin_voigt).
    let order = (-1.2 * libm::log10(tolerance)).round().clamp(8.0, (MAX_ORDER - 2) as f64);
    (tolerance, order as usize)
}

/// Share of the time left for which floors are held together that rounding cannot tell from free ones.
const SHORT_WHILE: f64 = 1e-3;

impl Model {
    /// Works out the step in contact from the base until `limit` (s since the segment's start) or the next event.
    pub(super) fn plan_contact(&self, state: &mut State, limit: f64) {
        state.base.velocity_scale = state.base.velocity_scale.max(self.present_velocity(&state.base));
        let (remaining, cut) = match self.time_for_rigid_pairs(state, limit - state.base.elapsed) {
            Ok(time) => time,
            Err(event) => return happen_now(state, event),
        };
        if let Some(p) = self.entry_at_once(&state.base) {
            return happen_now(state, Event::Entry(p));
        }
        let is_singular = touching(&state.base).any(|(_, contact)| contact.is_singular());
        if is_singular && !self.has_close_rigid_pair(&state.base) && self.plan_onset(state, remaining) {
            return;
        }
        let State { base, step, inputs, counters, work, .. } = state;
        counters.contact_steps += 1;
        step.ends.clear();
        self.load(base, inputs, &mut work.load, &mut work.slope);
        let scale = self.series_scale(base, remaining);
        self.expand(base, step, work, scale);
        let reach = self.accurate_reach(base, step, remaining / scale);
        let whole = remaining / scale <= reach;
        let end = if whole { remaining / scale } else { reach };
        step.end.set(end, step.series.order);
        let event = self.first_event(base, step, work);
        let x = event.map_or(end, |(x, _)| x);
        if event.is_some() {
            step.end.set(x, step.series.order);
        }
        step.kind = StepKind::Contact;
        step.event = event.map(|(_, event)| event);
        step.reaches_limit = whole && !cut && event.is_none();
        step.length = if step.reaches_limit { remaining } else { x * scale };
        step.series.evaluate(&step.end, &mut step.q, &mut step.v);
        self.carry(base, &step.series, x, &mut work.scalar, &mut step.carried);
        for (contact, pair) in base.contacts.iter_mut().zip(&step.pairs).filter(|(contact, _)| contact.is_held()) {
            contact.reaction = pair.force[0];
        }
        base.last_length = reach * scale;
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
        touching(base)
            .filter(|(_, contact)| contact.penetration > 0.0 && !contact.branch().is_regular() && contact.rate != 0.0)
            .map(|(_, contact)| contact.penetration / contact.rate.abs())
            .fold(last.min(remaining), f64::min)
    }

    /// A pair that stands at the surface and approaches: it enters now, together with another.
    fn entry_at_once(&self, base: &Base) -> Option<usize> {
        let at_surface = |contact: &Contact| contact.at_surface || contact.penetration >= 0.0;
        base.contacts.iter().position(|contact| !contact.in_contact() && at_surface(contact) && contact.rate > 0.0)
    }

    /// The series of modes, penetrations and forces from the base on.
    fn expand(&self, base: &Base, step: &mut Step, work: &mut Workspace, scale: f64) {
        let Step { series, pairs, .. } = step;
        series.start(scale, &base.q, &base.v);
        work.soft.clear();
        work.laws.clear();
        for (p, contact) in touching(base) {
            pairs[p].start(contact.penetration, contact.rate * scale);
            if !contact.is_held() {
                work.soft.push(p);
                work.laws.push(contact.starting_force());
            }
        }
        let mut soft = SoftPairs { model: self, base, pairs, numbers: &work.soft, laws: &work.laws, scale };
        let count = soft.numbers.len();
        if self.structure.is_classical() && work.rigid.pairs.is_empty() {
            let loads = (&work.load[..], &work.slope[..]);
            let rows = (&self.rows[..], soft.numbers);
            let room = (&mut work.forces[..count], &mut work.gathered[..count]);
            series.expand_in_contact(&self.structure, self.order + 1, loads, rows, &mut soft, room);
            return;
        }
        for n in 0..self.order {
            self.extend_together(series, &mut soft, (&work.load, &work.slope), &mut work.rigid, &mut work.forces, n);
        }
    }

    /// One power where damping couples modes or floors are held together.
    fn extend_together(
        &self,
        series: &mut ModalSeries,
        soft: &mut SoftPairs<'_>,
        (load, slope): (&[f64], &[f64]),
        rigid: &mut Complementarity,
        forces: &mut [f64],
        n: usize,
    ) {
        let scale = series.scale;
        for (k, force) in forces.iter_mut().enumerate().take(soft.numbers.len()) {
            *force = soft.force(k, n);
        }
        let load_of_power = |out: &mut [f64]| {
            match n {
                0 => out.copy_from_slice(load),
                1 => out.iter_mut().zip(slope).for_each(|(out, slope)| *out = slope * scale),
                _ => {}
            }
            for (&p, force) in soft.numbers.iter().zip(&*forces) {
                for (out, row) in out.iter_mut().zip(&self.pairs[p].row) {
                    *out -= row * force;
                }
            }
        };
        series.extend(&self.structure, load_of_power, |acceleration| self.hold(rigid, acceleration));
        for (&k, reaction) in rigid.pairs.iter().zip(&rigid.found) {
            let pair = &mut soft.pairs[self.rigid.pairs[k]];
            pair.force[n] = *reaction;
            pair.order = n;
        }
        let term = series.term(n + 2);
        for (k, &p) in soft.numbers.iter().enumerate() {
            soft.advance(k, n + 2, dot(&self.pairs[p].row, term), term);
        }
    }

    /// How far, in units of the series' scale, its last two terms stay below the tolerance.
    ///
    /// It is the velocity that is controlled: over a contact of a millisecond a displacement error is a velocity error
    /// a thousand times larger.
    fn accurate_reach(&self, base: &Base, step: &Step, whole: f64) -> f64 {
        let series = &step.series;
        let allowed = self.step_tolerance * base.velocity_scale * series.scale;
        let mut reach = f64::INFINITY;
        for n in [series.order - 1, series.order] {
            let term = n as f64 * self.worst_floor(series.term(n));
            if term > 0.0 {
                reach = reach.min(match allowed {
                    0.0 => self.reach_from_rest(series, n, term),
                    _ => rough_root(allowed / term, n - 1),
                });
            }
        }
        reach *= 0.9;
        for (p, contact) in touching(base).filter(|(_, contact)| contact.is_singular()) {
            let law = contact.branch();
            let terms = &step.pairs[p].penetration[..=series.order];
            let left_out = |x: f64| {
                let (penetration, rate) =
                    terms.iter().rev().fold((0.0, 0.0), |(value, slope), c| (value * x + c.abs(), slope * x + value));
                law.value(penetration, rate / series.scale) * x * series.scale / self.pairs[p].mass
            };
            reach = reach.min(self.forceless_reach(left_out, base.velocity_scale, series, whole));
        }
        reach
    }

    /// How far a last term stays below the tolerance where nothing has moved yet: relative to the velocity that any of
    /// the terms before it brings about by then.
    fn reach_from_rest(&self, series: &ModalSeries, last: usize, last_term: f64) -> f64 {
        (2..last / 2)
            .map(|n| {
                let term = n as f64 * self.worst_floor(series.term(n));
                libm::pow(self.step_tolerance * term / last_term, 1.0 / (last - n) as f64)
            })
            .fold(0.0, f64::max)
    }

    /// How far a power law's force may be left out after an entry: the velocity that it would have caused, m/s, stays a
    /// small share of what there is and what the step brings about.
    fn forceless_reach(&self, left_out: impl Fn(f64) -> f64, speed: f64, series: &ModalSeries, whole: f64) -> f64 {
        let gained = [2, 3, 4].map(|n| n as f64 * self.worst_floor(series.term(n)) / series.scale);
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

    /// Largest floor displacement, velocity ... that any one mode of a modal vector stands for.
    pub(super) fn worst_floor(&self, modal: &[f64]) -> f64 {
        let mut largest = [0.0_f64; LANES];
        for (modal, weight) in modal.chunks_exact(LANES).zip(self.structure.weight.chunks_exact(LANES)) {
            for i in 0..LANES {
                largest[i] = largest[i].max(modal[i].abs() * weight[i]);
            }
        }
        largest.iter().fold(0.0, |a, b| a.max(*b))
    }

    /// The velocity that contact errors are measured against: of the floors, or what the springs can give them.
    fn present_velocity(&self, base: &Base) -> f64 {
        let floors = self.worst_floor(&base.v);
        // What is stored later comes from the motion that has been seen.
        if base.last_length > 0.0 {
            return floors;
        }
        let springs = base.contacts.iter().zip(&self.pairs).map(|(contact, pair)| {
            (2.0 * contact.branch().stored_energy(contact.penetration.max(0.0)) / pair.mass).sqrt()
        });
        springs.fold(floors, f64::max)
    }

    /// The first event up to the end of the step's series.
    fn first_event(&self, base: &Base, step: &Step, work: &mut Workspace) -> Option<(f64, Event)> {
        let end = step.end.x;
        let mut first: Option<(f64, Event)> = None;
        let mut growth = None;
        for (p, (contact, pair)) in base.contacts.iter().zip(&self.pairs).enumerate() {
            let until = first.map_or(end, |(x, _)| x);
            let found = if contact.in_contact() {
                self.leaving(p, contact, step, work, until)
            } else {
                let growth = *growth.get_or_insert_with(|| self.growth(step, end));
                self.entering(p, contact, pair, step, work, until, growth)
            };
            first = found.or(first);
        }
        first
    }

    /// Bound on what the powers from 2 on add to any penetration within the step, m.
    fn growth(&self, step: &Step, end: f64) -> f64 {
        let series = &step.series;
        let mut sum = 0.0;
        for n in (2..=series.order).rev() {
            let term: f64 = series.term(n).iter().zip(&self.pair_weight).map(|(q, weight)| q.abs() * weight).sum();
            sum = (sum + term) * end;
        }
        sum * end
    }

    /// Release or change of branch of a pair in contact.
    fn leaving(
        &self,
        p: usize,
        contact: &Contact,
        step: &Step,
        work: &mut Workspace,
        end: f64,
    ) -> Option<(f64, Event)> {
        if contact.undecided {
            return None;
        }
        if contact.is_held() {
            return self.letting_go(p, step, work, end);
        }
        let pair = &step.pairs[p];
        let depth = if contact.at_surface && contact.rate == 0.0 { self.noise_of(p, step, work) } else { 0.0 };
        let first = release(pair, &step.end, &mut work.scalar, (end, depth)).map(|x| (x, Event::Release(p)));
        let Some(guard) = contact.force.guard else { return first };
        let until = first.map_or(end, |(x, _)| x);
        let sense = if contact.phase == Phase::Engaged { -1.0 } else { 1.0 };
        pair.guard(&guard, step.series.scale, sense, &mut work.scalar);
        let value = &mut work.scalar;
        if roots::ceiling((value[0].min(0.0), value[1]), step.end.x, &step.end.read(value)) <= 0.0 {
            return first;
        }
        match roots::first_rise(&mut value[..=pair.order], until, 0.0) {
            Some(x) if x < until || first.is_none() => Some((x, Event::Branch(p))),
            _ => first,
        }
    }

    /// m, rounding error of a penetration within the step.
    fn noise_of(&self, p: usize, step: &Step, work: &mut Workspace) -> f64 {
        let pair = &self.pairs[p];
        pair.noise(step.series.project(&pair.row, step.end.x, &mut work.scalar[..=step.series.order]))
    }

    /// Entry of a pair that is apart.
    #[expect(clippy::too_many_arguments, reason = "one place in the loop over pairs")]
    fn entering(
        &self,
        p: usize,
        contact: &Contact,
        pair: &Pair,
        step: &Step,
        work: &mut Workspace,
        end: f64,
        growth: f64,
    ) -> Option<(f64, Event)> {
        let series = &step.series;
        let start = contact.flight_start();
        if start + (contact.rate * series.scale * end).max(0.0) + growth < 0.0 {
            return None;
        }
        let penetration = &mut work.scalar[..=series.order];
        let noise = pair.noise(series.project(&pair.row, end, penetration));
        let noise = contact.begin_flight(penetration, series.scale, noise);
        roots::first_rise(penetration, end, noise).map(|x| (x, Event::Entry(p)))
    }
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

/// The pairs in contact whose force follows from their penetration.
struct SoftPairs<'a> {
    model: &'a Model,
    base: &'a Base,
    pairs: &'a mut [PairSeries],
    numbers: &'a [usize],
    laws: &'a [Force],
    scale: f64,
}

impl PairForces for SoftPairs<'_> {
    #[inline]
    fn force(&mut self, k: usize, n: usize) -> f64 {
        let p = self.numbers[k];
        let pair = &mut self.pairs[p];
        pair.extend_force(&self.laws[k], n, self.scale);
        pair.force[n]
    }

    #[inline]
    fn advance(&mut self, k: usize, n: usize, penetration: f64, term: &[f64]) {
        let p = self.numbers[k];
        let at_surface = self.base.contacts[p].at_surface;
        let cancelled = || difference(&self.model.pairs[p].row, term).0;
        self.pairs[p].set_penetration(n, if at_surface { cancelled() } else { penetration });
    }
}

/// Where the penetration is back at 0, up to `until`; at -`depth` for a pair that has entered without any speed, whose
/// first terms may be rounding.
fn release(pair: &PairSeries, end: &Powers, distance: &mut Coefficients, (until, depth): (f64, f64)) -> Option<f64> {
    // Distance to the surface, positive once d has passed 0 downwards.
    for (out, d) in distance.iter_mut().zip(&pair.penetration) {
        *out = -d;
    }
    distance[0] -= depth;
    if roots::ceiling((distance[0].min(0.0), distance[1]), end.x, &end.read(distance)) <= 0.0 {
        return None;
    }
    roots::first_rise(&mut distance[..=pair.order + 2], until, 0.0)
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
    fn starting_force(&self) -> Force {
        if self.is_singular() { Force::None } else { self.branch() }
    }
}
