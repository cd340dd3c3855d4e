//! A full matrix between two vectors of lanes, laid out so that the sums of [`LANES`] rows stay in registers.

use super::{LANES, Lane};
use crate::polynomial::each;

/// A matrix whose columns and rows stand at given lanes of a source and a target vector.
#[derive(Clone, Debug)]
pub struct Dense {
    /// Lane of the source that the first column belongs to.
    source: usize,
    columns: usize,
    /// First block of the target.
    target: usize,
    /// Block of rows after block of rows, each with all its columns.
    entries: Vec<Lane>,
}

impl Dense {
    /// `size` rows from lane `target` on and columns from lane `source` on.
    pub fn new(size: usize, source: usize, target: usize, entry: impl Fn(usize, usize) -> f64) -> Dense {
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
        Dense { source, columns: size, target: blocks.start, entries }
    }

    /// The rows of one block times some vectors.
    pub fn block<const N: usize>(&self, block: usize, vectors: [&[f64]; N]) -> [Lane; N] {
        let rows = &self.entries[(block - self.target) * self.columns..][..self.columns];
        products(rows, vectors.map(|vector| &vector[self.source..][..self.columns]))
    }

    /// `out` += matrix * `vector`.
    pub fn add(&self, vector: &[f64], out: &mut [Lane]) {
        let vector = &vector[self.source..][..self.columns];
        for (rows, out) in self.entries.chunks_exact(self.columns).zip(&mut out[self.target..]) {
            let [sum] = products(rows, [vector]);
            *out = each(|i| out[i] + sum[i]);
        }
    }
}

/// Sums of rows times the numbers of some vectors, two by two: neither has to wait for the other. Wide instructions give the
/// same bits.
#[multiversion::multiversion(targets("x86_64+avx2"))]
fn products<const N: usize>(rows: &[Lane], vectors: [&[f64]; N]) -> [Lane; N] {
    let (pairs, last) = rows.as_chunks::<2>();
    let vectors = vectors.map(|vector| vector[..rows.len()].as_chunks::<2>());
    // Says once that no index below leaves its vector; a closure would have no wide instructions.
    let (count, mut firsts) = (pairs.len(), [&[][..]; N]);
    for n in 0..N {
        firsts[n] = &vectors[n].0[..count];
    }
    let (mut even, mut odd) = ([[0.0; LANES]; N], [[0.0; LANES]; N]);
    // Indices of arrays whose length is known leave the sums in registers.
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
        for (row, value) in last.iter().zip(vectors[n].1) {
            for i in 0..LANES {
                even[n][i] += row[i] * value;
            }
        }
    }
    even
}
