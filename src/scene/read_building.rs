//! The keys of a building: `[left]`, `[right]`, `[[building]]`.

use super::data::{Building, Damping, PDelta, Stiffness, Yielding};
use super::document::{Item, KEY, Section};
use super::levels::Heights;
use super::units::Units;
use super::{read_foundation, rule};

/// A building by its keys; that of its name has been read.
pub(super) fn building(name: &str, mut section: Section<'_>, units: Units) -> Building {
    let what = format!("a list of masses in {}, one per floor", units.unit("kg"));
    let mass = section.require("mass", &what).map(|item| {
        let mass = item.quantities(units);
        if mass.is_empty() && item.is_list() {
            item.refuse("at least one floor");
        }
        mass
    });
    let mass = mass.unwrap_or_default();
    let stiffness = stiffness(&mut section, units);
    let damping = section.require("damping", "a table with one of ratio, ratios, rayleigh, dashpots, matrix");
    let damping = match damping {
        Some(item) if item.is_number() => {
            item.refuse(format!("a table, such as {{ ratio = {} }}", item.written()));
            Damping::Ratio(0.0)
        }
        Some(item) => self::damping(item.section(), units),
        None => Damping::Ratio(0.0),
    };
    let mut building = Building::new(name, mass, stiffness, damping);
    section.path().clone_into(&mut building.path);
    section.get("initial_displacement").inspect(|item| building.initial_displacement = item.numbers());
    section.get("initial_velocity").inspect(|item| building.initial_velocity = item.numbers());
    building.heights = heights(&mut section);
    building.yielding = yielding(&mut section, &building.stiffness, building.mass.len(), units);
    building.p_delta = p_delta(&mut section, building.yielding.is_some(), building.mass.len(), units);
    building.foundation = read_foundation::of_building(&mut section, units);
    section.close(KEY);
    building
}

const ONLY_THOSE_COLLAPSE: &str = "yield_force as well: only storeys that yield collapse";

fn p_delta(section: &mut Section<'_>, can_yield: bool, storeys: usize, units: Units) -> Option<PDelta> {
    let (leaning, load) = (section.get("p_delta"), section.get("gravity_load"));
    let ratio = section.get("collapse_drift_ratio");
    let Some(leaning) = leaning else {
        if let Some(load) = load {
            load.refuse("p_delta as well, the storeys that gravity pushes on as they lean");
            load.look_at_list(rule::GRAVITY_LOAD, units, storeys, "floor");
        }
        if let Some(ratio) = ratio {
            ratio.refuse("p_delta as well: without gravity no storey collapses");
            if !can_yield {
                ratio.refuse(ONLY_THOSE_COLLAPSE);
            }
            ratio.look_at(rule::COLLAPSE_DRIFT_RATIO, units);
        }
        return None;
    };
    let mut p_delta = PDelta::new(match leaning.is_list() {
        true => leaning.list("true, false or a list of them").iter().flatten().map(|entry| entry.boolean()).collect(),
        false => vec![leaning.boolean(); storeys],
    });
    p_delta.load = load.map(|item| item.quantities(units));
    if let Some(item) = ratio {
        match can_yield {
            true => p_delta.collapse_drift_ratio = item.number(),
            false => {
                item.refuse(ONLY_THOSE_COLLAPSE);
                item.look_at(rule::COLLAPSE_DRIFT_RATIO, units);
            }
        }
    }
    Some(p_delta)
}

fn yielding(section: &mut Section<'_>, stiffness: &Stiffness, storeys: usize, units: Units) -> Option<Yielding> {
    let (force, ratio) = (section.get("yield_force"), section.get("post_yield_ratio"));
    let Some(force) = force else {
        if let Some(ratio) = ratio {
            ratio.refuse("yield_force as well, the storey shears at first yield");
            look_at_ratio(&ratio, storeys);
        }
        return None;
    };
    if matches!(stiffness, Stiffness::Matrix(_)) {
        force.refuse("a shear building, with stiffness instead of stiffness_matrix: only storeys yield");
        force.look_at_list(rule::YIELD_FORCE, units, storeys, "storey");
        ratio.inspect(|ratio| look_at_ratio(ratio, storeys));
        return None;
    }
    let force = force.quantities(units);
    let ratio = match ratio {
        None => vec![0.0; force.len()],
        Some(item) if item.is_number() => {
            let rule = rule::POST_YIELD_RATIO;
            let ratio = Some(item.number()).filter(|ratio| rule.holds(*ratio));
            vec![item.found(ratio, rule.expected(Units::Si)).unwrap_or(0.0); force.len()]
        }
        Some(item) => item.numbers(),
    };
    Some(Yielding { force, ratio })
}

/// What is wrong with post-yield ratios, one or one per storey, of storeys that do not yield.
fn look_at_ratio(ratio: &Item<'_>, storeys: usize) {
    match ratio.is_list() {
        true => ratio.look_at_list(rule::POST_YIELD_RATIO, Units::Si, storeys, "storey"),
        false => ratio.look_at(rule::POST_YIELD_RATIO, Units::Si),
    }
}

fn heights(section: &mut Section<'_>) -> Option<Heights> {
    let (storeys, base_level) = (section.get("height"), section.get("base_level"));
    let Some(storeys) = storeys else {
        if let Some(level) = base_level {
            level.refuse("height as well, the heights of the storeys above that level");
            level.look_at(rule::LEVEL, Units::Si);
        }
        return None;
    };
    Some(Heights { storeys: storeys.numbers(), base_level: base_level.map_or(0.0, |item| item.number()) })
}

fn stiffness(section: &mut Section<'_>, units: Units) -> Stiffness {
    match (section.get("stiffness"), section.get("stiffness_matrix")) {
        (None, Some(matrix)) => Stiffness::Matrix(matrix.rows(units)),
        (Some(storeys), None) => Stiffness::Shear(storeys.quantities(units)),
        (Some(storeys), Some(matrix)) => {
            matrix.refuse("either stiffness or stiffness_matrix, not both");
            Stiffness::Shear(storeys.quantities(units))
        }
        (None, None) => {
            let what = format!("a list in {}, one per storey, or stiffness_matrix", units.unit("N/m"));
            section.missing("stiffness", &what);
            Stiffness::Shear(Vec::new())
        }
    }
}

fn damping(mut section: Section<'_>, units: Units) -> Damping {
    type Kind = (&'static str, fn(&Item<'_>, Units) -> Damping);
    const KINDS: [Kind; 5] = [
        ("ratio", |item, _| Damping::Ratio(item.number())),
        ("ratios", |item, _| Damping::Ratios(item.numbers())),
        ("rayleigh", |item, _| rayleigh(item.section())),
        ("dashpots", |item, units| Damping::Dashpots(item.quantities(units))),
        ("matrix", |item, units| Damping::Matrix(item.rows(units))),
    ];
    let mut damping = None;
    for (kind, read) in KINDS {
        match (section.get(kind), &damping) {
            (None, _) => {}
            (Some(item), None) => damping = Some(read(&item, units)),
            (Some(item), Some(_)) => item.refuse("one kind of damping only"),
        }
    }
    if damping.is_none() {
        section.refuse("one of ratio, ratios, rayleigh, dashpots, matrix");
    }
    section.close(KEY);
    damping.unwrap_or(Damping::Ratio(0.0))
}

fn rayleigh(mut section: Section<'_>) -> Damping {
    let ratio = section.require("ratio", "the damping ratio in both modes").map_or(0.0, |item| item.number());
    let modes = section.require("modes", "two modes, counted from 1").map_or([1, 2], |item| two_modes(&item));
    section.close(KEY);
    Damping::Rayleigh { ratio, modes }
}

fn two_modes(item: &Item<'_>) -> [usize; 2] {
    let expected = "two modes, counted from 1";
    match item.list(expected).as_deref() {
        Some([first, second]) => return [first.count(), second.count()],
        Some(_) => item.refuse(expected),
        None => {}
    }
    [1, 2]
}
