//! The work of damping in a step, by Gauss-Legendre quadrature over the series of a penetration.

use super::block::{Each, PairBlock};
use crate::contact::force::Force;
use crate::numerics::polynomial::COUNT;
use crate::numerics::quadrature::TWELVE_POINTS;
use crate::numerics::time_map::TimeMap;

/// A step at whose end a pair has less than this share of its first penetration is integrated as one that ends with a
/// release.
const NEARLY_RELEASED: f64 = 0.1;

impl PairBlock {
    /// J, work of the damping part of a pair's force over 0..=x, where the penetration is `end`.
    pub(crate) fn damping_work(
        &self,
        lane: usize,
        force: &Force,
        (time_map, scale): (&TimeMap, f64),
        x: f64,
        end: f64,
    ) -> f64 {
        if !force.is_damped() {
            return 0.0;
        }
        let terms = &self.penetration[..self.order + 3];
        if let Force::Linear { damping, .. } = *force {
            return damping / scale * squared_slope(terms, lane, time_map, x);
        }
        // Near a release the damping force of a power law goes as a root of the time left: it is smoother in the square
        // root of that time.
        let released = !force.is_regular() && end < NEARLY_RELEASED * terms[0][lane];
        let (mut at, mut weights) = ([0.0; 12], [0.0; 12]);
        for (i, &(node, weight)) in TWELVE_POINTS.iter().enumerate() {
            let left = 1.0 - node;
            (at[i], weights[i]) = match released {
                true => (x * (1.0 - left * left), x * 2.0 * left * weight),
                false => (x * node, x * weight),
            };
        }
        // The powers are those of dd/dx in place of dd/dt: (dd/dt)^2 dt = (dd/dx)^2 / (dt/dx) dx.
        if time_map.is_curved() {
            weights.iter_mut().zip(&at).for_each(|(weight, at)| *weight /= time_map.rate(*at));
        }
        let powers = damping_powers(terms, lane, force, scale, &at);
        scale * (0..12).map(|i| weights[i] * powers[i]).sum::<f64>()
    }
}

/// Power of the damping part of a pair's force at twelve x.
#[multiversion::multiversion(targets("x86_64+avx2"))]
fn damping_powers(terms: &[Each], lane: usize, force: &Force, scale: f64, x: &[f64; 12]) -> [f64; 12] {
    let (mut d, mut rate) = ([0.0; 12], [0.0; 12]);
    for term in terms.iter().rev() {
        let term = term[lane];
        for i in 0..12 {
            rate[i] = rate[i] * x[i] + d[i];
            d[i] = d[i] * x[i] + term;
        }
    }
    force.damping_powers(&d, &rate.map(|rate| rate / scale))
}

/// Integral over 0..=x of the square of the slope of one pair's series, over the time of a time map: (dd/dt)^2 dt =
/// (dd/dx)^2 / (dt/dx) dx.
#[multiversion::multiversion(targets("x86_64+avx2"))]
fn squared_slope(terms: &[Each], lane: usize, time_map: &TimeMap, x: f64) -> f64 {
    let (at, weights) = (TWELVE_POINTS.map(|(node, _)| x * node), TWELVE_POINTS.map(|(_, weight)| weight));
    let mut slope = [0.0; 12];
    for (term, count) in terms.iter().zip(&COUNT).skip(1).rev() {
        let own = count * term[lane];
        for i in 0..12 {
            slope[i] = slope[i] * at[i] + own;
        }
    }
    if time_map.is_curved() {
        slope.iter_mut().zip(&at).for_each(|(slope, at)| *slope /= time_map.rate(*at).sqrt());
    }
    let mut sum = [0.0; 4];
    for k in 0..3 {
        for i in 0..4 {
            sum[i] += weights[4 * k + i] * (slope[4 * k + i] * slope[4 * k + i]);
        }
    }
    x * ((sum[0] + sum[2]) + (sum[1] + sum[3]))
}
