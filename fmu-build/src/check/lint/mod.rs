//! Rules about what is written in an FMU that the importers and validators at hand do not check: those of FMI 2.0, and
//! what every FMU of ours keeps to so that importers have no trouble with it.

mod document;
mod experiment;
mod model_structure;
#[cfg(test)]
mod tests;
mod variables;

use fmi::model_description::fmi2::ModelDescription;
use std::collections::HashSet;

/// Names in the archive: relative to its root, with forward slashes, inside it.
pub fn file_names(names: &[String]) -> Vec<String> {
    let mut findings = Vec::new();
    for name in names {
        let parts: Vec<&str> = name.trim_end_matches('/').split('/').collect();
        if name.contains('\\') {
            findings.push(format!("{name:?}: a backslash; expected forward slashes"));
        }
        if name.starts_with('/') || name.as_bytes().get(1) == Some(&b':') {
            findings.push(format!("{name:?}: an absolute path; expected one relative to the archive's root"));
        }
        if parts.iter().any(|part| matches!(*part, ".." | ".")) || parts.iter().skip(1).any(|part| part.is_empty()) {
            findings.push(format!("{name:?}: expected a plain path without empty, `.` or `..` parts"));
        }
    }
    findings
}

/// `modelDescription.xml`: `text` as it stands, `description` as the importer has read it.
pub fn description(text: &str, description: &ModelDescription) -> Vec<String> {
    let mut findings = document::findings(text);
    findings.extend(identifier(description));
    findings.extend(experiment::findings(description));
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
