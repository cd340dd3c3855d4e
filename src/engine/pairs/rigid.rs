//! The pairs whose law is rigid.

use crate::engine::pairs::pair::Pair;
use nalgebra::DMatrix;

/// Which pairs are rigid, and how they act on each other.
#[derive(Debug)]
pub struct RigidPairs {
    /// Their numbers among all pairs.
    pub pairs: Vec<usize>,
    /// 1/kg: what an impulse between one pair does to the rate of another. Only pairs that share a floor do.
    pub matrix: DMatrix<f64>,
}

impl RigidPairs {
    pub fn of(all: &[Pair]) -> RigidPairs {
        let pairs: Vec<usize> = (0..all.len()).filter(|&p| all[p].law.is_rigid()).collect();
        let shared = |a: &Pair, b: &Pair, side: usize| {
            if a.floors[side] == b.floors[side] { 1.0 / a.masses[side] } else { 0.0 }
        };
        let effect = |i: usize, j: usize| {
            let (a, b) = (&all[pairs[i]], &all[pairs[j]]);
            shared(a, b, 0) + shared(a, b, 1)
        };
        let matrix = DMatrix::from_fn(pairs.len(), pairs.len(), effect);
        RigidPairs { pairs, matrix }
    }
}
