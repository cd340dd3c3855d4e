//! The Python that the tests in Python run with: an environment below cargo's target directory that holds exactly what
//! lists of requirements say. It is kept until one of them changes.

use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// The Python of the environment in `home`. The first list is installed; the others are those that it includes.
pub fn environment(home: &Path, requirements: &[PathBuf]) -> PathBuf {
    let wanted: String = requirements.iter().map(|list| std::fs::read_to_string(list).unwrap()).collect();
    let python = home.join(if cfg!(windows) { "Scripts/python.exe" } else { "bin/python" });
    // Written last: an environment without it is not finished.
    let installed = home.join("requirements.installed");
    if std::fs::read_to_string(&installed).is_ok_and(|text| text == wanted) && python.exists() {
        return python;
    }
    let _ = std::fs::remove_dir_all(home);
    require(base().args(["-m", "venv"]).arg(home), "python3 -m venv (Debian: apt install python3-venv)");
    let install = ["-m", "pip", "install", "--quiet", "--disable-pip-version-check", "--requirement"];
    require(Command::new(&python).args(install).arg(&requirements[0]), "pip install");
    std::fs::write(&installed, wanted).unwrap();
    python
}

/// The Python that environments are made with, `PYTHON` or `python3`.
pub fn base() -> Command {
    let base: OsString = std::env::var_os("PYTHON").unwrap_or_else(|| "python3".into());
    Command::new(base)
}

/// What a command that must succeed prints.
pub fn require(command: &mut Command, what: &str) -> String {
    let Output { status, stdout, stderr } = command.output().unwrap_or_else(|error| panic!("{what}: {error}"));
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    assert!(status.success(), "{what} failed:\n{}\n{}", text(&stdout), text(&stderr));
    text(&stdout)
}
