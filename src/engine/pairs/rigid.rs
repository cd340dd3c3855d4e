//! The pairs whose law is rigid.

use crate::engine::pairs::pair::Pair;
use nalgebra::DMatrix;

/// The rigid pairs and their coupling by common floors.
#[derive(Debug)]
pub(crate) struct RigidPairs {
    /// Numbers of the rigid pairs among all pairs.
    pub pairs: Vec<usize>,
    /// J M^-1 J', 1/kg: minus the change of one pair's rate per unit impulse of another. Only pairs with a common floor
    /// are coupled.
    pub matrix: DMatrix<f64>,
}

impl RigidPairs {
    /// The rigid pairs among all.
    pub(crate) fn of(all: &[Pair]) -> RigidPairs {
        let pairs: Vec<usize> = (0..all.len()).filter(|&p| all[p].law.is_rigid()).collect();
        let effect = |i: usize, j: usize| all[pairs[i]].softness(&all[pairs[j]]);
        let matrix = DMatrix::from_fn(pairs.len(), pairs.len(), effect);
        RigidPairs { pairs, matrix }
    }
}
