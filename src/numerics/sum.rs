//! Sums of many terms.

use serde::{Deserialize, Serialize};

/// A sum, with the rounding error that it has lost (Neumaier's compensated summation).
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Sum {
    /// The plain sum of all terms.
    pub value: f64,
    /// What its rounding has left out.
    pub lost: f64,
}

impl Sum {
    /// Adds a term.
    #[inline(always)]
    pub(crate) fn add(&mut self, term: f64) {
        let sum = self.value + term;
        let (large, small) = if self.value.abs() > term.abs() { (self.value, term) } else { (term, self.value) };
        self.lost += (large - sum) + small;
        self.value = sum;
    }

    /// Its numbers, for the checks of a saved state.
    pub(crate) fn numbers(&self) -> [f64; 2] {
        [self.value, self.lost]
    }

    /// The sum without the rounding errors of its additions.
    pub(crate) fn exact(&self) -> f64 {
        self.value + self.lost
    }
}
