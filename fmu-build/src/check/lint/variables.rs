//! The attributes of each variable.

use crate::description::{Causality, Description, Initial, Kind, Variable};
use pounding::FmiVersion;
use std::collections::HashMap;

pub(super) fn findings(description: &Description) -> Vec<String> {
    let variables = &description.variables;
    let mut findings = aliases(variables);
    findings.extend(times(description));
    for variable in variables {
        findings.extend(attributes(variable));
        findings.extend(limits(variable));
        if description.version == FmiVersion::V3 {
            findings.extend(updates(variable));
        }
    }
    findings
}

/// Continuous inputs and outputs are exchanged within steps, and nothing else is.
fn updates(variable: &Variable) -> Option<String> {
    let is_exchanged = matches!(variable.causality, Causality::Input | Causality::Output);
    let expected = is_exchanged && variable.kind == Kind::Real && variable.is_continuous;
    let found = variable.has_updates;
    (found != expected).then(|| format!("{}: intermediateUpdate {found}; expected {expected}", variable.name))
}

/// What a variable has to have by its causality.
fn attributes(variable: &Variable) -> Vec<String> {
    let name = &variable.name;
    let mut findings = Vec::new();
    if variable.description.as_ref().is_none_or(String::is_empty) {
        findings.push(format!("{name}: no description"));
    }
    if let Kind::Other(kind) = variable.kind {
        findings.push(format!("{name}: of type {kind}; expected a type that FMUs of ours have"));
    }
    let (has_start, causality) = (variable.start.is_some(), &variable.causality);
    match causality {
        Causality::Input | Causality::Parameter if !has_start => findings.push(format!("{name}: no start value")),
        Causality::Input | Causality::Parameter => {}
        _ if has_start => findings.push(format!("{name}: a start value; expected those of what can be set only")),
        _ => {}
    }
    let is_calculated = matches!(variable.initial, Some(Initial::Calculated));
    if matches!(causality, Causality::Output | Causality::CalculatedParameter) && !is_calculated {
        findings.push(format!("{name}: initial {:?}; expected calculated", variable.initial));
    }
    findings
}

/// In FMI 3.0 there is one independent variable, the time; in FMI 2.0 some importers report one as an error.
fn times(description: &Description) -> Vec<String> {
    let times = description.variables.iter().filter(|variable| variable.causality == Causality::Independent);
    let names: Vec<&str> = times.map(|variable| variable.name.as_str()).collect();
    match description.version {
        FmiVersion::V2 => {
            names.into_iter().map(|name| format!("{name}: an independent variable; expected none")).collect()
        }
        FmiVersion::V3 if names == ["time"] => Vec::new(),
        FmiVersion::V3 => vec![format!("independent variables: {names:?}; expected \"time\" alone")],
    }
}

/// min <= start <= max, and a nominal value that can be divided by.
fn limits(variable: &Variable) -> Vec<String> {
    if matches!(variable.kind, Kind::Boolean | Kind::String) {
        return Vec::new();
    }
    let Variable { name, min, max, nominal, start, .. } = variable;
    let mut findings = Vec::new();
    let mut number = |attribute: &str, text: &Option<String>| {
        let text = text.as_ref()?;
        let number = text.parse::<f64>().ok();
        if number.is_none() {
            findings.push(format!("{name}: {attribute} {text:?}; expected a number"));
        }
        number
    };
    let (low, high) = (number("min", min), number("max", max));
    let (start, nominal) = (number("start", start), number("nominal", nominal));
    let (low, high) = (low.unwrap_or(f64::NEG_INFINITY), high.unwrap_or(f64::INFINITY));
    if low > high {
        findings.push(format!("{name}: min {low} is greater than max {high}"));
    }
    if let Some(start) = start.filter(|start| !(low..=high).contains(start)) {
        findings.push(format!("{name}: start {start}; expected {low} to {high}"));
    }
    if let Some(nominal) = nominal.filter(|nominal| !(*nominal > 0.0 && nominal.is_finite())) {
        findings.push(format!("{name}: nominal {nominal}; expected > 0"));
    }
    findings
}

/// Each variable has a value reference of its own, whatever its type.
fn aliases(variables: &[Variable]) -> Vec<String> {
    let mut names: HashMap<u32, &str> = HashMap::new();
    let mut findings = Vec::new();
    for Variable { name, reference, .. } in variables {
        if let Some(other) = names.insert(*reference, name) {
            findings.push(format!("{name} and {other}: both have the value reference {reference}"));
        }
    }
    findings
}
