//! What the importer does not read: the order of the elements, units, the date.

use super::attributes;
use super::units;
use anyhow::{Result, bail};
use pounding::FmiVersion;
use roxmltree::{Document, Node};

/// Children of the root in the order that the schema demands, and whether every FMU of ours has them.
const ELEMENTS2: [(&str, bool); 9] = [
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
const ELEMENTS3: [(&str, bool); 10] = [
    ("ModelExchange", false),
    ("CoSimulation", true),
    ("ScheduledExecution", false),
    ("UnitDefinitions", true),
    ("TypeDefinitions", true),
    ("LogCategories", true),
    ("DefaultExperiment", true),
    ("ModelVariables", true),
    ("ModelStructure", true),
    ("Annotations", false),
];

const fn elements(version: FmiVersion) -> &'static [(&'static str, bool)] {
    match version {
        FmiVersion::V2 => &ELEMENTS2,
        FmiVersion::V3 => &ELEMENTS3,
    }
}

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

/// The version that a description says it is of; what it does not say, or not well, is for the lint to tell.
pub fn version(text: &str) -> FmiVersion {
    let document = Document::parse(text).ok();
    let version = document.as_ref().and_then(|document| document.root_element().attribute("fmiVersion"));
    if version.is_some_and(|version| version.starts_with('3')) { FmiVersion::V3 } else { FmiVersion::V2 }
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
    let version = version(text);
    let mut findings = order(document.root_element(), version);
    let (said, expected) = (document.root_element().attribute("fmiVersion").unwrap_or_default(), version.name());
    if said != expected {
        findings.push(format!("fmiVersion {said:?}: expected exactly {expected:?}, whatever the revision"));
    }
    findings.extend(attributes::findings(&document, version));
    findings.extend(empty_lists(&document));
    findings.extend(units::findings(&document, version));
    if document.root_element().has_attribute("generationDateAndTime") {
        findings.push("generationDateAndTime: expected none, so that the same scene gives the same bytes".into());
    }
    findings
}

fn order(root: Node, version: FmiVersion) -> Vec<String> {
    let elements = elements(version);
    let mut findings = Vec::new();
    let mut found = Vec::new();
    for name in root.children().filter(Node::is_element).map(|child| child.tag_name().name()) {
        match elements.iter().position(|(known, _)| *known == name) {
            None => findings.push(format!("<{name}>: not an element of FMI {}", version.name())),
            Some(place) if found.contains(&place) => findings.push(format!("<{name}>: more than once")),
            Some(place) => {
                if found.last().is_some_and(|last| place < *last) {
                    let expected = elements.iter().map(|(name, _)| *name).collect::<Vec<_>>().join(", ");
                    findings.push(format!("<{name}>: out of order; expected {expected}"));
                }
                found.push(place);
            }
        }
    }
    let missing = elements.iter().enumerate().filter(|(place, (_, ours))| *ours && !found.contains(place));
    findings.extend(missing.map(|(_, (name, _))| format!("<{name}>: missing")));
    findings
}

fn empty_lists(document: &Document) -> Vec<String> {
    let lists = document.descendants().filter(|node| LISTS.contains(&node.tag_name().name()));
    let empty = lists.filter(|list| !list.children().any(|child| child.is_element()));
    empty.map(|list| format!("<{}>: empty", list.tag_name().name())).collect()
}
