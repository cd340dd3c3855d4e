//! What an FMU holds, and the zip that it is.

pub mod archive;
mod documentation;
mod licenses;
pub mod platform;

use crate::libraries::Library;
use anyhow::Result;
use archive::Entry;
use pounding::FmiVersion;
use pounding::description::Package;

/// The bytes of the FMU of a scene with these libraries, one for each platform. They depend on nothing else.
pub fn pack(package: &Package, libraries: &[Library], version: FmiVersion) -> Result<Vec<u8>> {
    archive::pack(&entries(package, libraries, version))
}

/// What the FMU of a scene is called where nobody has named it: neither version takes the place of the other.
pub fn file_name(package: &Package, version: FmiVersion) -> String {
    let name = &package.scene.name;
    match version {
        FmiVersion::V2 => format!("{name}.fmu"),
        FmiVersion::V3 => format!("{name}.fmi3.fmu"),
    }
}

/// What the FMU holds, in the order in which it stands in the archive: the libraries by path, as `merge` has them.
fn entries(package: &Package, libraries: &[Library], version: FmiVersion) -> Vec<Entry> {
    let of_scene = |library: &Library| library.entry(&package.scene.name, version);
    let mut binaries: Vec<Entry> = libraries.iter().map(of_scene).collect();
    binaries.sort_by(|one, other| one.path.cmp(&other.path));
    let mut entries = vec![Entry::file("modelDescription.xml", package.model_description(version).into_bytes())];
    entries.extend(binaries);
    entries.extend(package.resources().map(|(name, bytes)| Entry::file(&format!("resources/{name}"), bytes.to_vec())));
    entries.extend(documentation::entries(package, version));
    entries.extend(licenses::entries());
    entries
}
