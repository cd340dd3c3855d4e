//! The attributes of each variable.

use fmi::model_description::fmi2::{Causality, Initial, ModelDescription, ScalarVariable, VariableType};
use std::collections::HashMap;

pub(super) fn findings(description: &ModelDescription) -> Vec<String> {
    let variables = &description.modelVariables;
    let mut findings = aliases(variables);
    for variable in variables {
        findings.extend(attributes(variable));
        findings.extend(limits(variable));
    }
    findings
}

/// What a variable has to have by its causality. Some importers report an independent variable as an error.
fn attributes(variable: &ScalarVariable) -> Vec<String> {
    let name = &variable.name;
    let mut findings = Vec::new();
    if variable.description.as_ref().is_none_or(String::is_empty) {
        findings.push(format!("{name}: no description"));
    }
    let (has_start, causality) = (variable.variableType.has_start(), &variable.causality);
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
    if matches!(causality, Causality::Independent) {
        findings.push(format!("{name}: an independent variable; expected none"));
    }
    findings
}

/// min <= start <= max, and a nominal value that can be divided by.
fn limits(variable: &ScalarVariable) -> Vec<String> {
    let (min, max, nominal) = match &variable.variableType {
        VariableType::Real { min, max, nominal, .. } => (min, max, nominal),
        VariableType::Integer { min, max, .. } | VariableType::Enumeration { min, max, .. } => (min, max, &None),
        VariableType::Boolean { .. } | VariableType::String { .. } => return Vec::new(),
    };
    let name = &variable.name;
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
    let (start, nominal) = (number("start", variable.variableType.start()), number("nominal", nominal));
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
fn aliases(variables: &[ScalarVariable]) -> Vec<String> {
    let mut names: HashMap<u32, &str> = HashMap::new();
    let mut findings = Vec::new();
    for ScalarVariable { name, valueReference: reference, .. } in variables {
        if let Some(other) = names.insert(*reference, name) {
            findings.push(format!("{name} and {other}: both have the value reference {reference}"));
        }
    }
    findings
}
