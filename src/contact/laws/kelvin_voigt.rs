//! `kelvin_voigt`: a linear spring and a dashpot side by side, until d = 0.
//!
//! A free impact is half a period of a damped oscillation, over which the velocity changes from V to -e V. It begins
//! with F = c V at d = 0 and ends with F = -c e V at d = 0.

use crate::contact::{EpisodeForce, Force, ImpactLaw, LawInfo, LawKey, StiffnessUnit};
use std::f64::consts::PI;

/// What the catalogue knows of it.
pub const INFO: LawInfo = LawInfo {
    name: "kelvin_voigt",
    force: "k d + c v, c = 2 xi sqrt(k m), xi = -ln e / sqrt(pi^2 + ln^2 e)",
    symbols: "c in N s/m, xi dimensionless",
    source: "[Anagnostopoulos1988], [BarrosKhatami2013, eqs. 4, 5]",
    returns: "exactly e",
    valid: "0 < e <= 1",
    defect: "the force jumps to c V at the entry and becomes tension before the floors part, c e V at the end",
    keys: &[LawKey::Stiffness, LawKey::Restitution],
    pulls: true,
    has_damping_formula: false,
    stiffness_unit: Some(StiffnessUnit::NewtonPerMetre),
    episode,
};

fn episode(law: &ImpactLaw, mass: f64, _: Option<f64>) -> EpisodeForce {
    EpisodeForce::always(Force::Linear { stiffness: law.stiffness, damping: damping(law, mass) })
}

/// c, N s/m.
pub(super) fn damping(law: &ImpactLaw, mass: f64) -> f64 {
    let log = libm::log(law.restitution);
    let ratio = -log / (PI * PI + log * log).sqrt();
    2.0 * ratio * (law.stiffness * mass).sqrt()
}
