//! Units: every number has one that is defined, and every one is that of a number.

use pounding::FmiVersion;
use roxmltree::{Document, Node};
use std::collections::HashSet;

/// A variable with the element that says its unit.
struct Number<'a, 'd> {
    variable: &'a str,
    says: Node<'a, 'd>,
}

pub(super) fn findings(document: &Document, version: FmiVersion) -> Vec<String> {
    let with_name = |wanted| document.descendants().filter(move |node| node.has_tag_name(wanted));
    let units: Vec<Node> = with_name("Unit").collect();
    let mut findings = repeated("unit", units.iter().map(name));
    let numbers = match version {
        FmiVersion::V2 => numbers_of_fmi2(document),
        FmiVersion::V3 => {
            let (numbers, problems) = numbers_of_fmi3(document);
            findings.extend(problems);
            numbers
        }
    };
    let mut used = HashSet::new();
    for Number { variable, says } in numbers {
        let Some(unit) = says.attribute("unit") else {
            let shown =
                says.attribute("displayUnit").map_or(String::new(), |unit| format!(", but display unit {unit:?}"));
            findings.push(format!("{variable}: no unit{shown}"));
            continue;
        };
        used.insert(unit);
        let Some(definition) = units.iter().find(|definition| name(definition) == unit) else {
            findings.push(format!("{variable}: unit {unit:?} is not in <UnitDefinitions>"));
            continue;
        };
        let is_shown = |shown| definition.children().any(|d| d.has_tag_name("DisplayUnit") && name(&d) == shown);
        if let Some(shown) = says.attribute("displayUnit").filter(|shown| !is_shown(*shown)) {
            findings.push(format!("{variable}: display unit {shown:?} is not defined for unit {unit:?}"));
        }
    }
    let unused = units.iter().map(name).filter(|unit| !used.contains(unit));
    findings.extend(unused.map(|unit| format!("unit {unit:?} is not used")));
    findings
}

fn numbers_of_fmi2<'a, 'd>(document: &'a Document<'d>) -> Vec<Number<'a, 'd>> {
    let reals = document.descendants().filter(|node| node.has_tag_name("Real"));
    let numbers = reals.filter_map(|says| {
        let parent = says.parent().filter(|parent| parent.has_tag_name("ScalarVariable"))?;
        Some(Number { variable: name(&parent), says })
    });
    numbers.collect()
}

/// Those whose type is declared, and what is wrong with types. Not every importer knows a unit on a variable.
fn numbers_of_fmi3<'a, 'd>(document: &'a Document<'d>) -> (Vec<Number<'a, 'd>>, Vec<String>) {
    let types: Vec<Node> = document.descendants().filter(|node| node.has_tag_name("Float64Type")).collect();
    let mut findings = repeated("type", types.iter().map(name));
    let (mut numbers, mut used) = (Vec::new(), HashSet::new());
    for number in document.descendants().filter(|node| node.has_tag_name("Float64")) {
        let variable = name(&number);
        let Some(declared) = number.attribute("declaredType") else {
            findings.push(format!("{variable}: no declaredType, and so no unit"));
            continue;
        };
        used.insert(declared);
        match types.iter().find(|definition| name(definition) == declared) {
            Some(says) => numbers.push(Number { variable, says: *says }),
            None => findings.push(format!("{variable}: declaredType {declared:?} is not in <TypeDefinitions>")),
        }
    }
    let unused = types.iter().map(name).filter(|declared| !used.contains(declared));
    findings.extend(unused.map(|declared| format!("type {declared:?} is not used")));
    (numbers, findings)
}

fn name<'a>(node: &Node<'a, '_>) -> &'a str {
    node.attribute("name").unwrap_or_default()
}

/// A finding for every name that has been there before.
fn repeated<'a>(what: &str, names: impl Iterator<Item = &'a str>) -> Vec<String> {
    let mut seen = HashSet::new();
    names.filter(|name| !seen.insert(*name)).map(|name| format!("{what} {name:?}: more than once")).collect()
}
