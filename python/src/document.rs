//! A scene written as a Python dict, as the TOML text that the FMU carries.

use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyFloat, PyInt, PyMapping, PySequence, PyString};
use serde::ser::{Serialize, SerializeMap, Serializer};

/// Tables and lists within each other: a scene has five; a dict may hold itself.
const DEEPEST: usize = 16;

/// What both Python and TOML have.
enum Value {
    Boolean(bool),
    Integer(i64),
    Float(f64),
    Text(String),
    List(Vec<Value>),
    /// In the order of the dict.
    Table(Vec<(String, Value)>),
}

impl Serialize for Value {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Value::Boolean(value) => serializer.serialize_bool(*value),
            Value::Integer(value) => serializer.serialize_i64(*value),
            Value::Float(value) => serializer.serialize_f64(*value),
            Value::Text(value) => serializer.serialize_str(value),
            Value::List(values) => values.serialize(serializer),
            Value::Table(entries) => {
                let mut map = serializer.serialize_map(Some(entries.len()))?;
                entries.iter().try_for_each(|(key, value)| map.serialize_entry(key, value))?;
                map.end()
            }
        }
    }
}

/// The text of a scene file that says what a dict says.
///
/// # Errors
/// `TypeError` or `ValueError` with the path, such as `left.mass[2]`, of what TOML does not have.
pub fn to_toml(scene: &Bound<'_, PyAny>) -> PyResult<String> {
    toml::to_string(&value(scene, "", DEEPEST)?).map_err(|error| PyValueError::new_err(error.to_string()))
}

fn value(object: &Bound<'_, PyAny>, path: &str, depth: usize) -> PyResult<Value> {
    if depth == 0 {
        return Err(PyValueError::new_err(format!("{path}: expected no more than {DEEPEST} levels")));
    }
    if object.is_instance_of::<PyBool>() {
        Ok(Value::Boolean(object.extract()?))
    } else if object.is_instance_of::<PyInt>() {
        integer(object, path)
    } else if object.is_instance_of::<PyFloat>() {
        Ok(Value::Float(object.extract()?))
    } else if object.is_instance_of::<PyString>() {
        let found = object.repr()?;
        let half = |_| PyValueError::new_err(format!("{path} = {found}: expected a text in Unicode"));
        object.extract().map(Value::Text).map_err(half)
    } else if let Ok(table) = object.cast::<PyMapping>() {
        entries(table, path, depth)
    } else if object.hasattr("tolist")? {
        value(&object.call_method0("tolist")?, path, depth - 1) // an array or a number of numpy
    } else if object.hasattr("__fspath__")? {
        value(&object.call_method0("__fspath__")?, path, depth - 1)
    } else if let Some(list) = list(object) {
        list.try_iter()?
            .enumerate()
            .map(|(i, item)| value(&item?, &format!("{path}[{}]", i + 1), depth - 1))
            .collect::<PyResult<_>>()
            .map(Value::List)
    } else {
        let (found, kind) = (object.repr()?, object.get_type().name()?);
        let expected = "expected a number, a text, a path, a list, an array or a dict";
        Err(PyTypeError::new_err(format!("{path} = {found}: {expected}, not {kind}")))
    }
}

/// A list or tuple, but not bytes, which are sequences of numbers too.
fn list<'a, 'py>(object: &'a Bound<'py, PyAny>) -> Option<&'a Bound<'py, PySequence>> {
    let is_bytes = object.hasattr("decode").unwrap_or(true);
    object.cast::<PySequence>().ok().filter(|_| !is_bytes)
}

fn integer(object: &Bound<'_, PyAny>, path: &str) -> PyResult<Value> {
    let large = || PyValueError::new_err(format!("{path}: expected a whole number of at most 64 bits"));
    object.extract().map(Value::Integer).map_err(|_| large())
}

fn entries(table: &Bound<'_, PyMapping>, path: &str, depth: usize) -> PyResult<Value> {
    let mut entries = Vec::new();
    for item in table.items()?.iter() {
        let (key, item): (Bound<'_, PyAny>, Bound<'_, PyAny>) = item.extract()?;
        let Ok(key) = key.extract::<String>() else {
            let place = if path.is_empty() { "the scene" } else { path };
            return Err(PyTypeError::new_err(format!("{place}: expected keys that are texts, not {}", key.repr()?)));
        };
        let path = if path.is_empty() { key.clone() } else { format!("{path}.{key}") };
        entries.push((key, value(&item, &path, depth - 1)?));
    }
    Ok(Value::Table(entries))
}
