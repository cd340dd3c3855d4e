//! Arithmetic on numbers at the first N nodes, the same with wide instructions and without.

use super::nodes::{AtNodes, Matrix, NODES};
use crate::contact::Force;
use crate::numerics::polynomial::{SECOND, each, larger};

/// Columns that are added up side by side.
const ABREAST: usize = 2;

/// A row by fours, as many numbers as wide instructions take: the first N / 4 of these are the first N numbers. Without
/// this form the compiler bundles sixteen sums in another way and does the rest one by one.
pub(crate) type Fours = [[f64; 4]; NODES / 4];

/// Zeros to add to.
pub(super) const NOTHING: Fours = [[0.0; 4]; NODES / 4];

#[inline(always)]
pub(crate) fn fours(row: &AtNodes) -> &[[f64; 4]] {
    row.as_chunks::<4>().0
}

#[inline(always)]
pub(super) fn fours_mut(row: &mut AtNodes) -> &mut [[f64; 4]] {
    row.as_chunks_mut::<4>().0
}

/// The sum of tables times factors.
#[inline(always)]
pub(super) fn combine<const N: usize>(tables: &[Matrix], factors: &[f64], out: &mut Matrix) {
    let tables = &tables[..factors.len()];
    for (j, out) in out[..N].as_chunks_mut::<ABREAST>().0.iter_mut().enumerate() {
        let mut sums = [NOTHING; ABREAST];
        for (table, factor) in tables.iter().zip(factors) {
            for (sum, column) in sums.iter_mut().zip(&table.as_chunks::<ABREAST>().0[j]) {
                for (sum, column) in sum.iter_mut().zip(fours(column)).take(N / 4) {
                    *sum = each(|i| sum[i] + column[i] * factor);
                }
            }
        }
        for (out, sum) in out.iter_mut().zip(&sums) {
            fours_mut(out)[..N / 4].copy_from_slice(&sum[..N / 4]);
        }
    }
}

/// The sum of rows times factors.
#[inline(always)]
pub(crate) fn combined<const N: usize>(rows: &[AtNodes], factors: &[f64]) -> AtNodes {
    let mut sum = NOTHING;
    for (row, factor) in rows.iter().zip(factors) {
        for (sum, row) in sum.iter_mut().zip(fours(row)).take(N / 4) {
            *sum = each(|i| sum[i] + row[i] * factor);
        }
    }
    row(&sum)
}

/// A matrix times values.
#[inline(always)]
pub(crate) fn product<const N: usize>(matrix: &Matrix, values: &AtNodes) -> Fours {
    add_product::<N>(&NOTHING, matrix, values)
}

/// Numbers and a matrix times values.
#[inline(always)]
pub(super) fn add_product<const N: usize>(to: &Fours, matrix: &Matrix, values: &AtNodes) -> Fours {
    let mut sum = *to;
    match N {
        // Half of them at a time: the compiler keeps no more sums in wide registers.
        16 => {
            add_rows::<N, 2>(&mut sum, 0, matrix, values);
            add_rows::<N, 2>(&mut sum, 2, matrix, values);
        }
        12 => add_rows::<N, 3>(&mut sum, 0, matrix, values),
        _ => add_rows::<N, 2>(&mut sum, 0, matrix, values),
    }
    sum
}

/// Enters some fours of a product; every other column by itself, so that no sum waits for the one before.
#[inline(always)]
fn add_rows<const N: usize, const FOURS: usize>(to: &mut Fours, first: usize, matrix: &Matrix, values: &AtNodes) {
    let to = &mut to[first..first + FOURS];
    let (mut even, mut odd) = ([[0.0; 4]; FOURS], [[0.0; 4]; FOURS]);
    even.copy_from_slice(to);
    for (columns, values) in matrix[..N].as_chunks::<2>().0.iter().zip(values[..N].as_chunks::<2>().0) {
        for (sum, column, value) in [(&mut even, &columns[0], values[0]), (&mut odd, &columns[1], values[1])] {
            for (sum, column) in sum.iter_mut().zip(&fours(column)[first..first + FOURS]) {
                *sum = each(|i| sum[i] + column[i] * value);
            }
        }
    }
    for ((to, even), odd) in to.iter_mut().zip(&even).zip(&odd) {
        *to = each(|i| even[i] + odd[i]);
    }
}

/// Forces of penetrations and rates; none where floors are apart.
#[inline(always)]
pub(super) fn forces<const N: usize>(force: &Force, depth: &AtNodes, rate: &AtNodes, out: &mut AtNodes) {
    let all = fours_mut(out).iter_mut().zip(fours(depth)).zip(fours(rate)).take(N / 4);
    match *force {
        Force::Power { stiffness, exponent: 1.5, damping: 0.0 } => {
            for ((out, depth), _) in all {
                let d = inside(depth);
                *out = each(|i| stiffness * (d[i] * d[i].sqrt()));
            }
        }
        Force::Power { stiffness, exponent: 1.5, damping } => {
            for ((out, depth), v) in all {
                let d = inside(depth);
                let elastic = each(|i| stiffness * (d[i] * d[i].sqrt()));
                *out = each(|i| elastic[i] * (1.0 + damping * v[i]));
            }
        }
        Force::Root { stiffness, damping } => {
            for ((out, depth), v) in all {
                let d = inside(depth);
                let root = each(|i| d[i].sqrt());
                let slow = each(|i| root[i].sqrt());
                let elastic = each(|i| stiffness * (d[i] * root[i]));
                *out = each(|i| elastic[i] + damping * slow[i] * v[i]);
            }
        }
        _ => {
            for ((out, depth), v) in all {
                let d = inside(depth);
                *out = each(|i| force.value(d[i], v[i]));
            }
        }
    }
}

/// Penetrations, 0 where floors are apart.
#[inline(always)]
fn inside(depth: &[f64; 4]) -> [f64; 4] {
    each(|i| larger(0.0, depth[i]))
}

/// Values of a polynomial at N points.
#[inline(always)]
pub(crate) fn value<const N: usize>(terms: &[f64], x: &Fours) -> AtNodes {
    let mut value = NOTHING;
    for (value, x) in value.iter_mut().zip(x).take(N / 4) {
        *value = terms.iter().rev().fold([0.0; 4], |value, term| each(|i| value[i] * x[i] + term));
    }
    row(&value)
}

/// Values and derivatives by t of a polynomial in x = t / scale.
#[inline(always)]
pub(super) fn values<const N: usize>(terms: &[f64], x: &Fours, scale: f64) -> (AtNodes, AtNodes) {
    let (mut value, mut rate) = (NOTHING, NOTHING);
    let per_second = 1.0 / scale;
    for ((value, rate), x) in value.iter_mut().zip(&mut rate).zip(x).take(N / 4) {
        let (last, slope) = terms.iter().rev().fold(([0.0; 4], [0.0; 4]), |(value, slope), term| {
            (each(|i| value[i] * x[i] + term), each(|i| slope[i] * x[i] + value[i]))
        });
        (*value, *rate) = (last, each(|i| slope[i] * per_second));
    }
    (row(&value), row(&rate))
}

#[inline(always)]
pub(crate) fn row(fours: &Fours) -> AtNodes {
    let mut row = [0.0; NODES];
    fours_mut(&mut row).copy_from_slice(fours);
    row
}

/// Of a polynomial.
pub(super) fn second_derivative(terms: &[f64], x: f64) -> f64 {
    let last = terms.len().min(SECOND.len());
    terms[2..last].iter().zip(&SECOND[2..last]).rev().fold(0.0, |sum, (c, count)| sum * x + count * c)
}
