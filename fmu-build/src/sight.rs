//! What is seen of a description at first sight: whose it is, its version, what its libraries are called.

use anyhow::{Result, bail};
use pounding::FmiVersion;
use roxmltree::Document;

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
