//! Gravity on storeys that lean: left out where it matters, weights in other units, storeys that may fall.

use super::facts::{Facts, Pace, how_many_times};
use super::found::{Found, LIKEWISE};
use crate::figures::short;
use crate::record::STANDARD_GRAVITY;
use crate::scene::{Building, NetStorey, PDelta, Stiffness, Units};
use crate::structure::BuildingId;

/// Stability coefficient up to which codes let gravity on leaning storeys be left out, and beyond which none allows a design.
const NEGLIGIBLE: f64 = 0.1;
const MOST_ALLOWED: f64 = 0.3;
/// Critical drift over yield drift below which a storey falls as soon as it yields.
const LEAST_RESERVE: f64 = 2.0;
/// Shares of the weight of its mass that a floor's load has, with all that leans on the building.
const USUAL_LOADS: std::ops::RangeInclusive<f64> = 0.2..=5.0;
/// A first storey is an isolation level that has less of the height, or of the stiffness, of the storey above.
const ISOLATION_HEIGHT: f64 = 0.5;
const ISOLATION_STIFFNESS: f64 = 0.125;

pub(super) fn look(facts: &Facts<'_>, found: &mut Found) {
    for id in facts.scene.ids() {
        let building = facts.building(id);
        let name = &building.path;
        let is_known = ["mass", "stiffness", "stiffness_matrix"].iter().any(|key| found.has(&format!("{name}.{key}")));
        match &building.p_delta {
            Some(p_delta) => {
                look_at_loads(facts, id, p_delta, found);
                look_at_coefficients(facts, id, p_delta, found);
                look_at_falls(facts, id, p_delta, found);
            }
            None if is_known || facts.pace(id) != Pace::Usual => {}
            None => look_at_neglect(facts, id, found),
        }
    }
}

/// Stability coefficient of each storey on which gravity acts, with its number, the largest first.
fn coefficients(building: &Building) -> Vec<(usize, f64)> {
    let Stiffness::Shear(storeys) = &building.stiffness else { return Vec::new() };
    let gravity = building.gravity_stiffness();
    let mut all: Vec<_> = storeys.iter().zip(gravity).map(|(k, g)| g / k).enumerate().collect();
    all.sort_by(|(_, one), (_, other)| other.total_cmp(one));
    all.into_iter().map(|(storey, theta)| (storey + 1, theta)).collect()
}

/// How many storeys there are of which the same is to be said as of the first.
fn likewise<T>(storeys: &[T]) -> String {
    if storeys.len() > 1 { format!("{LIKEWISE}{} more)", storeys.len() - 1) } else { String::new() }
}

/// Heights are there, and with them the weights would be a good part of the stiffness.
fn look_at_neglect(facts: &Facts<'_>, id: BuildingId, found: &mut Found) {
    let building = facts.building(id);
    let Some(heights) = &building.heights else { return };
    let mut leaning = building.clone();
    leaning.p_delta = Some(PDelta::new(vec![true; building.mass.len()]));
    let has_bearings = match (&building.stiffness, &heights.storeys[..]) {
        (Stiffness::Shear(k), [first, second, ..]) => {
            *first < ISOLATION_HEIGHT * second || k[0] < ISOLATION_STIFFNESS * k[1]
        }
        _ => false,
    };
    let mut storeys = coefficients(&leaning);
    storeys.retain(|(storey, theta)| *theta > NEGLIGIBLE && !(has_bearings && *storey == 1));
    let Some((storey, theta)) = storeys.first() else { return };
    let text = format!(
        "the weight above storey {storey} over its height is {} of its stiffness{}, and codes neglect no more than 0.1: it \
         matters, add p_delta = true",
        short(*theta),
        likewise(&storeys)
    );
    found.add(format!("{}.p_delta", building.path), "false".to_owned(), text);
}

fn look_at_coefficients(facts: &Facts<'_>, id: BuildingId, p_delta: &PDelta, found: &mut Found) {
    let building = facts.building(id);
    let mut storeys = coefficients(building);
    storeys.retain(|(_, theta)| *theta > MOST_ALLOWED);
    let Some((storey, theta)) = storeys.first() else { return };
    let text = format!(
        "storey {storey} has the stability coefficient {}{}, and codes forbid more than 0.3; is the height right, and is it \
         a storey? For a level of bearings say false",
        short(*theta),
        likewise(&storeys)
    );
    found.add(format!("{}.p_delta", building.path), p_delta.written(), text);
}

/// A storey whose stiffness is negative once it yields.
struct Falling {
    /// From 0 at the bottom.
    storey: usize,
    net: NetStorey,
    /// m, at which it resists no push any more.
    critical_drift: f64,
}

/// Storeys whose stiffness is negative once they yield, and those that start where they can only fall.
fn look_at_falls(facts: &Facts<'_>, id: BuildingId, p_delta: &PDelta, found: &mut Found) {
    let building = facts.building(id);
    let storeys = (0..building.mass.len()).filter_map(|storey| {
        let net = building.net_storey(storey)?;
        Some(Falling { storey, net, critical_drift: net.critical_drift()? })
    });
    let mut storeys: Vec<Falling> = storeys.collect();
    for falling in &storeys {
        look_at_start(facts, id, falling, found);
    }
    storeys.sort_by(|one, other| one.critical_drift.total_cmp(&other.critical_drift));
    let Some(Falling { storey, net, critical_drift }) = storeys.first() else { return };
    let reserve = critical_drift / net.yield_drift();
    let near = if reserve < LEAST_RESERVE {
        format!(", only {} times the drift at which it yields", short(reserve))
    } else {
        String::new()
    };
    let text = format!(
        "the stiffness after yield of storey {} is negative, {} of the initial one; it can collapse beyond a drift of {} m\
         {near}{}",
        storey + 1,
        short(net.ratio - net.theta()),
        short(*critical_drift),
        likewise(&storeys)
    );
    found.add(format!("{}.p_delta", building.path), p_delta.written(), text);
}

fn look_at_start(facts: &Facts<'_>, id: BuildingId, falling: &Falling, found: &mut Found) {
    let building = facts.building(id);
    let drift = building.initial_drift(falling.storey);
    let path = format!("{}.initial_displacement", building.path);
    if drift.abs() > falling.critical_drift && !found.has(&path) {
        let text = format!(
            "storey {} starts at a drift of {} m, and beyond {} m it resists no push any more",
            falling.storey + 1,
            short(drift),
            short(falling.critical_drift)
        );
        found.numbers(path, &building.initial_displacement, text);
    }
}

/// Loads far from the weights of the masses. A floor may have none.
fn look_at_loads(facts: &Facts<'_>, id: BuildingId, p_delta: &PDelta, found: &mut Found) {
    let (Some(loads), building) = (&p_delta.load, facts.building(id)) else { return };
    let has_any = loads.iter().any(|load| *load > 0.0);
    let share = |floor: usize| loads[floor] / (STANDARD_GRAVITY * building.mass[floor]);
    let is_odd = |floor: &usize| !USUAL_LOADS.contains(&share(*floor)) && (loads[*floor] > 0.0 || !has_any);
    let odd: Vec<usize> = (0..loads.len()).filter(is_odd).collect();
    let text = |floor: usize| {
        let share = share(floor);
        let meant = meant_by_load(share, facts.scene.units);
        match share > 0.0 {
            true => format!("{} the weight of the mass of the floor{meant}", how_many_times(share)),
            false => "no floor weighs anything, which p_delta = false would say as well".to_owned(),
        }
    };
    found.entries(&format!("{}.gravity_load", building.path), loads, &odd, loads.len(), text);
}

/// What else than weights in the units of the scene may have been given.
fn meant_by_load(share: f64, units: Units) -> &'static str {
    match (units, share) {
        (_, 0.09..0.12) => "; a mass times 9.81 m/s2 is its weight, was the mass given?",
        (Units::Si, 2e-4..5e-3) => "; loads are in N, were they given in kN?",
        (Units::KilonewtonTonne, 200.0..5000.0) => "; loads are in kN, were they given in N?",
        _ => "; is its power of ten right?",
    }
}
