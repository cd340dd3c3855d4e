//! Quadratic forms of vectors.

use super::lanes::{LANES, Lane, from_left_to_right};
use nalgebra::DMatrix;

/// z' X z for a symmetric X: block of rows after block of rows, each from its diagonal block on, with all beyond it twice.
#[derive(Clone, Debug)]
pub(super) struct Form {
    entries: Vec<Lane>,
    size: usize,
}

impl Form {
    /// Of a matrix over the numbers from `first` on of vectors in whole blocks; the others do not count.
    pub(super) fn of(matrix: &DMatrix<f64>, first: usize) -> Form {
        let size = (first + matrix.nrows()).next_multiple_of(LANES);
        let at = |i: usize, j: usize| match (i.checked_sub(first), j.checked_sub(first)) {
            (Some(i), Some(j)) => matrix.get((i, j)).copied().unwrap_or(0.0),
            _ => 0.0,
        };
        let entry = |i: usize, j: usize, block: usize| -> f64 {
            let mean = 0.5 * (at(i, j) + at(j, i));
            if j < (block + 1) * LANES { mean } else { 2.0 * mean }
        };
        let blocks = (0..size / LANES).flat_map(|block| {
            (block * LANES..size).map(move |j| std::array::from_fn(|i| entry(block * LANES + i, j, block)))
        });
        Form { entries: blocks.collect(), size }
    }

    /// Of a vector, which may be longer.
    pub(super) fn of_vector(&self, z: &[f64]) -> f64 {
        product(&self.entries, &z[..self.size])
    }
}

/// See [`Form`]; four sums side by side, so that none has to wait for the one before.
#[multiversion::multiversion(targets("x86_64+avx2"))]
fn product(mut entries: &[Lane], z: &[f64]) -> f64 {
    let mut whole = [0.0; LANES];
    for (block, of_rows) in z.as_chunks::<LANES>().0.iter().enumerate() {
        let columns = z[block * LANES..].as_chunks::<LANES>().0;
        let (own, rest) = entries.split_at(columns.len() * LANES);
        let mut sums = [[0.0; LANES]; LANES];
        for (four, factors) in own.as_chunks::<LANES>().0.iter().zip(columns) {
            for k in 0..LANES {
                for i in 0..LANES {
                    sums[k][i] += four[k][i] * factors[k];
                }
            }
        }
        for i in 0..LANES {
            whole[i] += of_rows[i] * ((sums[0][i] + sums[1][i]) + (sums[2][i] + sums[3][i]));
        }
        entries = rest;
    }
    from_left_to_right(whole)
}
