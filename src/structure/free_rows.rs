//! The distance of a pair of floors apart from contact, over some time, as a polynomial: one row over the modes for each
//! power, prepared once, instead of a series of all modes.

use super::equations::Structure;
use super::lanes::{LANES, Lane, from_left_to_right};
use super::mode_polynomials::{POLYNOMIAL_TERMS, PolynomialMaker};
use crate::numerics::polynomial::each;

/// Powers that have rows: all but the first two, which are the distance and its rate.
const ROWS: usize = POLYNOMIAL_TERMS - 2;

/// Rows that are multiplied side by side.
const ABREAST: usize = 3;

/// The rows of some pairs over a length of time.
#[derive(Clone, Debug)]
pub struct FreeRows {
    /// s: the unit of time of the powers, and the time up to which the polynomials are good.
    pub length: f64,
    pairs: Vec<PairRows>,
}

/// The rows of one pair, from power 2 on.
#[derive(Clone, Debug)]
struct PairRows {
    /// Power by power, for the displacements of all modes.
    by_q: Vec<Lane>,
    /// For their velocities.
    by_v: Vec<Lane>,
    /// For the ground acceleration and its slope.
    by_ground: [[f64; 2]; ROWS],
}

impl FreeRows {
    /// For the rows of the modal Jacobian of some pairs, where damping couples no modes.
    pub fn new<'a>(structure: &Structure, pairs: impl Iterator<Item = &'a [f64]>, length: f64) -> FreeRows {
        let maker = PolynomialMaker::new(length);
        let modes: Vec<_> = (0..structure.lanes)
            .map(|m| maker.mode(structure.omega2[m], structure.damping[m]).of)
            .collect();
        let pair = |row: &[f64]| {
            let blocks = row.len() / LANES;
            let rows = |of: usize| {
                let mut rows = vec![[0.0; LANES]; ROWS * blocks];
                for (n, rows) in rows.chunks_exact_mut(blocks.max(1)).enumerate() {
                    for (m, entry) in rows.as_flattened_mut().iter_mut().enumerate() {
                        *entry = row[m] * modes[m][of][n + 2];
                    }
                }
                rows
            };
            let mut by_ground = [[0.0; 2]; ROWS];
            for (n, by_ground) in by_ground.iter_mut().enumerate() {
                for (m, share) in structure.participation.iter().enumerate() {
                    for (k, by_ground) in by_ground.iter_mut().enumerate() {
                        *by_ground -= row[m] * share * modes[m][2 + k][n + 2];
                    }
                }
            }
            PairRows { by_q: rows(0), by_v: rows(1), by_ground }
        };
        FreeRows { length, pairs: pairs.map(pair).collect() }
    }

    /// Number of terms of a polynomial.
    pub fn terms(&self) -> usize {
        POLYNOMIAL_TERMS
    }

    /// Writes the terms of a pair's distance from power 2 on, m, from the motion at the start, the ground acceleration
    /// there, m/s2, and its slope.
    pub fn enter(&self, pair: usize, motion: (&[f64], &[f64]), ground: (f64, f64), out: &mut [f64]) {
        enter(&self.pairs[pair], motion, ground, &mut out[2..POLYNOMIAL_TERMS]);
    }
}

/// See [`FreeRows::enter`].
#[multiversion::multiversion(targets("x86_64+avx2"))]
fn enter(pair: &PairRows, (q, v): (&[f64], &[f64]), (acceleration, slope): (f64, f64), out: &mut [f64]) {
    let [(q, _), (v, _)] = [q, v].map(<[f64]>::as_chunks::<LANES>);
    let (blocks, v) = (q.len(), &v[..q.len()]);
    let rows = pair.by_q.chunks_exact(ABREAST * blocks).zip(pair.by_v.chunks_exact(ABREAST * blocks));
    let out = out.as_chunks_mut::<ABREAST>().0.iter_mut().zip(pair.by_ground.as_chunks::<ABREAST>().0);
    for ((by_q, by_v), (out, by_ground)) in rows.zip(out) {
        // Equal lengths: no bounds checks below.
        let mut of_q = [&by_q[..blocks]; ABREAST];
        let mut of_v = [&by_v[..blocks]; ABREAST];
        for n in 1..ABREAST {
            of_q[n] = &by_q[n * blocks..][..blocks];
            of_v[n] = &by_v[n * blocks..][..blocks];
        }
        let mut sums = [[[0.0; LANES]; 2]; ABREAST];
        for c in 0..blocks {
            for n in 0..ABREAST {
                sums[n][0] = each(|i| sums[n][0][i] + of_q[n][c][i] * q[c][i]);
                sums[n][1] = each(|i| sums[n][1][i] + of_v[n][c][i] * v[c][i]);
            }
        }
        for n in 0..ABREAST {
            let of_modes = from_left_to_right(each(|i| sums[n][0][i] + sums[n][1][i]));
            out[n] = of_modes + (by_ground[n][0] * acceleration + by_ground[n][1] * slope);
        }
    }
}
