//! Power series in time of all modes, or of all floors: the dense solution of a step.

pub(super) mod expand;
pub(super) mod power;
mod project;
pub(super) mod sums;

use super::lanes::{LANES, Lane};
use crate::numerics::polynomial::{MAX_TERMS, SECOND};
use crate::numerics::powers::Powers;
use crate::numerics::substitution::Substitution;
use crate::numerics::time_map::TimeMap;
use project::{dot_each, project};
use std::ops::Range;
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

    /// d2t/dx2, s.
    pub fn time_bend(&self) -> f64 {
        2.0 * self.time_map.curvature * self.scale
    }

    /// x at a time, s.
    pub fn x_at(&self, time: f64) -> f64 {
        self.time_map.inverse(time / self.scale)
    }

    /// The powers of the x at a time, s.
    pub fn set_powers(&self, time: f64, powers: &mut Powers) {
        powers.set_by(&self.time_map, self.x_at(time), self.order);
    }

    /// The coefficients of power `n`.
    pub fn term(&self, n: usize) -> &[f64] {
        &self.coefficients[n * self.lanes..(n + 1) * self.lanes]
    }

    /// Replaces the coefficients of one mode or floor, from power 0 on.
    pub fn set_terms_of(&mut self, lane: usize, terms: impl Iterator<Item = f64>) {
        let own = self.coefficients[lane..].iter_mut().step_by(self.lanes);
        own.zip(terms).take(self.order + 1).for_each(|(own, term)| *own = term);
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

    /// Becomes another series, in the x of its time map.
    pub fn set_in_x(&mut self, of: &MotionSeries, substitution: &Substitution) {
        (self.order, self.scale, self.time_map) = (of.order, of.scale, TimeMap::default());
        let end = (self.order + 1) * self.lanes;
        self.coefficients[..end].copy_from_slice(&of.coefficients[..end]);
        substitution.apply(self.coefficients[..end].as_chunks_mut::<LANES>().0, self.lanes / LANES);
    }

    /// Becomes the series of the accelerations of another one, m/s2, in the x of its time map.
    pub fn set_accelerations(&mut self, of: &MotionSeries, substitution: &Substitution) {
        (self.order, self.scale, self.time_map) = (of.order.saturating_sub(2), of.scale, TimeMap::default());
        let square = 1.0 / (of.scale * of.scale);
        let end = (self.order + 1) * self.lanes;
        let terms = self.coefficients[..end].chunks_exact_mut(self.lanes);
        for (n, (terms, of)) in terms.zip(of.coefficients.chunks_exact(of.lanes).skip(2)).enumerate() {
            let factor = SECOND[n + 2] * square;
            terms.iter_mut().zip(of).for_each(|(term, of)| *term = factor * of);
        }
        substitution.apply(self.coefficients[..end].as_chunks_mut::<LANES>().0, self.lanes / LANES);
    }

    /// Bounds on the magnitudes of the second derivatives with respect to x, from 0 to that x, for each mode or floor
    /// of a series whose variable x is.
    pub fn bound_seconds(&self, x: f64, bounds: &mut [f64]) {
        let (mut factors, mut power) = ([0.0; MAX_TERMS], 1.0);
        for n in 2..=self.order {
            factors[n] = SECOND[n] * power;
            power *= x;
        }
        let terms = &self.coefficients[..(self.order + 1) * self.lanes];
        sum_sizes(terms, &factors[..=self.order], &mut bounds[..self.lanes]);
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
        self.dot_each_in(0..self.lanes, row, first, out);
    }

    /// The same for a row that is 0 outside of some lanes.
    pub fn dot_each_in(&self, lanes: Range<usize>, row: &[f64], first: usize, out: &mut [f64]) {
        let blocks = (lanes.start / LANES, lanes.end.div_ceil(LANES));
        dot_each(&self.coefficients[first * self.lanes..], row, blocks, &mut out[first..=self.order]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// (1 + t)^3.5 and (1 - t)^3.5: in the x of the map that ends at the root, their accelerations are cubic, with the
    /// terms of 8.75 (1 + x/2)^3 and 8.75 (1 - x/2)^3.
    #[test]
    fn accelerations_in_a_time_map_and_bounds_on_their_curvature() {
        const ORDER: usize = 15;
        const SIZES: Lane = [1.0, -2.0, 0.0, 0.5];
        for sign in [1.0, -1.0] {
            let (mut motion, mut term) = (MotionSeries::new(LANES, ORDER), 1.0);
            (motion.order, motion.scale, motion.time_map.curvature) = (ORDER, 0.5, 0.25 * sign);
            for (n, terms) in motion.coefficients.as_chunks_mut::<LANES>().0.iter_mut().enumerate() {
                *terms = SIZES.map(|size| size * term);
                term *= sign * (3.5 - n as f64) / (n + 1) as f64;
            }
            let mut substitution = Substitution::default();
            substitution.set(&motion.time_map, ORDER + 1);
            let mut accelerations = MotionSeries::new(LANES, ORDER);
            accelerations.set_accelerations(&motion, &substitution);
            for x in [0.0, 0.3, 1.0] {
                let mut bounds = [f64::NAN; LANES];
                accelerations.bound_seconds(x, &mut bounds);
                for (bound, size) in bounds.iter().zip(SIZES) {
                    let exact = 8.75 * (1.5 + 0.75 * x) * size.abs() / 0.25;
                    assert!((bound - exact).abs() <= 1e-9 * exact, "{sign}, {size} at {x}: {bound}, not {exact}");
                }
            }
        }
    }
}
