//! `cargo fmu merge`: one FMU with the libraries of two.

use crate::common::libraries::{exporting, functions, library};
use crate::common::{Files, cargo_fmu, cargo_fmu_in, feup_fmu, files, replace_once, stderr, stdout, write_fmu};
use pounding::FmiVersion;
use std::fs::File;
use std::path::{Path, PathBuf};
use tempfile::TempDir;

/// An FMU for this machine and one for another, which no machine can run.
struct Pair {
    directory: TempDir,
}

impl Pair {
    /// The default FMU twice, the other one with a change.
    fn new(change: impl Fn(Files) -> Files) -> Pair {
        let pair = Pair { directory: TempDir::new().unwrap() };
        std::fs::copy(feup_fmu(), pair.path("here.fmu")).unwrap();
        write_fmu(&pair.path("there.fmu"), &change(elsewhere("win64/FeupFrames.dll")));
        pair
    }

    fn path(&self, name: &str) -> PathBuf {
        self.directory.path().join(name)
    }

    /// Exit code, output and errors of merging two of the files.
    fn merge(&self, one: &str, other: &str, output: &str) -> (Option<i32>, String, String) {
        let said = cargo_fmu_in(self.directory.path(), &["merge", one, other, "-o", output]);
        (said.status.code(), stdout(&said), stderr(&said))
    }

    /// Merging fails; what is said about it.
    fn refused(&self, one: &str, other: &str) -> String {
        let (code, out, said) = self.merge(one, other, "new/both.fmu");
        assert_eq!((code, out.as_str()), (Some(1), ""), "{said}");
        assert!(!self.path("new").exists(), "something has been left behind");
        assert!(!said.contains("bug"), "{said}");
        said
    }
}

/// The files of the default FMU with a library for another machine in its place.
fn elsewhere(path: &str) -> Files {
    let mut files = files(feup_fmu());
    files[1] = (format!("binaries/{path}"), library(path.split('/').next().unwrap()));
    files
}

fn unchanged(files: Files) -> Files {
    files
}

#[test]
fn both_libraries_and_everything_else_once() {
    let pair = Pair::new(unchanged);
    let (code, said, errors) = pair.merge("here.fmu", "there.fmu", "new/both.fmu");
    assert_eq!((code, errors.as_str()), (Some(0), ""));
    assert!(said.contains("new/both.fmu") && said.contains("linux64, win64"), "{said}");
    let mut expected = files(feup_fmu());
    expected.insert(2, elsewhere("win64/FeupFrames.dll").swap_remove(1));
    assert!(files(&pair.path("new/both.fmu")) == expected);
    let mut archive = zip::ZipArchive::new(File::open(pair.path("new/both.fmu")).unwrap()).unwrap();
    for library in ["binaries/linux64/FeupFrames.so", "binaries/win64/FeupFrames.dll"] {
        assert_eq!(archive.by_name(library).unwrap().unix_mode().unwrap() & 0o777, 0o755, "{library}");
    }
    assert_eq!(std::fs::read(pair.path("here.fmu")).unwrap(), std::fs::read(feup_fmu()).unwrap());

    let check = cargo_fmu(&["check", pair.path("new/both.fmu").to_str().unwrap()]);
    assert_eq!(check.status.code(), Some(0), "{}", stdout(&check));
}

/// Not those of the order in which they are named, of the time, or of how the archives were written.
#[test]
fn the_bytes_depend_on_the_contents_alone() {
    let pair = Pair::new(unchanged);
    assert_eq!(pair.merge("here.fmu", "there.fmu", "one.fmu").0, Some(0));
    std::thread::sleep(std::time::Duration::from_millis(2100));
    write_fmu(&pair.path("stored.fmu"), &files(feup_fmu()));
    assert_ne!(std::fs::read(pair.path("stored.fmu")).unwrap(), std::fs::read(feup_fmu()).unwrap());
    let mut backwards = elsewhere("win64/FeupFrames.dll");
    backwards.reverse();
    write_fmu(&pair.path("backwards.fmu"), &backwards);
    let pairs = [["there", "here"], ["stored", "there"], ["here", "backwards"], ["backwards", "here"]];
    for (k, [one, other]) in pairs.map(|names| names.map(|name| name.to_owned() + ".fmu")).iter().enumerate() {
        let output = format!("{k}.fmu");
        assert_eq!(pair.merge(one, other, &output).0, Some(0));
        assert!(std::fs::read(pair.path(&output)).unwrap() == std::fs::read(pair.path("one.fmu")).unwrap(), "{one}");
    }
}

#[test]
fn a_merged_fmu_takes_another_platform() {
    let pair = Pair::new(unchanged);
    write_fmu(&pair.path("third.fmu"), &elsewhere("darwin64/FeupFrames.dylib"));
    assert_eq!(pair.merge("here.fmu", "there.fmu", "two.fmu").0, Some(0));
    let (code, said, _) = pair.merge("two.fmu", "third.fmu", "three.fmu");
    assert_eq!(code, Some(0));
    assert!(said.contains("darwin64, linux64, win64"), "{said}");
    assert_eq!(pair.merge("there.fmu", "third.fmu", "others.fmu").0, Some(0));
    assert_eq!(pair.merge("others.fmu", "here.fmu", "again.fmu").0, Some(0));
    assert!(std::fs::read(pair.path("again.fmu")).unwrap() == std::fs::read(pair.path("three.fmu")).unwrap());
}

#[test]
fn a_platform_that_both_have_is_refused() {
    let pair = Pair::new(unchanged);
    let said = pair.refused("here.fmu", "here.fmu");
    assert!(said.contains("binaries/linux64: in both; expected libraries for different platforms"), "{said}");
}

#[test]
fn what_is_no_library_for_its_folder_is_refused() {
    let pair = Pair::new(unchanged);
    let refused = |path: &str, bytes: &[u8], expected: &str| {
        let mut files = elsewhere("win64/FeupFrames.dll");
        files[1] = (format!("binaries/{path}"), bytes.to_vec());
        write_fmu(&pair.path("bad.fmu"), &files);
        for fmus in [["here.fmu", "bad.fmu"], ["bad.fmu", "here.fmu"]] {
            let said = pair.refused(fmus[0], fmus[1]);
            assert!(said.contains(&format!("bad.fmu: binaries/{path}: {expected}")), "no {expected:?} in {said}");
        }
    };
    refused("darwin64/FeupFrames.so", b"MZ no library at all", "expected the name FeupFrames.dylib in darwin64");
    refused("darwin64/FeupFrames.dylib", b"MZ no library at all", "no library that can be read");
    refused("win64/Other.dll", &library("win64"), "expected the name FeupFrames.dll in win64");
    let arm = "a library in the format Pe for Aarch64; expected a library in the format Pe for X86_64";
    refused("win64/FeupFrames.dll", &library("aarch64-windows"), arm);
    refused(
        "win64/FeupFrames.dll",
        &exporting("win64", &functions(FmiVersion::V2)[1..]),
        "fmi2GetTypesPlatform is not exported",
    );
}

#[test]
fn every_file_that_differs_is_named() {
    let pair = Pair::new(|mut files| {
        let change = |files: &mut Files, place: usize, old, new| {
            files[place].1 = replace_once(std::str::from_utf8(&files[place].1).unwrap(), old, new).into_bytes();
        };
        assert_eq!((files[0].0.as_str(), files[2].0.as_str()), ("modelDescription.xml", "resources/scene.toml"));
        change(&mut files, 0, "guid=\"{", "guid=\"{0");
        change(&mut files, 2, "gap = 0.005", "gap = 0.006");
        files.retain(|(name, _)| name != "model.png");
        files.push(("sources/buildDescription.xml".into(), b"<fmiBuildDescription/>".to_vec()));
        files
    });
    let said = pair.refused("here.fmu", "there.fmu");
    let scene = String::from_utf8(files(feup_fmu()).swap_remove(2).1).unwrap();
    let line = 1 + scene.lines().position(|line| line.contains("gap = 0.005")).unwrap();
    let expected = [
        "error: here.fmu and there.fmu cannot be merged:".to_owned(),
        "  modelDescription.xml: different from line 2 on".to_owned(),
        format!("  resources/scene.toml: different from line {line} on"),
        "  model.png: only in here.fmu".to_owned(),
        "  sources/buildDescription.xml: only in there.fmu".to_owned(),
    ];
    assert_eq!(said.lines().collect::<Vec<_>>(), expected);
    // One that both have, and the same, is part of the whole.
    let with_more = |name: &str, mut files: Files| {
        files.push(("sources/buildDescription.xml".into(), b"<fmiBuildDescription/>".to_vec()));
        write_fmu(&pair.path(name), &files);
    };
    with_more("a.fmu", files(feup_fmu()));
    with_more("b.fmu", elsewhere("win64/FeupFrames.dll"));
    assert_eq!(pair.merge("a.fmu", "b.fmu", "c.fmu").0, Some(0));
    assert!(files(&pair.path("c.fmu")).iter().any(|(name, _)| name == "sources/buildDescription.xml"));
}

#[test]
fn a_file_that_is_longer_differs() {
    let pair = Pair::new(|mut files| {
        files[2].1.push(b'\n');
        files
    });
    assert!(pair.refused("there.fmu", "here.fmu").contains("resources/scene.toml: different from line"));
}

#[test]
fn the_fmus_to_merge_are_never_written_to() {
    let pair = Pair::new(unchanged);
    let before = ["here.fmu", "there.fmu"].map(|name| std::fs::read(pair.path(name)).unwrap());
    #[cfg(unix)]
    std::os::unix::fs::symlink(pair.path("here.fmu"), pair.path("link.fmu")).unwrap();
    let outputs = ["here.fmu", "there.fmu", "./there.fmu", if cfg!(unix) { "link.fmu" } else { "here.fmu" }];
    for output in outputs {
        let (code, _, said) = pair.merge("here.fmu", "there.fmu", output);
        assert_eq!(code, Some(1));
        assert!(said.contains(&format!("-o {output} is one of the FMUs to merge")), "{said}");
        assert!(["here.fmu", "there.fmu"].map(|name| std::fs::read(pair.path(name)).unwrap()) == before);
    }
    // Any other file that is there is replaced, as by cargo fmu.
    std::fs::write(pair.path("old.fmu"), "old").unwrap();
    assert_eq!(pair.merge("here.fmu", "there.fmu", "old.fmu").0, Some(0));
    assert_eq!(files(&pair.path("old.fmu")).len(), 10);
}

#[test]
fn what_is_no_fmu_of_ours_is_refused_and_both_are_looked_at() {
    let pair = Pair::new(unchanged);
    let said = pair.refused("none.fmu", "neither.fmu");
    assert!(said.contains("none.fmu: cannot open") && said.contains("neither.fmu: cannot open"), "{said}");
    std::fs::write(pair.path("text.fmu"), "name = 1").unwrap();
    assert!(pair.refused("here.fmu", "text.fmu").contains("cannot be read as a zip archive"));
    write_fmu(&pair.path("other.fmu"), &vec![("readme.txt".into(), Vec::new()), ("../x".into(), Vec::new())]);
    let said = pair.refused("other.fmu", "here.fmu");
    for expected in ["no modelDescription.xml", "no library in binaries/", "`..`"] {
        assert!(said.contains(expected), "no {expected:?} in {said}");
    }
    let mut foreign = elsewhere("win64/FeupFrames.dll");
    foreign[0].1 = b"<fmiModelDescription generationTool=\"Other\"/>".to_vec();
    write_fmu(&pair.path("foreign.fmu"), &foreign);
    assert!(pair.refused("here.fmu", "foreign.fmu").contains("made by \"Other\""));
}

#[test]
fn a_damaged_archive_is_refused() {
    let pair = Pair::new(unchanged);
    let good = std::fs::read(feup_fmu()).unwrap();
    std::fs::write(pair.path("cut.fmu"), &good[..good.len() / 2]).unwrap();
    assert!(pair.refused("cut.fmu", "there.fmu").contains("cut.fmu: "));
    let mut bytes = good.clone();
    bytes[good.len() / 2] ^= 0x10;
    std::fs::write(pair.path("flipped.fmu"), &bytes).unwrap();
    assert!(pair.refused("there.fmu", "flipped.fmu").contains("flipped.fmu: the archive is damaged at binaries/"));
    // Wherever it may be: refused, or of no meaning. Never a crash.
    for place in 0..40 {
        let mut bytes = good.clone();
        let at = bytes.len() * place / 40;
        bytes[at] ^= 0x10;
        std::fs::write(pair.path("flipped.fmu"), bytes).unwrap();
        let (code, _, said) = pair.merge("flipped.fmu", "there.fmu", "maybe.fmu");
        assert!(matches!(code, Some(0 | 1)) && !said.contains("bug"), "byte {at}: {said}");
    }
}

#[test]
fn two_fmus_and_a_place_for_the_third() {
    let usage = |arguments: &[&str]| {
        let output = cargo_fmu(arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        assert!(stderr(&output).contains("try '--help'"), "{}", stderr(&output));
    };
    usage(&["merge", "a.fmu", "-o", "c.fmu"]);
    usage(&["merge", "a.fmu", "b.fmu"]);
    usage(&["merge", "a.fmu", "b.fmu", "c.fmu", "-o", "d.fmu"]);
    let directory = TempDir::new().unwrap();
    let pair = Pair::new(unchanged);
    let said = pair.merge("here.fmu", "there.fmu", directory.path().to_str().unwrap());
    assert!(said.0 == Some(1) && said.2.contains("is a directory"), "{}", said.2);
    assert!(Path::new(&pair.path("here.fmu")).is_file());
}
