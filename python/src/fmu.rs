//! FMUs of scenes, with libraries that have been compiled before.

use crate::scene::Scene;
use anyhow::Result;
use fmu_build::destination::Destination;
use fmu_build::libraries::{Libraries, Shipped};
use fmu_build::pack;
use pounding::description::Package;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use std::io;
use std::path::{Path, PathBuf};

/// Writes the FMU of a scene, by default NAME.fmu in the current directory, with the libraries of a folder for these
/// platforms or all; returns where it is.
#[pyfunction]
pub fn build(
    py: Python<'_>,
    scene: &Bound<'_, Scene>,
    output: Option<PathBuf>,
    libraries: PathBuf,
    platforms: Vec<String>,
) -> PyResult<PathBuf> {
    let package = &scene.get().package;
    let output = output.unwrap_or_else(|| format!("{}.fmu", package.scene.name).into());
    py.detach(|| write(package, &output, libraries, &platforms)).map_err(|error| exception(&error))?;
    Ok(output)
}

fn write(package: &Package, output: &Path, libraries: PathBuf, platforms: &[String]) -> Result<()> {
    let destination = Destination::open(output.to_path_buf())?;
    let libraries = Shipped(libraries).get(platforms, &mut |_| {})?;
    destination.take(destination.draft(&pack(package, &libraries)?)?)
}

/// `OSError` where the system has said no, else `ValueError`.
fn exception(error: &anyhow::Error) -> PyErr {
    let text = format!("{error:#}");
    match error.chain().find_map(|cause| cause.downcast_ref::<io::Error>()) {
        Some(cause) => io::Error::new(cause.kind(), text).into(),
        None => PyValueError::new_err(text),
    }
}
