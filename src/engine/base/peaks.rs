//! The largest magnitudes so far of the watched quantities.

use crate::numerics::polynomial::larger;
use crate::structure::{LANES, Lane};
use serde::{Deserialize, Serialize};

/// The peaks up to the base, in the order and units of `quantities/rows.rs`.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(crate) struct Peaks {
    /// One peak per watched quantity, in blocks of [`LANES`]; 0 in lanes without a quantity.
    pub values: Vec<f64>,
}

impl Peaks {
    /// Peaks of 0, for that many blocks of quantities.
    pub(crate) fn new(blocks: usize) -> Peaks {
        Peaks { values: vec![0.0; blocks * LANES] }
    }

    /// Whether these are as many peaks as `other` and none of them is negative or NaN.
    pub(crate) fn fit(&self, other: &Peaks) -> bool {
        self.values.len() == other.values.len() && self.values.iter().all(|peak| *peak >= 0.0)
    }

    /// All peaks.
    pub(crate) fn numbers(&self) -> impl Iterator<Item = f64> + '_ {
        let Peaks { values } = self;
        values.iter().copied()
    }

    /// The peaks of one block of quantities.
    pub(crate) fn block(&self, block: usize) -> &Lane {
        &self.values.as_chunks::<LANES>().0[block]
    }

    /// Raises each peak to another one.
    pub(crate) fn raise_all(&mut self, others: &Peaks) {
        self.values.iter_mut().zip(&others.values).for_each(|(peak, other)| *peak = larger(*peak, *other));
    }

    /// Raises the peak at an index to the magnitude of a value.
    pub(crate) fn raise(&mut self, place: usize, value: f64) {
        let peak = &mut self.values[place];
        *peak = larger(*peak, value.abs());
    }
}
