//! What begins and ends the phases of the motion.

use super::{Piecewise, exponential};
use nalgebra::{DMatrix, DVector};

#[derive(Clone, Copy)]
pub enum Event {
    Yield(usize, f64),
    Turn(usize),
    Entry(usize),
    Release(usize),
}

/// A function of the state.
type Watched<'p> = Box<dyn Fn(&DVector<f64>) -> f64 + 'p>;

/// Between two impulses of a pair, s.
const SHORTEST: f64 = 2e-3;

impl Piecewise<'_> {
    /// Everything that can happen in the present phase: a function that becomes positive, and its rate.
    fn watched(&self) -> Vec<(Event, Watched<'_>, Watched<'_>)> {
        let mut all: Vec<(Event, Watched<'_>, Watched<'_>)> = Vec::new();
        for i in (0..self.system.storeys.len()).filter(|&i| self.system.storeys[i].can_yield) {
            let (limit, plastic, sense) = (self.system.storeys[i].limit, self.plastic[i], self.sense[i]);
            if sense != 0.0 {
                all.push((Event::Turn(i), Box::new(move |y| -sense * self.drift_rate(i, y)), Box::new(|_| 0.0)));
                continue;
            }
            for sense in [1.0, -1.0] {
                let excess = move |y: &DVector<f64>| {
                    let drift = self.drift(i, y);
                    let noise = 4.0 * f64::EPSILON * (limit + drift.abs() + plastic.abs());
                    sense * (drift - plastic) - limit - noise
                };
                let rate = move |y: &DVector<f64>| sense * self.drift_rate(i, y);
                all.push((Event::Yield(i, sense), Box::new(excess), Box::new(rate)));
            }
        }
        for p in 0..self.system.pairs.len() {
            if self.closed[p] {
                all.push((Event::Release(p), Box::new(move |y| -self.penetration(p, y)), Box::new(|_| 0.0)));
            } else {
                let excess =
                    move |y: &DVector<f64>| self.penetration(p, y) - 4.0 * f64::EPSILON * self.system.pairs[p].gap;
                all.push((Event::Entry(p), Box::new(excess), Box::new(move |y| self.closing(p, y))));
            }
        }
        all
    }

    pub(super) fn first_event(&self, matrix: &DMatrix<f64>, after: &DVector<f64>, step: f64) -> Option<(f64, Event)> {
        let mut first: Option<(f64, Event)> = None;
        for (event, function, rate) in self.watched() {
            let at = |t: f64| exponential(matrix, &self.y, t);
            let mut end = step;
            if function(after) <= 0.0 {
                // It may have been positive in between.
                if !(rate(&self.y) > 0.0 && rate(after) < 0.0) {
                    continue;
                }
                end = bisect(|t| -rate(&at(t)), step);
                if function(&at(end)) <= 0.0 {
                    continue;
                }
            }
            let t = bisect(|t| function(&at(t)), end);
            if first.is_none_or(|(earliest, _)| t < earliest) {
                first = Some((t, event));
            }
        }
        first
    }

    pub(super) fn handle(&mut self, event: Event) {
        match event {
            Event::Yield(i, sense) => {
                self.sense[i] = sense;
                self.yields += 1;
            }
            Event::Turn(i) => self.turn(i),
            Event::Release(p) => self.closed[p] = false,
            Event::Entry(p) => {
                self.impacts += 1;
                match self.system.pairs[p].restitution {
                    None => self.closed[p] = true,
                    Some(e) => self.strike(p, e),
                }
            }
        }
    }

    fn turn(&mut self, i: usize) {
        let plastic = self.plastic_now(i);
        self.cumulative[i] += (plastic - self.plastic[i]).abs();
        (self.plastic[i], self.sense[i]) = (plastic, 0.0);
    }

    fn strike(&mut self, p: usize, e: f64) {
        self.is_over = self.time < self.struck[p] + SHORTEST;
        self.struck[p] = self.time;
        let n = self.floors();
        let pair = &self.system.pairs[p];
        let impulse = (1.0 + e) * pair.mass * self.closing(p, &self.y);
        for i in 0..n {
            self.y[n + i] -= pair.row[i] * impulse / self.system.mass[i];
        }
        for i in 0..self.system.storeys.len() {
            if self.sense[i] * self.drift_rate(i, &self.y) < 0.0 {
                self.turn(i);
            }
        }
    }
}

/// Where a function that is positive at `end` has become so, seen from 0.
fn bisect(function: impl Fn(f64) -> f64, end: f64) -> f64 {
    let (mut low, mut high) = (0.0, end);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        *if function(middle) > 0.0 { &mut high } else { &mut low } = middle;
    }
    high
}
