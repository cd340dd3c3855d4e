//! `linear`: a linear spring. A free impact is half a period of an undamped oscillation.

use crate::contact::{EpisodeForce, Force, ImpactLaw, LawInfo, LawKey, StiffnessUnit};

/// What the catalogue knows of it.
pub const INFO: LawInfo = LawInfo {
    name: "linear",
    force: "k d",
    symbols: "",
    source: "[BarrosKhatami2013, eq. 3]",
    returns: "1, after a contact that lasts pi sqrt(m/k)",
    valid: "impacts that lose no energy",
    defect: "loses no energy",
    keys: &[LawKey::Stiffness],
    pulls: false,
    has_damping_formula: false,
    stiffness_unit: Some(StiffnessUnit::NewtonPerMetre),
    episode,
};

fn episode(law: &ImpactLaw, _: f64, _: Option<f64>) -> EpisodeForce {
    EpisodeForce::always(Force::Linear { stiffness: law.stiffness, damping: 0.0 })
}
