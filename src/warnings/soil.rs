//! Foundations on soil: springs that hardly differ from a fixed base or let the building swing far too slowly, dashpots that
//! let nothing swing, moments of inertia of no foundation.

use super::facts::Facts;
use super::found::Found;
use crate::figures::short;
use crate::scene::{Building, Foundation, Soil, Units};
use crate::structure::FirstMode;

/// First period on the soil over that on a fixed base, beyond which and up to which soil is odd.
const MOST_LENGTHENED: f64 = 2.0;
const HARDLY_LENGTHENED: f64 = 1.001;
/// Radii of gyration that foundations have, m.
const RADII: std::ops::RangeInclusive<f64> = 0.01..=100.0;
/// A unit with kN in it holds so many with N.
const KILO: f64 = 1e3;

pub(super) fn look(facts: &Facts<'_>, found: &mut Found) {
    for id in facts.scene.ids() {
        let building = facts.building(id);
        // A building with other units makes its soil look odd.
        let (Some(foundation), false) = (&building.foundation, found.has(&building.path)) else { continue };
        if let Some(first) = &facts.first[id.index()] {
            look_at_period(
                (facts.scene.units, &building.path),
                foundation,
                springs(building, first, foundation),
                found,
            );
        }
        look_at_dashpots(building, foundation, found);
        look_at_inertia(&building.path, foundation, found);
    }
}

/// How much the springs of sway and rocking add to the square of the first period, as shares of that on a fixed base: those
/// of one mass on a column, whose mass, stiffness and height are those of the first mode.
fn springs(building: &Building, first: &FirstMode, foundation: &Foundation) -> [f64; 2] {
    let moving = || building.mass.iter().zip(&first.shape);
    let [all, squares] = [1, 2].map(|power| moving().map(|(m, x)| m * x.powi(power)).sum::<f64>());
    let height = moving().zip(levels(building)).map(|((m, x), level)| m * x * level).sum::<f64>() / all;
    let stiffness = first.omega * first.omega * all * all / squares;
    let share = |soil: Option<Soil>, of: f64| soil.map_or(0.0, |soil| of / soil.stiffness);
    [share(foundation.sway, stiffness), share(foundation.rocking, stiffness * height * height)]
}

/// m, of the floors above the foundation.
fn levels(building: &Building) -> impl Iterator<Item = f64> {
    building.heights.iter().flat_map(|heights| (1..).map(|i| heights.level(i) - heights.base_level))
}

fn look_at_period((units, name): (Units, &str), foundation: &Foundation, shares: [f64; 2], found: &mut Found) {
    let ratio = (1.0 + shares[0] + shares[1]).sqrt();
    let is_sway = shares[0] >= shares[1];
    let (key, soil, unit) = match is_sway {
        true => ("sway", foundation.sway, "N/m"),
        false => ("rocking", foundation.rocking, "N m/rad"),
    };
    let Some(soil) = soil else { return };
    let path = format!("{name}.foundation.{key}.stiffness");
    let given = units.unit(unit);
    let (text, is_in_other, other) = if ratio > MOST_LENGTHENED {
        let meant = shares[0].max(shares[1]) / KILO + shares[0].min(shares[1]);
        let is_in_kn = units == Units::Si && (HARDLY_LENGTHENED..MOST_LENGTHENED).contains(&(1.0 + meant).sqrt());
        let times = short(ratio);
        let text = format!(
            "with this soil the first period is {times} times that on a fixed base, where soil seldom doubles it"
        );
        (text, is_in_kn, format!("k{unit}"))
    } else if ratio < HARDLY_LENGTHENED {
        let times = format!("the first period is {ratio:.7} times that on a fixed base");
        let text = format!("hardly any soil: {times}, which no foundation would say as well");
        (text, units == Units::KilonewtonTonne, unit.to_owned())
    } else {
        return;
    };
    let hint = if is_in_other { format!(", was it given in {other}?") } else { String::new() };
    found.quantity(path, soil.stiffness, format!("{text}; it is in {given}{hint}"));
}

/// Judged by the building as a rigid body on the soil.
fn look_at_dashpots(building: &Building, foundation: &Foundation, found: &mut Found) {
    let name = &building.path;
    let turned: f64 = building.mass.iter().zip(levels(building)).map(|(m, level)| m * level * level).sum();
    let mass = foundation.mass + building.mass.iter().sum::<f64>();
    let of = [("sway", foundation.sway, mass), ("rocking", foundation.rocking, foundation.inertia + turned)];
    for (key, soil, inertia) in of {
        let spring_is_odd = found.has(&format!("{name}.foundation.{key}.stiffness"));
        let (Some(Soil { stiffness, dashpot }), false) = (soil, spring_is_odd) else { continue };
        let ratio = 0.5 * dashpot / (stiffness * inertia).sqrt();
        if ratio > 1.0 {
            let motion = if key == "sway" { "sways" } else { "rocks" };
            let text = format!(
                "{} times critical damping of the building as it {motion} on the soil: it creeps back instead of swinging",
                short(ratio)
            );
            found.quantity(format!("{name}.foundation.{key}.dashpot"), dashpot, text);
        }
    }
}

fn look_at_inertia(name: &str, foundation: &Foundation, found: &mut Found) {
    if foundation.rocking.is_none() {
        return;
    }
    let radius = (foundation.inertia / foundation.mass).sqrt();
    if !RADII.contains(&radius) {
        let text = format!(
            "that of the mass of the foundation at {} m from its centre: no foundation is like that",
            short(radius)
        );
        found.quantity(format!("{name}.foundation.inertia"), foundation.inertia, text);
    }
}
