//! The names of the files in the archive.

use crate::description::Description;

/// Beside the libraries.
const FILES: [&str; 10] = [
    "modelDescription.xml",
    "model.png",
    "resources/scene.toml",
    "resources/record.csv",
    "resources/record.at2",
    "resources/record.txt",
    "documentation/index.html",
    "documentation/licenses/license.txt",
    "documentation/licenses/LICENSE-APACHE",
    "documentation/licenses/LICENSE-MIT",
];

/// No file that is not an FMU's of ours, and each library under the name that importers look for.
pub fn files(names: &[String], description: &Description) -> Vec<String> {
    let identifier = description.identifier.as_str();
    let is_ours =
        |name: &str| FILES.contains(&name) || is_channel(name) || is_folder(name) || is_library(name, identifier);
    let strange = names.iter().filter(|name| !is_ours(name));
    strange
        .map(|name| match name.split('/').next() {
            Some("binaries") => format!("{name:?}: expected binaries/<platform>/{identifier}.so, .dll or .dylib"),
            _ => format!("{name:?}: not a file of such an FMU"),
        })
        .collect()
}

/// A record whose scene has asked for one of its channels.
fn is_channel(name: &str) -> bool {
    let number = name.strip_prefix("resources/record_channel_").and_then(|rest| rest.strip_suffix(".txt"));
    number.is_some_and(|number| number.parse::<usize>().is_ok())
}

/// Of one of the files.
fn is_folder(name: &str) -> bool {
    name.ends_with('/') && (name.starts_with("binaries/") || FILES.iter().any(|file| file.starts_with(name)))
}

fn is_library(name: &str, identifier: &str) -> bool {
    let parts: Vec<&str> = name.split('/').collect();
    let ["binaries", platform, file] = parts.as_slice() else { return false };
    let library = ["so", "dll", "dylib"].map(|extension| format!("{identifier}.{extension}"));
    !platform.is_empty() && library.iter().any(|library| library == file)
}
