//! Where FMI 2.0 wants the library of each platform.

use std::env::consts::{ARCH, DLL_EXTENSION, OS};

/// The folder of the host's library below `binaries/`, such as `linux64`.
///
/// FMI 2.0 defines the names for Intel processors only. FMPy looks for `linux64` and `darwin64` on Arm too; other
/// importers use `<architecture>-<system>` there, the names of FMI 3.0.
pub fn folder() -> String {
    match (OS, ARCH) {
        ("linux", "x86_64") => "linux64".into(),
        ("linux", "x86") => "linux32".into(),
        ("windows", "x86_64") => "win64".into(),
        ("windows", "x86") => "win32".into(),
        ("macos", "x86_64") => "darwin64".into(),
        ("macos", arch) => format!("{arch}-darwin"),
        (system, arch) => format!("{arch}-{system}"),
    }
}

/// Path inside the FMU of the host's library.
pub fn library_path(model_identifier: &str) -> String {
    format!("binaries/{}/{model_identifier}.{DLL_EXTENSION}", folder())
}
