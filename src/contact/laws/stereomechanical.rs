//! `stereomechanical`: rigid floors that exchange momentum in an instant.
//!
//! With velocities before and after the impact, positive to the right,
//!
//! ```text
//! v_left'  = v_left  - (1 + e) m_right / (m_left + m_right) (v_left - v_right)
//! v_right' = v_right + (1 + e) m_left  / (m_left + m_right) (v_left - v_right)
//! ```
//!
//! which keeps the momentum and loses (1 - e^2) m V^2 / 2. An impact acts on the floors that meet, in multi-storey
//! buildings too: nothing else moves in an instant.

use crate::contact::{EpisodeForce, Force, ImpactLaw, LawInfo, LawKey};

/// What the catalogue knows of it.
pub const INFO: LawInfo = LawInfo {
    name: "stereomechanical",
    force: "none: an instantaneous exchange of momentum, `impulse`; floors whose rebounds die out are held together, \
            d = 0, while `force` pushes",
    symbols: "",
    source: "[Goldsmith1960], [BarrosKhatami2013, eqs. 1, 2]",
    returns: "exactly e",
    valid: "0 <= e <= 1; floors that do not overlap at the start",
    defect: "no penetration, no duration and no force of an impact",
    keys: &[LawKey::ImpulseRestitution],
    pulls: false,
    has_damping_formula: false,
    stiffness_unit: None,
    episode,
};

/// No force: the engine works out impulses and reactions from the motion of all floors together.
fn episode(_: &ImpactLaw, _: f64, _: Option<f64>) -> EpisodeForce {
    EpisodeForce::always(Force::None)
}
