//! What an FMU holds, and the archive that it is: for the commands on every machine and for the browser page.
//!
//! | file | holds |
//! |---|---|
//! | `lib.rs` | from a scene and libraries to the bytes of an FMU |
//! | `library.rs` | the library for one platform |
//! | `platform.rs` | where each version of FMI wants the library of each platform, and what it is |
//! | `documentation.rs`, `licenses.rs` | the page about the model and the icon; the licence texts |
//! | `archive.rs` | the zip, written reproducibly |

pub mod archive;
mod documentation;
pub mod library;
mod licenses;
pub mod platform;

use archive::Entry;
use library::Library;
use pounding::FmiVersion;
use pounding::description::Package;
use std::io;

/// The bytes of the FMU of a scene with these libraries, one for each platform. They depend on nothing else.
///
/// # Errors
/// More bytes than an archive can have.
pub fn pack(package: &Package, libraries: &[Library], version: FmiVersion) -> io::Result<Vec<u8>> {
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
