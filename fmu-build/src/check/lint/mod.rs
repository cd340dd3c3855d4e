//! Rules about what is written in an FMU that the importers and validators at hand do not check: those of FMI 2.0, and
//! what every FMU of ours keeps to so that importers have no trouble with it.

mod attributes;
mod document;
mod experiment;
mod files;
mod model_structure;
#[cfg(test)]
mod tests;
mod variables;

pub use document::{findings as document, model_identifier, origin};
pub use files::{file_names, files};
use fmi::model_description::fmi2::ModelDescription;
use std::collections::HashSet;

/// `modelDescription.xml` as the importer has read it; what it does not read is looked at by [`document()`].
pub fn description(description: &ModelDescription) -> Vec<String> {
    let mut findings = experiment::findings(description);
    findings.extend(identifier(description));
    findings.extend(repeated("log category", description.logCategories.iter().map(|category| category.name.as_str())));
    findings.extend(model_structure::findings(description));
    findings.extend(variables::findings(description));
    findings
}

/// The library carries the identifier in its file name and, in C, in its function names.
fn identifier(description: &ModelDescription) -> Option<String> {
    let identifier = &description.coSimulation.as_ref()?.modelIdentifier;
    let mut letters = identifier.chars();
    let starts = letters.next().is_some_and(|first| first.is_ascii_alphabetic() || first == '_');
    let goes_on = letters.all(|letter| letter.is_ascii_alphanumeric() || letter == '_');
    (!(starts && goes_on)).then(|| format!("modelIdentifier {identifier:?}: expected a C identifier"))
}

/// A finding for every name that has been there before.
fn repeated<'a>(what: &str, names: impl Iterator<Item = &'a str>) -> Vec<String> {
    let mut seen = HashSet::new();
    names.filter(|name| !seen.insert(*name)).map(|name| format!("{what} {name:?}: more than once")).collect()
}
