//! The largest magnitudes so far.

use crate::numerics::polynomial::larger;
use crate::structure::{LANES, Lane};
use serde::{Deserialize, Serialize};

/// The peaks up to the base, in the places of [`PeakRows`].
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct Peaks {
    pub values: Vec<f64>,
}

impl Peaks {
    /// No peak yet, of so many blocks of quantities.
    pub fn new(blocks: usize) -> Peaks {
        Peaks { values: vec![0.0; blocks * LANES] }
    }

    /// Whether they can be peaks of the same quantities.
    pub fn fit(&self, other: &Peaks) -> bool {
        self.values.len() == other.values.len() && self.values.iter().all(|peak| *peak >= 0.0)
    }

    /// All numbers in it.
    pub fn numbers(&self) -> impl Iterator<Item = f64> + '_ {
        let Peaks { values } = self;
        values.iter().copied()
    }

    pub fn block(&self, block: usize) -> &Lane {
        &self.values.as_chunks::<LANES>().0[block]
    }

    pub fn raise(&mut self, place: usize, value: f64) {
        let peak = &mut self.values[place];
        *peak = larger(*peak, value.abs());
    }
}
