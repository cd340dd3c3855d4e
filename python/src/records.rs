//! Records from files and arrays. The same content is read once: studies come back to the same files.

use crate::document;
use numpy::{PyArray1, PyArrayMethods, PyReadonlyArray1};
use pounding::record::{self, KnownRecords, RecordError, RecordFile, RecordOptions};
use pounding::scene::{SceneError, record_source, record_table};
use pounding::warnings;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// A ground motion.
#[pyclass(frozen, module = "pounding_fmu._native")]
pub struct Record {
    /// What `ground.record` reads as.
    #[pyo3(get)]
    pub name: String,
    pub record: Arc<record::Record>,
}

/// What a file says of itself: format, unit, station or title, and the names of its components.
type About = (String, String, String, Vec<String>);

#[pymethods]
impl Record {
    /// That of a file; `key` is what a message calls it.
    #[staticmethod]
    fn read(file: PathBuf, key: &str) -> PyResult<Record> {
        match file.to_str() {
            Some(text) => {
                let (name, options) = record_source(text).map_err(|error| refused(&error, key))?;
                Record::of_file(Path::new(&name), &options, key)
            }
            None => Record::of_file(&file, &RecordOptions::default(), key),
        }
    }

    /// That of a dict with the keys of a scene's `ground.record`, its file as a path.
    #[staticmethod]
    fn read_dict(source: &Bound<'_, PyDict>, key: &str) -> PyResult<Record> {
        let (file, options) = options_of(source, key)?;
        Record::of_file(&file, &options, key)
    }

    /// What a file says of itself, which such a dict names.
    #[staticmethod]
    fn about(source: &Bound<'_, PyDict>, key: &str) -> PyResult<About> {
        let (file, options) = options_of(source, key)?;
        let found = RecordFile::read(&file)?.with(&options).parse();
        let found = found.map_err(|error| all(&error, |problem| format!("{key} = {file:?}: {problem}")))?;
        Ok((found.format.to_string(), found.unit.to_string(), found.about, found.channels))
    }

    /// That of two arrays, s and m/s2.
    #[staticmethod]
    fn of(times: PyReadonlyArray1<'_, f64>, accelerations: PyReadonlyArray1<'_, f64>, key: &str) -> PyResult<Record> {
        let record = record::Record::new(times.to_vec()?, accelerations.to_vec()?);
        let record = record.checked().map_err(|error| all(&error, |problem| format!("{key}: {problem}")))?;
        Ok(Record { name: "(arrays)".to_owned(), record: Arc::new(record) })
    }

    /// Its times, s, and accelerations, m/s2.
    fn samples<'py>(&self, py: Python<'py>) -> (Bound<'py, PyArray1<f64>>, Bound<'py, PyArray1<f64>>) {
        (PyArray1::from_slice(py, &self.record.times), PyArray1::from_slice(py, &self.record.accelerations))
    }

    /// m/s2, of its samples.
    fn mean(&self) -> f64 {
        self.record.mean()
    }

    /// m/s2, the mean, where it is a level about which the record stands.
    fn offset(&self) -> Option<f64> {
        self.record.offset()
    }

    /// m/s, the velocity that the mean leaves the ground with, where that is much beside the rest.
    fn drift(&self) -> Option<f64> {
        self.record.drift()
    }

    /// The component that has been read, as its file calls it.
    fn component(&self) -> &str {
        &self.record.component
    }

    /// What looks like a slip in it.
    fn warnings(&self) -> Vec<String> {
        warnings::of_record(&self.name, &self.record).iter().map(|warning| warning.text.clone()).collect()
    }
}

impl Record {
    fn of_file(file: &Path, options: &RecordOptions, key: &str) -> PyResult<Record> {
        let name = file.to_string_lossy().into_owned();
        let record = KNOWN.read(RecordFile::read(file)?.with(options)).map_err(|error| {
            all(&error, |problem| format!("{key} = {name:?}: expected a record file, but {problem}"))
        })?;
        Ok(Record { name, record })
    }
}

/// File and options of a dict as a scene has it.
fn options_of(source: &Bound<'_, PyDict>, key: &str) -> PyResult<(PathBuf, RecordOptions)> {
    let (name, options) = record_table(&document::to_toml(source)?).map_err(|error| refused(&error, key))?;
    Ok((name.into(), options))
}

/// What is wrong with such a table, which a message calls otherwise.
fn refused(error: &SceneError, key: &str) -> PyErr {
    let lines = error.problems.iter().map(|problem| problem.to_string().replacen("ground.record", key, 1));
    PyValueError::new_err(lines.collect::<Vec<_>>().join("\n"))
}

/// Everything that is wrong with a record, a line each.
fn all(error: &RecordError, line: impl Fn(&String) -> String) -> PyErr {
    PyValueError::new_err(error.problems.iter().map(line).collect::<Vec<_>>().join("\n"))
}

/// The latest files, of all calls.
static KNOWN: KnownRecords = KnownRecords::new(16);
