//! What the library of an FMU does, compared with what its description says.

use crate::archive::Unpacked;
use crate::c_interface::{self, Binary};
use crate::description::{Description, Kind, Variable};
use crate::experiment::{CoSimulation, experiment};
use anyhow::{Context, Result, bail};
use pounding::FmiVersion;
use pounding_pack::platform;
use std::path::Path;

/// The library for this machine.
pub fn library(fmu: &Unpacked, description: &Description) -> Result<Binary> {
    let path = platform::host_library(&fmu.names, &description.identifier, description.version);
    Binary::load(&fmu.path(path.context("the FMU has no library for this machine")?))
}

/// A finding for each function that the library does not export.
pub fn missing_functions(description: &Description, binary: &Binary) -> Vec<String> {
    binary.missing_functions(description.version).into_iter().map(|name| format!("{name} is not exported")).collect()
}

/// The library must refuse a GUID that is not its own, else it cannot notice a description that is not its own.
pub fn wrong_guid_accepted(root: &Path, description: &Description, binary: &Binary) -> Vec<String> {
    let other = "{00000000-0000-0000-0000-000000000000}";
    let what = match description.version {
        FmiVersion::V2 => "fmi2Instantiate accepts the GUID",
        FmiVersion::V3 => "fmi3InstantiateCoSimulation accepts the token",
    };
    match c_interface::instantiate(binary, description, other, root) {
        Ok(_) => vec![format!("{what} {other} beside {}", description.token)],
        Err(_) => Vec::new(),
    }
}

/// No importer writes the start values of the description into the FMU: the library must have the same ones.
pub fn start_values(description: &Description, fmu: &dyn CoSimulation) -> Result<Vec<String>> {
    let experiment = experiment(description)?;
    fmu.set_up(experiment.start, experiment.stop)?;
    let mut findings = Vec::new();
    for variable in &description.variables {
        let Some(start) = &variable.start else { continue };
        let actual = value(variable, fmu).with_context(|| format!("{} cannot be read", variable.name))?;
        if !actual.is(start) {
            findings.push(format!("{}: start is {start:?}, the library has {actual:?}", variable.name));
        }
    }
    Ok(findings)
}

#[derive(Debug)]
enum Value {
    Real(f64),
    Integer(i32),
    Boolean(bool),
    String(String),
}

impl Value {
    /// Whether the text of an XML attribute says the same.
    fn is(&self, text: &str) -> bool {
        match self {
            Value::Real(value) => text.parse() == Ok(*value),
            Value::Integer(value) => text.parse() == Ok(*value),
            Value::Boolean(value) => matches!((value, text), (true, "true" | "1") | (false, "false" | "0")),
            Value::String(value) => text == value,
        }
    }
}

fn value(variable: &Variable, fmu: &dyn CoSimulation) -> Result<Value> {
    let reference = [variable.reference];
    let value = match variable.kind {
        Kind::Real => fmu.reals(&reference)?.pop().map(Value::Real),
        Kind::Integer => fmu.integers(&reference)?.pop().map(Value::Integer),
        Kind::Boolean => fmu.booleans(&reference)?.pop().map(Value::Boolean),
        Kind::Other(name) => bail!("a variable of type {name}"),
        Kind::String => fmu.strings(&reference)?.pop().map(Value::String),
    };
    value.context("the library returns no value")
}
