//! Many runs on all cores.

use crate::cases::{Cases, Findings};
use crate::scene::Scene;
use crate::threads::{caught, work_on};
use numpy::{PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray1};
use pounding::engine::{Model, Point};
use pounding_simulate::instants;
use pyo3::exceptions::{PyMemoryError, PyValueError};
use pyo3::prelude::*;
use std::collections::BTreeMap;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};
use std::thread::available_parallelism;

/// Cases of a scene that differ in parameters and records.
#[pyclass(frozen, module = "pounding_fmu._native")]
pub struct Batch {
    cases: Cases,
    /// s, where each of the records ends the run.
    stops: Vec<f64>,
}

/// The values at the end, a row each case, and why a case has none.
type Ends<'py> = (Bound<'py, PyArray2<f64>>, BTreeMap<usize, String>);

#[pymethods]
impl Batch {
    /// `which` of the scenes each case has (the first, without it), and parameters: value references and a number each.
    #[new]
    fn new(
        count: usize,
        scenes: Vec<Bound<'_, Scene>>,
        which: Option<Vec<usize>>,
        parameters: Vec<(u32, PyReadonlyArray1<'_, f64>)>,
    ) -> PyResult<Batch> {
        let first = scenes.first().ok_or_else(|| PyValueError::new_err("no scene"))?.get();
        let fits = which.as_ref().is_none_or(|which| which.len() == count && which.iter().all(|&i| i < scenes.len()));
        if !fits || parameters.iter().any(|(_, values)| values.as_array().len() != count) {
            return Err(PyValueError::new_err("lengths that do not fit"));
        }
        let parameter = |(reference, values): (u32, PyReadonlyArray1<'_, f64>)| {
            Ok((first.parameter(reference)?, values.as_array().to_vec()))
        };
        let parameters = parameters.into_iter().map(parameter).collect::<PyResult<_>>()?;
        let settings = scenes.iter().map(|scene| scene.get().0.settings.clone()).collect();
        let stops = scenes.iter().map(|scene| scene.get().stop()).collect();
        Ok(Batch { cases: Cases { count, table: first.0.table.clone(), settings, which, parameters }, stops })
    }

    /// Looks at all cases: what seems odd in them.
    fn look(&self, py: Python<'_>, threads: Option<usize>) -> PyResult<Vec<String>> {
        let findings = Mutex::new(Findings::default());
        let look = |case| {
            let looked = self.cases.settings(case);
            findings.lock().unwrap_or_else(PoisonError::into_inner).note(case, &looked);
        };
        share(py, (self.cases.count, threads), look, |_, _| Ok(()))?;
        let findings = findings.into_inner().unwrap_or_else(PoisonError::into_inner);
        findings.finish(self.cases.count).map_err(PyValueError::new_err)
    }

    /// Runs all cases, to `stop` or where each record ends, in steps of `step` or a single one; `progress` is called
    /// with how many are done.
    fn run<'py>(
        &self,
        py: Python<'py>,
        references: Vec<u32>,
        step: Option<f64>,
        stop: Option<f64>,
        threads: Option<usize>,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<Ends<'py>> {
        let (rows, columns) = (self.cases.count, references.len());
        let mut values = Vec::new();
        let too_many = |_| PyMemoryError::new_err(format!("{rows} cases of {columns} outputs: expected fewer"));
        values.try_reserve_exact(rows.saturating_mul(columns)).map_err(too_many)?;
        values.resize(rows * columns, f64::NAN);
        let ends = Mutex::new((values, BTreeMap::new()));
        let run = |case| {
            let end = caught(|| self.end(case, &references, step, stop)).unwrap_or_else(Err);
            let (values, failures) = &mut *ends.lock().unwrap_or_else(PoisonError::into_inner);
            match end {
                Ok(end) => values[case * columns..(case + 1) * columns].copy_from_slice(&end),
                Err(message) => drop(failures.insert(case, message)),
            }
        };
        let tell = |py: Python<'_>, done| match &progress {
            Some(progress) => progress.call1(py, (done, rows)).map(drop),
            None => Ok(()),
        };
        share(py, (rows, threads), run, tell)?;
        tell(py, rows)?;
        let (values, failures) = ends.into_inner().unwrap_or_else(PoisonError::into_inner);
        Ok((PyArray1::from_vec(py, values).reshape([rows, columns])?, failures))
    }
}

impl Batch {
    /// The values at the end of a case.
    fn end(&self, case: usize, references: &[u32], step: Option<f64>, stop: Option<f64>) -> Result<Vec<f64>, String> {
        let settings = self.cases.settings(case).map_err(|error| error.to_string())?;
        let stop = stop.unwrap_or(self.stops[self.cases.which.as_ref().map_or(0, |which| which[case])]);
        let model = Model::new(&settings.scene, settings.record()).map_err(|error| error.to_string())?;
        let (mut state, mut point) = (model.start(0.0), Point::default());
        for time in instants::regular(step.unwrap_or(stop), stop).filter(|&time| time > 0.0) {
            let collapse = model.advance(&mut state, time, &mut |_| {}).map_err(|error| error.to_string())?;
            if collapse.is_some() {
                break;
            }
        }
        let now = model.observe(&state, &mut point);
        Ok(self.cases.readings(&settings, references).into_iter().map(|reading| reading.at(&now)).collect())
    }
}

/// Does something with each of so many cases on so many threads, and tells how many are done.
fn share(
    py: Python<'_>,
    (cases, threads): (usize, Option<usize>),
    each: impl Fn(usize) + Send + Sync,
    tell: impl Fn(Python<'_>, usize) -> PyResult<()> + Send + Sync,
) -> PyResult<()> {
    let (next, done) = (AtomicUsize::new(0), AtomicUsize::new(0));
    let work = |told_to_stop: &AtomicBool| {
        while !told_to_stop.load(Ordering::Relaxed) {
            let case = next.fetch_add(1, Ordering::Relaxed);
            if case >= cases {
                break;
            }
            each(case);
            done.fetch_add(1, Ordering::Relaxed);
        }
    };
    let threads = threads.unwrap_or_else(|| available_parallelism().map_or(1, usize::from));
    work_on(py, threads.min(cases), work, |py| tell(py, done.load(Ordering::Relaxed)))
}
