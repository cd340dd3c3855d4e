//! Scenes in which every mass and every stiffness is in other units: periods and contacts are then as they should be, and
//! only the size of the masses tells.

use super::facts::{Facts, Pace};
use super::found::Found;
use crate::figures::short;
use crate::scene::{Building, Units};

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
    let scene = facts.scene;
    let is_usual = facts.pace == [Pace::Usual; 2] && !found.has("left") && !found.has("right");
    if !is_usual {
        return;
    }
    let masses = [&scene.left, &scene.right].map(mean_mass);
    if scene.units == Units::KilonewtonTonne && masses.iter().all(|&mass| mass >= HEAVY) {
        let text = format!(
            "a floor has {} t on average, as no building has; masses are in t, were all masses and forces given in kg and N \
             (units = \"SI\")?",
            short(scene.units.written(masses[0]))
        );
        found.quantities("left.mass", &scene.left.mass, text);
    }
    // Frames in laboratories are as light, but not as slow and as far apart, and have fewer floors.
    let is_like_buildings = scene.left.mass.len() + scene.right.mass.len() >= 4
        && facts.usual_periods().all(|(side, period)| period >= FAST * facts.building(side).mass.len() as f64)
        && !scene.contacts.is_empty()
        && scene.contacts.iter().all(|pair| pair.gap >= WIDE);
    if scene.units == Units::Si && is_like_buildings && masses.iter().all(|mass| LIGHT.contains(mass)) {
        let text = format!(
            "a floor has {} kg on average, that of a laboratory frame, at periods and gaps of buildings; masses are in kg and \
             forces in N, were all of them given in t and kN (units = \"kN-t\")?",
            short(masses[0])
        );
        found.quantities("left.mass", &scene.left.mass, text);
    }
}

fn mean_mass(building: &Building) -> f64 {
    building.mass.iter().sum::<f64>() / building.mass.len().max(1) as f64
}
