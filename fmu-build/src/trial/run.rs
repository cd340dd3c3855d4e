//! The run after building.

use super::channel::Channel;
use crate::archive::Unpacked;
use crate::c_interface::{self, Binary};
use crate::description::Description;
use crate::experiment;
use anyhow::{Context, Result};
use pounding_pack::platform;
use std::path::Path;

/// In a process of its own: loads the FMU as an importer would and runs it.
pub fn try_out(fmu: &Path, directory: &Path, channel: &Channel) -> Result<()> {
    let run = || {
        let unpacked = Unpacked::open(fmu, directory)?;
        let text = unpacked.description()?;
        let description = Description::for_a_run(&text)?;
        let library = platform::host_library(&unpacked.names, &description.identifier, description.version);
        let binary = Binary::load(&unpacked.path(library.context("the FMU has no library for this machine")?))?;
        let instance = c_interface::instantiate(&binary, &description, &description.token, unpacked.root())?;
        experiment::run(&description, &*instance)
    };
    channel.need("run", run)?.map_or(Ok(()), |outcome| channel.ran(outcome))
}
