//! Files that commands in Python write: none of them may be one that is read.

use pounding::record::RecordFile;
use pounding::scene::Scene;
use pounding_simulate::written::{check, sources};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use std::path::{Path, PathBuf};

/// Refuses outputs, each with the option that names it, that are one of these scenes, the record of one, one of these records,
/// or two of them one file.
#[pyfunction]
pub fn spare(outputs: Vec<(String, Option<PathBuf>)>, scenes: Vec<PathBuf>, records: Vec<PathBuf>) -> PyResult<()> {
    let read = scenes.iter().filter_map(|file| {
        // What is wrong with a scene is told by those who run it.
        let scene = Scene::from_toml(&std::fs::read_to_string(file).ok()?).ok()?;
        Some(sources(file, &scene, None))
    });
    let records = records.iter().map(|file| ("record", RecordFile::place(file).0));
    let scenes = scenes.iter().map(|file| ("scene", file.clone()));
    let read: Vec<_> = scenes.chain(read.flatten()).chain(records).collect();
    let outputs: Vec<(&str, Option<&Path>)> =
        outputs.iter().map(|(option, file)| (option.as_str(), file.as_deref())).collect();
    check(&read, &outputs).map_err(PyValueError::new_err)
}
