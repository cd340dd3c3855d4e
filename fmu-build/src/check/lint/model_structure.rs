//! Outputs and initial unknowns: in order, and made of what can be known.

use crate::description::{Causality, Description, Unknown};
use pounding::FmiVersion;

pub(super) fn findings(description: &Description) -> Vec<String> {
    let mut findings = unknowns("Outputs", &description.outputs, description);
    findings.extend(unknowns("InitialUnknowns", &description.initial_unknowns, description));
    findings
}

fn unknowns(list: &str, unknowns: &[Unknown], description: &Description) -> Vec<String> {
    let noun = match description.version {
        FmiVersion::V2 => "index",
        FmiVersion::V3 => "value reference",
    };
    let numbers: Vec<u32> = unknowns.iter().map(|unknown| unknown.number).collect();
    let mut findings = descents(list, noun, &numbers);
    for Unknown { number: index, dependencies } in unknowns {
        findings.extend(descents(&format!("{list} {index}, dependencies"), noun, dependencies));
        let variables = dependencies.iter().filter_map(|number| description.variable(*number));
        let unknown = variables.filter(|v| !matches!(v.causality, Causality::Input | Causality::Parameter));
        findings.extend(
            unknown.map(|v| format!("{list} {index}: depends on {}; expected inputs and parameters only", v.name)),
        );
    }
    findings
}

/// A finding wherever indices do not ascend.
fn descents(what: &str, noun: &str, indices: &[u32]) -> Vec<String> {
    let pairs = indices.iter().zip(indices.iter().skip(1)).filter(|(one, next)| next <= one);
    pairs.map(|(one, next)| format!("{what}: {noun} {next} after {one}; expected ascending")).collect()
}
