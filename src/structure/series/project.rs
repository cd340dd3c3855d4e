//! The series of a scalar row . q, such as the distance of a pair of floors, from those of all modes.

use crate::numerics::polynomial::each;
use crate::structure::lanes::{LANES, Lane, from_left_to_right};

/// See [`super::MotionSeries::project`]: each term as [`crate::structure::difference`] has it, [`LANES`] powers
/// abreast.
#[multiversion::multiversion(targets("x86_64+avx2"))]
pub fn project(terms: &[f64], row: &[f64], factors: &[f64], out: &mut [f64]) -> f64 {
    let (terms, row) = (terms.as_chunks::<LANES>().0, row.as_chunks::<LANES>().0);
    match row.len() {
        1 => project_blocks::<1>(terms, row, factors, out),
        2 => project_blocks::<2>(terms, row, factors, out),
        3 => project_blocks::<3>(terms, row, factors, out),
        _ => project_blocks::<0>(terms, row, factors, out),
    }
}

/// The same for `N` blocks of modes, or for any number of blocks where N is 0.
#[inline(always)]
fn project_blocks<const N: usize>(terms: &[Lane], row: &[Lane], factors: &[f64], out: &mut [f64]) -> f64 {
    let width = if N > 0 { N } else { row.len() };
    let row = &row[..width];
    let mut whole = 0.0;
    let factors = factors.chunks(LANES);
    for ((out, terms), factors) in out.chunks_mut(LANES).zip(terms.chunks(LANES * width)).zip(factors) {
        let (mut sums, mut sizes) = ([[0.0; LANES]; LANES], [[0.0; LANES]; LANES]);
        for ((term, sum), size) in terms.chunks_exact(width).zip(&mut sums).zip(&mut sizes) {
            for c in 0..width {
                // Without closures, whose code would not be compiled for wide instructions.
                for i in 0..LANES {
                    let product = row[c][i] * term[c][i];
                    sum[i] += product;
                    size[i] += product.abs();
                }
            }
        }
        let [values, sizes] = [sums, sizes].map(|of| each(|k| from_left_to_right(of[k])));
        for (((out, value), size), factor) in out.iter_mut().zip(&values).zip(&sizes).zip(factors) {
            *out = if value.abs() <= 4.0 * f64::EPSILON * size { 0.0 } else { *value };
            whole += size * factor.abs();
        }
    }
    whole
}

/// See [`super::MotionSeries::dot_each`]: over some blocks of the row, outside of which it is 0.
#[multiversion::multiversion(targets("x86_64+avx2"))]
pub fn dot_each(terms: &[f64], row: &[f64], (from, to): (usize, usize), out: &mut [f64]) {
    let (terms, row) = (terms.as_chunks::<LANES>().0, row.as_chunks::<LANES>().0);
    let (width, row) = (row.len(), &row[from..to]);
    for (out, term) in out.iter_mut().zip(terms.chunks_exact(width)) {
        let mut sum = [0.0; LANES];
        for (row, term) in row.iter().zip(&term[from..to]) {
            sum = each(|i| sum[i] + row[i] * term[i]);
        }
        *out = from_left_to_right(sum);
    }
}
