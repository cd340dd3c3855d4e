//! Power series in time of all modes, or of all floors: the dense solution of a step.

pub mod expand;
mod power;
mod project;
pub mod sums;

use super::lanes::{LANES, Lane};
use crate::numerics::polynomial::MAX_TERMS;
use crate::numerics::powers::Powers;
use crate::numerics::time_map::TimeMap;
use project::{dot_each, project};
use sums::{sum_sizes, sum_terms};

/// q(t) = sum of term n times (t / scale)^n, of all modes or floors, evaluated at t / scale or at the x of a time map.
#[derive(Clone, Debug, Default)]
pub struct MotionSeries {
    lanes: usize,
    /// s, unit of x: near the length of the step, so that the terms tell the error and never overflow.
    pub scale: f64,
    /// The map from x to t / scale: the series is evaluated at an x, while its terms remain those of powers of t /
    /// scale.
    pub time_map: TimeMap,
    /// Highest power.
    pub order: usize,
    coefficients: Vec<f64>,
}

impl MotionSeries {
    /// Room for powers up to `highest`.
    pub fn new(lanes: usize, highest: usize) -> MotionSeries {
        MotionSeries {
            lanes,
            scale: 1.0,
            time_map: TimeMap::default(),
            order: 0,
            coefficients: vec![0.0; lanes * (highest + 1)],
        }
    }

    /// Starts a series from a state.
    pub fn start(&mut self, scale: f64, q: &[f64], v: &[f64]) {
        self.scale = scale;
        self.time_map = TimeMap::default();
        self.order = 1;
        let (first, rest) = self.coefficients.split_at_mut(self.lanes);
        first.copy_from_slice(q);
        for (c, v) in rest.iter_mut().zip(v) {
            *c = v * scale;
        }
    }

    /// s at x.
    pub fn time(&self, x: f64) -> f64 {
        self.time_map.time(x) * self.scale
    }

    /// dt/dx at x, s.
    pub fn time_rate(&self, x: f64) -> f64 {
        self.time_map.rate(x) * self.scale
    }

    /// x at a time, s.
    pub fn x_at(&self, time: f64) -> f64 {
        self.time_map.inverse(time / self.scale)
    }

    /// The powers of the x at a time, s.
    pub fn set_powers(&self, time: f64, powers: &mut Powers) {
        powers.set_by(&self.time_map, self.x_at(time), self.order);
        powers.set_in_time(&self.time_map);
    }

    /// The coefficients of power `n`.
    pub fn term(&self, n: usize) -> &[f64] {
        &self.coefficients[n * self.lanes..(n + 1) * self.lanes]
    }

    /// The coefficients of all powers, block by block.
    #[inline(always)]
    pub fn rows(&self) -> impl Iterator<Item = &[Lane]> {
        let (terms, _) = self.coefficients.as_chunks::<LANES>();
        terms.chunks_exact(self.lanes / LANES).take(self.order + 1)
    }

    /// q and v at the x of the powers.
    pub fn evaluate(&self, powers: &Powers, q: &mut [f64], v: &mut [f64]) {
        let terms = (self.order + 1).min(MAX_TERMS);
        let (value, rate) = powers.in_time();
        let (q, v) = (&mut q[..self.lanes], &mut v[..self.lanes]);
        let terms = (&self.coefficients[..terms * self.lanes], (&value[..terms], &rate[..terms]));
        sum_terms(terms.0, terms.1, 1.0 / self.scale, q, v);
    }

    /// Sum of the magnitudes of all terms from power `first` on at x, for each mode or floor, m.
    pub fn sum_sizes(&self, first: usize, x: f64, sizes: &mut [f64]) {
        let mut powers = [1.0; MAX_TERMS];
        for n in 1..=self.order.min(MAX_TERMS - 1) {
            powers[n] = powers[n - 1] * x;
        }
        let terms = &self.coefficients[first * self.lanes..(self.order + 1) * self.lanes];
        sum_sizes(terms, &powers[first..], &mut sizes[..self.lanes]);
    }

    /// Bounds on the fourth derivatives up to the x of the powers, m/s4, for each mode or floor of a series in time.
    pub fn bound_fourths(&self, powers: &Powers, bounds: &mut [f64]) {
        let order = self.order.min(MAX_TERMS - 1);
        let (_, _, factors) = powers.all();
        sum_sizes(&self.coefficients[4 * self.lanes..(order + 1) * self.lanes], &factors[4..=order], bounds);
        let square = 1.0 / (self.scale * self.scale);
        bounds.iter_mut().for_each(|bound| *bound *= square * square);
    }

    /// The last two terms of the series of dq/dx, m, from which the step size follows; returns their powers of x.
    pub fn last_rates(&self, last: &mut [f64], before: &mut [f64]) -> [usize; 2] {
        let powers = [self.order - 1, self.order - 2];
        let [mut of_last, mut of_before] = [[0.0; MAX_TERMS]; 2];
        self.time_map.rate_term_weights(powers[0], &mut of_last);
        self.time_map.rate_term_weights(powers[1], &mut of_before);
        let first = powers[1] / 2;
        let terms = &self.coefficients[first * self.lanes..(self.order + 1) * self.lanes];
        let factors = (&of_last[first..=self.order], &of_before[first..=self.order]);
        sum_terms(terms, factors, 1.0, &mut last[..self.lanes], &mut before[..self.lanes]);
        powers
    }

    /// Writes the series of the scalar `row` . q to `out`, with 0 for each term that cancels but for rounding. Returns
    /// the sum of the magnitudes of all products, those of term n times `factors[n]`.
    pub fn project(&self, row: &[f64], factors: &[f64], out: &mut [f64]) -> f64 {
        project(&self.coefficients[..], row, factors, &mut out[..=self.order])
    }

    /// Writes the series of the scalar `row` . q from power `first` on to `out`, each term as [`super::dot`] has it.
    pub fn dot_each(&self, row: &[f64], first: usize, out: &mut [f64]) {
        dot_each(&self.coefficients[first * self.lanes..], row, &mut out[first..=self.order]);
    }
}
