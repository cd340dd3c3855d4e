//! Keeps what is linked in from being called by others: an importer of FMUs has C functions with names of its own, which
//! another importer in the same Python must not take for its own.

use std::env;

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rerun-if-changed=exports.map");
    println!("cargo::rerun-if-env-changed=CARGO_ZIGBUILD_TARGET");
    let folder = env::var("CARGO_MANIFEST_DIR").unwrap_or_default();
    if env::var("CARGO_CFG_TARGET_OS").is_ok_and(|system| system == "linux") {
        // Of two version scripts, one being rustc's, zig takes the last; others refuse them, and zig what they take.
        let is_zig = env::var_os("CARGO_ZIGBUILD_TARGET").is_some();
        let argument =
            if is_zig { format!("--version-script={folder}/exports.map") } else { "--exclude-libs=ALL".into() };
        println!("cargo::rustc-link-arg-cdylib=-Wl,{argument}");
    }
}
