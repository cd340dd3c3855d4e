//! Records from files and arrays. The same content is read once: studies come back to the same files.

use numpy::{PyArray1, PyArrayMethods, PyReadonlyArray1};
use pounding::record::{self, KnownRecords, RecordError, RecordFile};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use std::path::PathBuf;
use std::sync::Arc;

/// A ground motion.
#[pyclass(frozen, module = "pounding_fmu._native")]
pub struct Record {
    /// What `ground.record` reads as.
    #[pyo3(get)]
    pub name: String,
    pub record: Arc<record::Record>,
}

#[pymethods]
impl Record {
    /// That of a file; `key` is what a message calls it.
    #[staticmethod]
    fn read(file: PathBuf, key: &str) -> PyResult<Record> {
        let name = file.to_string_lossy().into_owned();
        let record = KNOWN.read(RecordFile::read(&file)?).map_err(|error| {
            all(&error, |problem| format!("{key} = {name:?}: expected a record file, but {problem}"))
        })?;
        Ok(Record { name, record })
    }

    /// What a file says of itself: format, station or title, and the names of its channels.
    #[staticmethod]
    fn about(file: PathBuf, key: &str) -> PyResult<(String, String, Vec<String>)> {
        let found = RecordFile::read(&file)?.parse();
        let found = found.map_err(|error| all(&error, |problem| format!("{key} = {file:?}: {problem}")))?;
        Ok((found.format.to_string(), found.about, found.channels))
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
}

/// Everything that is wrong with a record, a line each.
fn all(error: &RecordError, line: impl Fn(&String) -> String) -> PyErr {
    PyValueError::new_err(error.problems.iter().map(line).collect::<Vec<_>>().join("\n"))
}

/// The latest files, of all calls.
static KNOWN: KnownRecords = KnownRecords::new(16);
