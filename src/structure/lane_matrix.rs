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
        add_products(rows, &vector[matrix.source..], out);
    }
}

/// Adds rows times the numbers of a vector, summed two by two: neither has to wait for the other.
#[inline(always)]
fn add_products(rows: &[Lane], vector: &[f64], sum: &mut Lane) {
    let ((pairs, last), (values, last_value)) = (rows.as_chunks::<2>(), vector[..rows.len()].as_chunks::<2>());
    let (mut even, mut odd) = ([0.0; LANES], [0.0; LANES]);
    // Equal lengths: no bounds checks below. Loops over arrays of constant length leave the sums in registers.
    let (count, values) = (pairs.len(), &values[..pairs.len()]);
    for k in 0..count {
        let ([row, next], [value, other]) = (pairs[k], values[k]);
        for i in 0..LANES {
            even[i] += row[i] * value;
            odd[i] += next[i] * other;
        }
    }
    for i in 0..LANES {
        even[i] += odd[i];
    }
    if let ([row], [value]) = (last, last_value) {
        for i in 0..LANES {
            even[i] += row[i] * value;
        }
    }
    for i in 0..LANES {
        sum[i] += even[i];
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn matrices_that_share_a_block_keep_their_own_rows() {
        let matrices =
            [LaneMatrix::new(1, 0, 0, |_, _| 2.0), LaneMatrix::new(2, 1, 2, |i, j| [[3.0, 4.0], [5.0, 6.0]][i][j])];
        for (vector, expected) in
            [([1.0, 10.0, 100.0, 0.0], [2.0, 0.0, 430.0, 650.0]), ([-1.0, 0.0, 1.0, 0.0], [-2.0, 0.0, 4.0, 6.0])]
        {
            let mut got = [[0.0; LANES]];
            matrices.iter().for_each(|matrix| matrix.add(&vector, &mut got));
            assert_eq!(got, [expected]);
        }
    }
}
