//! What validators do not look at (and a few things that most do).

use fmi::model_description::fmi2::{Causality, Initial, ModelDescription, VariableType};
use roxmltree::{Document, Node};
use std::collections::HashSet;
use std::hash::Hash;

/// Everything that is wrong with a description.
pub fn findings(text: &str) -> Vec<String> {
    let description = match ModelDescription::from_string(text) {
        Ok(description) => description,
        Err(error) => return vec![format!("cannot be read: {error}")],
    };
    let document = Document::parse(text).unwrap();
    let mut findings = Vec::new();
    elements_in_order(&document, &mut findings);
    units(&document, &mut findings);
    variables(&description, &mut findings);
    structure(&description, &mut findings);
    experiment(&description, &mut findings);
    repeated(description.logCategories.iter().map(|c| &c.name), "log category", &mut findings);
    if text.contains("generationDateAndTime") {
        findings.push("a clock".into());
    }
    findings
}

/// The order that the schema demands of the children of the root, none of them twice or empty.
fn elements_in_order(document: &Document<'_>, findings: &mut Vec<String>) {
    const ORDER: [&str; 6] =
        ["CoSimulation", "UnitDefinitions", "LogCategories", "DefaultExperiment", "ModelVariables", "ModelStructure"];
    let children = document.root_element().children().filter(Node::is_element);
    let found = children.map(|child| child.tag_name().name()).collect::<Vec<_>>();
    if found != ORDER {
        findings.push(format!("elements {found:?}"));
    }
    for list in ["Outputs", "InitialUnknowns", "Derivatives"] {
        if document.descendants().any(|node| node.has_tag_name(list) && !node.has_children()) {
            findings.push(format!("empty {list}"));
        }
    }
}

fn variables(description: &ModelDescription, findings: &mut Vec<String>) {
    let variables = &description.modelVariables;
    repeated(variables.iter().map(|v| &v.name), "name", findings);
    repeated(variables.iter().map(|v| v.valueReference), "value reference", findings);
    for variable in variables {
        let name = &variable.name;
        if variable.description.as_ref().is_none_or(String::is_empty) {
            findings.push(format!("{name}: no description"));
        }
        let has_start = variable.variableType.has_start();
        let needs_start = matches!(variable.causality, Causality::Input | Causality::Parameter);
        if has_start != needs_start {
            findings.push(format!("{name}: start value {has_start}"));
        }
        let calculated = matches!(variable.initial, Some(Initial::Calculated));
        if matches!(variable.causality, Causality::Output | Causality::CalculatedParameter) && !calculated {
            findings.push(format!("{name}: initial"));
        }
        if matches!(variable.causality, Causality::Independent) {
            findings.push(format!("{name}: some importers report an independent variable as an error"));
        }
        range(name, &variable.variableType, findings);
    }
}

fn range(name: &str, ty: &VariableType, findings: &mut Vec<String>) {
    let (min, max, nominal, start) = match ty {
        VariableType::Real { min, max, nominal, start, .. } => (min, max, nominal, start),
        VariableType::Integer { min, max, start, .. } => (min, max, &None, start),
        _ => return,
    };
    let number = |text: &Option<String>| text.as_ref().map(|text| text.parse::<f64>().unwrap());
    let (min, max) = (number(min).unwrap_or(f64::MIN), number(max).unwrap_or(f64::MAX));
    if min > max {
        findings.push(format!("{name}: min > max"));
    }
    if number(start).is_some_and(|start| !(min..=max).contains(&start)) {
        findings.push(format!("{name}: start outside min and max"));
    }
    if number(nominal).is_some_and(|nominal| nominal <= 0.0) {
        findings.push(format!("{name}: nominal <= 0"));
    }
}

/// The importer does not read the definitions.
fn units(document: &Document<'_>, findings: &mut Vec<String>) {
    let units = document.descendants().filter(|node| node.has_tag_name("Unit")).collect::<Vec<_>>();
    let name = |node: &Node<'_, '_>| node.attribute("name").unwrap_or_default().to_owned();
    repeated(units.iter().map(name), "unit", findings);
    let mut used = HashSet::new();
    for real in document.descendants().filter(|node| node.has_tag_name("Real")) {
        let variable = real.parent().as_ref().map(name).unwrap_or_default();
        let Some(unit) = units.iter().find(|unit| unit.attribute("name") == real.attribute("unit")) else {
            findings.push(format!("{variable}: unit {:?} is not defined", real.attribute("unit")));
            continue;
        };
        used.insert(name(unit));
        let shown = real.attribute("displayUnit");
        if shown.is_some() && !unit.children().any(|d| d.has_tag_name("DisplayUnit") && d.attribute("name") == shown) {
            findings.push(format!("{variable}: display unit {shown:?} is not defined"));
        }
    }
    let unused = units.iter().map(name).filter(|unit| !used.contains(unit));
    findings.extend(unused.map(|unit| format!("unit {unit} is not used")));
}

fn structure(description: &ModelDescription, findings: &mut Vec<String>) {
    for (list, unknowns) in [("Outputs", &description.outputs), ("InitialUnknowns", &description.initialUnknowns)] {
        if !unknowns.is_sorted_by(|a, b| a.index < b.index) {
            findings.push(format!("{list}: not in ascending order"));
        }
        for unknown in unknowns {
            let dependencies = unknown.dependencies.iter().flatten();
            if !dependencies.clone().is_sorted_by(|a, b| a < b) {
                findings.push(format!("{list} {}: dependencies not in ascending order", unknown.index));
            }
            let known = dependencies.filter_map(|index| description.variable_by_index(*index).ok());
            let not_known = known.filter(|v| !matches!(v.causality, Causality::Input | Causality::Parameter));
            findings.extend(not_known.map(|v| format!("{list} {}: depends on {}", unknown.index, v.name)));
        }
    }
}

fn experiment(description: &ModelDescription, findings: &mut Vec<String>) {
    let Some(experiment) = &description.defaultExperiment else { return findings.push("no experiment".into()) };
    let number = |text: &Option<String>| text.as_ref().map(|text| text.parse::<f64>().unwrap());
    let (start, stop) = (number(&experiment.startTime).unwrap_or(0.0), number(&experiment.stopTime));
    if stop.is_some_and(|stop| stop <= start) {
        findings.push("stopTime <= startTime".into());
    }
    let length = stop.map_or(f64::INFINITY, |stop| stop - start);
    if number(&experiment.stepSize).is_some_and(|step| !(step > 0.0 && step < length)) {
        findings.push("stepSize".into());
    }
}

fn repeated<T: Hash + Eq + std::fmt::Debug>(items: impl Iterator<Item = T>, what: &str, findings: &mut Vec<String>) {
    let mut seen = HashSet::new();
    for item in items {
        let shown = format!("{what} {item:?} twice");
        if !seen.insert(item) {
            findings.push(shown);
        }
    }
}

/// A lint that finds nothing anywhere finds nothing in our descriptions either.
#[test]
fn every_kind_of_damage_is_found() {
    let text = crate::package(crate::support::SCENE).model_description();
    assert_eq!(findings(&text), [""; 0]);
    for (from, to, finding) in [
        ("start=\"0.65\"", "start=\"1.65\"", "contact[1].restitution: start outside"),
        ("min=\"1\" max=\"3\"", "min=\"3\" max=\"1\"", "contact[2].exponent: min > max"),
        ("nominal=\"0.01\"", "nominal=\"0\"", "left.displacement[1]: nominal"),
        ("name=\"logStatusError\"", "name=\"logEvents\"", "log category \"logEvents\" twice"),
        ("stopTime=\"4\"", "stopTime=\"0\"", "stopTime"),
        ("stepSize=\"0.01\"", "stepSize=\"4\"", "stepSize"),
        ("valueReference=\"3\"", "valueReference=\"4\"", "value reference 4 twice"),
        ("name=\"left.mass[1]\"", "name=\"left.mass[2]\"", "name \"left.mass[2]\" twice"),
        ("<Unit name=\"Hz\">", "<Unit name=\"kHz\">", "left.frequency[1]: unit"),
        ("<Unit name=\"Hz\">", "<Unit name=\"kHz\">", "unit kHz is not used"),
        ("<DisplayUnit name=\"kN\"", "<DisplayUnit name=\"MN\"", "left.force[1]: display unit Some(\"kN\")"),
        ("index=\"5\" dependencies=\"2\"", "index=\"5\" dependencies=\"3\"", "depends on left.displacement[1]"),
        ("index=\"5\" dependencies=\"2\"", "index=\"5\" dependencies=\"2 1\"", "dependencies not in"),
        ("<Unknown index=\"3\"", "<Unknown index=\"5\"", "Outputs: not in ascending order"),
        ("description=\"mass of floor 1\" ", "", "left.mass[1]: no description"),
        ("start=\"3.65\"", "", "left.mass[1]: start value false"),
        ("initial=\"calculated\"", "initial=\"exact\"", "left.displacement[1]: initial"),
        ("</ModelStructure>", "<Derivatives/></ModelStructure>", "empty Derivatives"),
        ("<LogCategories>", "<TypeDefinitions/><LogCategories>", "elements"),
        ("modelName=", "generationDateAndTime=\"2020-01-01T00:00:00Z\" modelName=", "a clock"),
    ] {
        assert!(text.contains(from), "{from}");
        let found = findings(&text.replacen(from, to, 1));
        assert!(found.iter().any(|f| f.contains(finding)), "{from} -> {to}: {found:?}");
    }
}
