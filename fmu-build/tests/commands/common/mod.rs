//! `cargo fmu` as a user runs it, and FMUs to run it on.

pub mod libraries;

use pounding::FmiVersion;
use serde_json::Value;
use std::fs::File;
use std::io::{Read, Write};
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::OnceLock;
use tempfile::TempDir;

/// The checkout.
pub fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap()
}

/// Runs `cargo fmu` in a directory, its output in a pipe.
pub fn cargo_fmu_in(directory: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_cargo-fmu")).args(arguments).current_dir(directory).output().unwrap()
}

/// Exit code and report of `cargo fmu check --json`, which says nothing else.
pub fn checked(fmu: &Path) -> (Option<i32>, Value) {
    let output = cargo_fmu(&["check", fmu.to_str().unwrap(), "--json"]);
    assert_eq!(stderr(&output), "");
    (output.status.code(), serde_json::from_str(&stdout(&output)).unwrap())
}

/// What a report says under the name of one check, a line each.
pub fn findings(report: &Value, name: &str) -> String {
    let checks = report["checks"].as_array().unwrap().iter().filter(|check| check["name"] == name);
    let findings = checks.flat_map(|check| check["findings"].as_array().unwrap());
    findings.map(|finding| finding.as_str().unwrap().to_owned() + "\n").collect()
}

/// Runs `cargo fmu` in the checkout.
pub fn cargo_fmu(arguments: &[&str]) -> Output {
    cargo_fmu_in(root(), arguments)
}

pub fn stdout(output: &Output) -> String {
    String::from_utf8(output.stdout.clone()).unwrap()
}

pub fn stderr(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).unwrap()
}

/// Builds a scene that must build.
pub fn build(scene: &Path, fmu: &Path) -> Output {
    let output = cargo_fmu(&[scene.to_str().unwrap(), "-o", fmu.to_str().unwrap()]);
    assert!(output.status.success(), "{}", stderr(&output));
    output
}

/// The default scene.
pub fn feup() -> PathBuf {
    root().join("examples/scenes/feup.toml")
}

/// The default scene, changed; its record is beside it.
pub fn changed_feup(directory: &Path, change: impl Fn(&str) -> String) -> PathBuf {
    let text = std::fs::read_to_string(feup()).unwrap();
    let text = replace_once(&text, "../records/el_centro_1940_ns.csv", "record.csv");
    std::fs::copy(root().join("examples/records/el_centro_1940_ns.csv"), directory.join("record.csv")).unwrap();
    let scene = directory.join("scene.toml");
    std::fs::write(&scene, change(&text)).unwrap();
    scene
}

/// The FMU of the default scene.
pub fn feup_fmu() -> &'static Path {
    feup_fmu_of(FmiVersion::V2)
}

/// The same of a version.
pub fn feup_fmu_of(version: FmiVersion) -> &'static Path {
    static FMUS: [OnceLock<(TempDir, PathBuf)>; 2] = [const { OnceLock::new() }; 2];
    let (place, option) = option_of(version);
    let (_, path) = FMUS[place].get_or_init(|| {
        let directory = TempDir::new().unwrap();
        let path = directory.path().join("feup.fmu");
        let said = cargo_fmu(&[feup().to_str().unwrap(), option, "-o", path.to_str().unwrap()]);
        assert!(said.status.success(), "{}", stderr(&said));
        (directory, path)
    });
    path
}

/// The place of a version among both, and the option that asks for its FMU.
pub fn option_of(version: FmiVersion) -> (usize, &'static str) {
    match version {
        FmiVersion::V2 => (0, "--fmi=2"),
        FmiVersion::V3 => (1, "--fmi=3"),
    }
}

/// Names and contents of the files of an FMU, in their order.
pub type Files = Vec<(String, Vec<u8>)>;

pub fn files(fmu: &Path) -> Files {
    let mut archive = zip::ZipArchive::new(File::open(fmu).unwrap()).unwrap();
    (0..archive.len())
        .map(|index| {
            let mut file = archive.by_index(index).unwrap();
            let mut bytes = Vec::new();
            file.read_to_end(&mut bytes).unwrap();
            (String::from_utf8(file.name_raw().to_vec()).unwrap(), bytes)
        })
        .collect()
}

pub fn write_fmu(path: &Path, files: &Files) {
    let mut archive = zip::ZipWriter::new(File::create(path).unwrap());
    for (name, bytes) in files {
        archive.start_file(name.as_str(), zip::write::SimpleFileOptions::default()).unwrap();
        archive.write_all(bytes).unwrap();
    }
    archive.finish().unwrap();
}

/// An archive with a number of so many bytes changed in the entry of a file: at that place of its header in the directory
/// or, where none is given, before the file itself.
pub fn patched(archive: &[u8], name: &str, [central, local]: [Option<usize>; 2], value: u32) -> Vec<u8> {
    let mut bytes = archive.to_vec();
    for (signature, name_at, place) in [(b"PK\x01\x02", 46, central), (b"PK\x03\x04", 30, local)] {
        let is_header =
            |at: &usize| bytes[*at..].starts_with(signature) && bytes[at + name_at..].starts_with(name.as_bytes());
        let at = (0..bytes.len() - name_at).find(is_header).expect("the header");
        if let Some(place) = place {
            bytes[at + place..at + place + 4].copy_from_slice(&value.to_le_bytes());
        }
    }
    bytes
}

/// An archive with a name replaced by another of the same length, wherever it stands.
pub fn renamed(archive: &[u8], old: &str, new: &str) -> Vec<u8> {
    assert_eq!(old.len(), new.len());
    let mut bytes = archive.to_vec();
    let places: Vec<usize> = (0..bytes.len()).filter(|at| bytes[*at..].starts_with(old.as_bytes())).collect();
    assert!(places.len() >= 2, "no {old} to rename");
    for at in places {
        bytes[at..at + new.len()].copy_from_slice(new.as_bytes());
    }
    bytes
}

/// The text with its only (or first) `old` replaced; a test that finds nothing to replace tests nothing.
pub fn replace_once(text: &str, old: &str, new: &str) -> String {
    assert!(text.contains(old), "no {old:?} to replace");
    text.replacen(old, new, 1)
}

/// The files of the default FMU with another description.
pub fn changed_description(change: impl Fn(&str) -> String) -> Files {
    let mut files = files(feup_fmu());
    let text = String::from_utf8(std::mem::take(&mut files[0].1)).unwrap();
    files[0].1 = change(&text).into_bytes();
    files
}
