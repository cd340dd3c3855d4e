//! What is seen of cargo at work, with a package of one line.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use fmu_start::{Done, watch};
use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::process::Command;

/// A package in a directory of its own, below cargo's for tests.
fn package(name: &str, code: &str) -> PathBuf {
    let directory = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = fs::remove_dir_all(&directory);
    fs::create_dir_all(directory.join("src")).unwrap();
    let manifest = format!("[package]\nname = \"{name}\"\nedition = \"2024\"\n[workspace]\n");
    fs::write(directory.join("Cargo.toml"), manifest).unwrap();
    fs::write(directory.join("src/main.rs"), code).unwrap();
    directory
}

fn build(package: &Path, show: impl FnMut(&str)) -> Done {
    let mut cargo = Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    cargo.args(["build", "--offline", "--message-format=json-render-diagnostics", "--target-dir"]);
    cargo.arg(package.join("target")).current_dir(package);
    watch(cargo, show).unwrap()
}

#[test]
fn compiling_is_seen_and_nothing_when_there_is_nothing_to_compile() {
    let package = package("one_line", "fn main() {}");
    let mut states = Vec::new();
    let done = build(&package, |state| states.push(state.to_owned()));
    assert!(done.status.success() && done.output.contains("\"executable\":\""), "{}", done.complaints);
    assert!(states.iter().any(|state| state.starts_with("Building [") && state.contains("0/1")), "{states:?}");
    assert!(states.iter().all(|state| !state.contains(char::is_control) && state.len() < 60), "{states:?}");
    assert_eq!(done.complaints, "");
    let done = build(&package, |state| assert!(!state.starts_with("Building"), "{state}"));
    assert_eq!((done.status.success(), done.complaints.as_str()), (true, ""));
}

#[test]
fn what_does_not_compile_is_a_complaint() {
    let done = build(&package("wrong_line", "fn main() { nonsense }"), |_| {});
    assert!(!done.status.success());
    assert!(done.complaints.starts_with("error[E0425]: cannot find value `nonsense`"), "{}", done.complaints);
    assert!(!done.complaints.contains("Compiling") && !done.complaints.contains('\r'), "{}", done.complaints);
}

#[test]
fn the_wait_for_another_cargo_is_seen() {
    let package = package("locked", "fn main() {}");
    build(&package, |_| {});
    let lock = File::options().write(true).open(package.join("target/debug/.cargo-lock")).unwrap();
    lock.lock().unwrap();
    let holder = std::thread::spawn(move || {
        std::thread::sleep(std::time::Duration::from_secs(2));
        drop(lock);
    });
    let mut waits = 0;
    build(&package, |state| waits += usize::from(state.starts_with("Blocking waiting for file lock")));
    assert!(waits > 0);
    holder.join().unwrap();
}
