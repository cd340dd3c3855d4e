//! FMUs of scenes, with libraries that have been compiled before.

use crate::scene::Scene;
use anyhow::Result;
use fmu_build::destination::Destination;
use fmu_build::libraries::{Libraries, Shipped};
use fmu_build::{file_name, numbers_only, pack};
use pounding::FmiVersion;
use pounding::description::Package;
use pounding_simulate::scenario::Scenario;
use pounding_simulate::written;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use std::io;
use std::path::{Path, PathBuf};

/// Writes the FMU of a scene, by default NAME.fmu or NAME.fmi3.fmu in the current directory, with the libraries of a folder for these
/// platforms or all; returns where it is. It goes neither over the file that the scene comes from, if there is one, nor over its
/// record.
#[pyfunction]
pub fn build(
    py: Python<'_>,
    scene: &Bound<'_, Scene>,
    output: Option<PathBuf>,
    file: Option<PathBuf>,
    libraries: PathBuf,
    platforms: Vec<String>,
    is_fmi3: bool,
) -> PyResult<PathBuf> {
    let package = &scene.get().0.package;
    let version = if is_fmi3 { FmiVersion::V3 } else { FmiVersion::V2 };
    let output = output.unwrap_or_else(|| file_name(package, version).into());
    if let Some(file) = file {
        written::check(&written::sources(&file, &package.scene, None), &[("output", Some(&output))])
            .map_err(PyValueError::new_err)?;
    }
    py.detach(|| write(package, &output, libraries, &platforms, version)).map_err(|error| exception(&error))?;
    Ok(output)
}

/// The scene of an FMU that has numbers alone.
#[pyfunction]
pub fn with_numbers_only(scene: &Bound<'_, Scene>) -> PyResult<Scene> {
    let package = numbers_only(&scene.get().0.package).map_err(|error| exception(&error))?;
    Ok(Scene(Scenario::new(package)))
}

fn write(
    package: &Package,
    output: &Path,
    libraries: PathBuf,
    platforms: &[String],
    version: FmiVersion,
) -> Result<()> {
    let destination = Destination::open(output.to_path_buf())?;
    let libraries = Shipped(libraries).get(version, platforms, &mut |_| {})?;
    destination.take(destination.draft(&pack(package, &libraries, version)?)?)
}

/// `OSError` where the system has said no, else `ValueError`.
fn exception(error: &anyhow::Error) -> PyErr {
    let text = format!("{error:#}");
    match error.chain().find_map(|cause| cause.downcast_ref::<io::Error>()) {
        Some(cause) => io::Error::new(cause.kind(), text).into(),
        None => PyValueError::new_err(text),
    }
}
