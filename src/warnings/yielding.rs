//! Storeys that yield: forces that are never reached or always exceeded, and a damping that isolators do not have.

use super::facts::{Facts, NEVER_REACHED, Pace, how_many_times, median, nearest, shaken, was_given};
use super::found::Found;
use crate::figures::short;
use crate::record::STANDARD_GRAVITY;
use crate::scene::{Building, Damping, Units};
use crate::structure::BuildingId;

/// Share of the weight above that even isolators have as their yield force, which are the first storey.
const LEAST_ISOLATOR: f64 = 0.01;
/// The same of storeys above.
const LEAST_STOREY: f64 = 0.02;
/// Share of the weight above up to which a first storey is of isolators, and how many times that the storeys which it
/// carries have if they yield at all.
const MOST_ISOLATOR: f64 = 0.1;
const MUCH_STRONGER: f64 = 3.0;
/// Between shares of one storey and of those beside it: storeys that were designed together have less.
const ODD: f64 = 6.0;

pub(super) fn look(facts: &Facts<'_>, found: &mut Found) {
    for id in facts.scene.ids() {
        let building = facts.building(id);
        let (name, storeys) = (&building.path, Storey::all(building));
        let is_sound = !found.has(&format!("{name}.mass")) && facts.pace(id) != Pace::Slow;
        if storeys.is_empty() || !is_sound {
            continue;
        }
        look_at_forces(facts, id, &storeys, found);
        look_at_neighbours(name, &storeys, found);
        look_at_isolators(facts, id, &storeys, found);
    }
}

/// A storey that can yield.
struct Storey {
    /// From 0 at the bottom.
    index: usize,
    /// N.
    force: f64,
    /// Yield force over the weight of the floors above.
    share: f64,
}

impl Storey {
    fn all(building: &Building) -> Vec<Storey> {
        let weight = |index: usize| STANDARD_GRAVITY * building.mass.iter().skip(index).sum::<f64>();
        let storeys = (0..building.mass.len()).filter_map(|index| {
            let (force, _) = building.yielding_storey(index)?;
            Some(Storey { index, force, share: force / weight(index) })
        });
        storeys.collect()
    }

    fn path(&self, name: &str) -> String {
        format!("{name}.yield_force[{}]", self.index + 1)
    }
}

/// Forces that make a storey one that never yields, or one that always does.
fn look_at_forces(facts: &Facts<'_>, id: BuildingId, storeys: &[Storey], found: &mut Found) {
    let Building { path: name, yielding: Some(yielding), .. } = facts.building(id) else { return };
    let shaken = shaken(facts.peak);
    let is_large = |storey: &&Storey| storey.share > NEVER_REACHED * shaken;
    let is_small = |storey: &&Storey| storey.share < if storey.index == 0 { LEAST_ISOLATOR } else { LEAST_STOREY };
    let mut tell = |odd: Vec<&Storey>, meaning: &str, given_in: Units| {
        let Some(first) = odd.first() else { return };
        let given = was_given(facts.scene.units, given_in, "N");
        let text = format!("{} times the weight above: {meaning}{given}", short(first.share));
        let indices: Vec<usize> = odd.iter().map(|storey| storey.index).collect();
        found.entries(&format!("{name}.yield_force"), &yielding.force, &indices, storeys.len(), |_| text.clone());
    };
    let never = "the storey will never yield, which inf would say as well";
    tell(storeys.iter().filter(is_large).collect(), never, Units::KilonewtonTonne);
    let always = "the storey will slide all the time; designs have 0.05 to 1";
    tell(storeys.iter().filter(is_small).collect(), always, Units::Si);
}

/// Storeys far weaker or stronger for the weight above them than those beside. Isolators are weaker than what they carry.
fn look_at_neighbours(name: &str, storeys: &[Storey], found: &mut Found) {
    if found.has(&format!("{name}.yield_force")) {
        return;
    }
    let Some(usual) = median(storeys.iter().map(|storey| storey.share)) else { return };
    for (place, storey) in storeys.iter().enumerate() {
        let beside = [place.checked_sub(1), Some(place + 1)];
        let mut shares: Vec<f64> = beside.iter().filter_map(|j| Some(storeys.get((*j)?)?.share)).collect();
        shares.push(usual);
        let factor = nearest(storey.share, &shares);
        let is_isolator = storey.index == 0 && factor < 1.0;
        if factor.max(1.0 / factor) >= ODD && !is_isolator {
            let text = format!(
                "{} times the weight above, {} that of the storeys beside it; is its power of ten right?",
                short(storey.share),
                how_many_times(factor)
            );
            found.quantity(storey.path(name), storey.force, text);
        }
    }
}

/// A ratio is of the stiffness before yield: isolators yield early, and are far softer from then on.
fn look_at_isolators(facts: &Facts<'_>, id: BuildingId, storeys: &[Storey], found: &mut Found) {
    let building = facts.building(id);
    let name = &building.path;
    let Some(first) = storeys.first().filter(|first| first.index == 0 && first.share < MOST_ISOLATOR) else { return };
    let is_carried = |storey: &Storey| storey.share > MUCH_STRONGER * first.share;
    let is_known = ["yield_force", "damping"].iter().any(|key| found.has(&format!("{name}.{key}")));
    if building.mass.len() < 2 || !storeys[1..].iter().all(is_carried) || is_known {
        return;
    }
    let text = format!(
        "the first storey yields at {} times the weight, as isolators do; a ratio is of the stiffness before that and gives \
         them a damping that they do not have: {{ dashpots = [...] }} has one for each storey",
        short(first.share)
    );
    let path = |key: &str| format!("{name}.damping.{key}");
    match &building.damping {
        Damping::Ratio(ratio) if *ratio > 0.0 => found.number(path("ratio"), *ratio, text),
        Damping::Ratios(ratios) if ratios[0] > 0.0 => found.number(path("ratios[1]"), ratios[0], text),
        Damping::Rayleigh { ratio, .. } if *ratio > 0.0 => found.number(path("rayleigh.ratio"), *ratio, text),
        Damping::Ratio(_) | Damping::Ratios(_) | Damping::Rayleigh { .. } => {}
        Damping::Dashpots(_) | Damping::Matrix(_) => {}
    }
}
