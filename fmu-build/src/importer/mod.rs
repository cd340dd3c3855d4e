//! FMUs through fmi-rs, an importer that shares no code with the exporter, a file for each version.

mod description;
mod v2;
pub mod v3;

use crate::description::Description;
use crate::experiment::CoSimulation;
use anyhow::Result;
pub use description::read;
use pounding::FmiVersion;
use std::path::Path;

/// Instantiates the co-simulation of an unpacked FMU, for a master that knows no events.
pub fn instantiate(root: &Path, description: &Description) -> Result<Box<dyn CoSimulation>> {
    Ok(match description.version {
        FmiVersion::V2 => Box::new(v2::Imported::new(root, description)?),
        FmiVersion::V3 => Box::new(v3::Imported::new(root, description, false)?),
    })
}
