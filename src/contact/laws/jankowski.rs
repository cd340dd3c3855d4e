//! `jankowski`: a Hertz spring with a dashpot while the floors approach each other.
//!
//! The seed paper's eq. 8 has lost symbols in print (R for d, VE for sqrt 5, a for e, n for pi): xi is that of
//! \[Jankowski2006\]. What an impact returns depends on xi alone, not on k, m or V.

use crate::contact::{EpisodeForce, Force, Guard, ImpactLaw, LawInfo, LawKey, StiffnessUnit};
use std::f64::consts::PI;

/// What the catalogue knows of it.
pub const INFO: LawInfo = LawInfo {
    name: "jankowski",
    force: "k d^1.5 + 2 xi sqrt(k sqrt(d) m) v while v > 0, k d^1.5 after; \
            xi = 9 sqrt(5) (1 - e^2) / (2 e (e (9 pi - 16) + 16))",
    symbols: "xi dimensionless",
    source: "[Jankowski2005], [Jankowski2006], [BarrosKhatami2013, eqs. 7, 8]",
    returns: "nearly e: 0.4946 for e = 0.5",
    valid: "0 < e <= 1",
    defect: "xi is an approximation: the restitution of a free impact is off by up to 0.0086 for e from 0.05 to 0.95",
    keys: &[LawKey::Stiffness, LawKey::Restitution],
    pulls: false,
    has_damping_formula: false,
    stiffness_unit: Some(StiffnessUnit::NewtonPerMetreToTheThreeHalves),
    episode,
};

fn episode(law: &ImpactLaw, mass: f64, _: Option<f64>) -> EpisodeForce {
    let stiffness = law.stiffness;
    let spring = Force::Power { stiffness, exponent: 1.5, damping: 0.0 };
    let damping = 2.0 * ratio(law.restitution) * (stiffness * mass).sqrt();
    if damping <= 0.0 {
        return EpisodeForce::always(spring);
    }
    let approaching = Guard { constant: 0.0, stiffness: 0.0, damping: 1.0 };
    EpisodeForce { engaged: Force::Root { stiffness, damping }, slack: spring, guard: Some(approaching) }
}

/// xi.
fn ratio(e: f64) -> f64 {
    4.5 * 5.0_f64.sqrt() * (1.0 - e * e) / (e * (e * (9.0 * PI - 16.0) + 16.0))
}
