//! The run after building.

use super::channel::Channel;
use crate::c_interface::{Binary, Instance};
use crate::experiment;
use crate::pack::archive::{self, Unpacked};
use crate::pack::platform;
use anyhow::{Context, Result};
use fmi::model_description::fmi2::ModelDescription;
use std::path::Path;

/// In a process of its own: loads the FMU as an importer would and runs it.
pub fn try_out(fmu: &Path, directory: &Path, channel: &Channel) -> Result<()> {
    let run = || {
        let unpacked = Unpacked::open(fmu, directory)?;
        let description = ModelDescription::from_string(&unpacked.description()?)?;
        let library = platform::host_library(&unpacked.names, &description.modelName);
        let binary = Binary::load(&unpacked.path(library.context("the FMU has no library for this machine")?))?;
        let resources = archive::resource_uri(unpacked.root());
        let instance = Instance::new(&binary, &description.modelName, &description.guid, &resources)?;
        experiment::run(&description, &instance)
    };
    channel.need("run", run)?.map_or(Ok(()), |outcome| channel.ran(outcome))
}
