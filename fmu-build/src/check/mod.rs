//! `cargo fmu check`: what is wrong with an FMU, as far as it can be seen from outside.
//!
//! The description is read and validated, and the FMU run, by an importer that is not ours. What that importer and
//! other validators do not look at is in [`scene`] (whether the description is that of the scene), [`lint`] (what is written
//! in the FMU), [`behaviour`] (what its library does) and [`events`] (what it does for a master that takes events). All of it
//! happens in a process of its own, for as long as it may take.

mod behaviour;
mod events;
mod lint;
mod scene;

use crate::archive::{Unpacked, odd_names};
use crate::description::Description;
use crate::experiment;
use crate::importer;
use crate::inspection;
use crate::sight::{origin, version};
use crate::trial::channel::Channel;
use anyhow::{Context, Result};
use pounding::FmiVersion;
use pounding_pack::platform::{self, Platform};
use std::path::Path;

/// What is looked at, in this order.
pub const CHECKS: [&str; 11] = [
    "archive",
    "description",
    "origin",
    "file names",
    "description lint",
    "scene",
    "library",
    "exported functions",
    "guid",
    "start values",
    "run",
];

/// Goes through the FMU as long as what has been found lets it.
pub fn inspect(fmu: &Path, directory: &Path, channel: &Channel) -> Result<()> {
    let Some(fmu) = channel.need("archive", || Unpacked::open(fmu, directory))? else { return Ok(()) };
    let Some(text) = channel.need("description", || fmu.description())? else { return Ok(()) };
    if channel.need("origin", || origin(&text))?.is_none() {
        return Ok(());
    }
    channel.look("file names", || odd_names(&fmu.names))?;
    channel.look("description lint", || lint::document(&text))?;
    channel.look("scene", || scene::differences(&fmu, &text))?;

    let Some(description) = channel.need("description", || importer::read(&text, version(&text)))? else {
        return Ok(());
    };
    channel.look("description", || description.problems.clone())?;
    channel.look("description lint", || lint::description(&description))?;
    channel.look("file names", || lint::files(&fmu.names, &description))?;

    let Some(can_be_tried) = channel.need("library", || libraries(&fmu, &description, channel))? else { return Ok(()) };
    if can_be_tried { try_library(&fmu, &description, channel) } else { Ok(()) }
}

/// Looks at the libraries for all machines as files; whether the one for this machine is in order.
fn libraries(fmu: &Unpacked, description: &Description, channel: &Channel) -> Result<bool> {
    let (identifier, version) = (description.identifier.as_str(), description.version);
    let here = platform::host_library(&fmu.names, identifier, version);
    // Others than plain names have not been unpacked, and have been found already.
    let is_plain = |name: &str| odd_names(&[name.to_owned()]).is_empty() && !name.ends_with('/');
    let there = fmu.names.iter().filter(|name| name.starts_with("binaries/") && is_plain(name));
    let mut is_here_in_order = None;
    for name in there.clone() {
        let bytes = std::fs::read(fmu.path(name)).with_context(|| format!("{name} cannot be read"))?;
        let findings = inspection::inspect(name, &bytes, identifier, version, there.clone().count() == 1);
        let is_for_another = findings.platform.is_some_and(|platform| Some(platform) != Platform::host());
        if here == Some(name) && !is_for_another {
            is_here_in_order = Some(findings.is_empty());
        }
        channel.look("library", || findings.library)?;
        channel.look("exported functions", || findings.functions)?;
    }
    let all = || there.cloned().collect::<Vec<_>>().join(", ");
    is_here_in_order.with_context(|| {
        let here = platform::named(&platform::folder(), version);
        format!("cannot be tried here: the FMU has no library for this machine, {here}; it has: {}", all())
    })
}

/// Goes through what the library does as long as what has been found lets it.
fn try_library(fmu: &Unpacked, description: &Description, channel: &Channel) -> Result<()> {
    let root = fmu.root();
    let Some(binary) = channel.need("library", || behaviour::library(fmu, description))? else { return Ok(()) };
    if !channel.look("exported functions", || behaviour::missing_functions(description, &binary))? {
        return Ok(());
    }
    channel.look("guid", || behaviour::wrong_guid_accepted(root, description, &binary))?;
    let start_values = || {
        let instance = importer::instantiate(root, description)?;
        behaviour::start_values(description, &*instance)
    };
    let Some(differences) = channel.need("start values", start_values)? else { return Ok(()) };
    channel.look("start values", || differences)?;
    let run = || experiment::run(description, &*importer::instantiate(root, description)?);
    let Some(outcome) = channel.need("run", run)? else { return Ok(()) };
    if description.version == FmiVersion::V3
        && channel.need("run", || events::compare(root, description, &outcome))?.is_none()
    {
        return Ok(());
    }
    channel.ran(outcome)
}
