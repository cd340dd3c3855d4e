//! Where the shared library is that `cargo fmu` packs into FMUs, for the few tests that load it.
#![allow(clippy::unwrap_used)]

use std::path::{Path, PathBuf};

/// Tells where the library is, if it is compiled already.
const LIBRARY: &str = "POUNDING_LIBRARY";

/// Compiled if need be, as `cargo fmu` does it.
pub fn library_path() -> PathBuf {
    std::env::var_os(LIBRARY).map_or_else(compiled_library, PathBuf::from)
}

fn compiled_library() -> PathBuf {
    let compiled = fmu_start::compile(Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap(), true, |_| {}).unwrap();
    compiled.library().unwrap().to_path_buf()
}
