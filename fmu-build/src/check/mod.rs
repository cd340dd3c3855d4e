//! `cargo fmu check`: what is wrong with an FMU, as far as it can be seen from outside.
//!
//! The description is read and validated, and the FMU run, by an importer that is not ours. What that importer and
//! other validators do not look at is in [`lint`] (what is written in the FMU) and [`behaviour`] (what its library does);
//! [`trial`] keeps the library in a process of its own, for as long as it may take.

mod behaviour;
mod lint;
mod report;
mod trial;

use crate::archive::Unpacked;
use crate::platform;
use anyhow::{Result, bail};
use fmi::model_description::fmi2::ModelDescription;
pub use report::Report;
use std::path::Path;
use std::time::Duration;
pub use trial::try_library;

/// Goes through the FMU as long as what has been found lets it; its library may take that long.
pub fn check(fmu: &Path, limit: Duration) -> Report {
    let mut report = Report::new(fmu);
    // An error ends the inspection and is in the report.
    let _ = inspect(fmu, limit, &mut report);
    report
}

/// `None` where a check has failed that the next ones stand on.
fn inspect(fmu: &Path, limit: Duration, report: &mut Report) -> Option<()> {
    let fmu = report.need("archive", Unpacked::open(fmu))?;
    let text = report.need("description", fmu.description())?;
    report.need("origin", lint::origin(&text))?;
    report.add("file names", lint::file_names(&fmu.names));
    report.add("description lint", lint::document(&text));

    let description = report.need("description", parse(&text))?;
    report.add("description", description.validate().into_iter().map(|problem| problem.message).collect());
    report.add("description lint", lint::description(&description));
    report.add("file names", lint::files(&fmu.names, &description));

    report.need("library", library_is_there(&fmu, &description))?;
    trial::run(fmu.root(), limit, report);
    Some(())
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
