//! Runs the tests in `tests/python/`: the FMUs as FMPy, an importer that is not ours, sees them.
//!
//! They need Python 3.11 or later and nothing else: an environment with the packages of `requirements.txt` is made below
//! cargo's target directory and kept until that file changes.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

#[test]
fn python() {
    let cargo_fmu = built(&["--package", "fmu-build", "--bin", "cargo-fmu"]);
    let simulate = built(&["--example", "simulate"]);
    let output = Command::new(environment())
        .args(["-m", "pytest", "--quiet", "-p", "no:cacheprovider", "tests/python"])
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .env("PYTHONDONTWRITEBYTECODE", "1")
        .env("CARGO_FMU", cargo_fmu)
        .env("SIMULATE", simulate)
        .output()
        .expect("the Python of the environment starts");
    require(&output, "pytest");
}

/// Builds a program of the workspace as a user does, optimised, and returns where cargo has put it.
///
/// Cargo itself holds no lock while it runs tests, so the nested call waits for nobody.
fn built(what: &[&str]) -> PathBuf {
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let output = Command::new(cargo)
        .args(["build", "--release", "--quiet", "--message-format=json-render-diagnostics"])
        .args(what)
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .expect("cargo starts");
    require(&output, "cargo build");
    let messages = String::from_utf8(output.stdout).unwrap();
    let executable =
        |line: &str| Some(line.split_once("\"executable\":\"")?.1.split_once('"')?.0.replace("\\\\", "\\"));
    messages.lines().find_map(executable).expect("cargo says where the program is").into()
}

/// The Python of an environment that holds exactly what `requirements.txt` says.
fn environment() -> PathBuf {
    let requirements = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/python/requirements.txt");
    let wanted = std::fs::read_to_string(&requirements).unwrap();
    let home = Path::new(env!("CARGO_TARGET_TMPDIR")).join("python");
    let python = home.join(if cfg!(windows) { "Scripts/python.exe" } else { "bin/python" });
    // Written last: an environment without it is not finished.
    let installed = home.join("requirements.installed");
    if std::fs::read_to_string(&installed).is_ok_and(|text| text == wanted) && python.exists() {
        return python;
    }
    let _ = std::fs::remove_dir_all(&home);
    let base: OsString = std::env::var_os("PYTHON").unwrap_or_else(|| "python3".into());
    run(Command::new(base).args(["-m", "venv"]).arg(&home), "python3 -m venv (Debian: apt install python3-venv)");
    run(
        Command::new(&python)
            .args(["-m", "pip", "install", "--quiet", "--disable-pip-version-check", "--requirement"])
            .arg(&requirements),
        "pip install",
    );
    std::fs::write(&installed, wanted).unwrap();
    python
}

fn run(command: &mut Command, what: &str) {
    let output = command.output().unwrap_or_else(|error| panic!("{what}: {error}"));
    require(&output, what);
}

fn require(output: &Output, what: &str) {
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    assert!(output.status.success(), "{what} failed:\n{}\n{}", text(&output.stdout), text(&output.stderr));
}
