//! Arithmetic on numbers at the first N nodes, the same with wide instructions and without.

use super::nodes::{Matrix, NODES, Row};
use crate::contact::Force;
use crate::polynomial::SECOND;

/// Columns that are added up side by side.
const ABREAST: usize = 2;

/// The sum of tables times factors.
#[inline(always)]
pub fn combine<const N: usize>(tables: &[Matrix], factors: &[f64], out: &mut Matrix) {
    let tables = &tables[..factors.len()];
    for j in (0..N).step_by(ABREAST) {
        let mut sums = [[0.0; N]; ABREAST];
        for k in 0..factors.len() {
            for (sum, column) in sums.iter_mut().zip(&tables[k][j..j + ABREAST]) {
                for i in 0..N {
                    sum[i] += column[i] * factors[k];
                }
            }
        }
        for (out, sum) in out[j..j + ABREAST].iter_mut().zip(&sums) {
            out[..N].copy_from_slice(sum);
        }
    }
}

#[inline(always)]
pub fn combined<const N: usize>(rows: &[Row], factors: &[f64]) -> Row {
    let mut sum = [0.0; NODES];
    for (row, factor) in rows.iter().zip(factors) {
        for i in 0..N {
            sum[i] += row[i] * factor;
        }
    }
    sum
}

/// Adds a matrix times values.
#[inline(always)]
pub fn add_product<const N: usize>(to: &mut Row, matrix: &Matrix, values: &Row) {
    let mut sum = [0.0; N];
    sum.copy_from_slice(&to[..N]);
    for j in 0..N {
        let (column, value) = (&matrix[j], values[j]);
        for i in 0..N {
            sum[i] += column[i] * value;
        }
    }
    to[..N].copy_from_slice(&sum);
}

/// The larger of two numbers, in one instruction; the second where they are none.
#[inline(always)]
pub fn larger(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

/// Forces of penetrations and rates; none where floors are apart.
#[inline(always)]
pub fn forces<const N: usize>(force: &Force, depth: &Row, rate: &Row, out: &mut Row) {
    match *force {
        Force::Power { stiffness, exponent: 1.5, damping: 0.0 } => {
            for i in 0..N {
                let d = larger(depth[i], 0.0);
                out[i] = stiffness * (d * d.sqrt());
            }
        }
        Force::Power { stiffness, exponent: 1.5, damping } => {
            for i in 0..N {
                let d = larger(depth[i], 0.0);
                out[i] = stiffness * (d * d.sqrt()) * (1.0 + damping * rate[i]);
            }
        }
        Force::Root { stiffness, damping } => {
            for i in 0..N {
                let d = larger(depth[i], 0.0);
                let root = d.sqrt();
                out[i] = stiffness * (d * root) + damping * root.sqrt() * rate[i];
            }
        }
        _ => {
            for i in 0..N {
                out[i] = force.value(larger(depth[i], 0.0), rate[i]);
            }
        }
    }
}

/// Values of a polynomial at N points.
#[inline(always)]
pub fn value<const N: usize>(terms: &[f64], x: &[f64; N]) -> Row {
    let mut value = [0.0; N];
    for term in terms.iter().rev() {
        for i in 0..N {
            value[i] = value[i] * x[i] + term;
        }
    }
    row(&value)
}

/// Values and derivatives by t of a polynomial in x = t / scale.
#[inline(always)]
pub fn values<const N: usize>(terms: &[f64], x: &[f64; N], scale: f64) -> (Row, Row) {
    let (mut value, mut slope) = ([0.0; N], [0.0; N]);
    for term in terms.iter().rev() {
        for i in 0..N {
            slope[i] = slope[i] * x[i] + value[i];
            value[i] = value[i] * x[i] + term;
        }
    }
    let rate = 1.0 / scale;
    (row(&value), row(&slope.map(|slope| slope * rate)))
}

/// N values, and none beyond them.
#[inline(always)]
fn row<const N: usize>(values: &[f64; N]) -> Row {
    let mut row = [0.0; NODES];
    row[..N].copy_from_slice(values);
    row
}

/// Of a polynomial.
pub fn second_derivative(terms: &[f64], x: f64) -> f64 {
    let terms = terms.iter().zip(&SECOND).skip(2).rev();
    terms.fold(0.0, |sum, (c, count)| sum * x + count * c)
}
