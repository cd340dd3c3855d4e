//! `hertz`: a spring that stiffens with the penetration.

use crate::contact::{EpisodeForce, Force, ImpactLaw, LawInfo, LawKey, StiffnessUnit};

/// What the catalogue knows of it.
pub const INFO: LawInfo = LawInfo {
    name: "hertz",
    force: "k d^n",
    symbols: "n dimensionless",
    source: "[Hertz1882], [Goldsmith1960], [BarrosKhatami2013, eq. 6]",
    returns: "1",
    valid: "1 <= n <= 3; n = 3/2 for round bodies that do not yield",
    defect: "loses no energy",
    keys: &[LawKey::Stiffness, LawKey::Exponent],
    pulls: false,
    has_damping_formula: false,
    stiffness_unit: Some(StiffnessUnit::NewtonPerMetreToTheExponent),
    episode,
};

fn episode(law: &ImpactLaw, _: f64, _: Option<f64>) -> EpisodeForce {
    let (stiffness, exponent, damping) = (law.stiffness, law.exponent, 0.0);
    EpisodeForce::always(match exponent {
        1.0 => Force::Linear { stiffness, damping },
        _ => Force::Power { stiffness, exponent, damping },
    })
}
