//! Rules of FMI 2.0 about what is written in an FMU that the importers and validators at hand do not check.

use fmi::model_description::fmi2::{Causality, ModelDescription, ScalarVariable, VariableType};
use std::collections::{HashMap, HashSet};

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
    let mut findings = structure(text, description);
    findings.extend(identifier(description));
    findings.extend(experiment(description));
    findings.extend(log_categories(description));
    findings.extend(initial_unknowns(description));
    findings.extend(description.modelVariables.iter().flat_map(limits));
    findings.extend(aliases(description));
    findings
}

/// Order of the elements, and units, which the importer does not read.
fn structure(text: &str, description: &ModelDescription) -> Vec<String> {
    let Ok(document) = roxmltree::Document::parse(text) else { return Vec::new() };
    let root = document.root_element();
    let mut findings = Vec::new();

    let order = [
        "ModelExchange",
        "CoSimulation",
        "UnitDefinitions",
        "TypeDefinitions",
        "LogCategories",
        "DefaultExperiment",
        "VendorAnnotations",
        "ModelVariables",
        "ModelStructure",
    ];
    let place = |name: &str| order.iter().position(|known| *known == name);
    let mut last = 0;
    for child in root.children().filter(roxmltree::Node::is_element) {
        let name = child.tag_name().name();
        match place(name) {
            None => findings.push(format!("<{name}>: not an element of FMI 2.0")),
            Some(at) if at < last => findings.push(format!("<{name}>: out of order; expected {}", order.join(", "))),
            Some(at) => last = at,
        }
    }

    let units: HashSet<&str> =
        root.descendants().filter(|node| node.has_tag_name("Unit")).filter_map(|node| node.attribute("name")).collect();
    for variable in &description.modelVariables {
        if let VariableType::Real { unit: Some(unit), .. } = &variable.variableType
            && !units.contains(unit.as_str())
        {
            findings.push(format!("{}: unit {unit:?} is not in <UnitDefinitions>", variable.name));
        }
    }
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

fn experiment(description: &ModelDescription) -> Vec<String> {
    let Some(experiment) = &description.defaultExperiment else { return Vec::new() };
    let mut findings = Vec::new();
    let mut number = |name: &str, text: &Option<String>, default: Option<f64>| {
        let Some(text) = text else { return default };
        match text.parse::<f64>() {
            Ok(number) if number.is_finite() => Some(number),
            _ => {
                findings.push(format!("DefaultExperiment {name} {text:?}: expected a finite number"));
                None
            }
        }
    };
    let start = number("startTime", &experiment.startTime, Some(0.0));
    let stop = number("stopTime", &experiment.stopTime, None);
    let step = number("stepSize", &experiment.stepSize, None);
    let tolerance = number("tolerance", &experiment.tolerance, None);
    if let (Some(start), Some(stop)) = (start, stop) {
        if start >= stop {
            findings.push(format!("DefaultExperiment stopTime {stop}: expected more than startTime {start}"));
        } else if let Some(step) = step.filter(|step| *step > stop - start) {
            findings.push(format!("DefaultExperiment stepSize {step}: expected at most the duration {}", stop - start));
        }
    }
    for (name, value) in [("stepSize", step), ("tolerance", tolerance)] {
        if let Some(value) = value.filter(|value| *value <= 0.0) {
            findings.push(format!("DefaultExperiment {name} {value}: expected > 0"));
        }
    }
    findings
}

fn log_categories(description: &ModelDescription) -> Vec<String> {
    let mut seen = HashSet::new();
    let again = description.logCategories.iter().filter(|category| !seen.insert(&category.name));
    again.map(|category| format!("log category {:?}: more than once", category.name)).collect()
}

fn initial_unknowns(description: &ModelDescription) -> Vec<String> {
    let pairs = description.initialUnknowns.iter().zip(description.initialUnknowns.iter().skip(1));
    pairs
        .filter(|(one, next)| next.index <= one.index)
        .map(|(one, next)| format!("InitialUnknowns: index {} after {}; expected ascending", next.index, one.index))
        .collect()
}

/// min <= start <= max, and a nominal value that can be divided by.
fn limits(variable: &ScalarVariable) -> Vec<String> {
    let (min, max, nominal) = match &variable.variableType {
        VariableType::Real { min, max, nominal, .. } => (min, max, nominal),
        VariableType::Integer { min, max, .. } | VariableType::Enumeration { min, max, .. } => (min, max, &None),
        VariableType::Boolean { .. } | VariableType::String { .. } => return Vec::new(),
    };
    let number = |text: &Option<String>| text.as_ref().and_then(|text| text.parse::<f64>().ok());
    let name = &variable.name;
    let (low, high) = (number(min).unwrap_or(f64::NEG_INFINITY), number(max).unwrap_or(f64::INFINITY));
    let mut findings = Vec::new();
    if low > high {
        findings.push(format!("{name}: min {low} is greater than max {high}"));
    }
    if let Some(start) = number(variable.variableType.start()).filter(|start| !(low..=high).contains(start)) {
        findings.push(format!("{name}: start {start}; expected {low} to {high}"));
    }
    if let Some(nominal) = number(nominal).filter(|nominal| *nominal <= 0.0) {
        findings.push(format!("{name}: nominal {nominal}; expected > 0"));
    }
    findings
}

/// Variables of one type and value reference are one variable: at most one of them may be set.
fn aliases(description: &ModelDescription) -> Vec<String> {
    let mut settable: HashMap<(&str, u32), &str> = HashMap::new();
    let mut findings = Vec::new();
    for variable in &description.modelVariables {
        if matches!(variable.causality, Causality::Parameter | Causality::Input) {
            let key = (variable.variableType.name(), variable.valueReference);
            if let Some(other) = settable.insert(key, &variable.name) {
                findings.push(format!("{} and {other}: both can be set and are one value reference", variable.name));
            }
        }
    }
    findings
}
