//! The C interfaces of FMI: as much of them as running a co-simulation takes.
//!
//! All `unsafe` code of this program is here. Its ground is the standard's promise of what each function reads and
//! writes; a library that breaks that promise can break this process. `library.rs` has what is the same in both versions.

mod library;
mod v2;
mod v3;

use crate::description::Description;
use crate::experiment::CoSimulation;
use anyhow::Result;
pub use library::Binary;
use pounding::FmiVersion;
use std::path::Path;

/// An instance of the FMU that is unpacked in `root`, with this GUID or token.
pub fn instantiate<'a>(
    binary: &'a Binary,
    description: &Description,
    token: &str,
    root: &Path,
) -> Result<Box<dyn CoSimulation + 'a>> {
    Ok(match description.version {
        FmiVersion::V2 => Box::new(v2::Instance::new(binary, &description.name, token, root)?),
        FmiVersion::V3 => Box::new(v3::Instance::new(binary, &description.name, token, root)?),
    })
}
