//! The pairs whose law is rigid.

use crate::engine::pairs::pair::Pair;
use nalgebra::DMatrix;

/// The rigid pairs and their coupling by common floors.
#[derive(Debug)]
pub struct RigidPairs {
    /// Numbers of the rigid pairs among all pairs.
    pub pairs: Vec<usize>,
    /// J M^-1 J', 1/kg: minus the change of one pair's rate per unit impulse of another. Only pairs with a common floor
    /// are coupled.
    pub matrix: DMatrix<f64>,
}

impl RigidPairs {
    /// The rigid pairs among all.
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
