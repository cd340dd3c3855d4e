//! A scene with its record and parameters, as `pounding_fmu` hands it from step to step.

use crate::document;
use crate::records::Record;
use pounding::description::Package;
use pounding::scene::{Building, SceneError};
use pounding::structure::{ModalDamping, Modes, period_ratio};
use pounding::variables::{Parameter, Row, Slot, Type, Value};
use pounding_simulate::layout::Layout;
use pounding_simulate::scenario::Scenario;
use pyo3::IntoPyObjectExt;
use pyo3::exceptions::{PyRuntimeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyTuple;
use std::f64::consts::TAU;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// A scene that never changes: what gives it a record or parameters returns another one.
#[pyclass(frozen, module = "pounding_fmu._native")]
pub struct Scene(pub Scenario);

/// A scene, or everything that is wrong with it.
type Read = (Option<Scene>, Vec<String>);

#[pymethods]
impl Scene {
    /// That of a file; its record is relative to the folder of the file.
    #[staticmethod]
    fn read(file: PathBuf) -> Read {
        Scene::of(Package::from_scene_file(&file))
    }

    /// That of a text; its record is relative to the current directory.
    #[staticmethod]
    fn parse(text: String) -> Read {
        Scene::of(Package::from_scene_text(text, Path::new("")))
    }

    /// That of a dict, likewise.
    #[staticmethod]
    fn from_dict(scene: &Bound<'_, PyAny>) -> PyResult<Read> {
        Ok(Scene::parse(document::to_toml(scene)?))
    }

    /// The variables of its FMU in their order: name, causality, variability, type, unit, min, max, start, description.
    fn variables<'py>(&self, py: Python<'py>) -> PyResult<Vec<Bound<'py, PyTuple>>> {
        self.0.table.rows.iter().map(|row| self.variable(py, row)).collect()
    }

    /// What looks like a slip in it.
    fn warnings(&self) -> Vec<String> {
        self.0.warnings().iter().map(ToString::to_string).collect()
    }

    /// The same under another record.
    fn with_record(&self, record: &Record) -> PyResult<Scene> {
        self.0.with_record(&record.name, &record.record).map(Scene).map_err(|error| refusal(&error))
    }

    /// The same with other parameters: value references and numbers.
    fn with_parameters(&self, parameters: Vec<(u32, f64)>) -> PyResult<Scene> {
        let known = |(reference, value)| Ok((self.parameter(reference)?, value));
        let parameters = parameters.into_iter().map(known).collect::<PyResult<Vec<_>>>()?;
        self.0.with_parameters(&parameters).map(Scene).map_err(|error| refusal(&error))
    }

    /// The same without any contact: how each building moves by itself, or with its links.
    fn without_contacts(&self) -> Scene {
        Scene(self.0.without_contacts())
    }

    /// Whether it has what buildings of another program have added to a run.
    fn is_coupled(&self) -> bool {
        self.0.corrections.start(0).is_some()
    }

    #[getter]
    fn name(&self) -> &str {
        &self.0.settings.scene.name
    }

    #[getter]
    fn description(&self) -> &str {
        &self.0.settings.scene.description
    }

    /// The names of its buildings, from left to right.
    fn buildings(&self) -> Vec<&str> {
        self.0.settings.scene.buildings.iter().map(|building| building.name.as_str()).collect()
    }

    /// What stands where, as JSON.
    fn layout(&self) -> PyResult<String> {
        serde_json::to_string(&Layout::of(&self.0.settings.scene))
            .map_err(|error| PyRuntimeError::new_err(error.to_string()))
    }

    /// s, when a run ends where nothing else is said.
    pub fn stop(&self) -> f64 {
        self.0.stop()
    }

    /// The record that it has.
    fn record(&self) -> Option<Record> {
        let (name, record) = self.0.settings.scene.ground.record.as_ref().zip(self.0.settings.record())?;
        Some(Record { name: name.clone(), record: Arc::new(record.clone()) })
    }

    /// The text of the scene without `[ground]`: what another machine needs that has the records.
    fn without_ground(&self) -> PyResult<String> {
        let unreadable = |error: String| PyValueError::new_err(error);
        let mut scene: toml::Table =
            self.0.package.scene_text.parse().map_err(|error| unreadable(format!("{error}")))?;
        scene.remove("ground");
        toml::to_string(&scene).map_err(|error| unreadable(error.to_string()))
    }

    /// Of the first mode of each building alone the period, s, on its soil if it has any, and the ratio of critical damping on
    /// a fixed base.
    fn first_modes(&self) -> PyResult<Vec<Option<(f64, f64)>>> {
        self.0.settings.scene.buildings.iter().map(first_mode).collect()
    }
}

fn first_mode(building: &Building) -> PyResult<Option<(f64, f64)>> {
    let modes = Modes::of(building).map_err(|_| PyValueError::new_err("expected a positive definite stiffness"))?;
    let damping = match &modes.damping {
        ModalDamping::Diagonal(each) => each.first().copied(),
        ModalDamping::Coupled(matrix) => matrix.get((0, 0)).copied(),
    };
    let first = modes.omega.first().zip(damping);
    Ok(first.map(|(omega, damping)| (period_ratio(building) * TAU / omega, damping / (2.0 * omega))))
}

impl Scene {
    fn of(package: Result<Package, SceneError>) -> Read {
        match package {
            Ok(package) => (Some(Scene(Scenario::new(package))), Vec::new()),
            Err(error) => (None, error.problems.iter().map(ToString::to_string).collect()),
        }
    }

    /// The parameter of a value reference.
    pub fn parameter(&self, reference: u32) -> PyResult<Parameter> {
        let unknown = || PyValueError::new_err(format!("value reference {reference}: expected that of a parameter"));
        self.0.parameter(reference).ok_or_else(unknown)
    }

    fn variable<'py>(&self, py: Python<'py>, row: &Row) -> PyResult<Bound<'py, PyTuple>> {
        let unit = if let Type::Real(unit) = row.ty { Some(unit.info().name) } else { None };
        let start = match row.slot {
            Slot::Parameter(parameter) => match self.0.settings.read(parameter) {
                Value::String(text) => text.into_bound_py_any(py)?,
                value => value.real().into_bound_py_any(py)?,
            },
            Slot::Input(_) => 0.0.into_bound_py_any(py)?,
            Slot::Calculated(_) | Slot::Output(_) => py.None().into_bound(py),
        };
        let (causality, variability) = (row.slot.causality().name(), row.variability.name());
        let (name, description) = (row.name.as_str(), row.description.as_str());
        (
            name,
            causality,
            variability,
            row.ty.name(pounding::FmiVersion::V2),
            unit,
            row.min,
            row.max,
            start,
            description,
        )
            .into_pyobject(py)
    }
}

/// Everything that is wrong with the parameters.
pub fn refusal(error: &SceneError) -> PyErr {
    PyValueError::new_err(error.to_string())
}
