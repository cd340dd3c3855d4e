//! Arithmetic on numbers at the first N nodes, the same with wide instructions and without.

use super::nodes::{Matrix, NODES, Row};
use crate::contact::Force;

/// The sum of tables times factors.
#[inline(always)]
pub fn combine<const N: usize>(tables: &[Matrix], factors: &[f64], out: &mut Matrix) {
    for (j, out) in out.iter_mut().enumerate().take(N) {
        let mut sum = [0.0; N];
        for (table, factor) in tables.iter().zip(factors) {
            let column = &table[j];
            for i in 0..N {
                sum[i] += column[i] * factor;
            }
        }
        out[..N].copy_from_slice(&sum);
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

/// Values and derivatives by t of a polynomial in x = t / scale.
#[inline(always)]
pub fn values<const M: usize>(terms: &[f64], x: &[f64; M], scale: f64) -> ([f64; M], [f64; M]) {
    let (mut value, mut slope) = ([0.0; M], [0.0; M]);
    for term in terms.iter().rev() {
        for i in 0..M {
            slope[i] = slope[i] * x[i] + value[i];
            value[i] = value[i] * x[i] + term;
        }
    }
    let rate = 1.0 / scale;
    (value, slope.map(|slope| slope * rate))
}

/// Of a polynomial.
pub fn second_derivative(terms: &[f64], x: f64) -> f64 {
    terms.iter().enumerate().skip(2).rev().fold(0.0, |sum, (n, c)| sum * x + (n * (n - 1)) as f64 * c)
}
