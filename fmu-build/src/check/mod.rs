//! `cargo fmu check`: what is wrong with an FMU, as far as it can be seen from outside.
//!
//! The description is read and validated, and the FMU run, by an importer that is not ours. What that importer and
//! other validators do not look at is in [`lint`] (what is written in the FMU) and [`behaviour`] (what its library does).

mod behaviour;
mod lint;
mod report;

use crate::archive::Unpacked;
use crate::experiment::{self, Outcome};
use crate::importer::Imported;
use anyhow::Result;
use fmi::model_description::fmi2::ModelDescription;
pub use report::Report;
use std::path::Path;

/// Goes through the FMU as long as what has been found lets it.
pub fn check(fmu: &Path) -> Report {
    let mut report = Report::new(fmu);
    // An error ends the inspection and is in the report.
    let _ = inspect(fmu, &mut report);
    report
}

/// `None` where a check has failed that the next ones stand on.
fn inspect(fmu: &Path, report: &mut Report) -> Option<()> {
    let fmu = report.need("archive", Unpacked::open(fmu))?;
    report.add("file names", lint::file_names(&fmu.names));

    let text = report.need("description", fmu.description())?;
    let description = report.need("description", parse(&text))?;
    report.add("description", description.validate().into_iter().map(|problem| problem.message).collect());
    report.add("description lint", lint::description(&text, &description));

    let binary = report.need("library", behaviour::library(&fmu, &description))?;
    report.add("exported functions", behaviour::missing_functions(&binary));
    if !report.is_valid() {
        return None;
    }
    report.add("guid", behaviour::wrong_guid_accepted(&fmu, &description, &binary));
    let start_values =
        Imported::new(fmu.root(), &description).and_then(|instance| behaviour::start_values(&description, &instance));
    let differences = report.need("start values", start_values)?;
    report.add("start values", differences);

    let outcome = report.need("run", run(&fmu, &description))?;
    report.ran(&description, outcome);
    Some(())
}

fn parse(text: &str) -> Result<ModelDescription> {
    Ok(ModelDescription::from_string(text)?)
}

fn run(fmu: &Unpacked, description: &ModelDescription) -> Result<Outcome> {
    experiment::run(description, &Imported::new(fmu.root(), description)?)
}
