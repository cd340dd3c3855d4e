//! `cargo fmu check`: what is wrong with an FMU, as far as it can be seen from outside.
//!
//! The description is read and validated, and the FMU run, by an importer that is not ours. What that importer and
//! other validators do not look at is in [`lint`] (what is written in the FMU) and [`behaviour`] (what its library
//! does). All of it happens in a process of its own, for as long as it may take.

mod behaviour;
mod lint;

use crate::archive::Unpacked;
use crate::experiment;
use crate::importer::Imported;
use crate::platform;
use crate::trial::{look, need, ran};
use anyhow::{Result, bail};
use fmi::model_description::fmi2::ModelDescription;
pub use lint::{file_names, origin};
use std::path::Path;

/// Goes through the FMU as long as what has been found lets it.
pub fn inspect(fmu: &Path, directory: &Path) -> Result<()> {
    let Some(fmu) = need("archive", || Unpacked::open(fmu, directory))? else { return Ok(()) };
    let Some(text) = need("description", || fmu.description())? else { return Ok(()) };
    if need("origin", || lint::origin(&text))?.is_none() {
        return Ok(());
    }
    look("file names", || lint::file_names(&fmu.names))?;
    look("description lint", || lint::document(&text))?;

    let Some(description) = need("description", || parse(&text))? else { return Ok(()) };
    look("description", || description.validate().into_iter().map(|problem| problem.message).collect())?;
    look("description lint", || lint::description(&description))?;
    look("file names", || lint::files(&fmu.names, &description))?;

    if need("library", || library_is_there(&fmu, &description))?.is_none() {
        return Ok(());
    }
    try_library(fmu.root(), &description)
}

fn parse(text: &str) -> Result<ModelDescription> {
    Ok(ModelDescription::from_string(text)?)
}

fn library_is_there(fmu: &Unpacked, description: &ModelDescription) -> Result<()> {
    let Some(interface) = &description.coSimulation else { bail!("the FMU has no co-simulation interface") };
    let path = platform::library_path(&interface.modelIdentifier);
    if !fmu.path(&path).is_file() {
        let there = fmu.names.iter().filter(|name| name.starts_with("binaries/")).cloned().collect::<Vec<_>>();
        bail!("the FMU has no {path}, the library for this machine; it has: {}", there.join(", "));
    }
    Ok(())
}

/// Goes through what the library does as long as what has been found lets it.
fn try_library(root: &Path, description: &ModelDescription) -> Result<()> {
    let Some(binary) = need("library", || behaviour::library(root, description))? else { return Ok(()) };
    if !look("exported functions", || behaviour::missing_functions(&binary))? {
        return Ok(());
    }
    look("guid", || behaviour::wrong_guid_accepted(root, description, &binary))?;
    let start_values = || {
        let instance = Imported::new(root, description)?;
        behaviour::start_values(description, &instance)
    };
    let Some(differences) = need("start values", start_values)? else { return Ok(()) };
    look("start values", || differences)?;
    let run = || experiment::run(description, &Imported::new(root, description)?);
    let Some(outcome) = need("run", run)? else { return Ok(()) };
    ran(outcome)
}
