//! FMUs in the simulator of fmi-rs, a master that is not ours: FMI 3.0 has the bits of FMI 2.0, whatever it is asked for.
#![expect(clippy::arc_with_non_send_sync, reason = "fmi-rs wants its recorder in an `Arc`")]

use crate::common::{cargo_fmu, root, stderr};
use fmi::fmi3::LibraryKind;
use fmi::model_description::{fmi2, fmi3};
use fmi::sim;
use pounding::description::Package;
use pounding::engine::Model;
use pounding_simulate::solve::{self, Events};
use std::path::PathBuf;
use std::sync::{Arc, Mutex, PoisonError};
use tempfile::TempDir;

const STEP: f64 = 1.0 / 64.0;
const STOP: f64 = 10.0;
/// By how much of a time the master takes two for one.
const TOLERANCE: f64 = 1e-12;

/// Event Mode, early returns, and intermediate updates: those it asks for without a function that takes them.
const WAYS: [(bool, bool, bool); 5] =
    [(false, false, false), (false, true, false), (true, false, false), (true, true, false), (true, true, true)];

/// The unpacked FMU of a scene in one version of FMI.
fn unpacked(scene: &str, version: &str) -> TempDir {
    let directory = TempDir::new().unwrap();
    let fmu = directory.path().join("some.fmu");
    let scene = root().join(scene);
    let said = cargo_fmu(&[scene.to_str().unwrap(), "--fmi", version, "-o", fmu.to_str().unwrap()]);
    assert!(said.status.success(), "{}", stderr(&said));
    fmi::zip::extract_zip_archive(&fmu, directory.path()).unwrap();
    directory
}

fn description_of(fmu: &TempDir) -> PathBuf {
    fmu.path().join("modelDescription.xml")
}

/// The bits of all outputs, by the time at which they were read.
#[derive(PartialEq)]
struct Rows(Vec<(f64, Vec<u64>)>);

impl Rows {
    fn new<'a, V: 'a>(times: &[f64], rows: &'a [Vec<V>], number: impl Fn(&'a V) -> f64) -> Rows {
        let bits = rows.iter().map(|row| row.iter().map(|value| number(value).to_bits()).collect());
        Rows(times.iter().copied().zip(bits).collect())
    }

    /// At the points of the grid: of several rows the last, at the start the first.
    fn on_grid(&self) -> Rows {
        let point = |k: u32| {
            let is_there = |row: &&(f64, Vec<u64>)| row.0 == f64::from(k) * STEP;
            let found = if k == 0 { self.0.iter().find(is_there) } else { self.0.iter().rfind(is_there) };
            found.unwrap_or_else(|| panic!("no row at point {k}")).clone()
        };
        Rows((0..=(STOP / STEP) as u32).map(point).collect())
    }
}

fn run_of_2(fmu: &TempDir) -> Rows {
    let description = Arc::new(fmi2::ModelDescription::from_path(&description_of(fmu)).unwrap());
    let is_output = |variable: &fmi2::ScalarVariable| variable.causality == fmi2::Causality::Output;
    let outputs = places(&description.modelVariables, is_output);
    let settings = sim::fmi2::SimulationSettings {
        unzipdir: fmu.path().to_owned(),
        model_description: description.clone(),
        start_time: 0.0,
        stop_time: STOP,
        logging_on: false,
        set_stop_time: true,
        output_interval: STEP,
        log_time_scale: false,
        tolerance: TOLERANCE,
        set_tolerance: false,
        start_values: Vec::new(),
        log_fmi_calls: false,
        input_file: None,
        early_return_allowed: false,
        event_mode_used: false,
        log_file: None,
        initial_fmu_state_file: None,
        final_fmu_state_file: None,
    };
    let recorder = sim::fmi2::recorder::Recorder::new(sim::fmi2::Trajectories::new(description, outputs));
    let recorder = Arc::new(recorder);
    sim::fmi2::cs::simulate(&settings, None, recorder.clone()).unwrap();
    let found = recorder.trajectories.borrow();
    Rows::new(&found.time, &found.rows, |value| value.to_f64().unwrap())
}

fn run_of_3(fmu: &TempDir, (event_mode_used, early_return_allowed, intermediate_update): (bool, bool, bool)) -> Rows {
    let description = Arc::new(fmi3::ModelDescription::from_path(&description_of(fmu)).unwrap());
    let is_output = |variable: &fmi3::ModelVariable| variable.causality == fmi3::Causality::Output;
    let outputs = places(&description.modelVariables, is_output);
    let settings = sim::fmi3::SimulationSettings {
        unzipdir: fmu.path().to_owned(),
        model_description: description.clone(),
        library_kind: LibraryKind::Native,
        enable_dae: false,
        start_time: 0.0,
        stop_time: STOP,
        visible: false,
        logging_on: false,
        set_stop_time: true,
        output_interval: STEP,
        log_time_scale: false,
        tolerance: TOLERANCE,
        set_tolerance: false,
        start_values: Vec::new(),
        log_fmi_calls: false,
        intermediate_update,
        input_file: None,
        early_return_allowed,
        event_mode_used,
        log_file: None,
        initial_fmu_state_file: None,
        final_fmu_state_file: None,
    };
    let recorder = sim::fmi3::recorder::Recorder::new(sim::fmi3::Trajectories::new(description, outputs));
    let recorder = Arc::new(recorder);
    sim::fmi3::cs::simulate(&settings, None, recorder.clone()).unwrap();
    let found = recorder.trajectories.borrow();
    Rows::new(&found.time, &found.rows, |value| value.as_f64().unwrap()[0])
}

fn places<T>(all: &[T], is_wanted: impl Fn(&T) -> bool) -> Vec<usize> {
    all.iter().enumerate().filter(|(_, one)| is_wanted(one)).map(|(place, _)| place).collect()
}

/// s, when contacts begin and end and storeys yield and turn back, as the engine says that knows nothing of FMI.
fn events(scene: &str) -> (Vec<f64>, usize) {
    let package = Package::from_scene_file(&root().join(scene)).unwrap();
    let model = Model::new(&package.scene, package.record.as_ref().map(|record| &record.record)).unwrap();
    let Events { episodes, switches, .. } = solve::events(&model, STOP).unwrap();
    let starts = episodes.iter().map(|episode| episode.start).collect::<Vec<_>>();
    let ends = episodes.iter().filter(|episode| episode.end.is_some()).count();
    let count = starts.len() + ends + switches.len();
    (starts, count)
}

/// s, when the number of contacts so far, the output in that column, has grown.
fn onsets(rows: &Rows, column: usize) -> Vec<f64> {
    let pairs = rows.0.windows(2).filter(|pair| pair[0].1[column] != pair[1].1[column]);
    pairs.map(|pair| pair[1].0).collect()
}

/// One at a time: the parser of variable names in fmi-rs, which is C, keeps its state in globals.
static PARSER: Mutex<()> = Mutex::new(());

fn check(scene: &str) {
    let _alone = PARSER.lock().unwrap_or_else(PoisonError::into_inner);
    let [older, newer] = ["2", "3"].map(|version| unpacked(scene, version));
    let description = fmi3::ModelDescription::from_path(&description_of(&newer)).unwrap();
    assert!(description.validate().is_empty());
    let outputs = description.modelVariables.iter().filter(|variable| variable.causality == fmi3::Causality::Output);
    let impacts = outputs.into_iter().position(|variable| variable.name == "impacts").unwrap();
    let expected = run_of_2(&older);
    let runs = WAYS.map(|way| run_of_3(&newer, way));
    for (run, way) in runs.iter().zip(WAYS) {
        assert!(run.on_grid() == expected, "{scene} {way:?}");
    }
    let (starts, events) = events(scene);
    let counts = runs.each_ref().map(|run| run.0.len() - expected.0.len());
    assert_eq!([counts[0], counts[1], counts[3], counts[4]], [0, events, 2 * events, 2 * events], "{scene}");
    assert!(0 < counts[2] && counts[2] < events, "{scene}: {}", counts[2]);
    for run in [1, 3, 4] {
        assert_eq!(onsets(&runs[run], impacts), starts, "{scene} {:?}", WAYS[run]);
    }
}

#[test]
fn contacts() {
    check("examples/scenes/feup.toml");
}

#[test]
fn storeys_that_yield() {
    check("examples/scenes/yielding.toml");
}
