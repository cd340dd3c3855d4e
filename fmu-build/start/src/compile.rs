//! The one way in which a checkout compiles the command and the library of its FMUs.

use crate::watch::watch;
use std::ffi::{OsStr, OsString};
use std::io;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The package with the command, and the one with the library that goes into FMUs.
const PACKAGES: [&str; 2] = ["fmu-build", "pounding-library"];

/// The programs and libraries that cargo has compiled, wherever it has put them.
pub struct Compiled(Vec<PathBuf>);

impl Compiled {
    /// The command.
    pub fn command(&self) -> Option<&Path> {
        self.found(std::env::consts::EXE_EXTENSION)
    }

    /// The library of FMUs.
    pub fn library(&self) -> Option<&Path> {
        self.found(std::env::consts::DLL_EXTENSION)
    }

    fn found(&self, extension: &str) -> Option<&Path> {
        self.0.iter().map(PathBuf::as_path).find(|file| file.extension().unwrap_or_default() == extension)
    }
}

/// Compiles command and library, the command with what `check` needs where that is wanted; `show` gets what cargo is at.
///
/// # Errors
/// What cargo says is wrong.
pub fn compile(checkout: &Path, with_check: bool, show: impl FnMut(&str)) -> io::Result<Compiled> {
    let mut cargo = Command::new(cargo());
    cargo.args(["build", "--profile", "quick", "--message-format=json-render-diagnostics"]).current_dir(checkout);
    for package in PACKAGES {
        cargo.args(["--package", package]);
    }
    match with_check {
        true => cargo.args(["--lib", "--bin", "cargo-fmu-check", "--features", "check"]),
        false => cargo.args(["--lib", "--bin", "cargo-fmu"]),
    };
    // The functions of FMI have their names in what is compiled here, and in nothing else. Flags of the user's own, which
    // these replace, would make it another library than that of everybody.
    let flags = [vec!["--cfg".into(), "fmi_exports".into()], remapping(checkout)].concat();
    cargo.env("CARGO_ENCODED_RUSTFLAGS", flags.join(OsStr::new("\u{1f}")));
    let done = watch(cargo, show).map_err(|error| io::Error::other(format!("cannot start cargo: {error}")))?;
    if !done.status.success() {
        return Err(io::Error::other(format!("it does not compile:\n{}", done.complaints.trim_end())));
    }
    Ok(Compiled(done.output.lines().flat_map(files).collect()))
}

/// The cargo that runs this program, else the one on the path.
pub fn cargo() -> OsString {
    std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into())
}

/// Flags that keep the paths of this machine out of what is compiled: whoever builds a scene, wherever the checkout lies,
/// gets the same bytes and gives no home directory away.
fn remapping(checkout: &Path) -> Vec<OsString> {
    let cargo_home = std::env::var_os("CARGO_HOME").map(PathBuf::from);
    let cargo_home = cargo_home.or_else(|| std::env::home_dir().map(|home| home.join(".cargo")));
    let prefixes = cargo_home.iter().map(|home| (home.as_path(), "/cargo")).chain([(checkout, "/pounding-fmu")]);
    let flag = |(path, name): (&Path, &str)| {
        let mut flag = OsString::from("--remap-path-prefix=");
        flag.push(path);
        flag.push(format!("={name}"));
        flag
    };
    prefixes.map(flag).collect()
}

/// The files that one of cargo's messages says are compiled: a program by itself, a library in a list.
fn files(message: &str) -> Vec<PathBuf> {
    let of = |key: &str, end: &str| Some(message.split_once(key)?.1.split_once(end)?.0);
    if let Some(program) = of("\"executable\":\"", "\",") {
        return vec![path(program)];
    }
    let is_library = message.contains("\"crate_types\":[\"cdylib\"]");
    let list = of("\"filenames\":[", "],\"").filter(|_| is_library).unwrap_or_default();
    // What stands between quotes, where a comma is part of a path.
    list.split('"').skip(1).step_by(2).map(path).collect()
}

/// As it was before it became part of a message.
fn path(text: &str) -> PathBuf {
    text.replace("\\\\", "\\").into()
}

#[cfg(test)]
mod tests {
    use super::files;
    use std::path::Path;

    #[test]
    fn paths_are_read_whole() {
        let library = "{\"crate_types\":[\"cdylib\"],\"filenames\":[\"/a, b [c]/lib.so\",\"C:\\\\d\\\\e.dll\"],\"executable\":null}";
        assert_eq!(files(library), [Path::new("/a, b [c]/lib.so"), Path::new("C:\\d\\e.dll")]);
        let program =
            "{\"crate_types\":[\"bin\"],\"filenames\":[\"/x\"],\"executable\":\"/a, b [c]/cargo-fmu\",\"fresh\":true}";
        assert_eq!(files(program), [Path::new("/a, b [c]/cargo-fmu")]);
        assert!(files("{\"crate_types\":[\"lib\"],\"filenames\":[\"/x.rlib\"],\"executable\":null}").is_empty());
    }
}
