//! Where the number of each parameter stands in a scene.

use super::slot::Parameter;
use crate::scene::{Damping, Face, Foundation, FoundationKey as Key, Scaling, Scene, Stiffness};

/// One match for reading and for writing: `$building` takes a building of the scene, `$as_ref` what is in an `Option`,
/// and `$mut` is `mut` where the number is to be changed, nothing where it is read.
macro_rules! number {
    ($scene:ident, $parameter:ident, $building:expr, $as_ref:ident $(, $mut:tt)?) => {
        match $parameter {
            Parameter::GroundRecord => None,
            Parameter::GroundScale => match &$($mut)? $scene.ground.scaling {
                Scaling::Scale(factor) => Some(factor),
                Scaling::Pga(_) => None,
            },
            Parameter::Mass(id, floor) => Some(&$($mut)? $building($scene, id).mass[floor]),
            Parameter::Stiffness(id, storey) => match &$($mut)? $building($scene, id).stiffness {
                Stiffness::Shear(storeys) => Some(&$($mut)? storeys[storey]),
                Stiffness::Matrix(_) => None,
            },
            Parameter::DampingRatio(id) => match &$($mut)? $building($scene, id).damping {
                Damping::Ratio(ratio) => Some(ratio),
                _ => None,
            },
            Parameter::Dashpot(id, storey) => match &$($mut)? $building($scene, id).damping {
                Damping::Dashpots(storeys) => Some(&$($mut)? storeys[storey]),
                _ => None,
            },
            Parameter::YieldForce(id, storey) => {
                $building($scene, id).yielding.$as_ref().map(|yielding| &$($mut)? yielding.force[storey])
            }
            Parameter::PostYieldRatio(id, storey) => {
                $building($scene, id).yielding.$as_ref().map(|yielding| &$($mut)? yielding.ratio[storey])
            }
            Parameter::Foundation(id, key) => match (key, &$($mut)? $building($scene, id).foundation) {
                (Key::Mass, Some(Foundation { mass, .. })) => Some(mass),
                (Key::Inertia, Some(Foundation { inertia, rocking: Some(_), .. })) => Some(inertia),
                (Key::SwayStiffness, Some(Foundation { sway: Some(soil), .. }))
                | (Key::RockingStiffness, Some(Foundation { rocking: Some(soil), .. })) => {
                    Some(&$($mut)? soil.stiffness)
                }
                (Key::SwayDashpot, Some(Foundation { sway: Some(soil), .. }))
                | (Key::RockingDashpot, Some(Foundation { rocking: Some(soil), .. })) => Some(&$($mut)? soil.dashpot),
                _ => None,
            },
            Parameter::Gap(p) => Some(&$($mut)? $scene.contacts[p].gap),
            Parameter::Position(p) => {
                let pair = &$($mut)? $scene.contacts[p];
                match (&$($mut)? pair.left, &$($mut)? pair.right) {
                    (Face::Columns { position, .. }, _) | (_, Face::Columns { position, .. }) => Some(position),
                    _ => None,
                }
            }
            Parameter::ContactStiffness(p) => Some(&$($mut)? $scene.contacts[p].law.stiffness),
            Parameter::Exponent(p) => Some(&$($mut)? $scene.contacts[p].law.exponent),
            Parameter::Restitution(p) => Some(&$($mut)? $scene.contacts[p].law.restitution),
            Parameter::LinkStiffness(l) => Some(&$($mut)? $scene.links[l].stiffness),
            Parameter::LinkDashpot(l) => Some(&$($mut)? $scene.links[l].dashpot),
            Parameter::SlipForce(l) => $scene.links[l].slip.$as_ref().map(|slip| &$($mut)? slip.force),
            Parameter::LinkPostYieldRatio(l) => $scene.links[l].slip.$as_ref().map(|slip| &$($mut)? slip.ratio),
            Parameter::RelativeTolerance => Some(&$($mut)? $scene.solver.relative_tolerance),
        }
    };
}

/// The number of a parameter as the scene has it; none where it has none.
pub(super) fn number(scene: &Scene, parameter: Parameter) -> Option<f64> {
    number!(scene, parameter, Scene::building, as_ref).copied()
}

/// The same, to be changed.
pub(super) fn number_mut(scene: &mut Scene, parameter: Parameter) -> Option<&mut f64> {
    number!(scene, parameter, Scene::building_mut, as_mut, mut)
}
