//! A run with buildings of other programs, which Python reaches.

use crate::scene::{Scene, refusal};
use crate::threads::caught;
use numpy::{PyArray1, PyReadonlyArray1};
use pounding::scene::{BuildingId, Scene as Described};
use pounding_simulate::couple::{Asked, Failure, How, Outside, Stiffer, couple as run, stiffness_of};
use pyo3::exceptions::{PyException, PyRuntimeError, PyTypeError, PyValueError};
use pyo3::prelude::*;

/// The scene with buildings of other programs: for each its place in the row, counted from 0, and its stiffness, N/m, as rows
/// of a matrix, or a single row of storeys.
#[pyfunction]
pub fn with_outside(scene: &Bound<'_, Scene>, stiffness: Vec<(u8, Vec<Vec<f64>>)>) -> PyResult<Scene> {
    let of = |(place, mut rows): (u8, Vec<Vec<f64>>)| {
        let storeys = (rows.len() == 1).then(|| pounding::scene::Stiffness::Shear(rows.remove(0)));
        (BuildingId::new(place.into()), storeys.unwrap_or_else(|| stiffness_of(rows)))
    };
    let stiffness = stiffness.into_iter().map(of).collect();
    scene.get().0.with_outside(stiffness).map(Scene).map_err(|error| refusal(&error))
}

/// Runs such a scene; `models` are, for each of its buildings, its place in the row and what is called with displacements, m,
/// and returns forces, N. The scene comes back with what went in, so that the same run can be made
/// again without them, and with what looks like a slip.
#[pyfunction]
pub fn couple(
    py: Python<'_>,
    scene: &Bound<'_, Scene>,
    models: Vec<(u8, Bound<'_, PyAny>)>,
    how: &str,
    step: f64,
    stop: f64,
) -> PyResult<(Scene, Vec<String>)> {
    let how = match how {
        "held" => How::Held,
        "line" => How::Line,
        _ => How::Twice,
    };
    let scenario = &scene.get().0;
    let described = &scenario.settings.scene;
    let model = scenario.model().map_err(|error| refusal(&error))?;
    let outside = models.into_iter().map(|(place, model)| {
        let forces = move |displacements: &[f64]| {
            py.check_signals()?;
            forces(&model.call1((PyArray1::from_slice(py, displacements),))?, displacements.len())
        };
        Outside { building: BuildingId::new(place.into()), forces: Box::new(forces) }
    });
    let whole = || run(&model, described, outside.collect(), how, (step, stop));
    let coupled = caught(whole).map_err(PyRuntimeError::new_err)?.map_err(|failure| raised(py, described, failure))?;
    let slips = coupled.stiffer.iter().map(|stiffer| slip(described, stiffer)).collect();
    Ok((Scene(scenario.with_corrections(coupled.corrections)), slips))
}

/// The forces that a model has answered with.
fn forces(answer: &Bound<'_, PyAny>, floors: usize) -> PyResult<Vec<f64>> {
    let forces = match answer.extract::<PyReadonlyArray1<'_, f64>>() {
        Ok(array) => array.as_array().to_vec(),
        Err(_) => answer.extract::<Vec<f64>>().map_err(|_| {
            let found = answer.get_type();
            PyTypeError::new_err(format!("{found}: expected {floors} numbers, the forces on the floors in N"))
        })?,
    };
    match forces.iter().position(|force| !force.is_finite()) {
        _ if forces.len() != floors => {
            let found = format!("{} numbers: expected {floors}, the forces on the floors in N", forces.len());
            Err(PyValueError::new_err(found))
        }
        Some(floor) => Err(PyValueError::new_err(format!(
            "{} on floor {}: expected a finite force in N",
            forces[floor],
            floor + 1
        ))),
        None => Ok(forces),
    }
}

/// What ends a run; what a model has raised is the cause of it, but for Ctrl-C, which goes through as it is.
fn raised(py: Python<'_>, scene: &Described, failure: Failure<PyErr>) -> PyErr {
    match failure {
        Failure::Engine(error) => PyRuntimeError::new_err(error.to_string()),
        Failure::Outside(_, error) if !error.is_instance_of::<PyException>(py) => error,
        Failure::Outside(asked, error) => {
            let (storey, drift) = asked.largest_drift();
            let Asked { building, time, displacements } = asked;
            let name = &scene.building(building).name;
            let said = error.value(py).to_string();
            let failed = PyRuntimeError::new_err(format!(
                "{name}: the model failed at {time} s, with floors at {displacements:?} m and its largest drift, {drift:.3e} m, in \
                 storey {storey}: {said}"
            ));
            failed.set_cause(py, Some(error));
            failed
        }
    }
}

fn slip(scene: &Described, stiffer: &Stiffer) -> String {
    let &Stiffer { building, storey, time, ratio, steps, moved: _ } = stiffer;
    let name = &scene.building(building).name;
    let of = storey.map_or_else(String::new, |storey| format!(", storey {storey}"));
    format!(
        "{name}{of}: the model was up to {ratio:.3} times as stiff as its initial_stiffness(), in {steps} steps, first at {time} s: \
         with a stiffness that is too soft the run chatters; expected the largest that the model ever has"
    )
}
