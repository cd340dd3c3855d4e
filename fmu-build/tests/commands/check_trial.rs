//! `cargo fmu check` on FMUs whose library is not to be trusted: it always comes to an end, and says what happened.

use crate::common::libraries::{functions, library, universal};
use crate::common::{Files, cargo_fmu, changed_description, feup_fmu, files, replace_once, stderr, stdout, write_fmu};
use pounding::FmiVersion;
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

/// The FMU with a library that exports what it should, and does something when it is loaded or instantiated.
#[cfg(target_os = "linux")]
fn with_library(on_load: &str, on_instantiate: &str) -> Files {
    let directory = TempDir::new().unwrap();
    let (source, library) = (directory.path().join("evil.rs"), directory.path().join("evil.so"));
    let functions = functions(FmiVersion::V2).iter().map(|name| {
        let body = if *name == "fmi2Instantiate" { on_instantiate } else { "" };
        format!("#[no_mangle] pub extern \"C\" fn {name}() -> usize {{ unsafe {{ {body}; }} 0 }}\n")
    });
    let code = format!(
        "#![allow(unused, clashing_extern_declarations)]\n\
         extern \"C\" {{ fn _exit(code: i32) -> !; fn write(file: i32, text: *const u8, length: usize) -> isize;\n\
         fn fork() -> i32; fn sleep(seconds: u32) -> u32; fn close(file: i32) -> i32; fn raise(signal: i32) -> i32;\n\
         fn chdir(path: *const u8) -> i32; }}\n\
         #[used] #[link_section = \".init_array\"] static ON_LOAD: extern \"C\" fn() = on_load;\n\
         extern \"C\" fn on_load() {{ unsafe {{ {on_load}; }} }}\n{}",
        functions.collect::<String>()
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

/// What a check finds under the name of what it was at, with a library that must be found.
#[cfg(target_os = "linux")]
fn found(on_load: &str, on_instantiate: &str, name: &str) -> String {
    let (code, report) = check(&with_library(on_load, on_instantiate), "30");
    assert_eq!((code, &report["valid"]), (Some(1), &Value::Bool(false)), "{report:#}");
    assert!(report.get("run").is_none(), "{report:#}");
    assert!(report.to_string().len() < 20_000, "{} bytes", report.to_string().len());
    finding(&report, name)
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
    let said = found("std::process::abort()", "", "library");
    assert!(said.contains("came to a bad end") && said.contains("signal"), "{said}");
    assert!(found("raise(9)", "", "library").contains("signal: 9"));
    assert!(found("", "(8 as *mut u8).write_volatile(1)", "guid").contains("signal: 11"));

    let (code, report) = check(&with_library("loop { std::thread::yield_now() }", ""), "2");
    assert_eq!(code, Some(1), "{report:#}");
    assert!(finding(&report, "library").contains("not over after 2 s"), "{report:#}");
}

/// A library may say what it likes, wherever it can write: what it says is no finding, and no verdict.
#[test]
#[cfg(target_os = "linux")]
fn a_library_cannot_speak_for_the_check() {
    let lines = "\n\"Over\"\n{\"Over\":1}\n{\"Found\":[\"run\",{\"texts\":[],\"more\":0}]}\n";
    let forged = format!("let text = {lines:?}; for file in 0..64 {{ write(file, text.as_ptr(), text.len()); }}");
    for end in ["_exit(0)", "std::process::exit(0)"] {
        let said = found(&format!("{forged} {end}"), "", "library");
        assert!(said.contains("came to a bad end before all was tried: exit status: 0"), "{said}");
        assert!(said.contains("its output begins") && said.contains("Over"), "{said}");
        let said = found("", &format!("{forged} {end}"), "guid");
        assert!(said.contains("exit status: 0"), "{said}");
    }
    // Where it goes on, so does the check.
    for harmless in [&forged, "chdir(b\"/\\0\".as_ptr())"] {
        // It is no FMU that can be instantiated, then.
        assert_eq!(found(harmless, "", "start values"), "[\"FMI call failed\"]");
    }
    // A copy of the process that goes on alone is not the process.
    assert!(found("if fork() != 0 { _exit(0) }", "", "start values").contains("came to a bad end"));
    // What is wrong with its own channel is found, too.
    assert!(found("for file in 0..1000 { close(file); }", "", "library").contains("came to a bad end"));
}

#[test]
#[cfg(target_os = "linux")]
fn a_library_that_says_much_is_cut_short() {
    let much =
        "let text = [b'x'; 65536]; for _ in 0..500 { for file in 1..64 { write(file, text.as_ptr(), text.len()); } }";
    let said = found(&format!("{much} std::process::abort()"), "", "library");
    assert!(said.contains("signal: 6") && said.contains("xxx"), "{said}");
}

/// Neither is a process waited for that the library leaves behind, nor does it stay.
#[test]
#[cfg(target_os = "linux")]
fn what_a_library_starts_ends_with_the_check() {
    let directory = TempDir::new().unwrap();
    let note = directory.path().join("child");
    let child = format!("std::fs::write({note:?}, std::process::id().to_string()).unwrap(); sleep(100); _exit(0)");
    let clock = Instant::now();
    let said = found(&format!("if fork() == 0 {{ {child} }} sleep(2); _exit(0)"), "", "library");
    assert!(said.contains("exit status: 0"), "{said}");
    assert!(clock.elapsed() < Duration::from_secs(60), "{:?}", clock.elapsed());
    let child = PathBuf::from("/proc").join(std::fs::read_to_string(note).unwrap()).join("cmdline");
    // One that has ended but that nobody has asked for has no command line any more.
    let has_ended = || std::fs::read(&child).unwrap_or_default().is_empty().then_some(());
    assert!(within_seconds(20, has_ended).is_some(), "the child goes on");
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
    for (folder, extension) in
        [("win64", "dll"), ("aarch64-darwin", "dylib"), ("aarch64-linux", "so"), ("aarch64-windows", "dll")]
    {
        files.push((format!("binaries/{folder}/FeupFrames.{extension}"), library(folder)));
    }
    files.push(("binaries/darwin64/FeupFrames.dylib".into(), universal(&["aarch64-darwin", "darwin64"])));
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
