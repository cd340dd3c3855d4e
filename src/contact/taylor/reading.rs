//! Values, bounds and integrals of the series of pairs, and where pairs are released.

use super::block::{Each, PAIRS, PairBlock};
use crate::numerics::polynomial::{Coefficients, RECIPROCAL, each};
use crate::numerics::powers::{Evaluation, Powers};

/// The penetrations of a block at the end of a step.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct BlockReading {
    /// m.
    pub value: Each,
    /// Its derivative by x.
    pub slope: Each,
    /// Bound on its fourth derivative.
    pub fourth: Each,
    /// Bound on the change of the slope since the start.
    pub turn: Each,
}

/// The forces of a block at the end of a step.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct ForceReading {
    /// N.
    pub value: Each,
    /// Its derivative by x.
    pub slope: Each,
    /// Bound on its fourth derivative.
    pub fourth: Each,
    /// Its integral over x.
    pub impulse: Each,
}

impl BlockReading {
    /// Of one pair.
    pub(crate) fn of(&self, lane: usize) -> Evaluation {
        Evaluation { value: self.value[lane], slope: self.slope[lane], fourth: self.fourth[lane] }
    }
}

impl ForceReading {
    /// Of one pair.
    pub(crate) fn of(&self, lane: usize) -> Evaluation {
        Evaluation { value: self.value[lane], slope: self.slope[lane], fourth: self.fourth[lane] }
    }
}

impl PairBlock {
    /// Estimate of the x at which each pair is released, if that is before `limit`; else infinite.
    pub(crate) fn releases(&self, limit: f64) -> Each {
        releases(&self.penetration[..self.order + 3], limit)
    }

    /// Penetrations and their bounds at the x of the powers.
    pub(crate) fn read(&self, powers: &Powers) -> BlockReading {
        read(&self.penetration[..self.order + 3], powers)
    }

    /// Forces at the x of the powers, and their integral over 0..=x, N s per unit of the scale.
    pub(crate) fn read_force(&self, powers: &Powers) -> ForceReading {
        read_force(&self.force[..=self.order], powers)
    }

    /// Integrals of elastic forces over time up to that of the powers, N s per unit of the scale.
    pub(crate) fn elastic_impulses(&self, powers: &Powers) -> Each {
        elastic_impulses(&self.force[..=self.order], powers.integral_in_time())
    }

    /// The penetration of one pair, copied; returns the number of its terms.
    pub(crate) fn copy_penetration(&self, lane: usize, out: &mut Coefficients) -> usize {
        copy(&self.penetration[..self.order + 3], lane, out)
    }

    /// The penetration of one pair at some x, m, and its first derivatives by x, derivative k divided by k!.
    pub(crate) fn derivatives<const N: usize, const K: usize>(&self, lane: usize, x: &[f64; N]) -> [[f64; N]; K] {
        derivatives(&self.penetration[..self.order + 3], lane, x)
    }
}

/// See [`PairBlock::derivatives`].
#[multiversion::multiversion(targets("x86_64+avx2"))]
fn derivatives<const N: usize, const K: usize>(terms: &[Each], lane: usize, x: &[f64; N]) -> [[f64; N]; K] {
    let mut all = [[0.0; N]; K];
    for term in terms.iter().rev() {
        for i in 0..N {
            for k in (1..K).rev() {
                all[k][i] = all[k][i] * x[i] + all[k - 1][i];
            }
            all[0][i] = all[0][i] * x[i] + term[lane];
        }
    }
    all
}

fn copy(rows: &[Each], lane: usize, out: &mut Coefficients) -> usize {
    for (out, row) in out.iter_mut().zip(rows) {
        *out = row[lane];
    }
    rows.len()
}

/// See [`PairBlock::read`].
#[multiversion::multiversion(targets("x86_64+avx2"))]
fn read(terms: &[Each], powers: &Powers) -> BlockReading {
    let (value, slope, fourth) = powers.all();
    let [mut values, mut slopes, mut fourths, mut turns] = [[0.0; PAIRS]; 4];
    for (n, term) in terms.iter().enumerate().skip(2) {
        for i in 0..PAIRS {
            values[i] += term[i] * value[n];
            slopes[i] += term[i] * slope[n];
            turns[i] += term[i].abs() * slope[n];
            fourths[i] += term[i].abs() * fourth[n];
        }
    }
    let (first, second) = (&terms[0], &terms[1]);
    let value = each(|i| first[i] + (second[i] * powers.x + values[i]));
    BlockReading { value, slope: each(|i| second[i] + slopes[i]), fourth: fourths, turn: turns }
}

/// See [`PairBlock::releases`]: three steps of Newton's method from the root of the parabola of the first terms.
#[multiversion::multiversion(targets("x86_64+avx2"))]
fn releases(terms: &[Each], limit: f64) -> Each {
    let [start, first, half] = [0, 1, 2].map(|n| terms[n]);
    let square = each(|i| first[i] * first[i] - 4.0 * start[i] * half[i]);
    let guess = each(|i| 2.0 * start[i] / (square[i].sqrt() - first[i]));
    let is_near = |i: usize| guess[i] > 0.0 && guess[i] < 1.5 * limit;
    if !(0..PAIRS).any(is_near) {
        return [f64::INFINITY; PAIRS];
    }
    let mut x = guess;
    for _ in 0..3 {
        let (mut value, mut slope) = ([0.0; PAIRS], [0.0; PAIRS]);
        for term in terms.iter().rev() {
            slope = each(|i| slope[i] * x[i] + value[i]);
            value = each(|i| value[i] * x[i] + term[i]);
        }
        x = each(|i| x[i] - value[i] / slope[i]);
    }
    let is_one = |i: usize| is_near(i) && x[i] > 0.0 && x[i] < limit;
    each(|i| if is_one(i) { x[i] } else { f64::INFINITY })
}

/// See [`PairBlock::read_force`].
#[multiversion::multiversion(targets("x86_64+avx2"))]
fn read_force(terms: &[Each], powers: &Powers) -> ForceReading {
    let ((value, slope, fourth), stretch) = (powers.all(), powers.stretch());
    let [mut values, mut slopes, mut fourths, mut integrals] = [[0.0; PAIRS]; 4];
    for (n, term) in terms.iter().enumerate() {
        // Weight of the integral over time, where dt = (1 + stretch x'/x) dx' at x' in 0..=x.
        let weight = (RECIPROCAL[n] + stretch * RECIPROCAL[n + 1]) * value[n];
        for i in 0..PAIRS {
            values[i] += term[i] * value[n];
            slopes[i] += term[i] * slope[n];
            fourths[i] += term[i].abs() * fourth[n];
            integrals[i] += term[i] * weight;
        }
    }
    ForceReading { value: values, slope: slopes, fourth: fourths, impulse: each(|i| powers.x * integrals[i]) }
}

/// See [`PairBlock::elastic_impulses`].
#[multiversion::multiversion(targets("x86_64+avx2"))]
fn elastic_impulses(terms: &[Each], factors: &Coefficients) -> Each {
    let mut impulses = [0.0; PAIRS];
    for (term, factor) in terms.iter().zip(factors) {
        for i in 0..PAIRS {
            impulses[i] += term[i] * factor;
        }
    }
    impulses
}
