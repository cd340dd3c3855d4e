//! Rules about what is written in an FMU that the importers and validators at hand do not check: those of FMI, and
//! what every FMU of ours keeps to so that importers have no trouble with it.

mod document;
mod experiment;
mod files;
mod model_structure;
#[cfg(test)]
mod tests;
mod units;
mod variables;

use crate::description::Description;
pub use document::findings as document;
pub use files::files;

/// `modelDescription.xml` as the importer has read it; what it does not read is looked at by [`document()`].
pub fn description(description: &Description) -> Vec<String> {
    let mut findings = experiment::findings(description);
    findings.extend(model_structure::findings(description));
    findings.extend(variables::findings(description));
    findings
}
