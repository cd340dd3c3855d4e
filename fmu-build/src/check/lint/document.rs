//! What the importer does not read: the order of the elements, units, the date.

use super::attributes;
use super::names::repeated;
use anyhow::{Result, bail};
use roxmltree::{Document, Node};
use std::collections::HashSet;

/// Children of the root in the order that the schema demands, and whether every FMU of ours has them.
const ELEMENTS: [(&str, bool); 9] = [
    ("ModelExchange", false),
    ("CoSimulation", true),
    ("UnitDefinitions", true),
    ("TypeDefinitions", false),
    ("LogCategories", true),
    ("DefaultExperiment", true),
    ("VendorAnnotations", false),
    ("ModelVariables", true),
    ("ModelStructure", true),
];

/// Elements that the schema does not allow to be empty.
const LISTS: [&str; 9] = [
    "UnitDefinitions",
    "TypeDefinitions",
    "LogCategories",
    "VendorAnnotations",
    "ModelVariables",
    "Outputs",
    "Derivatives",
    "DiscreteStates",
    "InitialUnknowns",
];

/// The tool that makes our FMUs, before its version.
const TOOL: &str = "pounding-fmu ";

/// Whether it is one of our FMUs: others are not looked at any further, and not run. What is no XML is for the
/// importer to say.
pub fn origin(text: &str) -> Result<()> {
    let Ok(document) = Document::parse(text) else { return Ok(()) };
    let root = document.root_element();
    match root.attribute("generationTool") {
        Some(tool) if tool.starts_with(TOOL) => Ok(()),
        Some(tool) => bail!("made by {tool:?}, not by {TOOL}: only FMUs of ours are checked here, others are not run"),
        None => bail!("does not say which tool made it: only FMUs of {TOOL}are checked here, others are not run"),
    }
}

/// What the libraries are called, for co-simulation.
pub fn model_identifier(text: &str) -> Option<String> {
    let document = Document::parse(text).ok()?;
    let interface = document.root_element().children().find(|child| child.has_tag_name("CoSimulation"))?;
    interface.attribute("modelIdentifier").map(str::to_owned)
}

/// `modelDescription.xml` as it stands.
pub fn findings(text: &str) -> Vec<String> {
    let document = match Document::parse(text) {
        Ok(document) => document,
        Err(error) => return vec![format!("no XML: {error}")],
    };
    let mut findings = order(document.root_element());
    let version = document.root_element().attribute("fmiVersion").unwrap_or_default();
    if version != "2.0" {
        findings.push(format!("fmiVersion {version:?}: expected exactly \"2.0\", whatever the revision"));
    }
    findings.extend(attributes::findings(&document));
    findings.extend(empty_lists(&document));
    findings.extend(units(&document));
    if document.root_element().has_attribute("generationDateAndTime") {
        findings.push("generationDateAndTime: expected none, so that the same scene gives the same bytes".into());
    }
    findings
}

fn order(root: Node) -> Vec<String> {
    let mut findings = Vec::new();
    let mut found = Vec::new();
    for name in root.children().filter(Node::is_element).map(|child| child.tag_name().name()) {
        match ELEMENTS.iter().position(|(known, _)| *known == name) {
            None => findings.push(format!("<{name}>: not an element of FMI 2.0")),
            Some(place) if found.contains(&place) => findings.push(format!("<{name}>: more than once")),
            Some(place) => {
                if found.last().is_some_and(|last| place < *last) {
                    let expected = ELEMENTS.map(|(name, _)| name).join(", ");
                    findings.push(format!("<{name}>: out of order; expected {expected}"));
                }
                found.push(place);
            }
        }
    }
    let missing = ELEMENTS.iter().enumerate().filter(|(place, (_, ours))| *ours && !found.contains(place));
    findings.extend(missing.map(|(_, (name, _))| format!("<{name}>: missing")));
    findings
}

fn empty_lists(document: &Document) -> Vec<String> {
    let lists = document.descendants().filter(|node| LISTS.contains(&node.tag_name().name()));
    let empty = lists.filter(|list| !list.children().any(|child| child.is_element()));
    empty.map(|list| format!("<{}>: empty", list.tag_name().name())).collect()
}

/// Every number has a unit that is defined, and every unit is that of a number.
fn units(document: &Document) -> Vec<String> {
    let units: Vec<Node> = document.descendants().filter(|node| node.has_tag_name("Unit")).collect();
    let mut findings = repeated("unit", units.iter().map(name));
    let mut used = HashSet::new();
    for real in document.descendants().filter(|node| node.has_tag_name("Real")) {
        let Some(variable) = real.parent().filter(|parent| parent.has_tag_name("ScalarVariable")) else { continue };
        let variable = name(&variable);
        let Some(unit) = real.attribute("unit") else {
            let shown =
                real.attribute("displayUnit").map_or(String::new(), |unit| format!(", but display unit {unit:?}"));
            findings.push(format!("{variable}: no unit{shown}"));
            continue;
        };
        used.insert(unit);
        let Some(definition) = units.iter().find(|definition| name(definition) == unit) else {
            findings.push(format!("{variable}: unit {unit:?} is not in <UnitDefinitions>"));
            continue;
        };
        let is_shown = |shown| definition.children().any(|d| d.has_tag_name("DisplayUnit") && name(&d) == shown);
        if let Some(shown) = real.attribute("displayUnit").filter(|shown| !is_shown(*shown)) {
            findings.push(format!("{variable}: display unit {shown:?} is not defined for unit {unit:?}"));
        }
    }
    let unused = units.iter().map(name).filter(|unit| !used.contains(unit));
    findings.extend(unused.map(|unit| format!("unit {unit:?} is not used")));
    findings
}

fn name<'a>(node: &Node<'a, '_>) -> &'a str {
    node.attribute("name").unwrap_or_default()
}
