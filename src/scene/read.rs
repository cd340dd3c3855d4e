//! The keys of a scene file, one after the other.

use super::building_id::BuildingId;
use super::data::{Ground, Scaling, Scene, Solver};
use super::document::{self, Document, KEY, Section, TextSpan};
use super::problem::{Problem, SceneError, excerpt};
use super::read_row::{self, Row};
use super::units::{self, Units};
use super::{check, read_contacts, read_links, read_record, rule};
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
            tell_in_file(&mut wrong_values, &scene);
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
fn tell_in_file(problems: &mut Vec<Problem>, scene: &Scene) {
    problems.iter_mut().for_each(|problem| problem.path = scene.path_in_file(&problem.path));
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
    let mut row = Row::read(&mut root, units);
    let ground = ground(root.section("ground"));
    let (floor_forces, restoring_corrections) = inputs(root.section("inputs"));
    let (contacts, facing) = read_contacts::all(&mut root, &row, units);
    let links = read_links::all(&mut root, &row, units);
    let with_right = |what| root.missing("right", &format!("the building on the right, which {what} are with"));
    if !row.is_named && row.buildings.len() == 1 {
        if facing.is_some() || contacts.iter().any(|pair| pair.is_with(BuildingId::RIGHT)) {
            with_right("contacts");
            row.buildings.push(read_row::absent("right"));
        } else if links.iter().any(|link| link.is_with(BuildingId::RIGHT)) {
            with_right("links");
            row.buildings.push(read_row::absent("right"));
        }
    }
    let Shown { energy, peaks, numbers_only } = outputs(root.section("outputs"));
    let solver = solver(root.section("solver"));
    root.close(KEY);
    let (name, description) = (name.to_owned(), description.to_owned());
    Scene {
        name,
        description,
        units,
        stop_time,
        buildings: row.buildings,
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
