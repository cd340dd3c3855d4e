//! The keys of a scene file, one after the other.

use super::building_id::BuildingId;
use super::data::{Building, Damping, Ground, PDelta, Scaling, Scene, Solver, Stiffness, Yielding};
use super::document::{self, Document, Item, KEY, Section, TextSpan};
use super::levels::Heights;
use super::problem::{Problem, SceneError, excerpt};
use super::units::{self, Units};
use super::{check, read_contacts, read_foundation, read_links, read_record, rule};
use std::collections::{HashMap, HashSet};

impl Scene {
    /// Reads a scene from TOML text. The record file is not touched: see [`super::load`].
    ///
    /// # Errors
    /// All problems of the scene in the order of the text; a single one, with line and column, where the text is not TOML.
    pub fn from_toml(text: &str) -> Result<Scene, SceneError> {
        Draft::read(text)?.finish()
    }
}

/// A scene as far as it could be read, with what is wrong with it.
pub(super) struct Draft<'t> {
    text: &'t str,
    pub(super) scene: Scene,
    problems: Vec<Problem>,
}

impl<'t> Draft<'t> {
    /// Reads all keys and checks all values; fails only where the text is not TOML.
    pub(super) fn read(text: &'t str) -> Result<Draft<'t>, SceneError> {
        let table = document::parse(text)?;
        let document = Document::new(text);
        let scene = scene(document.root(&table));
        let mut problems = document.into_problems();
        // A value that does not fit is represented in the scene by a neutral one, about which there is nothing to say.
        let mut wrong_values = check::problems(&scene);
        if scene.facing.is_some() {
            tell_of_facing(&mut wrong_values);
        }
        write_as_found(&mut wrong_values, text, &document::spans(&table));
        wrong_values.retain(|wrong| !problems.iter().any(|unfit| unfit.covers(&wrong.path)));
        problems.append(&mut wrong_values);
        Ok(Draft { text, scene, problems })
    }

    /// Whether something has been said about a value, or a part of it.
    pub(super) fn is_wrong_at(&self, path: &str) -> bool {
        self.problems.iter().any(|problem| problem.path.starts_with(path))
    }

    /// Adds what has been found wrong later, but nothing more about a value of which something has been said before.
    pub(super) fn add(&mut self, problems: Vec<Problem>) {
        let is_new = |problem: &Problem| !self.problems.iter().any(|known| known.covers(&problem.path));
        let mut new: Vec<Problem> = problems.into_iter().filter(is_new).collect();
        self.problems.append(&mut new);
    }

    /// The scene, if nothing is wrong with it.
    pub(super) fn finish(self) -> Result<Scene, SceneError> {
        if self.problems.is_empty() {
            return Ok(self.scene);
        }
        let mut problems = self.problems;
        let spans = document::spans(&document::parse(self.text)?);
        // A missing key has the position of the table that lacks it.
        problems.sort_by_cached_key(|problem| document::place(&problem.path, &spans).unwrap_or_default());
        Err(SceneError { problems })
    }
}

/// What is wrong with all contacts that `[facing]` has made is wrong with it, and told once.
fn tell_of_facing(problems: &mut Vec<Problem>) {
    for problem in problems.iter_mut().filter(|problem| problem.path.starts_with("contact[")) {
        let key = problem.path.split_once("].").map(|(_, key)| format!("facing.{key}"));
        problem.path = key.unwrap_or_else(|| "facing".to_owned());
    }
    let mut told = HashSet::new();
    problems.retain(|problem| !problem.path.starts_with("facing") || told.insert(problem.path.clone()));
}

/// Values that reading has changed as the file has them: an entry that is no number has been read as NaN, one of hundreds
/// of digits as infinite.
fn write_as_found(problems: &mut [Problem], text: &str, spans: &HashMap<String, TextSpan>) {
    let is_changed = |problem: &&mut Problem| problem.found.contains("nan") || problem.found.contains("inf");
    for problem in problems.iter_mut().filter(is_changed) {
        let range = spans.get(&problem.path).and_then(|span| span.value.clone());
        if let Some(found) = range.and_then(|range| text.get(range)) {
            problem.found = excerpt(found);
        }
    }
}

fn scene(mut root: Section<'_>) -> Scene {
    let name = root.require("name", "a C identifier").and_then(|item| item.text()).unwrap_or_default();
    let description = root.get("description").and_then(|item| item.text()).unwrap_or_default();
    let units = root.get("units").and_then(|item| item.named(Units::from_name, units::expected)).unwrap_or_default();
    let stop_time = root.get("stop_time").map(|item| item.number());
    let left = building("left", root.require_section("left", "the building on the left"), units);
    let right = root.get("right").map(|item| building("right", item.section(), units));
    let ground = ground(root.section("ground"));
    let (floor_forces, restoring_corrections) = inputs(root.section("inputs"));
    let (contacts, facing) = read_contacts::all(
        &mut root,
        [(BuildingId::LEFT, &left), (BuildingId::RIGHT, right.as_ref().unwrap_or(&Building::absent("right")))],
        units,
    );
    let links = read_links::all(&mut root, units);
    let is_met = facing.is_some() || contacts.iter().any(|pair| pair.is_with(BuildingId::RIGHT));
    match right.is_none() {
        true if is_met => root.missing("right", "the building on the right, which contacts are with"),
        true if links.iter().any(|link| link.is_with(BuildingId::RIGHT)) => {
            root.missing("right", "the building on the right, which links are with");
        }
        _ => {}
    }
    let right = right.unwrap_or_else(|| Building::absent("right"));
    let Shown { energy, peaks, numbers_only } = outputs(root.section("outputs"));
    let solver = solver(root.section("solver"));
    root.close(KEY);
    let (name, description) = (name.to_owned(), description.to_owned());
    Scene {
        name,
        description,
        units,
        stop_time,
        buildings: vec![left, right],
        ground,
        floor_forces,
        restoring_corrections,
        contacts,
        facing,
        links,
        energy,
        peaks,
        numbers_only,
        solver,
    }
}

fn building(name: &str, mut section: Section<'_>, units: Units) -> Building {
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

fn ground(mut section: Section<'_>) -> Ground {
    let record = section.get("record");
    let scale = section.get("scale");
    let pga = section.get("pga");
    section.close(KEY);
    if record.is_none() {
        for item in scale.iter().chain(&pga) {
            item.refuse("a record to scale, in ground.record");
        }
    } else if let (Some(_), Some(pga)) = (&scale, &pga) {
        pga.refuse("either scale or pga, not both");
    }
    // Both are looked at, so that what is wrong with either is said at once.
    let scale = scale.map(|item| item.number());
    let scaling = match (scale, pga) {
        (Some(scale), Some(pga)) => {
            pga.look_at(rule::PGA, Units::Si);
            Scaling::Scale(scale)
        }
        (Some(scale), None) => Scaling::Scale(scale),
        (None, Some(pga)) => Scaling::Pga(pga.number()),
        (None, None) => Scaling::Scale(1.0),
    };
    let (record, options) = record.map(|item| read_record::source(&item)).unwrap_or_default();
    Ground { record, options, scaling }
}

/// Whether floors have external forces, and whether what the buildings resist with is corrected.
fn inputs(mut section: Section<'_>) -> (bool, bool) {
    let floor_forces = section.get("floor_forces").is_some_and(|item| item.boolean());
    let restoring_corrections = section.get("restoring_corrections").is_some_and(|item| item.boolean());
    section.close(KEY);
    (floor_forces, restoring_corrections)
}

/// What is shown, and how; as in [`Scene`].
struct Shown {
    energy: bool,
    peaks: bool,
    numbers_only: bool,
}

fn outputs(mut section: Section<'_>) -> Shown {
    let energy = section.get("energy").is_some_and(|item| item.boolean());
    let peaks = section.get("peaks").is_none_or(|item| item.boolean());
    let numbers_only = section.get("numbers_only").is_some_and(|item| item.boolean());
    section.close(KEY);
    Shown { energy, peaks, numbers_only }
}

fn solver(mut section: Section<'_>) -> Solver {
    let mut solver = Solver::default();
    section.get("relative_tolerance").inspect(|item| solver.relative_tolerance = item.number());
    section.get("min_approach_velocity").inspect(|item| solver.min_approach_velocity = item.number());
    section.close(KEY);
    solver
}
