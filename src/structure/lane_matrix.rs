//! A full matrix between two vectors of lanes, laid out so that the sums of [`LANES`] rows stay in registers.

use super::lanes::{LANES, Lane};

/// A matrix whose columns and rows stand at given lanes of a source and a target vector.
#[derive(Clone, Debug)]
pub(super) struct LaneMatrix {
    /// Lane of the source that the first column belongs to.
    source: usize,
    columns: usize,
    /// First block of the target.
    target: usize,
    /// Block of rows after block of rows, each with all its columns.
    entries: Vec<Lane>,
}

impl LaneMatrix {
    /// `size` rows from lane `target` on and columns from lane `source` on.
    pub(super) fn new(size: usize, source: usize, target: usize, entry: impl Fn(usize, usize) -> f64) -> LaneMatrix {
        let blocks = target / LANES..(target + size).div_ceil(LANES);
        let of_row = |lane: usize, column: usize| match lane.checked_sub(target) {
            Some(row) if row < size => entry(row, column),
            _ => 0.0,
        };
        let entries = blocks
            .clone()
            .flat_map(|block| (0..size).map(move |column| (block, column)))
            .map(|(block, column)| std::array::from_fn(|i| of_row(block * LANES + i, column)))
            .collect();
        LaneMatrix { source, columns: size, target: blocks.start, entries }
    }

    /// The rows of one block of the target, where any of them is of this matrix.
    #[inline(always)]
    fn rows(&self, block: usize) -> Option<&[Lane]> {
        let start = block.checked_sub(self.target)? * self.columns;
        self.entries.get(start..start + self.columns)
    }

    /// `out` += the magnitudes of the matrix * `vector`.
    pub(super) fn add_sizes(&self, vector: &[f64], out: &mut [Lane]) {
        for (rows, out) in self.entries.chunks_exact(self.columns.max(1)).zip(&mut out[self.target..]) {
            for (row, value) in rows.iter().zip(&vector[self.source..]) {
                for i in 0..LANES {
                    out[i] += row[i].abs() * value;
                }
            }
        }
    }

    /// `out` += matrix * `vector`.
    pub(super) fn add(&self, vector: &[f64], out: &mut [Lane]) {
        add_all(self, vector, out);
    }
}

/// See [`LaneMatrix::add`].
#[multiversion::multiversion(targets("x86_64+avx2"))]
fn add_all(matrix: &LaneMatrix, vector: &[f64], out: &mut [Lane]) {
    for (rows, out) in matrix.entries.chunks_exact(matrix.columns.max(1)).zip(&mut out[matrix.target..]) {
        add_products(rows, &[vector], matrix.source, std::array::from_mut(out));
    }
}

/// One block of the sum of some matrices, times each of some vectors.
#[multiversion::multiversion(targets("x86_64+avx2"))]
pub fn block_of_all<const N: usize>(matrices: &[LaneMatrix], block: usize, vectors: [&[f64]; N]) -> [Lane; N] {
    let mut sums = [[0.0; LANES]; N];
    for matrix in matrices {
        if let Some(rows) = matrix.rows(block) {
            add_products(rows, &vectors, matrix.source, &mut sums);
        }
    }
    sums
}

/// Adds rows times the numbers of some vectors from a lane on, summed two by two: neither has to wait for the other.
#[inline(always)]
fn add_products<const N: usize>(rows: &[Lane], vectors: &[&[f64]; N], from: usize, sums: &mut [Lane; N]) {
    let (pairs, last) = rows.as_chunks::<2>();
    // Equal lengths: no bounds checks below. Without closures, whose code would not be compiled for wide instructions.
    let (count, mut firsts, mut lasts) = (pairs.len(), [&[][..]; N], [&[][..]; N]);
    for n in 0..N {
        let (first, last) = vectors[n][from..][..rows.len()].as_chunks::<2>();
        (firsts[n], lasts[n]) = (&first[..count], last);
    }
    let (mut even, mut odd) = ([[0.0; LANES]; N], [[0.0; LANES]; N]);
    // Loops over arrays of constant length leave the sums in registers.
    for k in 0..count {
        let [row, next] = pairs[k];
        for n in 0..N {
            let [value, other] = firsts[n][k];
            for i in 0..LANES {
                even[n][i] += row[i] * value;
                odd[n][i] += next[i] * other;
            }
        }
    }
    for n in 0..N {
        for i in 0..LANES {
            even[n][i] += odd[n][i];
        }
        if let ([row], [value]) = (last, lasts[n]) {
            for i in 0..LANES {
                even[n][i] += row[i] * value;
            }
        }
        for i in 0..LANES {
            sums[n][i] += even[n][i];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn matrices_that_share_a_block_keep_their_own_rows() {
        let matrices =
            [LaneMatrix::new(1, 0, 0, |_, _| 2.0), LaneMatrix::new(2, 1, 2, |i, j| [[3.0, 4.0], [5.0, 6.0]][i][j])];
        let vectors = [[1.0, 10.0, 100.0, 0.0], [-1.0, 0.0, 1.0, 0.0]];
        let got = block_of_all(&matrices, 0, vectors.each_ref().map(|vector| &vector[..]));
        assert_eq!(got, [[2.0, 0.0, 430.0, 650.0], [-2.0, 0.0, 4.0, 6.0]]);
    }
}
