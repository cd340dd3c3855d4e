//! The accuracy of one step in contact, and the order of its series.

use crate::numerics::polynomial::MAX_ORDER;

/// Share of `relative_tolerance` that one step may use: an episode takes some thirty steps and an earthquake some
/// hundred episodes, whose errors add up. With this share the golden scenes of `tests/golden.rs` come out within
/// `relative_tolerance`; with ten times as much, `hertz` is ten times worse for hardly fewer steps.
const STEP_SHARE: f64 = 0.002;

/// How accurate a step in contact has to be, and how many powers its series have for that.
#[derive(Clone, Copy, Debug)]
pub struct Tolerance {
    /// Velocity error allowed to one step, relative to the velocity scale.
    pub step: f64,
    /// Order of the series.
    pub order: usize,
    /// The same under linear laws, where it is worth while.
    pub linear_order: usize,
}

impl Tolerance {
    /// For that of a scene.
    pub fn of(relative_tolerance: f64) -> Tolerance {
        let step = STEP_SHARE * relative_tolerance;
        // 1.5 for each digit is about cheapest: with 1.2 single masses took 5 to 15 % more instructions, tall frames as
        // many.
        let order = (-1.5 * libm::log10(step)).round().clamp(8.0, (MAX_ORDER - 2) as f64) as usize;
        Tolerance { step, order, linear_order: linear_order(step, order) }
    }
}

/// Phase of its swing, rad, that a contact under a linear law goes through from entry to release, over the share of its
/// reach that a series is used for.
const WHOLE_CONTACT: f64 = 3.5;

/// The order at which one series takes a linear contact from entry to release: there each power costs a few products only,
/// where each step costs its events and its end.
fn linear_order(tolerance: f64, order: usize) -> usize {
    let (mut term, mut powers) = (1.0, 0);
    while term > tolerance && powers < MAX_ORDER - 2 {
        powers += 1;
        term *= WHOLE_CONTACT / powers as f64;
    }
    powers.max(order)
}
