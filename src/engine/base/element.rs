//! One element that can yield, a storey or the spring of a link that slips: whether it does, and how far it has.

use crate::numerics::sum::Sum;
use serde::{Deserialize, Serialize};

/// The sense in which an element yields.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) enum Sense {
    /// Its drift grows: the upper floor moves to the right.
    Positive,
    Negative,
}

impl Sense {
    /// Both senses.
    pub(crate) const BOTH: [Sense; 2] = [Sense::Positive, Sense::Negative];

    /// 1 or -1.
    pub(crate) fn sign(self) -> f64 {
        match self {
            Sense::Positive => 1.0,
            Sense::Negative => -1.0,
        }
    }
}

/// The state of one element that can yield. What its elastic part z = drift - plastic drift is follows from the motion, but
/// while it yields and where it has just turned back: there |z| is the yield drift exactly.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct ElementState {
    /// The sense in which it yields; `None` while it is elastic.
    pub yields: Option<Sense>,
    /// The sense in which it has yielded up to this very instant, at which its drift turns: the rate of z is exactly 0.
    pub turned: Option<Sense>,
    /// Plastic drift, m.
    pub plastic: f64,
    /// Sum of the magnitudes of its changes, m.
    pub cumulative: Sum,
    /// Largest magnitude of the plastic drift so far, m.
    pub furthest: f64,
}

impl ElementState {
    /// The element after its plastic drift has changed by `step`, m, in one sense.
    pub(crate) fn after(self, step: f64) -> ElementState {
        let plastic = self.plastic + step;
        let mut cumulative = self.cumulative;
        cumulative.add(step.abs());
        ElementState { plastic, cumulative, furthest: self.furthest.max(plastic.abs()), ..self }
    }

    /// Its numbers, for the checks of a saved state.
    pub(crate) fn numbers(&self) -> [f64; 4] {
        let &ElementState { yields: _, turned: _, plastic, cumulative, furthest } = self;
        [plastic, cumulative.value, cumulative.lost, furthest]
    }
}
