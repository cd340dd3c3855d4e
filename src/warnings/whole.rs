//! Scenes in which every mass and every stiffness is in other units: periods and contacts are then as they should be, and
//! only the size of the masses tells.

use super::facts::{Facts, Pace, mean_mass};
use super::found::Found;
use crate::figures::short;
use crate::scene::{Building, Units};
use crate::structure::BuildingId;

/// Where a scene has been given in t and kN without saying so.
pub(super) const IN_KN_T: &str = " (a scene with units = \"kN-t\" takes t and kN throughout)";

/// kg of a floor on average that is too light for a building and would be usual in t.
const LIGHT: std::ops::Range<f64> = 50.0..2000.0;
/// kg of a floor on average that is too heavy for any building: a hectare of it has 1e7 kg.
pub(super) const HEAVY: f64 = 2e7;
/// m: the narrowest gap that buildings in full size have and that laboratory frames seldom have.
const WIDE: f64 = 0.02;
/// s for each storey: buildings in full size are seldom faster.
const FAST: f64 = 0.07;

pub(super) fn look(facts: &Facts<'_>, found: &mut Found) {
    let is_sound = |pace: &Pace| matches!(pace, Pace::Usual | Pace::Wall);
    let is_odd = |building: &Building| found.has(&building.path);
    if !facts.pace.iter().all(is_sound) || facts.scene.buildings.iter().any(is_odd) {
        return;
    }
    // A wall may have any mass.
    let sides: Vec<(BuildingId, f64)> = facts.usual_periods().collect();
    let Some(&(first, _)) = sides.first() else { return };
    let mean = |id: BuildingId| mean_mass(facts.building(id));
    let are_all = |size: fn(f64) -> bool| sides.iter().all(|&(id, _)| size(mean(id)));
    let mass = short(facts.scene.units.written(mean(first)));
    let text = match facts.scene.units {
        Units::KilonewtonTonne if are_all(|mass| mass >= HEAVY) => format!(
            "a floor has {mass} t on average, as no building has; masses are in t, were all masses and forces given in kg \
             and N (units = \"SI\")?"
        ),
        Units::Si if are_all(|mass| LIGHT.contains(&mass)) && is_like_buildings(facts, &sides) => format!(
            "a floor has {mass} kg on average, that of a laboratory frame, at periods and gaps of buildings; masses are in \
             kg and forces in N, were all of them given in t and kN (units = \"kN-t\")?"
        ),
        _ => return,
    };
    found.quantities(format!("{}.mass", facts.building(first).path), &facts.building(first).mass, text);
}

/// Frames in laboratories may be as light, but seldom are as slow and as far apart, and have fewer floors.
fn is_like_buildings(facts: &Facts<'_>, sides: &[(BuildingId, f64)]) -> bool {
    let floors = |id: BuildingId| facts.building(id).mass.len();
    let contacts = &facts.scene.contacts;
    sides.iter().map(|&(id, _)| floors(id)).sum::<usize>() >= 4
        && sides.iter().all(|&(id, period)| period >= FAST * floors(id) as f64)
        && !contacts.is_empty()
        && contacts.iter().all(|pair| pair.gap >= WIDE)
}
