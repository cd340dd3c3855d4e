//! The Python that the tests in Python run with: an environment below `target/` that `ci/environment` makes.

use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// The Python of the environment for a folder of this checkout, with the wheel installed where that is `examples`.
pub fn environment(root: &Path, folder: &str) -> PathBuf {
    let base: OsString = std::env::var_os("PYTHON").unwrap_or_else(|| "python3".into());
    let printed = require(Command::new(base).arg(root.join("ci/environment")).arg(folder), "ci/environment");
    printed.trim().into()
}

/// What a command that must succeed prints.
pub fn require(command: &mut Command, what: &str) -> String {
    let Output { status, stdout, stderr } = command.output().unwrap_or_else(|error| panic!("{what}: {error}"));
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    assert!(status.success(), "{what} failed:\n{}\n{}", text(&stdout), text(&stderr));
    text(&stdout)
}
