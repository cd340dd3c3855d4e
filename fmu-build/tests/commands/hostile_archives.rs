//! Archives that readers may understand in different ways, or that pretend: refused by `cargo fmu check` and
//! `cargo fmu merge` alike, whatever the version of FMI.

use crate::common::libraries::library;
use crate::common::{
    Files, cargo_fmu, changed_description, feup_fmu, feup_fmu_of, files, option_of, patched, renamed, replace_once,
    stdout, write_fmu,
};
use pounding::FmiVersion;
use std::path::Path;
use tempfile::TempDir;

/// An archive that both commands must refuse, and what both must say: in place of an FMU of a version.
fn refused(version: FmiVersion, bytes: &[u8], expected: &str) {
    let directory = TempDir::new().unwrap();
    let path = |name: &str| directory.path().join(name).to_str().unwrap().to_owned();
    std::fs::write(path("bad.fmu"), bytes).unwrap();
    let output = cargo_fmu(&["check", &path("bad.fmu")]);
    let said = stdout(&output);
    assert_eq!(output.status.code(), Some(1), "{said}");
    assert!(said.contains("archive              WRONG") && said.contains(expected), "no {expected:?} in {said}");

    let mut there = files(feup_fmu_of(version));
    let folder = ["win64", "x86_64-windows"][option_of(version).0];
    there[1] = (format!("binaries/{folder}/FeupFrames.dll"), library(folder));
    write_fmu(Path::new(&path("there.fmu")), &there);
    let output = cargo_fmu(&["merge", &path("bad.fmu"), &path("there.fmu"), "-o", &path("both.fmu")]);
    let said = crate::common::stderr(&output);
    assert_eq!(output.status.code(), Some(1), "{said}");
    assert!(said.contains("bad.fmu: ") && said.contains(expected), "no {expected:?} in {said}");
}

/// The default FMU with further files before its own.
fn with(version: FmiVersion, first: &[(&str, &[u8])]) -> Vec<u8> {
    let mut all: Files = first.iter().map(|(name, bytes)| ((*name).to_owned(), bytes.to_vec())).collect();
    all.extend(files(feup_fmu_of(version)));
    bytes_of(&all)
}

fn bytes_of(files: &Files) -> Vec<u8> {
    let directory = TempDir::new().unwrap();
    let fmu = directory.path().join("some.fmu");
    write_fmu(&fmu, files);
    std::fs::read(fmu).unwrap()
}

#[test]
fn two_files_of_one_name() {
    FmiVersion::ALL.into_iter().for_each(two_files_of_one_name_in);
}

fn two_files_of_one_name_in(version: FmiVersion) {
    let with = |first: &[(&str, &[u8])]| with(version, first);
    let refused = |bytes: &[u8], expected: &str| refused(version, bytes, expected);
    let description = with(&[("modelDescription.xmX", b"<x/>")]);
    let twice = renamed(&description, "modelDescription.xmX", "modelDescription.xml");
    refused(&twice, "\"modelDescription.xml\": more than once in the archive");
    for other in ["ModelDescription.xml", "modelDescription.xml.", "./modelDescription.xml", ".\\modelDescription.xml"]
    {
        refused(&with(&[(other, b"<x/>")]), "on some systems");
    }
    refused(&with(&[("resources", b"")]), "\"resources\" is a file");
}

#[test]
fn a_directory_that_does_not_say_what_the_files_say() {
    FmiVersion::ALL.into_iter().for_each(a_directory_that_does_not_say_it_in);
}

fn a_directory_that_does_not_say_it_in(version: FmiVersion) {
    let refused = |bytes: &[u8], expected: &str| refused(version, bytes, expected);
    let good = std::fs::read(feup_fmu_of(version)).unwrap();
    let scene = "resources/scene.toml";
    // Places of the header: sum, compressed size, size; name length is left alone.
    for (central, local) in [(16, 14), (20, 18), (24, 22)] {
        for places in [[Some(central), None], [None, Some(local)]] {
            refused(&patched(&good, scene, places, 7), "the archive is damaged or says two things of one file");
        }
    }
    // Both alike, but not what is there.
    refused(&patched(&good, scene, [Some(24), Some(22)], 7), "larger than its declared uncompressed size");
    refused(&patched(&good, scene, [Some(24), Some(22)], 1 << 31), "where the archive says 2147483648");
    // Another name before the file than in the directory.
    let mut bytes = good.clone();
    let at = (0..bytes.len()).find(|at| bytes[*at..].starts_with(scene.as_bytes())).unwrap();
    bytes[at] = b'R';
    refused(&bytes, "the archive is damaged or says two things of one file");
    // A file that the directory does not know, and something before the first one.
    refused(&[&good[..], &good[..]].concat(), "bytes stand before the archive");
    refused(&[b"#!/bin/sh\n", &good[..]].concat(), "10 bytes stand before the archive");
}

/// The description of the one version in the FMU of the other.
#[test]
fn a_description_of_the_other_version() {
    for (version, other, of_check, of_merge) in [
        (FmiVersion::V2, FmiVersion::V3, "x86_64-", "expected the folder x86_64-"),
        (FmiVersion::V3, FmiVersion::V2, "binaries/x86_64-", "documentation/index.html: different"),
    ] {
        let mut all = files(feup_fmu_of(version));
        all[0] = files(feup_fmu_of(other)).swap_remove(0);
        let directory = TempDir::new().unwrap();
        let path = directory.path().join("mixed.fmu").to_str().unwrap().to_owned();
        write_fmu(Path::new(&path), &all);
        let output = cargo_fmu(&["check", &path]);
        let said = stdout(&output);
        assert_eq!(output.status.code(), Some(1), "{said}");
        assert!(said.contains("library              WRONG") && said.contains(of_check), "{said}");
        let output =
            cargo_fmu(&["merge", &path, feup_fmu_of(other).to_str().unwrap(), "-o", &format!("{path}.both.fmu")]);
        let said = crate::common::stderr(&output);
        assert_eq!(output.status.code(), Some(1), "{said}");
        assert!(said.contains("mixed.fmu") && said.contains(of_merge), "{said}");
    }
}

#[test]
fn what_unpacks_to_much_is_refused_and_the_report_stays_short() {
    let zeros = vec![0; 100 << 20];
    let mut files = files(feup_fmu());
    (0..11).for_each(|k| files.push((format!("resources/{k}"), zeros.clone())));
    refused(FmiVersion::V2, &deflated(&files), "more than 1073741824 bytes in the archive up to here");

    // Each finding with a long name, and many of them.
    let unit = |k: usize| format!("<Unit name=\"{k}{}\"/>", "u".repeat(5000));
    let units: String = (0..10_000).map(unit).collect();
    let files =
        changed_description(|text| replace_once(text, "<UnitDefinitions>", &format!("<UnitDefinitions>{units}")));
    let directory = TempDir::new().unwrap();
    let fmu = directory.path().join("many.fmu");
    std::fs::write(&fmu, deflated(&files)).unwrap();
    assert!(std::fs::metadata(&fmu).unwrap().len() < 5 << 20);
    for arguments in [&["check", fmu.to_str().unwrap()][..], &["check", "--json", fmu.to_str().unwrap()]] {
        let output = cargo_fmu(arguments);
        assert_eq!(output.status.code(), Some(1));
        let said = stdout(&output);
        assert!(said.len() < 1 << 20, "{} bytes", said.len());
        assert!(said.contains("... (50") && said.contains("more"), "{}", &said[..2000]);
    }
    // One that is too long to be read at all.
    let files = changed_description(|text| text.to_owned() + &" ".repeat(1 << 26));
    std::fs::write(&fmu, deflated(&files)).unwrap();
    let said = stdout(&cargo_fmu(&["check", fmu.to_str().unwrap()]));
    assert!(said.contains("expected no more than 67108864"), "{said}");
}

fn deflated(files: &Files) -> Vec<u8> {
    use std::io::Write;
    let mut archive = zip::ZipWriter::new(std::io::Cursor::new(Vec::new()));
    let options = zip::write::SimpleFileOptions::default().compression_method(zip::CompressionMethod::Deflated);
    for (name, bytes) in files {
        archive.start_file(name.as_str(), options).unwrap();
        archive.write_all(bytes).unwrap();
    }
    archive.finish().unwrap().into_inner()
}
