//! `hertz_damped`: a Hertz spring whose damping goes with the spring force.
//!
//! From m v dv = -k d^n (1 + a v/V) dd follows what a free impact returns, whatever k, n, m and V \[Gonthier2004\]:
//! a (1 + e) = ln[(1 + a) / (1 - a e)]. It ends with v > -V/a, where the force still pushes. A contact that something
//! else pulls apart faster than V/a would pull: there the force is 0.

use crate::contact::{DampingFormula, EpisodeForce, Force, Guard, ImpactLaw, LawInfo, LawKey, StiffnessUnit};

/// What the catalogue knows of it.
pub const INFO: LawInfo = LawInfo {
    name: "hertz_damped",
    force: "k d^n max(0, 1 + a v/V), a from e by `damping_formula`",
    symbols: "n and a dimensionless",
    source: "[Gonthier2004], [BarrosKhatami2013, eqs. 9-11, 14]",
    returns: "what the formula makes of e, whatever k, n, m and V: exactly e with `exact`",
    valid: "0 < e <= 1; 1 <= n <= 3; V from `solver.min_approach_velocity` on, which stands for a smaller one; floors that \
            overlap at the start are not damped until they part",
    defect: "the damping is scaled with the approach velocity V for the whole contact, however the motion of the \
             buildings changes the speed meanwhile",
    keys: &[LawKey::Stiffness, LawKey::Exponent, LawKey::Restitution],
    pulls: false,
    has_damping_formula: true,
    stiffness_unit: Some(StiffnessUnit::NewtonPerMetreToTheExponent),
    episode,
};

fn episode(law: &ImpactLaw, _: f64, approach: Option<f64>) -> EpisodeForce {
    let formula = law.damping_formula.unwrap_or(DampingFormula::Exact);
    let stiffness = law.stiffness * formula.info().spring_factor;
    let damping = approach.map_or(0.0, |speed| formula.coefficient(law.restitution) / speed);
    let guard = (damping > 0.0).then_some(Guard { constant: 1.0, stiffness: 0.0, damping });
    let engaged = Force::Power { stiffness, exponent: law.exponent, damping };
    EpisodeForce { engaged, slack: Force::None, guard }
}
