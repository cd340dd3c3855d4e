//! Outputs and initial unknowns: in order, and made of what can be known.

use fmi::model_description::fmi2::{Causality, ModelDescription, Unknown};

pub(super) fn findings(description: &ModelDescription) -> Vec<String> {
    let mut findings = unknowns("Outputs", &description.outputs, description);
    findings.extend(unknowns("InitialUnknowns", &description.initialUnknowns, description));
    findings
}

fn unknowns(list: &str, unknowns: &[Unknown], description: &ModelDescription) -> Vec<String> {
    let indices: Vec<u32> = unknowns.iter().map(|unknown| unknown.index).collect();
    let mut findings = descents(list, &indices);
    for Unknown { index, dependencies, .. } in unknowns {
        let dependencies = dependencies.as_deref().unwrap_or_default();
        findings.extend(descents(&format!("{list} {index}, dependencies"), dependencies));
        let variables = dependencies.iter().filter_map(|index| description.variable_by_index(*index).ok());
        let unknown = variables.filter(|v| !matches!(v.causality, Causality::Input | Causality::Parameter));
        findings.extend(
            unknown.map(|v| format!("{list} {index}: depends on {}; expected inputs and parameters only", v.name)),
        );
    }
    findings
}

/// A finding wherever indices do not ascend.
fn descents(what: &str, indices: &[u32]) -> Vec<String> {
    let pairs = indices.iter().zip(indices.iter().skip(1)).filter(|(one, next)| next <= one);
    pairs.map(|(one, next)| format!("{what}: index {next} after {one}; expected ascending")).collect()
}
