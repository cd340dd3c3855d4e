//! Builds the wheel, installs it into an environment and runs the tests in this folder there, where neither cargo nor a
//! compiler is on the path.
//!
//! They need Python 3.11 or later and nothing else: what they run with comes below `target/`.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

#[path = "../../tests/support/python_environment.rs"]
mod python_environment;

use python_environment::{environment, require};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::SystemTime;

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap()
}

#[test]
fn wheel() {
    let before = engines();
    let environment = environment(root(), "examples");
    assert_eq!(engines(), before, "the wheel compiles the engine again: with other features of a crate than the tests");
    let tests = root().join("python/tests");
    let mut pytest = Command::new(&environment);
    pytest.args(["-m", "pytest", "--quiet", "-p", "no:cacheprovider", "--numprocesses", "auto", "--doctest-modules"]);
    pytest.arg(&tests).args(["--pyargs", "pounding_fmu"]).current_dir(&tests);
    pytest.env("PATH", environment.parent().unwrap()).env("REFERENCE_FMUS", reference_fmus());
    pytest.env("PYTHONDONTWRITEBYTECODE", "1");
    println!("{}", require(&mut pytest, "pytest"));
}

/// What the engine has been compiled into beside these tests, and when.
fn engines() -> BTreeMap<PathBuf, SystemTime> {
    let here = std::env::current_exe().unwrap();
    let files = std::fs::read_dir(here.parent().unwrap()).unwrap().map(|entry| entry.unwrap().path());
    let is_engine = |file: &PathBuf| file.to_string_lossy().contains("libpounding-");
    files.filter(is_engine).map(|file| (file.clone(), file.metadata().unwrap().modified().unwrap())).collect()
}

/// The FMUs of the scenes that travel in the wheel, as `cargo fmu` makes them.
fn reference_fmus() -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("reference-fmus");
    let compiled = fmu_start::compile(root(), true, |_| {}).unwrap();
    for scene in std::fs::read_dir(root().join("examples/scenes")).unwrap().map(|entry| entry.unwrap().path()) {
        let fmu = folder.join(scene.file_name().unwrap()).with_extension("fmu");
        require(Command::new(compiled.command().unwrap()).arg(&scene).arg("-o").arg(fmu), "cargo fmu");
    }
    folder
}
