//! Records from files and arrays. The same content is read once: studies come back to the same files.

use numpy::{PyArrayMethods, PyReadonlyArray1};
use pounding::record::{self, Format, RecordError};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use std::collections::VecDeque;
use std::path::PathBuf;
use std::sync::{Arc, Mutex, PoisonError};

/// A ground motion.
#[pyclass(frozen, module = "pounding_fmu._native")]
pub struct Record {
    /// What `ground.record` reads as.
    pub name: String,
    pub record: Arc<record::Record>,
}

#[pymethods]
impl Record {
    /// That of a file; `key` is what a message calls it.
    #[staticmethod]
    fn read(file: PathBuf, key: &str) -> PyResult<Record> {
        let name = file.to_string_lossy().into_owned();
        let bytes = std::fs::read(&file)?;
        let record = read_once(&name, bytes).map_err(|error| {
            all(&error, |problem| format!("{key} = {name:?}: expected a record file, but {problem}"))
        })?;
        Ok(Record { name, record })
    }

    /// That of two arrays, s and m/s2.
    #[staticmethod]
    fn of(times: PyReadonlyArray1<'_, f64>, accelerations: PyReadonlyArray1<'_, f64>, key: &str) -> PyResult<Record> {
        let record = record::Record { times: times.to_vec()?, accelerations: accelerations.to_vec()? };
        let record = record.checked().map_err(|error| all(&error, |problem| format!("{key}: {problem}")))?;
        Ok(Record { name: "(arrays)".to_owned(), record: Arc::new(record) })
    }
}

/// Everything that is wrong with a record, a line each.
fn all(error: &RecordError, line: impl Fn(&String) -> String) -> PyErr {
    PyValueError::new_err(error.problems.iter().map(line).collect::<Vec<_>>().join("\n"))
}

/// A file that has been read.
struct Known {
    format: Format,
    bytes: Vec<u8>,
    record: Arc<record::Record>,
}

/// The latest ones.
static KNOWN: Mutex<VecDeque<Known>> = Mutex::new(VecDeque::new());
const MOST_KNOWN: usize = 16;

fn read_once(name: &str, bytes: Vec<u8>) -> Result<Arc<record::Record>, RecordError> {
    let format = Format::of(name);
    let same = |known: &&Known| known.format == format && known.bytes == bytes;
    let known = || KNOWN.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(known) = known().iter().find(same) {
        return Ok(Arc::clone(&known.record));
    }
    let record = Arc::new(record::Record::parse(name, &bytes)?);
    let mut known = known();
    known.truncate(MOST_KNOWN - 1);
    known.push_front(Known { format, bytes, record: Arc::clone(&record) });
    Ok(record)
}
