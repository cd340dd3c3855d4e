//! Error tolerance of one step in contact, and the order of its series.

use crate::numerics::polynomial::MAX_ORDER;

/// Share of `relative_tolerance` for one step: an episode takes some thirty steps and an earthquake some hundred
/// episodes, whose errors add up. With this share the golden scenes of `tests/physics/golden.rs` come out within
/// `relative_tolerance`; with ten times as much, `hertz` is ten times less accurate for hardly fewer steps.
const STEP_SHARE: f64 = 0.002;

/// Error tolerance of a step in contact, and the order of the series that fits it.
#[derive(Clone, Copy, Debug)]
pub struct Tolerance {
    /// Velocity error of one step, relative to the velocity scale.
    pub step: f64,
    /// Order of the Taylor series.
    pub order: usize,
    /// Order of the series while only linear laws act, at least `order`.
    pub linear_order: usize,
}

impl Tolerance {
    /// For the relative tolerance of a scene.
    pub fn of(relative_tolerance: f64) -> Tolerance {
        let step = STEP_SHARE * relative_tolerance;
        // 1.5 powers per digit cost about least: with 1.2, single masses took 5 to 15 % more instructions, tall frames
        // as many.
        let order = (-1.5 * libm::log10(step)).round().clamp(8.0, (MAX_ORDER - 2) as f64) as usize;
        Tolerance { step, order, linear_order: linear_order(step, order) }
    }
}

/// Phase angle, rad, of a contact under a linear law from its entry to its release, divided by the share of a series'
/// reach that one step uses.
const WHOLE_CONTACT: f64 = 3.5;

/// The order at which one series takes a linear contact from entry to release. A further power costs only a few
/// products there, whereas each step costs its event search and its end.
fn linear_order(tolerance: f64, order: usize) -> usize {
    let (mut term, mut powers) = (1.0, 0);
    while term > tolerance && powers < MAX_ORDER - 2 {
        powers += 1;
        term *= WHOLE_CONTACT / powers as f64;
    }
    powers.max(order)
}
