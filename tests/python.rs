//! Runs the tests in `tests/python/`: the FMUs as FMPy, an importer that is not ours, sees them.
//!
//! They need Python 3.11 or later and nothing else: an environment with the packages of `requirements.txt` is made below
//! `target/` and kept until that file changes.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

#[path = "support/python_environment.rs"]
mod python_environment;

use python_environment::{environment, require};
use std::path::{Path, PathBuf};
use std::process::Command;

#[test]
fn python() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap();
    let compiled = fmu_start::compile(root, true, |_| {}).unwrap();
    let mut pytest = Command::new(environment(root, "tests/python"));
    pytest
        .args(["-m", "pytest", "--quiet", "-p", "no:cacheprovider", "--numprocesses", "auto", "tests/python"])
        .current_dir(root)
        .env("PYTHONDONTWRITEBYTECODE", "1")
        .env("CARGO_FMU", compiled.command().unwrap())
        .env("SIMULATE", simulate(root));
    require(&mut pytest, "pytest");
}

/// The program of the engine alone, as `cargo test` compiles it, and where cargo has put it.
///
/// Cargo itself holds no lock while it runs tests, so the nested call waits for nobody.
fn simulate(root: &Path) -> PathBuf {
    let mut build = Command::new(fmu_start::cargo());
    build.args(["build", "--workspace", "--example", "simulate", "--quiet"]);
    build.arg("--message-format=json-render-diagnostics").current_dir(root);
    let messages = require(&mut build, "cargo build");
    let executable =
        |line: &str| Some(line.split_once("\"executable\":\"")?.1.split_once('"')?.0.replace("\\\\", "\\"));
    messages.lines().find_map(executable).expect("cargo says where the program is").into()
}
