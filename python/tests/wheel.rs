//! Builds the wheel, installs it into an environment of its own and runs the tests in this folder there, where neither
//! cargo nor a compiler is on the path.
//!
//! They need Python 3.11 or later and nothing else: what they run with comes below cargo's target directory.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap()
}

#[test]
fn wheel() {
    let built = require(python().arg(root().join("ci/wheel")).arg("--dev"), "ci/wheel");
    let wheel = built.lines().last().expect("the path of the wheel");
    let environment = environment();
    let install = ["-m", "pip", "install", "--quiet", "--disable-pip-version-check", "--no-deps", "--force-reinstall"];
    require(Command::new(&environment).args(install).arg(wheel), "pip install");

    let tests = root().join("python/tests");
    let mut pytest = Command::new(&environment);
    pytest.args(["-m", "pytest", "--quiet", "-p", "no:cacheprovider", "--doctest-modules"]);
    pytest.arg(&tests).args(["--pyargs", "pounding_fmu"]).current_dir(&tests);
    pytest.env("PATH", environment.parent().unwrap()).env("REFERENCE_FMUS", reference_fmus());
    pytest.env("PYTHONDONTWRITEBYTECODE", "1");
    println!("{}", require(&mut pytest, "pytest"));
}

/// The FMUs of the scenes that travel in the wheel, as `cargo fmu` makes them.
fn reference_fmus() -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("reference-fmus");
    for scene in std::fs::read_dir(root().join("examples/scenes")).unwrap().map(|entry| entry.unwrap().path()) {
        let fmu = folder.join(scene.file_name().unwrap()).with_extension("fmu");
        let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
        require(Command::new(cargo).current_dir(root()).arg("fmu").arg(&scene).arg("-o").arg(fmu), "cargo fmu");
    }
    folder
}

/// The Python of an environment that holds exactly what `requirements.txt` and the list that it includes say, and the wheel.
fn environment() -> PathBuf {
    let requirements = root().join("python/tests/requirements.txt");
    let files = [requirements.clone(), root().join("tests/python/requirements.txt")];
    let wanted = files.map(|file| std::fs::read_to_string(file).unwrap()).concat();
    let home = Path::new(env!("CARGO_TARGET_TMPDIR")).join("wheel");
    let python_here = home.join(if cfg!(windows) { "Scripts/python.exe" } else { "bin/python" });
    // Written last: an environment without it is not finished.
    let installed = home.join("requirements.installed");
    if std::fs::read_to_string(&installed).is_ok_and(|text| text == wanted) && python_here.exists() {
        return python_here;
    }
    let _ = std::fs::remove_dir_all(&home);
    require(python().args(["-m", "venv"]).arg(&home), "python3 -m venv (Debian: apt install python3-venv)");
    let install = ["-m", "pip", "install", "--quiet", "--disable-pip-version-check", "--requirement"];
    require(Command::new(&python_here).args(install).arg(&requirements), "pip install");
    std::fs::write(&installed, wanted).unwrap();
    python_here
}

fn python() -> Command {
    let base: OsString = std::env::var_os("PYTHON").unwrap_or_else(|| "python3".into());
    Command::new(base)
}

/// What a command that must succeed prints.
fn require(command: &mut Command, what: &str) -> String {
    let Output { status, stdout, stderr } = command.output().unwrap_or_else(|error| panic!("{what}: {error}"));
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    assert!(status.success(), "{what} failed:\n{}\n{}", text(&stdout), text(&stderr));
    text(&stdout)
}
