//! All scenes of the project, a run of one that stops at events, and what is read of it.

use pounding::description::Package;
use pounding::engine::{Episode, Input, Model, Output, Point, State};
use pounding::variables::{Row, Slot, Table, Variability};
use std::path::{Path, PathBuf};

/// Every scene that the project keeps.
pub fn all_scenes() -> Vec<PathBuf> {
    let folders = ["examples/scenes", "tests/reference/scenes", "ci/scenes"];
    let files = folders.iter().flat_map(|folder| {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap().join(folder);
        folder.read_dir().unwrap().map(|entry| entry.unwrap().path())
    });
    let mut scenes: Vec<PathBuf> =
        files.filter(|path| path.extension().is_some_and(|extension| extension == "toml")).collect();
    scenes.sort();
    assert!(scenes.len() > 35, "{} scenes", scenes.len());
    scenes
}

/// Of two with that name, that of the reference solutions.
pub fn scene_named(name: &str) -> PathBuf {
    let is_it = |path: &PathBuf| path.file_stem().is_some_and(|stem| stem == name);
    all_scenes().into_iter().rev().find(is_it).unwrap_or_else(|| panic!("no scene {name}"))
}

/// A scene, and all of its outputs.
pub struct Subject {
    pub model: Model,
    pub outputs: Vec<(Row, Output)>,
    pub inputs: Vec<Input>,
    pub stop: f64,
}

impl Subject {
    pub fn new(file: &Path) -> Subject {
        let package = Package::from_scene_file(file).unwrap();
        let rows = Table::new(&package.scene).rows;
        let input = |row: &Row| if let Slot::Input(input) = row.slot { Some(input) } else { None };
        let output = |row: Row| if let Slot::Output(output) = row.slot { Some((row, output)) } else { None };
        Subject {
            model: Model::new(&package.scene, package.record.as_ref().map(|record| &record.record)).unwrap(),
            inputs: rows.iter().filter_map(input).collect(),
            outputs: rows.into_iter().filter_map(output).collect(),
            stop: package.stop_time().unwrap_or(10.0).min(20.0),
        }
    }

    pub fn start(&self) -> Watched<'_> {
        let state = self.model.start(0.0);
        Watched { subject: self, state, point: Point::default(), episodes: Vec::new() }
    }

    /// Sets all inputs, if there are any, to what a master says at the state's time.
    pub fn drive(&self, state: &mut State) {
        let time = state.time();
        for (k, &input) in self.inputs.iter().enumerate() {
            let value = match input {
                Input::GroundAcceleration => 3.0 * (12.0 * time).sin() * (1.7 * time).cos(),
                _ => 4e4 * (7.0 * time + k as f64).sin(),
            };
            state.set_input(input, value);
        }
    }
}

/// A run that is read.
pub struct Watched<'s> {
    pub subject: &'s Subject,
    pub state: State,
    pub point: Point,
    pub episodes: Vec<Episode>,
}

impl Watched<'_> {
    pub fn advance(&mut self, until: f64) {
        let episodes = &mut self.episodes;
        self.subject.model.advance(&mut self.state, until, &mut |episode| episodes.push(*episode)).unwrap();
    }

    /// Whether an event waits.
    pub fn advance_to_event(&mut self, until: f64) -> bool {
        let episodes = &mut self.episodes;
        let note = &mut |episode: &Episode| episodes.push(*episode);
        self.subject.model.advance_to_event(&mut self.state, until, note).unwrap()
    }

    pub fn handle_event(&mut self) {
        let episodes = &mut self.episodes;
        self.subject.model.handle_event(&mut self.state, &mut |episode| episodes.push(*episode)).unwrap();
    }

    /// Of each output, in their order.
    pub fn read(&mut self) -> Vec<u64> {
        let Watched { subject, state, point, .. } = self;
        let now = subject.model.observe(state, point);
        subject.outputs.iter().map(|(_, output)| now.read(*output).to_bits()).collect()
    }

    pub fn value(&mut self, output: Output) -> f64 {
        self.subject.model.observe(&self.state, &mut self.point).read(output)
    }

    /// The discrete ones among values that have been read.
    pub fn discrete(&self, values: &[u64]) -> Vec<u64> {
        let of = self.subject.outputs.iter().zip(values);
        of.filter(|((row, _), _)| row.variability == Variability::Discrete).map(|(_, value)| *value).collect()
    }

    /// Saves the state and goes on from a new one, as if in another process.
    pub fn go_on_elsewhere(&mut self) {
        let model = &self.subject.model;
        let saved = model.save(&mut self.state);
        model.check_saved(&saved).unwrap_or_else(|error| panic!("at {} s: {error}", self.state.time()));
        let mut state = model.start(0.0);
        model.restore(&saved, &mut state);
        self.state = state;
    }
}

/// Names of the outputs in which two readings differ.
pub fn differing(subject: &Subject, one: &[u64], other: &[u64]) -> Vec<String> {
    let pairs = subject.outputs.iter().zip(one.iter().zip(other));
    pairs.filter(|(_, (one, other))| one != other).map(|((row, _), _)| row.name.clone()).collect()
}
