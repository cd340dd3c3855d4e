//! Keeps what is linked in from being called by others: an importer of FMUs has C functions with names of its own, which
//! another importer in the same Python must not take for its own.

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    if std::env::var("CARGO_CFG_TARGET_OS").is_ok_and(|system| system == "linux") {
        println!("cargo::rustc-link-arg-cdylib=-Wl,--exclude-libs=ALL");
    }
}
