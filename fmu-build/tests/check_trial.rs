//! `cargo fmu check` on FMUs whose library is not to be trusted: it always comes to an end, and says what happened.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod common;

use common::{Files, cargo_fmu, changed_description, feup_fmu, files, replace_once, stderr, stdout, write_fmu};
use serde_json::Value;
use std::path::PathBuf;
use std::process::Command;
use std::time::{Duration, Instant};
use tempfile::TempDir;

/// Exit code and report of a check that must be over soon after its time limit.
fn check(files: &Files, limit: &str) -> (Option<i32>, Value) {
    let directory = TempDir::new().unwrap();
    let fmu = directory.path().join("some.fmu");
    write_fmu(&fmu, files);
    let clock = Instant::now();
    let output = cargo_fmu(&["check", fmu.to_str().unwrap(), "--json", "--time-limit", limit]);
    assert!(clock.elapsed() < Duration::from_secs(40), "{:?}", clock.elapsed());
    assert_eq!(stderr(&output), "");
    (output.status.code(), serde_json::from_str(&stdout(&output)).unwrap())
}

fn finding(report: &Value, check: &str) -> String {
    let checks = report["checks"].as_array().unwrap();
    checks.iter().find(|c| c["name"] == check).map_or(String::new(), |c| c["findings"].to_string())
}

/// The FMU with a library that does something when it is loaded.
#[cfg(target_os = "linux")]
fn with_library(on_load: &str) -> Files {
    let directory = TempDir::new().unwrap();
    let (source, library) = (directory.path().join("evil.rs"), directory.path().join("evil.so"));
    let code = format!(
        "#[used] #[link_section = \".init_array\"] static ON_LOAD: extern \"C\" fn() = on_load;\n\
         extern \"C\" fn on_load() {{ {on_load} }}\n"
    );
    std::fs::write(&source, code).unwrap();
    let rustc = std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
    let mut command = Command::new(rustc);
    command.args(["--edition", "2021", "--crate-type", "cdylib", "-o"]).arg(&library).arg(&source);
    assert!(command.status().unwrap().success());
    let mut files = files(feup_fmu());
    files[1].1 = std::fs::read(&library).unwrap();
    files
}

#[test]
fn a_run_that_takes_too_long_is_stopped() {
    let (code, report) =
        check(&changed_description(|text| replace_once(text, "stopTime=\"20\"", "stopTime=\"1e9\"")), "2");
    assert_eq!(code, Some(1), "{report:#}");
    assert!(finding(&report, "run").contains("not over after 2 s"), "{report:#}");
    assert_eq!(finding(&report, "start values"), "[]", "what was found before is kept");
    assert!(report.get("run").is_none());
}

#[test]
#[cfg(target_os = "linux")]
fn a_library_that_crashes_or_hangs_is_a_finding() {
    let (code, report) = check(&with_library("std::process::abort()"), "30");
    assert_eq!(code, Some(1), "{report:#}");
    let said = finding(&report, "library");
    assert!(said.contains("came to a bad end") && said.contains("signal"), "{report:#}");

    let (code, report) = check(&with_library("loop { std::thread::yield_now() }"), "2");
    assert_eq!(code, Some(1), "{report:#}");
    assert!(finding(&report, "library").contains("not over after 2 s"), "{report:#}");

    // Output of its own, even where it looks like a finding, does not mislead.
    let (code, report) = check(&with_library("print!(\"{{\\\"Begins\\\": \"); std::process::exit(0)"), "30");
    assert_eq!(code, Some(1), "{report:#}");
}

/// What reads the description is not ours and may not stand everything, or not soon: here it compares each attribute
/// with all before it.
#[test]
fn a_description_that_its_reader_cannot_cope_with_is_a_finding() {
    let attributes: String = (0..500_000).map(|k| format!(" a{k}=\"\"")).collect();
    let annotation = format!("<VendorAnnotations><Tool name=\"x\"{attributes}/></VendorAnnotations><ModelVariables>");
    let files = changed_description(|text| replace_once(text, "<ModelVariables>", &annotation));
    let (code, report) = check(&files, "2");
    assert_eq!(code, Some(1), "{report:#}");
    assert_eq!(finding(&report, "archive"), "[]", "{report:#}");
    assert!(report["checks"].to_string().contains("not over after 2 s"), "{report:#}");
}

#[test]
#[cfg(target_os = "linux")]
fn who_stops_the_check_stops_its_trial() {
    let directory = TempDir::new().unwrap();
    let fmu = directory.path().join("endless.fmu");
    write_fmu(&fmu, &changed_description(|text| replace_once(text, "stopTime=\"20\"", "stopTime=\"1e9\"")));
    let mut check = Command::new(env!("CARGO_BIN_EXE_cargo-fmu")).arg("check").arg(&fmu).spawn().unwrap();
    let children = format!("/proc/{0}/task/{0}/children", check.id());
    let trial = within_seconds(20, || {
        let text = std::fs::read_to_string(&children).unwrap_or_default();
        let trial = PathBuf::from("/proc").join(text.split_whitespace().next()?);
        let libraries = std::fs::read_to_string(trial.join("maps")).unwrap_or_default();
        libraries.contains("FeupFrames.so").then_some(trial)
    });
    let trial = trial.expect("a process that has loaded the library");
    // It is in the middle of the run then, and has nothing to say.
    std::thread::sleep(Duration::from_secs(1));
    check.kill().unwrap();
    check.wait().unwrap();
    assert!(within_seconds(20, || (!trial.exists()).then_some(())).is_some(), "the trial goes on");
}

#[cfg(target_os = "linux")]
fn within_seconds<T>(seconds: u64, mut look: impl FnMut() -> Option<T>) -> Option<T> {
    let clock = Instant::now();
    loop {
        match look() {
            None if clock.elapsed().as_secs() < seconds => std::thread::sleep(Duration::from_millis(20)),
            seen => return seen,
        }
    }
}

#[test]
fn libraries_for_other_platforms_do_no_harm() {
    let mut files = files(feup_fmu());
    for library in
        ["binaries/win64/FeupFrames.dll", "binaries/darwin64/FeupFrames.dylib", "binaries/linux32/FeupFrames.so"]
    {
        files.push((library.into(), b"for another machine".to_vec()));
    }
    files.push(("binaries/darwin64/".into(), Vec::new()));
    let (code, report) = check(&files, "300");
    assert_eq!(code, Some(0), "{report:#}");

    files.push(("binaries/win32/feup.dll".into(), Vec::new()));
    let (code, report) = check(&files, "300");
    assert_eq!(code, Some(1), "{report:#}");
    assert!(finding(&report, "file names").contains("expected binaries/<platform>/FeupFrames"), "{report:#}");
}

#[test]
fn an_fmu_of_others_is_neither_inspected_nor_run() {
    let foreign = |change: fn(&str) -> String, expected: &str| {
        let (code, report) = check(&changed_description(change), "30");
        assert_eq!(code, Some(1), "{report:#}");
        assert!(finding(&report, "origin").contains(expected), "{report:#}");
        let names = report["checks"].as_array().unwrap().iter().map(|check| &check["name"]).collect::<Vec<_>>();
        assert_eq!(names, ["archive", "description", "origin"]);
    };
    foreign(|text| replace_once(text, "generationTool=\"pounding-fmu", "generationTool=\"Other"), "made by");
    foreign(|text| replace_once(text, "generationTool=", "author="), "does not say which tool made it");
    let fmi3 =
        |_: &str| "<fmiModelDescription fmiVersion=\"3.0\" modelName=\"x\" generationTool=\"Tool 3\"/>".to_owned();
    foreign(fmi3, "made by \\\"Tool 3\\\"");
}

#[test]
fn a_time_limit_is_a_number_of_seconds() {
    for limit in ["0", "-1", "nan", "inf", "1e300", "soon", ""] {
        let output = cargo_fmu(&["check", "some.fmu", &format!("--time-limit={limit}")]);
        assert_eq!(output.status.code(), Some(2), "{limit}");
        assert_eq!(stdout(&output), "");
        assert!(stderr(&output).contains("time-limit"), "{}", stderr(&output));
    }
}
