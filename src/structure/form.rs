//! Rows and quadratic forms of several vectors, side by side: the bits of each do not depend on the others.

use super::lanes::{LANES, Lane};
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

    /// Of several vectors, side by side, which may be longer. The bits of each do not depend on the others, nor on their number.
    pub(super) fn of_vectors<const N: usize>(&self, z: &[[f64; N]]) -> [f64; N] {
        products(&self.entries, &z[..self.size])
    }
}

/// The sum of the squares of some rows times a vector.
#[derive(Clone, Debug)]
pub(super) struct Squares {
    /// Four rows side by side, after each other.
    entries: Vec<Lane>,
    size: usize,
}

impl Squares {
    /// Of the rows of a matrix.
    pub(super) fn of(rows: &DMatrix<f64>) -> Squares {
        let at = |i: usize, j: usize| rows.get((i, j)).copied().unwrap_or(0.0);
        let blocks = (0..rows.nrows()).step_by(LANES);
        let entries = blocks.flat_map(|i| (0..rows.ncols()).map(move |j| std::array::from_fn(|k| at(i + k, j))));
        Squares { entries: entries.collect(), size: rows.ncols() }
    }

    /// Of several vectors, side by side.
    pub(super) fn of_vectors<const N: usize>(&self, z: &[[f64; N]]) -> [f64; N] {
        squares_of(&self.entries, &z[..self.size])
    }
}

/// A row times several vectors, side by side.
#[multiversion::multiversion(targets("x86_64+avx2"))]
pub fn row_times<const N: usize>(row: &[f64], z: &[[f64; N]]) -> [f64; N] {
    let mut sums = [0.0; N];
    for (entry, numbers) in row.iter().zip(z) {
        (0..N).for_each(|k| sums[k] += entry * numbers[k]);
    }
    sums
}

/// The sum of weights times squares, of several vectors side by side.
#[multiversion::multiversion(targets("x86_64+avx2"))]
pub fn squares<W: Iterator<Item = f64>, const N: usize>(weights: W, z: &[[f64; N]]) -> [f64; N] {
    let mut sums = [0.0; N];
    for (weight, numbers) in weights.zip(z) {
        (0..N).for_each(|k| sums[k] += weight * numbers[k] * numbers[k]);
    }
    sums
}

/// See [`Form`].
#[multiversion::multiversion(targets("x86_64+avx2"))]
fn products<const N: usize>(mut entries: &[Lane], z: &[[f64; N]]) -> [f64; N] {
    let mut whole = [0.0; N];
    for (block, of_rows) in z.as_chunks::<LANES>().0.iter().enumerate() {
        let columns = &z[block * LANES..];
        let (own, rest) = entries.split_at(columns.len());
        for (of_row, sums) in of_rows.iter().zip(times(own, columns)) {
            (0..N).for_each(|k| whole[k] += of_row[k] * sums[k]);
        }
        entries = rest;
    }
    whole
}

/// See [`Squares`].
#[multiversion::multiversion(targets("x86_64+avx2"))]
fn squares_of<const N: usize>(entries: &[Lane], z: &[[f64; N]]) -> [f64; N] {
    let mut whole = [0.0; N];
    for rows in entries.chunks_exact(z.len().max(1)) {
        for of_row in times(rows, z) {
            (0..N).for_each(|k| whole[k] += of_row[k] * of_row[k]);
        }
    }
    whole
}

/// Four rows times several vectors: no sum has to wait for the one before.
#[inline(always)]
fn times<const N: usize>(rows: &[Lane], z: &[[f64; N]]) -> [[f64; N]; LANES] {
    let mut sums = [[0.0; N]; LANES];
    for (four, factors) in rows.iter().zip(z) {
        for i in 0..LANES {
            for k in 0..N {
                sums[i][k] += four[i] * factors[k];
            }
        }
    }
    sums
}
