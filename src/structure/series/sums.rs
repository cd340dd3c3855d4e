//! Sums of the terms of a series, one vector each, times a factor for each term.

use crate::structure::lanes::{LANES, Lane};

/// q = sum of terms times powers and v = `rate` times the sum of terms times slopes, each term a vector; from the last
/// terms to the first, which are the largest.
#[multiversion::multiversion(targets("x86_64+avx2"))]
pub fn sum_terms(terms: &[f64], powers: (&[f64], &[f64]), rate: f64, q: &mut [f64], v: &mut [f64]) {
    let (terms, _) = terms.as_chunks::<LANES>();
    let (q, v) = (q.as_chunks_mut::<LANES>().0, v.as_chunks_mut::<LANES>().0);
    let terms = (terms, q.len());
    // As many blocks at a time as keep their sums in registers.
    let mut first = 0;
    while first < q.len() {
        first += match q.len() - first {
            1 => sum_next::<1>(terms, first, powers, rate, (q, v)),
            2 => sum_next::<2>(terms, first, powers, rate, (q, v)),
            3 => sum_next::<3>(terms, first, powers, rate, (q, v)),
            5 => sum_next::<5>(terms, first, powers, rate, (q, v)),
            6 => sum_next::<6>(terms, first, powers, rate, (q, v)),
            _ => sum_next::<4>(terms, first, powers, rate, (q, v)),
        };
    }
}

/// Enters `N` blocks of q and v, from the `first` on; returns how many that are.
#[inline(always)]
fn sum_next<const N: usize>(
    terms: (&[Lane], usize),
    first: usize,
    powers: (&[f64], &[f64]),
    rate: f64,
    (q, v): (&mut [Lane], &mut [Lane]),
) -> usize {
    let (sums, rates) = sum_blocks::<N>(terms, first, powers, rate);
    q[first..first + N].copy_from_slice(&sums);
    v[first..first + N].copy_from_slice(&rates);
    N
}

/// q and v of `N` blocks of lanes.
#[inline(always)]
pub(crate) fn sum_blocks<const N: usize>(
    (terms, width): (&[Lane], usize),
    first: usize,
    (powers, slopes): (&[f64], &[f64]),
    rate: f64,
) -> ([Lane; N], [Lane; N]) {
    let (mut value, mut change) = ([[0.0; LANES]; N], [[0.0; LANES]; N]);
    for (row, (power, slope)) in terms.chunks_exact(width).zip(powers.iter().zip(slopes)).rev() {
        let row = &row[first..first + N];
        for c in 0..N {
            for i in 0..LANES {
                value[c][i] += row[c][i] * power;
                change[c][i] += row[c][i] * slope;
            }
        }
    }
    (value, change.map(|change| change.map(|change| change * rate)))
}

/// Sum of the magnitudes of terms, a vector each, times a factor for each term.
#[multiversion::multiversion(targets("x86_64+avx2"))]
pub fn sum_sizes(terms: &[f64], factors: &[f64], out: &mut [f64]) {
    let (out, _) = out.as_chunks_mut::<LANES>();
    let (terms, width) = (terms.as_chunks::<LANES>().0, out.len());
    let terms = (terms, width);
    let mut first = 0;
    while first < width {
        first += match width - first {
            1 => sum_next_sizes::<1>(terms, first, factors, out),
            2 => sum_next_sizes::<2>(terms, first, factors, out),
            3 => sum_next_sizes::<3>(terms, first, factors, out),
            4 => sum_next_sizes::<4>(terms, first, factors, out),
            5 => sum_next_sizes::<5>(terms, first, factors, out),
            6 => sum_next_sizes::<6>(terms, first, factors, out),
            7 => sum_next_sizes::<7>(terms, first, factors, out),
            _ => sum_next_sizes::<8>(terms, first, factors, out),
        };
    }
}

/// Enters `N` blocks, from the `first` on; returns how many that are.
#[inline(always)]
fn sum_next_sizes<const N: usize>(terms: (&[Lane], usize), first: usize, factors: &[f64], out: &mut [Lane]) -> usize {
    out[first..first + N].copy_from_slice(&sizes_of_blocks::<N>(terms, first, factors));
    N
}

#[inline(always)]
fn sizes_of_blocks<const N: usize>((terms, width): (&[Lane], usize), first: usize, factors: &[f64]) -> [Lane; N] {
    let mut sum = [[0.0; LANES]; N];
    for (row, factor) in terms.chunks_exact(width).zip(factors) {
        let row = &row[first..first + N];
        for c in 0..N {
            for i in 0..LANES {
                sum[c][i] += row[c][i].abs() * factor;
            }
        }
    }
    sum
}
