//! Where the shared library of the crate is, for the few tests that load it.
#![allow(clippy::unwrap_used, clippy::expect_used)]

use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::OnceLock;

/// Tells where the library is, if it is compiled already.
const LIBRARY: &str = "POUNDING_LIBRARY";

/// The shared library of the crate, compiled as these tests are: cargo makes it of the same sources on demand.
pub fn library_path() -> &'static Path {
    static PATH: OnceLock<PathBuf> = OnceLock::new();
    PATH.get_or_init(|| std::env::var_os(LIBRARY).map_or_else(compiled_library, PathBuf::from))
}

fn compiled_library() -> PathBuf {
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let output = Command::new(cargo)
        .args(["rustc", "--lib", "--crate-type", "cdylib", "--quiet", "--message-format=json-render-diagnostics"])
        .args(["--profile", if cfg!(debug_assertions) { "dev" } else { "release" }, "--", "--cfg", "fmi_exports"])
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let messages = output.stdout.split(|byte| *byte == b'\n').filter_map(|line| serde_json::from_slice(line).ok());
    let files = messages.flat_map(|message: Value| message["filenames"].as_array().cloned().unwrap_or_default());
    let is_library = |path: &PathBuf| path.extension().is_some_and(|e| e == std::env::consts::DLL_EXTENSION);
    let mut libraries = files.filter_map(|file| file.as_str().map(PathBuf::from)).filter(is_library);
    // Those before it are macros of the compiler.
    libraries.next_back().expect("cargo says where the library is")
}
