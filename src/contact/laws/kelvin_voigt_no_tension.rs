//! `kelvin_voigt_no_tension`: [`kelvin_voigt`] with the pull at the end left out.
//!
//! A free impact ends in effect where k d + c v = 0, before the end of the half period that c is derived for. It returns
//! exp(-2 xi acos(xi) / sqrt(1 - xi^2)).

use super::kelvin_voigt;
use crate::contact::{EpisodeForce, Force, Guard, ImpactLaw, LawInfo, LawKey, StiffnessUnit};

/// What the catalogue knows of it.
pub const INFO: LawInfo = LawInfo {
    name: "kelvin_voigt_no_tension",
    force: "max(0, k d + c v), c as in `kelvin_voigt`",
    symbols: "c in N s/m, xi dimensionless",
    source: "[Komodromos2007], [BarrosKhatami2013, section 2.2]",
    returns: "more than e: 0.5503 for e = 0.5",
    valid: "0 < e <= 1",
    defect: "c is that of a contact with tension, which lasts until d = 0, while this force ends earlier; it jumps to c V \
             at the entry",
    keys: &[LawKey::Stiffness, LawKey::Restitution],
    pulls: false,
    has_damping_formula: false,
    stiffness_unit: Some(StiffnessUnit::NewtonPerMetre),
    episode,
};

fn episode(law: &ImpactLaw, mass: f64, _: Option<f64>) -> EpisodeForce {
    let (stiffness, damping) = (law.stiffness, kelvin_voigt::damping(law, mass));
    let guard = (damping > 0.0).then_some(Guard { constant: 0.0, stiffness, damping });
    EpisodeForce { engaged: Force::Linear { stiffness, damping }, slack: Force::None, guard }
}
