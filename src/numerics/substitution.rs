//! Changes the variable of a power series: from its terms in time to those of the same function in the x of a
//! [`TimeMap`].

use super::polynomial::{BLOCK, MAX_TERMS, each};
use super::time_map::{BINOMIAL, TimeMap, Weights};

/// The weights of that change for one time map: term m in x = sum over j of `weights[m][j]` times term m - j in time.
#[derive(Clone, Debug)]
pub struct Substitution {
    /// Row m: the weights for term m in x.
    weights: [Weights; MAX_TERMS],
    /// The time map and the number of terms for which the weights have been worked out.
    known: (TimeMap, usize),
}

impl Default for Substitution {
    fn default() -> Substitution {
        Substitution {
            weights: [[0.0; (MAX_TERMS / 2 + 1).next_multiple_of(BLOCK)]; MAX_TERMS],
            known: (TimeMap::default(), 0),
        }
    }
}

impl Substitution {
    /// Works out the weights for a time map and series of at most so many terms.
    pub fn set(&mut self, time_map: &TimeMap, terms: usize) {
        if std::mem::replace(&mut self.known, (*time_map, terms)) == (*time_map, terms) {
            return;
        }
        let mut powers: Weights = [1.0; _];
        for j in 1..=terms / 2 {
            powers[j] = powers[j - 1] * time_map.curvature;
        }
        let powers = powers.as_chunks::<BLOCK>().0;
        for (m, (weights, binomials)) in self.weights.iter_mut().zip(&BINOMIAL).enumerate().take(terms) {
            let (weights, binomials) = (weights.as_chunks_mut::<BLOCK>().0, binomials.as_chunks::<BLOCK>().0);
            let blocks = weights.iter_mut().zip(binomials).zip(powers).take(m / (2 * BLOCK) + 1);
            blocks.for_each(|((weights, binomials), powers)| *weights = each(|i| binomials[i] * powers[i]));
        }
    }

    /// Changes series that stand side by side in place: `terms` holds `width` blocks of [`BLOCK`] of them for each
    /// power.
    pub fn apply(&self, terms: &mut [[f64; BLOCK]], width: usize) {
        substitute_terms(terms, width, &self.weights);
    }

    /// Changes the terms of one series in place.
    pub fn apply_to_one(&self, terms: &mut [f64]) {
        for m in (2..terms.len()).rev() {
            terms[m] += (1..=m / 2).map(|j| self.weights[m][j] * terms[m - j]).sum::<f64>();
        }
    }

    /// Changes two arrays of [`BLOCK`] series each in place, with at most `count` terms.
    pub fn apply_to_both(&self, terms: [&mut [[f64; BLOCK]; MAX_TERMS]; 2], count: usize) {
        substitute_both(terms, &self.weights, count);
    }
}

/// See [`Substitution::apply_to_both`].
#[multiversion::multiversion(targets("x86_64+avx2"))]
fn substitute_both(terms: [&mut [[f64; BLOCK]; MAX_TERMS]; 2], weights: &[Weights; MAX_TERMS], count: usize) {
    let [first, second] = terms;
    for (m, weights) in weights[..count.min(MAX_TERMS)].iter().enumerate().skip(2).rev() {
        let ((known, own), (others, other)) = (first.split_at_mut(m), second.split_at_mut(m));
        let (mut sum, mut other_sum) = (own[0], other[0]);
        // From the highest term down, so that lower ones are still those in time.
        let rows = known[m - m / 2..].iter().zip(&others[m - m / 2..]).rev();
        for ((term, other), weight) in rows.zip(&weights[1..=m / 2]) {
            for i in 0..BLOCK {
                sum[i] += weight * term[i];
                other_sum[i] += weight * other[i];
            }
        }
        (own[0], other[0]) = (sum, other_sum);
    }
}

/// See [`Substitution::apply`].
#[multiversion::multiversion(targets("x86_64+avx2"))]
fn substitute_terms(terms: &mut [[f64; BLOCK]], width: usize, weights: &[Weights]) {
    let mut first = 0;
    while first < width {
        first += match width - first {
            1 if width == 1 => substitute_block(terms, weights),
            1 => substitute_blocks::<1>(terms, (first, width), weights),
            2 => substitute_blocks::<2>(terms, (first, width), weights),
            3 => substitute_blocks::<3>(terms, (first, width), weights),
            4 => substitute_blocks::<4>(terms, (first, width), weights),
            _ => substitute_blocks::<5>(terms, (first, width), weights),
        };
    }
}

/// Changes the first block of lanes in each row; returns 1, the number of blocks done.
#[inline(always)]
fn substitute_block(terms: &mut [[f64; BLOCK]], weights: &[Weights]) -> usize {
    for (m, weights) in weights[..terms.len()].iter().enumerate().skip(2).rev() {
        let (known, own) = terms.split_at_mut(m);
        let mut sum = own[0];
        for (row, weight) in known[m - m / 2..].iter().rev().zip(&weights[1..=m / 2]) {
            for i in 0..BLOCK {
                sum[i] += weight * row[i];
            }
        }
        own[0] = sum;
    }
    1
}

/// Changes `N` blocks of lanes from the `first` of each row on; returns `N`.
#[inline(always)]
fn substitute_blocks<const N: usize>(
    terms: &mut [[f64; BLOCK]],
    (first, width): (usize, usize),
    weights: &[Weights],
) -> usize {
    for (m, weights) in weights[..terms.len() / width].iter().enumerate().skip(2).rev() {
        let (known, own) = terms.split_at_mut(m * width);
        let own = &mut own[first..first + N];
        let mut sum = [[0.0; BLOCK]; N];
        sum.copy_from_slice(own);
        for (row, weight) in known.chunks_exact(width).rev().zip(&weights[1..=m / 2]) {
            let row = &row[first..first + N];
            for c in 0..N {
                for i in 0..BLOCK {
                    sum[c][i] += weight * row[c][i];
                }
            }
        }
        own.copy_from_slice(&sum);
    }
    N
}

#[cfg(test)]
mod tests {
    use super::super::polynomial::value_and_slope;
    use super::*;

    /// (1 + t)^3.5 has no power series in t that converges beyond t = 1; in the root of 1 + t it is a polynomial of
    /// degree 7.
    #[test]
    fn a_root_becomes_a_polynomial() {
        const LENGTH: usize = 24;
        let mut terms = [0.0; LENGTH * BLOCK];
        let (mut term, scale) = (1.0, [1.0, 2.0, -1.0, 0.5]);
        for n in 0..LENGTH {
            for i in 0..BLOCK {
                terms[n * BLOCK + i] = term * scale[i];
            }
            term *= (3.5 - n as f64) / (n + 1) as f64;
        }
        let time_map = TimeMap { curvature: 0.25 };
        let mut substitution = Substitution::default();
        substitution.set(&time_map, LENGTH);
        substitution.apply(terms.as_chunks_mut::<BLOCK>().0, 1);
        for i in 0..BLOCK {
            let terms: Vec<f64> = terms.chunks_exact(BLOCK).map(|row| row[i]).collect();
            for x in [0.5, 2.0, 4.0] {
                let exact = scale[i] * libm::pow(1.0 + time_map.time(x), 3.5);
                let value = value_and_slope(&terms[..8], x).0;
                assert!((value - exact).abs() < 1e-12 * exact.abs(), "{value} instead of {exact} at {x}");
            }
            assert!(terms[8..].iter().all(|term| term.abs() < 1e-11), "{terms:?}");
        }
    }
}
