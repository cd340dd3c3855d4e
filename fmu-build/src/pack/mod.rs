//! What an FMU holds, and the zip that it is.

pub mod archive;
mod documentation;
mod licenses;
pub mod platform;

use crate::libraries::Library;
use anyhow::Result;
use archive::Entry;
use pounding::description::Package;

/// The bytes of the FMU of a scene with these libraries, one for each platform. They depend on nothing else.
pub fn pack(package: &Package, libraries: &[Library]) -> Result<Vec<u8>> {
    archive::pack(&entries(package, libraries))
}

/// What the FMU holds, in the order in which it stands in the archive: the libraries by path, as `merge` has them.
fn entries(package: &Package, libraries: &[Library]) -> Vec<Entry> {
    let mut binaries: Vec<Entry> = libraries.iter().map(|library| library.entry(&package.scene.name)).collect();
    binaries.sort_by(|one, other| one.path.cmp(&other.path));
    let mut entries =
        vec![Entry::file("modelDescription.xml", package.model_description(pounding::FmiVersion::V2).into_bytes())];
    entries.extend(binaries);
    entries.extend(package.resources().map(|(name, bytes)| Entry::file(&format!("resources/{name}"), bytes.to_vec())));
    entries.extend(documentation::entries(package));
    entries.extend(licenses::entries());
    entries
}
