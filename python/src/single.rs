//! One run with all its rows.

use crate::scene::{Scene, refusal};
use crate::threads::work_on;
use numpy::PyArray1;
use pounding::engine::{BuildingId, Model};
use pounding_simulate::instants;
use pounding_simulate::outcome::Follower;
use pounding_simulate::readings::{Kind, Reading};
use pounding_simulate::scenario::Scenario;
use pounding_simulate::solve::{Run, Solved, solve_run};
use pounding_simulate::summary::{Problem, text};
use pounding_simulate::tables::impact;
use pyo3::exceptions::{PyMemoryError, PyRuntimeError};
use pyo3::prelude::*;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

/// What is kept of a run: its rows by columns, and its impacts.
#[derive(Default)]
struct Kept {
    time: Vec<f64>,
    columns: Vec<Vec<f64>>,
    contacts: Vec<i32>,
    impacts: Vec<[f64; 9]>,
}

/// The columns of a run, and those of its impacts.
type Arrays<'py> = (Vec<Bound<'py, PyAny>>, Vec<Bound<'py, PyAny>>);

/// Runs a scene: `time` and the columns of these value references, and those of the impacts; where `rows_per_impact` is
/// given, also at as many instants within each contact, at its beginning, largest force and end.
#[pyfunction]
#[pyo3(signature = (scene, step, stop, references, rows_per_impact=None))]
pub fn simulate<'py>(
    py: Python<'py>,
    scene: &Bound<'py, Scene>,
    step: f64,
    stop: f64,
    references: Vec<u32>,
    rows_per_impact: Option<u16>,
) -> PyResult<Arrays<'py>> {
    let Scenario { settings, table, corrections, .. } = &scene.get().0;
    let reading = |&reference| Reading::new(table, settings, reference);
    let readings: Vec<Reading> = references.iter().filter_map(reading).collect();
    has_room(stop / step, readings.len() + 1)?;
    let kept = solved(py, &scene.get().0, |model, told_to_stop| {
        let start = || Run::under(model, Arc::clone(corrections));
        run((model, &start), &readings, (step, stop, rows_per_impact), told_to_stop)
    })?;
    Ok(kept.into_arrays(py, &readings))
}

/// What a run of a scene has shown, for a person: as the command says it of the scene's FMU.
#[pyfunction]
pub fn summary(py: Python<'_>, scene: &Bound<'_, Scene>, step: f64, stop: f64) -> PyResult<String> {
    let scene = &scene.get().0;
    let problem = Problem::from(&scene.settings);
    let stop_reason = if stop == scene.stop() { problem.stop_reason() } else { "as asked" };
    solved(py, scene, |model, told_to_stop| {
        let mut follower = Follower::new(&scene.table, &scene.settings, step, stop);
        let look = |now: Solved<'_>| {
            follower.look(&now);
            go_on(told_to_stop)
        };
        let run = Run::under(model, Arc::clone(&scene.corrections));
        let solution = solve_run(run, model, instants::regular(step, stop), Some(look));
        let solution = solution.map_err(|error| error.to_string())?;
        Ok(problem.heading() + &coupled(scene) + &text(&follower.outcome(solution.time), Some(problem), stop_reason))
    })
}

/// Which buildings another program has had, if any.
fn coupled(Scenario { corrections, settings, .. }: &Scenario) -> String {
    let line = |id: BuildingId| {
        let what = "its restoring forces are another program's; frequencies are of its first stiffness";
        format!("  {:<12} {what}\n", settings.scene.building(id).name)
    };
    settings.scene.ids().filter(|id| corrections.are_of(*id)).map(line).collect()
}

/// What comes of work with the model of a scene, beside Python.
fn solved<T: Send>(
    py: Python<'_>,
    scene: &Scenario,
    work: impl Fn(&Model, &AtomicBool) -> Result<T, String> + Sync + Send,
) -> PyResult<T> {
    let model = py.detach(|| scene.model()).map_err(|error| refusal(&error))?;
    let done = Mutex::new(Err("interrupted".to_owned()));
    let body = |told_to_stop: &AtomicBool| {
        let result = work(&model, told_to_stop);
        *done.lock().unwrap_or_else(PoisonError::into_inner) = result;
    };
    work_on(py, 1, body, |_| Ok(()))?;
    done.into_inner().unwrap_or_else(PoisonError::into_inner).map_err(PyRuntimeError::new_err)
}

fn go_on(told_to_stop: &AtomicBool) -> Result<(), &'static str> {
    if told_to_stop.load(Ordering::Relaxed) { Err("interrupted") } else { Ok(()) }
}

/// Whether there is memory for so many rows and columns; a run that outgrows it would end the process.
fn has_room(rows: f64, columns: usize) -> PyResult<()> {
    let bytes = rows * columns as f64 * 8.0;
    Vec::<u8>::new().try_reserve_exact(bytes as usize).map_err(|_| {
        PyMemoryError::new_err(format!("{rows:.1e} rows of {columns} columns: expected fewer, by a larger step"))
    })
}

fn run(
    (model, start): (&Model, &impl Fn() -> Run),
    readings: &[Reading],
    (step, stop, rows_per_impact): (f64, f64, Option<u16>),
    told_to_stop: &AtomicBool,
) -> Result<Kept, String> {
    let regular = || instants::regular(step, stop);
    let within = match rows_per_impact {
        None => Vec::new(),
        Some(count) => {
            let first = solve_run(start(), model, regular(), Some(|_: Solved<'_>| go_on(told_to_stop)))
                .map_err(|error| error.to_string())?;
            instants::within(&first.events, stop, count)
        }
    };
    let mut kept = Kept { columns: vec![Vec::new(); readings.len()], ..Kept::default() };
    let keep = |now: Solved<'_>| {
        kept.time.push(now.time());
        kept.columns.iter_mut().zip(readings).for_each(|(column, reading)| column.push(reading.at(&now)));
        go_on(told_to_stop)
    };
    let solution = solve_run(start(), model, instants::merge(regular(), within), Some(keep));
    for episode in &solution.map_err(|error| error.to_string())?.events.episodes {
        let (contact, row) = impact(episode);
        kept.contacts.push(i32::try_from(contact).unwrap_or(i32::MAX));
        kept.impacts.push(row.map(|value| value.unwrap_or(f64::NAN)));
    }
    Ok(kept)
}

impl Kept {
    fn into_arrays<'py>(self, py: Python<'py>, readings: &[Reading]) -> Arrays<'py> {
        let real = |values: Vec<f64>| PyArray1::from_vec(py, values).into_any();
        let column = |(values, reading): (Vec<f64>, &Reading)| match reading.kind() {
            Kind::Real => real(values),
            Kind::Integer => PyArray1::from_iter(py, values.into_iter().map(|value| value as i32)).into_any(),
            Kind::Boolean => PyArray1::from_iter(py, values.into_iter().map(|value| value != 0.0)).into_any(),
        };
        let columns =
            std::iter::once(real(self.time)).chain(self.columns.into_iter().zip(readings).map(column)).collect();
        let of_impacts = (0..9).map(|i| real(self.impacts.iter().map(|row| row[i]).collect()));
        let impacts = std::iter::once(PyArray1::from_vec(py, self.contacts).into_any()).chain(of_impacts).collect();
        (columns, impacts)
    }
}
