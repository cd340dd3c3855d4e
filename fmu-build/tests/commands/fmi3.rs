//! FMI 3.0: `cargo fmu SCENE.toml --fmi 3`, and what `check` and `merge` do with such FMUs.

use crate::common::libraries::{exporting, functions, library};
use crate::common::{
    Files, cargo_fmu, cargo_fmu_in, checked, feup, feup_fmu, feup_fmu_of, files, findings, replace_once, root, stderr,
    stdout, write_fmu,
};
use pounding::FmiVersion;
use serde_json::Value;
use std::path::Path;
use tempfile::TempDir;

const HOST: [&str; 2] = if cfg!(windows) { ["win64", "x86_64-windows"] } else { ["linux64", "x86_64-linux"] };

/// The default scene as an FMU of FMI 3.0.
fn fmi3_fmu() -> &'static Path {
    feup_fmu_of(FmiVersion::V3)
}

/// Plants a defect in a good FMU and requires the check of that name to say so.
fn plant(change: impl Fn(&mut Files), name: &str, expected: &str) {
    let directory = TempDir::new().unwrap();
    let fmu = directory.path().join("defective.fmu");
    let mut files = files(fmi3_fmu());
    change(&mut files);
    write_fmu(&fmu, &files);
    let (code, report) = checked(&fmu);
    assert_eq!((code, &report["valid"]), (Some(1), &Value::Bool(false)), "{report:#}");
    assert!(findings(&report, name).contains(expected), "{name} does not say {expected:?}: {report:#}");
}

/// The text of one of the files, changed once.
fn change(files: &mut Files, place: usize, old: &str, new: &str) {
    files[place].1 = replace_once(std::str::from_utf8(&files[place].1).unwrap(), old, new).into_bytes();
}

#[test]
fn a_good_fmu_is_in_order_and_the_runs_of_both_versions_have_the_same_bits() {
    let (code, report) = checked(fmi3_fmu());
    assert_eq!(code, Some(0), "{report:#}");
    let (_, older) = checked(feup_fmu());
    let names = |report: &Value| {
        report["checks"].as_array().unwrap().iter().map(|check| check["name"].clone()).collect::<Vec<_>>()
    };
    assert_eq!(names(&report), names(&older));
    let mut values = report["run"]["values"].as_object().unwrap().clone();
    assert_eq!(values.remove("time"), Some(20.0.into()));
    assert_eq!(&values, older["run"]["values"].as_object().unwrap());
}

#[test]
fn the_archive_has_the_folders_of_fmi3_and_all_else_alike() {
    let [old, new] = [feup_fmu(), fmi3_fmu()].map(files);
    let names = |files: &Files| files.iter().map(|(name, _)| name.clone()).collect::<Vec<_>>();
    let expected = names(&old).iter().map(|name| name.replace(HOST[0], HOST[1])).collect::<Vec<_>>();
    assert_eq!(names(&new), expected);
    for ((name, old), (_, new)) in old.iter().zip(&new) {
        let differs = name == "modelDescription.xml" || name == "documentation/index.html";
        assert_eq!(old != new, differs, "{name}");
    }
    for (files, says_so) in [(&old, false), (&new, true)] {
        let page = &files.iter().find(|(name, _)| name == "documentation/index.html").unwrap().1;
        assert_eq!(String::from_utf8_lossy(page).contains("FMI 3.0"), says_so);
    }
}

#[test]
fn neither_version_takes_the_place_of_the_other() {
    let scene = feup();
    let places = ["FeupFrames.fmu", "FeupFrames.fmi3.fmu"].map(|name| root().join("target/fmu").join(name));
    let _ = std::fs::remove_file(&places[1]);
    let said = cargo_fmu(&[scene.to_str().unwrap(), "--fmi", "3"]);
    assert!(said.status.success() && stderr(&said).is_empty(), "{}", stderr(&said));
    assert!(stdout(&said).contains("  token        {") && stdout(&said).contains(HOST[1]), "{}", stdout(&said));
    assert!(std::fs::read(&places[1]).unwrap() == std::fs::read(fmi3_fmu()).unwrap());
    for wrong in ["1", "3.0", "", "two"] {
        let said = cargo_fmu(&[scene.to_str().unwrap(), &format!("--fmi={wrong}")]);
        assert_eq!(said.status.code(), Some(2));
        assert!(stderr(&said).contains("expected 2 or 3"), "{}", stderr(&said));
    }
}

#[test]
fn platforms_go_by_both_names_and_arm_needs_no_trick() {
    let directory = TempDir::new().unwrap();
    let put = |folder: &str, extension: &str, bytes: &[u8]| {
        let folder = directory.path().join("libraries").join(folder);
        std::fs::create_dir_all(&folder).unwrap();
        std::fs::write(folder.join(format!("pounding.{extension}")), bytes).unwrap();
    };
    put("win64", "dll", &library("win64"));
    put("aarch64-linux", "so", &library("aarch64-linux"));
    let build = |options: &[&str]| {
        let scene = feup();
        let basic = [scene.to_str().unwrap(), "--libraries", "libraries", "-o", "some.fmu"];
        cargo_fmu_in(directory.path(), &[&basic, options].concat())
    };
    let libraries = || {
        let names = files(&directory.path().join("some.fmu")).into_iter().map(|(name, _)| name);
        names.filter(|name| name.starts_with("binaries/")).collect::<Vec<_>>()
    };
    for version in ["2", "3"] {
        for platform in ["win64", "x86_64-windows"] {
            if cfg!(windows) {
                continue; // where such a library would be run
            }
            let said = build(&["--fmi", version, "--platform", platform]);
            assert!(said.status.success(), "{}", stderr(&said));
            let folder = if version == "2" { "win64" } else { "x86_64-windows" };
            assert_eq!(libraries(), [format!("binaries/{folder}/FeupFrames.dll")]);
        }
    }
    let said = build(&["--fmi", "3", "--platform", "aarch64-linux", "--arm-in-linux64"]);
    assert_eq!(said.status.code(), Some(1));
    assert!(stderr(&said).contains("--arm-in-linux64 is for FMI 2.0"), "{}", stderr(&said));
    // A library of old that knows FMI 2.0 only will do for that.
    put("win64", "dll", &exporting("win64", functions(FmiVersion::V2)));
    assert!(build(&["--platform", "win64"]).status.success() || cfg!(windows));
    let said = build(&["--fmi", "3", "--platform", "win64"]);
    assert!(stderr(&said).contains("fmi3DoStep"), "{}", stderr(&said));
}

#[test]
fn defects_of_the_description() {
    let lint = "description lint";
    let in_description = |old: &'static str, new: &'static str| move |files: &mut Files| change(files, 0, old, new);
    plant(in_description("name=\"time\"", "clocks=\"3\" name=\"time\""), "scene", "time: clocks \"3\"; expected none");
    plant(in_description("fmiVersion=\"3.0\"", "fmiVersion=\"3.1\""), "scene", "fmiVersion \"3.1\"; expected \"3.0\"");
    let velocity = "left.displacement[1]: declaredType \"Velocity\"; expected \"Length\"";
    plant(in_description("declaredType=\"Length\"", "declaredType=\"Velocity\""), "scene", velocity);
    plant(in_description("<InitialUnknown ", "<Output "), "description", "initial unknowns");
    plant(in_description("</ModelVariables>", ""), "description", "ModelVariables");
    plant(in_description("causality=\"independent\"", "causality=\"local\""), lint, "expected \"time\" alone");
    plant(in_description("start=\"3.65\"", "start=\"3.66\""), "start values", "left.mass[1]: start is");
    plant(in_description("instantiationToken=\"{", "instantiationToken=\"{0"), "start values", "oken");
    plant(|files| change(files, 2, "gap = 0.005", "gap = 0.004"), "start values", "oken");
}

#[test]
fn defects_of_libraries() {
    let add = |path: &'static str, bytes: Vec<u8>| {
        move |files: &mut Files| files.push((format!("binaries/{path}"), bytes.clone()))
    };
    plant(add("win64/FeupFrames.dll", library("win64")), "library", "expected the folder x86_64-windows");
    plant(add("x86_64-windows/FeupFrames.dll", b"MZ".to_vec()), "library", "no library that can be read");
    let all = functions(FmiVersion::V3);
    let one_less: Vec<&str> = all.iter().copied().filter(|name| *name != "fmi3GetShiftFraction").collect();
    let lacking = exporting("x86_64-windows", &one_less);
    plant(add("x86_64-windows/FeupFrames.dll", lacking), "exported functions", "fmi3GetShiftFraction is not exported");
    let older = exporting("x86_64-windows", functions(FmiVersion::V2));
    plant(add("x86_64-windows/FeupFrames.dll", older), "exported functions", "fmi3ActivateModelPartition");
    let (old, new) = (HOST[1], HOST[0]);
    plant(|files| files[1].0 = files[1].0.replace(old, new), "library", "the FMU has no library for this machine");
}

#[test]
fn fmus_of_one_version_are_merged() {
    let directory = TempDir::new().unwrap();
    let mut there = files(fmi3_fmu());
    there[1] = ("binaries/aarch64-linux/FeupFrames.so".into(), library("aarch64-linux"));
    write_fmu(&directory.path().join("there.fmu"), &there);
    let here = fmi3_fmu().to_str().unwrap();
    let merge = |one: &str| cargo_fmu_in(directory.path(), &["merge", one, "there.fmu", "-o", "both.fmu"]);
    let said = merge(here);
    assert!(said.status.success(), "{}", stderr(&said));
    assert!(stdout(&said).contains(&format!("aarch64-linux, {}", HOST[1])), "{}", stdout(&said));
    let (code, report) = checked(&directory.path().join("both.fmu"));
    assert_eq!(code, Some(0), "{report:#}");

    std::fs::remove_file(directory.path().join("both.fmu")).unwrap();
    let said = merge(feup_fmu().to_str().unwrap());
    assert_eq!(said.status.code(), Some(1));
    assert!(stderr(&said).contains("is FMI 2.0 and there.fmu is FMI 3.0: expected two FMUs"), "{}", stderr(&said));
    // A folder of FMI 2.0 in an FMU of FMI 3.0 is one that importers do not find.
    there[1] = ("binaries/win64/FeupFrames.dll".into(), library("win64"));
    write_fmu(&directory.path().join("there.fmu"), &there);
    let said = merge(here);
    assert!(stderr(&said).contains("expected the folder x86_64-windows"), "{}", stderr(&said));
    assert!(!directory.path().join("both.fmu").exists());
}
