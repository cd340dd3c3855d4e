//! The first step after an entry under a power law: a double power series of the motion (see [`crate::contact::onset`]).
//!
//! The step ends before anything else can happen - a turn, a release, an entry elsewhere -, shown by bounds on the sums
//! of its terms, so it has no event of its own.

use super::contact_step::touching;
use super::model::Model;
use super::state::*;
use crate::contact::Force;
use crate::contact::force::power;
use crate::contact::onset::{Grid, MOST_TERMS, OnsetPair, value_and_slope, values_and_slopes};
use crate::quadrature::{TWELVE, graded};
use crate::structure::LANES;

/// Highest power of x of the double series: its cost grows with the square, its reach hardly.
const HIGHEST: f64 = 10.0;

/// The double series of the motion and of all contacts.
#[derive(Clone, Debug, Default)]
pub(super) struct OnsetSeries {
    grid: Option<Grid>,
    lanes: usize,
    terms: Vec<f64>,
    pub pairs: Vec<OnsetPair>,
    /// s.
    pub scale: f64,
}

impl OnsetSeries {
    /// Room for the largest grid; none where no law needs one.
    pub fn new(lanes: usize, pairs: usize, needed: bool) -> OnsetSeries {
        if !needed {
            return OnsetSeries::default();
        }
        let terms = vec![0.0; MOST_TERMS * lanes];
        OnsetSeries { grid: None, lanes, terms, pairs: vec![OnsetPair::default(); pairs], scale: 1.0 }
    }

    fn term(&self, index: usize) -> &[f64] {
        &self.terms[index * self.lanes..(index + 1) * self.lanes]
    }

    /// u and v at x > 0.
    pub fn evaluate(&self, x: f64, q: &mut [f64], v: &mut [f64]) {
        let Some(grid) = &self.grid else { return };
        let z = power(x, grid.beta);
        let rate = 1.0 / (x * self.scale);
        for chunk in (0..self.lanes).step_by(LANES) {
            let (mut value, mut slope, mut factor) = ([0.0; LANES], [0.0; LANES], 1.0);
            for j in 0..grid.rows {
                let (mut r, mut s) = ([0.0; LANES], [0.0; LANES]);
                for i in (0..=grid.last(j)).rev() {
                    let exponent = grid.exponent(i, j);
                    let term = &self.term(grid.index(i, j))[chunk..chunk + LANES];
                    for m in 0..LANES {
                        r[m] = r[m] * x + term[m];
                        s[m] = s[m] * x + exponent * term[m];
                    }
                }
                for m in 0..LANES {
                    value[m] += factor * r[m];
                    slope[m] += factor * s[m];
                }
                factor *= z;
            }
            q[chunk..chunk + LANES].copy_from_slice(&value);
            for m in 0..LANES {
                v[chunk + m] = slope[m] * rate;
            }
        }
    }
}

impl Model {
    /// Works out the first step of an episode; `false` where a plain step has to do it: entries without speed to
    /// speak of, or of different laws at the same instant.
    pub(super) fn plan_onset(&self, state: &mut State, remaining: f64) -> bool {
        let State { base, step, inputs, counters, work, .. } = state;
        self.load(base, inputs, &mut work.load, &mut work.slope);
        let Some((grid, scale)) = self.onset_grid(base, work, remaining) else { return false };
        self.expand_onset(base, &mut step.onset, work, grid, scale);
        let accurate = self.onset_reach(base, &step.onset, &grid);
        let Some(x) = self.certain_reach(base, &step.onset, &grid, accurate.min(remaining / scale)) else {
            return false;
        };
        counters.contact_steps += 1;
        counters.law_evaluations += base.count_forces(Contact::branch);
        step.carried.fill(None);
        step.ends.clear();
        step.kind = StepKind::Onset;
        step.event = None;
        step.reaches_limit = x * scale >= remaining;
        step.length = if step.reaches_limit { remaining } else { x * scale };
        step.onset.evaluate(step.length / scale, &mut step.q, &mut step.v);
        base.last_length = step.length;
        true
    }

    /// The grid that all entering pairs share, and the time in which the quickest of them would turn round.
    fn onset_grid(&self, base: &Base, work: &mut Workspace, remaining: f64) -> Option<(Grid, f64)> {
        let mut found: Option<Grid> = None;
        let mut scale = self.series_scale(base, remaining);
        let allowed = self.step_tolerance * base.velocity_scale;
        self.accelerate(base.coordinates, (&base.q, &base.v), &work.load, &mut work.q);
        for (p, contact) in base.contacts.iter().enumerate().filter(|(_, contact)| contact.is_singular()) {
            let force = contact.branch();
            let grid = Grid::of(&force, HIGHEST)?;
            if found.is_some_and(|other| other.beta != grid.beta) || contact.rate <= 0.0 {
                return None;
            }
            found = Some(grid);
            let pair = &self.pairs[p];
            scale = scale.min(turning_time(&force, pair.mass, contact.rate));
            // Where acceleration overtakes the entry speed before the force amounts to anything, that speed is noise.
            let overtaken = contact.rate / self.relative(p, base.coordinates, &work.q).abs();
            let gained = force.value(1.5 * contact.rate * overtaken, contact.rate) * overtaken / pair.mass;
            if gained < allowed {
                return None;
            }
        }
        found.map(|grid| (grid, scale))
    }

    /// All terms, row by row: u_(i+2) from the force, load, damping and stiffness terms two powers of x below.
    fn expand_onset(&self, base: &Base, onset: &mut OnsetSeries, work: &Workspace, grid: Grid, scale: f64) {
        let lanes = self.structure.lanes;
        onset.grid = Some(grid);
        onset.scale = scale;
        onset.terms[2 * lanes..grid.terms() * lanes].fill(0.0);
        onset.terms[..lanes].copy_from_slice(&base.q);
        for (term, v) in onset.terms[lanes..].iter_mut().zip(&base.v) {
            *term = v * scale;
        }
        for (p, contact) in touching(base) {
            onset.pairs[p].start(&grid, contact.penetration, contact.rate * scale, contact.is_singular());
        }
        for j in 0..grid.rows {
            for (p, contact) in touching(base).filter(|(_, contact)| contact.is_singular()) {
                onset.pairs[p].extend_entering_row(&grid, &contact.branch(), j, scale);
            }
            let first = if j == 0 { 2 } else { 1 };
            for i in first..=grid.last(j) {
                self.extend_onset(base, onset, work, &grid, i, j);
            }
        }
    }

    /// One term x^(i + beta j) of the motion.
    fn extend_onset(&self, base: &Base, onset: &mut OnsetSeries, work: &Workspace, grid: &Grid, i: usize, j: usize) {
        let (lanes, scale) = (self.structure.lanes, onset.scale);
        let here = grid.index(i, j);
        let exponent = grid.exponent(i, j);
        let (known, rest) = onset.terms.split_at_mut(here * lanes);
        let next = &mut rest[..lanes];
        let mut moved = &self.structure.floors.rest[..];
        if i >= 2 {
            for (p, contact) in touching(base).filter(|(_, contact)| !contact.is_singular()) {
                onset.pairs[p].extend_touching(grid, &contact.branch(), i - 2, j, scale);
            }
            match (i - 2, j) {
                (0, 0) => next.copy_from_slice(&work.load),
                (1, 0) => next.iter_mut().zip(&work.slope).for_each(|(next, slope)| *next = slope * scale),
                _ => {}
            }
            moved = &known[(here - 2) * lanes..];
        }
        let moving = &known[(here - 1) * lanes..];
        let rate = (exponent - 1.0) / scale;
        self.resist(base.coordinates, moved, moving, rate, next);
        for (p, _) in touching(base) {
            self.push_apart_by(p, base.coordinates, onset.pairs[p].force[here - 1], next);
        }
        let factor = scale * scale / (exponent * (exponent - 1.0));
        for next in next.iter_mut() {
            *next *= factor;
        }
        for (p, _) in touching(base) {
            let value = self.relative(p, base.coordinates, &onset.terms[here * lanes..(here + 1) * lanes]);
            onset.pairs[p].set_penetration(grid, i, j, value);
        }
    }

    /// How far the last terms stay below the tolerance. Free masses have the terms x^(1 + beta j) only, and the last row
    /// begins up to one power of x and one of z below the highest.
    fn onset_reach(&self, base: &Base, onset: &OnsetSeries, grid: &Grid) -> f64 {
        let allowed = self.step_tolerance * base.velocity_scale * onset.scale;
        let mut last = [0.0; MOST_TERMS];
        grid.each(|index, exponent| {
            if exponent > HIGHEST - 1.0 - grid.beta {
                last[index] = exponent * self.worst_floor(base.coordinates, onset.term(index));
            }
        });
        // The sum goes nearly as a power of x: a few secant steps in logarithms.
        let mut x = 1.0;
        for _ in 0..3 {
            let error = grid.sum(&last, x) / x;
            if error <= 0.0 {
                return f64::INFINITY;
            }
            x *= libm::pow(allowed / error, 1.0 / (HIGHEST - 1.5));
        }
        0.9 * x
    }

    /// How far it is certain, up to `reach`, that no contact changes its state.
    fn certain_reach(&self, base: &Base, onset: &OnsetSeries, grid: &Grid, reach: f64) -> Option<f64> {
        let mut x = reach;
        let mut room = Room { grid, scale: onset.scale, sizes: [0.0; MOST_TERMS], turns: [0.0; MOST_TERMS] };
        for (p, contact) in base.contacts.iter().enumerate() {
            let start = if contact.in_contact() {
                let terms = &onset.pairs[p].penetration;
                room.set(|index| terms[index]);
                contact.penetration
            } else {
                room.set(|index| self.relative(p, base.coordinates, onset.term(index)));
                if contact.at_surface { 0.0 } else { contact.penetration.min(0.0) }
            };
            let mut tries = 0;
            while !room.holds(contact, start, x) {
                x *= 0.7;
                tries += 1;
                if tries > 60 {
                    return None;
                }
            }
        }
        Some(x)
    }
}

/// Sizes of a penetration's terms from x^2 on: how far it can get.
struct Room<'a> {
    grid: &'a Grid,
    scale: f64,
    sizes: [f64; MOST_TERMS],
    turns: [f64; MOST_TERMS],
}

impl Room<'_> {
    fn set(&mut self, term: impl Fn(usize) -> f64) {
        self.grid.each(|index, exponent| {
            self.sizes[index] = if index > 1 { term(index).abs() } else { 0.0 };
            self.turns[index] = exponent * self.sizes[index];
        });
    }

    /// Whether there is no room for an entry, a release or a change of branch within 0..=x, from penetration `d`.
    fn holds(&self, contact: &Contact, d: f64, x: f64) -> bool {
        let moved = self.grid.sum(&self.sizes, x);
        let step_rate = contact.rate * self.scale;
        if !contact.in_contact() {
            return if d == 0.0 { step_rate * x + moved < 0.0 } else { d + x * step_rate.max(0.0) + moved < 0.0 };
        }
        let turned = self.grid.sum(&self.turns, x) / x;
        if d <= 0.0 {
            // Entered now: it goes on deeper, which is also the engaged side of every guard.
            return step_rate > turned;
        }
        let inside = d + x * step_rate.min(0.0) - moved > 0.0;
        inside
            && contact.force.guard.is_none_or(|guard| {
                let change = guard.stiffness * (x * step_rate.abs() + moved) + guard.damping * turned / self.scale;
                guard.value(d, contact.rate).abs() > change
            })
    }
}

/// The time in which a power force stops a mass: k (V t)^n t = m V.
fn turning_time(force: &Force, mass: f64, speed: f64) -> f64 {
    let (stiffness, exponent) = match *force {
        Force::None => return f64::INFINITY,
        Force::Linear { stiffness, .. } => (stiffness, 1.0),
        Force::Power { stiffness, exponent, .. } => (stiffness, exponent),
        Force::Root { stiffness, .. } => (stiffness, 1.5),
    };
    libm::pow(mass * libm::pow(speed, 1.0 - exponent) / stiffness, 1.0 / (exponent + 1.0))
}

impl Contact {
    /// Follows the contact over 0..=x of an onset step: penetration, impulse, peaks, work.
    pub(super) fn follow_onset(&mut self, onset: &OnsetSeries, x: f64, start: f64) {
        let Some(grid) = &onset.grid else { return };
        let (pair, scale) = (&onset.pairs[self.episode.contact], onset.scale);
        let law = self.branch();
        let penetration = |x: f64| value_and_slope(grid, &pair.penetration, x);
        // The stored force terms are those of F x.
        let force = |x: f64| {
            let (product, slope) = value_and_slope(grid, &pair.force, x);
            (product / x, (slope - product / x) / x)
        };
        let mut primitive = [0.0; MOST_TERMS];
        grid.each(|index, exponent| {
            if index > 0 {
                primitive[index] = pair.force[index] / exponent;
            }
        });
        let impulse = grid.sum(&primitive, x);
        self.impulse += impulse * scale;
        self.episode.impulse += impulse * scale;
        if law.is_damped() {
            let (mut at, mut weights) = ([0.0; 12], [0.0; 12]);
            for ((at, weight), node) in at.iter_mut().zip(&mut weights).zip(graded(TWELVE, x)) {
                (*at, *weight) = node;
            }
            let (depths, rates) = values_and_slopes(grid, &pair.penetration, &at);
            let power = |i: usize| weights[i] * law.damping_power(depths[i], rates[i] / scale);
            self.work += scale * (0..12).map(power).sum::<f64>();
        }
        if let Some((at, peak)) = highest(force, x, self.episode.peak_force) {
            self.episode.peak_force = peak;
            self.episode.peak_time = start + at * scale;
            self.peak_force = self.peak_force.max(peak);
        }
        if let Some((_, peak)) = highest(penetration, x, self.episode.peak_penetration) {
            self.episode.peak_penetration = peak;
        }
        let (d, rate) = penetration(x);
        self.penetration = d;
        self.rate = rate / scale;
    }
}

/// The largest value of a smooth single-peaked curve of (value, slope) over 0..=end, if above `known`.
fn highest(curve: impl Fn(f64) -> (f64, f64), end: f64, known: f64) -> Option<(f64, f64)> {
    let (mut at, (mut value, slope)) = (end, curve(end));
    let (mut low, mut high) = (0.0, end);
    if slope < 0.0 && curve(1e-3 * end).1 > 0.0 {
        while high - low > 1e-9 * end {
            let middle = 0.5 * (low + high);
            if curve(middle).1 > 0.0 {
                low = middle;
            } else {
                high = middle;
            }
        }
        at = 0.5 * (low + high);
        value = curve(at).0;
    }
    (value > known).then_some((at, value))
}
