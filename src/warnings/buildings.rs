//! Masses, stiffnesses, damping and initial motion of each building.

use super::facts::{Facts, Pace, how_many_times, inertia_of, mean_mass, median, nearest, stiffness_key};
use super::found::Found;
use super::whole::{HEAVY, IN_KN_T};
use crate::figures::short;
use crate::record::STANDARD_GRAVITY;
use crate::scene::{Building, Damping, Stiffness, Units, number};
use crate::structure::{BuildingId, FirstMode};
use std::f64::consts::PI;

/// Largest damping ratio without a warning: isolators and dampers of buildings stay below.
const MOST_DAMPING: f64 = 0.3;
/// Smallest damping ratio above 0 without a warning: not even steel has less.
const LEAST_DAMPING: f64 = 2e-4;

pub(super) fn look(facts: &Facts<'_>, found: &mut Found) {
    for id in facts.scene.ids() {
        let building = facts.building(id);
        look_at_entries(facts, id, found);
        if ["mass", "stiffness"].iter().all(|key| !found.has(&format!("{}.{key}", building.path))) {
            look_at_period(facts, id, found);
            facts.neighbours(id).for_each(|other| look_at_storey_masses(facts, (id, other), found));
        }
        look_at_damping(facts, id, building, found);
        look_at_start(facts, id, building, found);
    }
}

/// Entries of a list that the others speak against.
fn look_at_entries<'a>(facts: &Facts<'a>, id: BuildingId, found: &mut Found) {
    let (building, units) = (facts.building(id), facts.scene.units);
    let name = &building.path;
    let mut tell = |(key, unit): (&str, &str), values: &[f64], odd: Vec<OddEntry>, beside: &str| {
        for OddEntry { index, factor } in odd {
            let times = how_many_times(factor);
            let text = format!(
                "{times} the {beside} beside it; all are in {}{}",
                units.unit(unit),
                other_unit(factor, units, unit)
            );
            found.quantity(format!("{name}.{key}[{}]", index + 1), values[index], text);
        }
    };
    let others = || facts.neighbours(id).map(|other| facts.building(other));
    let masses: Vec<f64> = others().flat_map(|other| &other.mass).copied().collect();
    let odd = odd_entries(&building.mass, &masses, |_| false);
    tell(("mass", "kg"), &building.mass, odd, "masses of the floors");
    let Stiffness::Shear(storeys) = &building.stiffness else { return };
    let of_shear = |other: &'a Building| match &other.stiffness {
        Stiffness::Shear(others) => others.as_slice(),
        Stiffness::Matrix(_) => &[],
    };
    let others: Vec<f64> = others().flat_map(of_shear).copied().collect();
    // A soft first storey is an isolated building, unless that makes it slower than any.
    let is_isolated = |odd: &OddEntry| odd.index == 0 && odd.factor < 1.0 && facts.pace(id) == Pace::Usual;
    tell(("stiffness", "N/m"), storeys, odd_entries(storeys, &others, is_isolated), "stiffness of the storeys");
}

/// An entry of a list that the others speak against.
struct OddEntry {
    index: usize,
    /// How many times what the others let expect.
    factor: f64,
}

/// Entries far from their neighbours: at either end of the list by 50, within it by 8 from both
/// neighbours. Where a list steps by 200 it is the entry above the step, wherever that is.
fn odd_entries(values: &[f64], others: &[f64], is_meant: impl Fn(&OddEntry) -> bool) -> Vec<OddEntry> {
    let mut odd: Vec<OddEntry> = Vec::new();
    let usual = median(values.iter().copied()).unwrap_or(1.0);
    for (index, &value) in values.iter().enumerate() {
        let beside = [index.checked_sub(1), Some(index + 1)].map(|j| j.and_then(|j| values.get(j).copied()));
        let (factor, least) = match beside {
            [Some(below), Some(above)] => (nearest(value, &[below, above, usual]), 8.0),
            [Some(one), None] | [None, Some(one)] if values.len() > 2 => (nearest(value, &[one, usual]), 50.0),
            _ => continue,
        };
        let entry = OddEntry { index, factor };
        if factor.max(1.0 / factor) >= least && !is_meant(&entry) {
            odd.push(entry);
        }
    }
    let is_far = |factor: f64| factor.max(1.0 / factor) >= 200.0;
    for (i, pair) in values.windows(2).enumerate() {
        let is_said = odd.iter().any(|known| known.index == i || known.index == i + 1);
        let factor = pair[1] / pair[0];
        let below = OddEntry { index: i, factor: 1.0 / factor };
        if is_said || !is_far(factor) || is_meant(&below) {
            continue;
        }
        // Of two floors the neighbour tells which one is odd.
        let neighbour = median(others.iter().copied()).unwrap_or(pair[0]);
        let first_is_odd = values.len() == 2 && distance(pair[0], neighbour) > distance(pair[1], neighbour);
        odd.push(if first_is_odd { below } else { OddEntry { index: i + 1, factor } });
    }
    odd
}

fn distance(value: f64, other: f64) -> f64 {
    (value / other).ln().abs()
}

/// What may have been meant by an entry that is off by a factor: `unit` is that of the SI.
fn other_unit(factor: f64, units: Units, unit: &str) -> String {
    match (factor, units) {
        (3e-4..3e-3, Units::Si) => format!("; was it given in {}?", Units::KilonewtonTonne.unit(unit)),
        (300.0..3000.0, Units::KilonewtonTonne) => format!("; was it given in {unit}?"),
        _ => "; is its power of ten right?".to_owned(),
    }
}

fn look_at_period(facts: &Facts<'_>, id: BuildingId, found: &mut Found) {
    let building = facts.building(id);
    let Some(period) = facts.period(id) else { return };
    let count = building.mass.len();
    let usual = format!("{} with some {} s", storeys(count), short(0.1 * count as f64));
    let found_here = format!("the first natural frequency is {} Hz, period {} s", short(1.0 / period), short(period));
    // A neighbour, where it is sound, tells whether it is the masses.
    let sound = facts.neighbours(id).find(|other| facts.pace(*other) == Pace::Usual);
    let lighter = sound.map(|other| mean_mass(facts.building(other)) / mean_mass(building));
    let units = facts.scene.units;
    let (far_too, (is_mass, meant)) = match facts.pace(id) {
        Pace::Fast => ("fast", meant_by_fast(units, lighter)),
        Pace::Slow => ("slow", meant_by_slow(units, lighter, mean_mass(building), period)),
        Pace::Usual | Pace::Wall | Pace::Free | Pace::Unknown => return,
    };
    let text = format!("{found_here}, far too {far_too} for {usual}; {meant}");
    let path = |key: &str| format!("{}.{key}", building.path);
    match &building.stiffness {
        _ if is_mass => found.quantities(path("mass"), &building.mass, text),
        Stiffness::Shear(storeys) => found.quantities(path(stiffness_key(building)), storeys, text),
        Stiffness::Matrix(rows) => found.matrix(path(stiffness_key(building)), rows, text),
    }
}

/// Whether it is the masses, or else the stiffnesses, and what they may have been given in. `lighter` is how many times
/// lighter than those of a sound neighbour the floors are.
fn meant_by_fast(units: Units, lighter: Option<f64>) -> (bool, String) {
    match (units, lighter) {
        (Units::Si, Some(..10.0)) => (false, "stiffnesses are in N/m, is their power of ten right?".to_owned()),
        (Units::Si, _) => (true, format!("masses are in kg, were they given in t?{IN_KN_T}")),
        (Units::KilonewtonTonne, Some(10.0..)) => (true, "masses are in t, is their power of ten right?".to_owned()),
        (Units::KilonewtonTonne, _) => (false, "stiffnesses are in kN/m, were they given in N/m?".to_owned()),
    }
}

/// The same of a building that is too slow; `mass` is that of a floor, kg, and `period` that of the building, s.
fn meant_by_slow(units: Units, lighter: Option<f64>, mass: f64, period: f64) -> (bool, String) {
    let is_heavy = lighter.is_some_and(|lighter| lighter < 0.02);
    match units {
        Units::Si if is_heavy => (true, "masses are in kg, were they given in g?".to_owned()),
        Units::Si => {
            let meant = if period > 100.0 { "kN/m or kN/mm" } else { "kN/m" };
            let text = format!("stiffnesses are in N/m, were they given in {meant} (or masses, in kg, in g)?{IN_KN_T}");
            (false, text)
        }
        Units::KilonewtonTonne if is_heavy || mass >= HEAVY => {
            (true, "masses are in t, were they given in kg?".to_owned())
        }
        Units::KilonewtonTonne => {
            (false, "stiffnesses are in kN/m, were they given in kN/mm or MN/m (or masses, in t, in kg)?".to_owned())
        }
    }
}

/// Two buildings of usual periods, one of them in other units throughout.
fn look_at_storey_masses(facts: &Facts<'_>, (id, other): (BuildingId, BuildingId), found: &mut Found) {
    let mean = |id| mean_mass(facts.building(id));
    let both_usual =
        [id, other].iter().all(|id| facts.pace(*id) == Pace::Usual) && facts.building(other).mass.len() > 1;
    let heavier = mean(other) / mean(id);
    if !both_usual || heavier < 200.0 {
        return;
    }
    // In kg and N the lighter building has been given in t and kN, in t and kN the heavier one in kg and N.
    let units = facts.scene.units;
    let (odd, beside, factor, meant) = match units {
        Units::Si => (id, other, 1.0 / heavier, Units::KilonewtonTonne),
        Units::KilonewtonTonne => (other, id, heavier, Units::Si),
    };
    let text = format!(
        "a floor has {} the mass of one of {}, at usual periods of both; masses are in {} and stiffnesses in \
         {}, were those of this building given in {} and {}?",
        how_many_times(factor),
        facts.building(beside).called(),
        units.unit("kg"),
        units.unit("N/m"),
        meant.unit("kg"),
        meant.unit("N/m")
    );
    found.quantities(format!("{}.mass", facts.building(odd).path), &facts.building(odd).mass, text);
}

fn storeys(count: usize) -> String {
    format!("{count} {}", if count == 1 { "storey" } else { "storeys" })
}

fn look_at_damping(facts: &Facts<'_>, id: BuildingId, building: &Building, found: &mut Found) {
    let path = format!("{}.damping", building.path);
    let (path, ratio) = match &building.damping {
        Damping::Ratio(ratio) => (format!("{path}.ratio"), *ratio),
        Damping::Rayleigh { ratio, .. } => (format!("{path}.rayleigh.ratio"), *ratio),
        Damping::Ratios(ratios) => {
            let Some(index) = ratios.iter().position(|&ratio| odd_damping(ratio).is_some()) else { return };
            (format!("{path}.ratios[{}]", index + 1), ratios[index])
        }
        Damping::Dashpots(_) | Damping::Matrix(_) => return look_at_first_mode(facts, id, found),
    };
    if let Some(text) = odd_damping(ratio) {
        let meant = if ratio > MOST_DAMPING { percent(ratio) } else { String::new() };
        found.number(path, ratio, format!("{text}{meant}"));
    }
}

fn percent(ratio: f64) -> String {
    if ratio >= 0.5 { format!("; was it meant in percent ({})?", number(ratio / 100.0)) } else { String::new() }
}

/// What a ratio of critical damping would mean that no building has.
fn odd_damping(ratio: f64) -> Option<String> {
    let meaning = match ratio {
        r if r >= 1.0 => "the floors creep back instead of swinging",
        r if r > MOST_DAMPING => "the floors hardly swing",
        r if r > 0.0 && r < LEAST_DAMPING => "as good as no damping",
        _ => return None,
    };
    Some(format!("{meaning}; 1 is critical damping and buildings have 0.01 to 0.1"))
}

/// Dashpots and matrices, by the damping that they give to the first mode. Dashpots may be those of isolators, which have three
/// tenths of critical damping and more.
fn look_at_first_mode(facts: &Facts<'_>, id: BuildingId, found: &mut Found) {
    const MOST_OF_ISOLATORS: f64 = 1.0;
    let (Some(first), building) = (facts.swinging(id), facts.building(id)) else { return };
    let (damped, most): (f64, f64) = match &building.damping {
        Damping::Dashpots(storeys) => {
            let drifts = first.shape.iter().zip([0.0].iter().chain(&first.shape)).map(|(above, below)| above - below);
            (storeys.iter().zip(drifts).map(|(c, drift)| c * drift * drift).sum(), MOST_OF_ISOLATORS)
        }
        Damping::Matrix(rows) => {
            let resistance = |row: &Vec<f64>| row.iter().zip(&first.shape).map(|(c, x)| c * x).sum::<f64>();
            (rows.iter().zip(&first.shape).map(|(row, x)| x * resistance(row)).sum(), MOST_DAMPING)
        }
        Damping::Ratio(_) | Damping::Ratios(_) | Damping::Rayleigh { .. } => return,
    };
    let ratio = ratio_of(first, damped, building);
    if !(ratio > most || ratio > 0.0 && ratio < LEAST_DAMPING) {
        return;
    }
    let text = format!(
        "the first mode has {} of critical damping, where buildings have 0.01 to 0.1; entries are in {}, were they given \
         in another unit?",
        short(ratio),
        facts.scene.units.unit("N s/m")
    );
    let name = &building.path;
    match &building.damping {
        Damping::Dashpots(storeys) => found.quantities(format!("{name}.damping.dashpots"), storeys, text),
        Damping::Matrix(rows) => found.matrix(format!("{name}.damping.matrix"), rows, text),
        Damping::Ratio(_) | Damping::Ratios(_) | Damping::Rayleigh { .. } => {}
    }
}

/// Ratio of critical damping of the first mode: shape' C shape = 2 ratio omega shape' M shape.
fn ratio_of(first: &FirstMode, damped: f64, building: &Building) -> f64 {
    damped / (2.0 * first.omega * inertia_of(first, building))
}

/// Initial motion beyond what a building stands.
fn look_at_start(facts: &Facts<'_>, id: BuildingId, building: &Building, found: &mut Found) {
    let largest = |values: &[f64]| values.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
    let omega = match facts.pace(id) {
        Pace::Usual => facts.period(id).map_or(0.0, |period| 2.0 * PI / period),
        Pace::Free => return look_at_speed(building, 0.0, largest(&building.initial_velocity), found),
        Pace::Fast | Pace::Slow | Pace::Wall | Pace::Unknown => 0.0,
    };
    let displacement = largest(&building.initial_displacement);
    let pull = omega * omega * displacement / STANDARD_GRAVITY;
    if displacement > 0.3 * building.mass.len() as f64 || pull > 5.0 {
        let times = short(pull);
        let held =
            if pull > 1.0 { format!(", held by forces of some {times} times its weight") } else { String::new() };
        let aside = short(displacement);
        let text =
            format!("the building starts up to {aside} m aside{held}; displacements are in m, were they given in mm?");
        found.numbers(format!("{}.initial_displacement", building.path), &building.initial_displacement, text);
    }
    look_at_speed(building, omega, largest(&building.initial_velocity), found);
}

fn look_at_speed(building: &Building, omega: f64, speed: f64, found: &mut Found) {
    if speed > 10.0 || omega * speed > 8.0 * STANDARD_GRAVITY {
        let text = format!(
            "a floor starts at {} km/h, where the strongest earthquakes move the ground at 1 or 2 m/s; velocities are in \
             m/s, were they given in mm/s or cm/s?",
            short(3.6 * speed)
        );
        found.numbers(format!("{}.initial_velocity", building.path), &building.initial_velocity, text);
    }
}
