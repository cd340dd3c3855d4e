//! Commands that take turns compile nothing. A program of its own: while it looks nobody else may compile.
#![allow(clippy::unwrap_used, clippy::expect_used)]

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::SystemTime;
use tempfile::TempDir;

/// Runs a cargo command as a user does, except that this test has been told where cargo is; what it says of its work.
fn cargo(arguments: &[&str]) -> String {
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let checkout = Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap();
    let output = Command::new(cargo).args(arguments).current_dir(checkout).output().unwrap();
    let said = String::from_utf8(output.stderr).unwrap();
    assert!(output.status.success(), "{arguments:?}: {said}");
    said
}

/// Everything that cargo has compiled for these commands, and when.
fn compiled() -> BTreeMap<PathBuf, SystemTime> {
    let executable = Path::new(env!("CARGO_BIN_EXE_cargo-fmu"));
    let target = executable.ancestors().find(|above| above.join("release").is_dir()).expect("a target directory");
    let mut files = BTreeMap::new();
    // `release` itself, and those of named machines.
    let releases = std::fs::read_dir(target).unwrap().map(|entry| entry.unwrap().path().join("release"));
    let mut folders: Vec<PathBuf> = releases.filter(|folder| folder.is_dir()).collect();
    folders.push(target.join("release"));
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(&folder).unwrap().map(|entry| entry.unwrap()) {
            let path = entry.path();
            // Beside them is what each file was made of, which cargo writes anew each time.
            let is_compiled = folder.ends_with("deps") || folder.ends_with("examples");
            if path.is_dir() {
                folders.push(path);
            } else if is_compiled && path.extension().is_none_or(|extension| extension != "d") {
                files.insert(path, entry.metadata().unwrap().modified().unwrap());
            }
        }
    }
    files
}

#[test]
fn ten_turns_of_building_and_simulating_compile_nothing() {
    let directory = TempDir::new().unwrap();
    let path = |name: &str| directory.path().join(name).to_str().unwrap().to_owned();
    let (scene, fmu) = (path("scene.toml"), path("turns.fmu"));
    // Nothing of it looks like a slip.
    let examples = concat!(env!("CARGO_MANIFEST_DIR"), "/../examples");
    let example = std::fs::read_to_string(format!("{examples}/scenes/feup.toml")).unwrap();
    std::fs::write(&scene, example.replace("../records/", &format!("{examples}/records/"))).unwrap();
    let turn = || {
        assert_eq!(cargo(&["fmu", &scene, "-o", &fmu]), "", "in a pipe not even the first one says anything");
        cargo(&["run", "--release", "--example", "simulate", "--", &scene]);
    };
    turn();
    let before = compiled();
    let count = |part: &str| before.keys().filter(|path| path.to_string_lossy().contains(part)).count();
    assert!(count("pounding") > 2 && count("cargo_fmu") > 0 && count("simulate") > 0, "{:#?}", before.keys());
    (0..10).for_each(|_| turn());
    let after = compiled();
    let new: Vec<_> = after.iter().filter(|(path, time)| before.get(*path) != Some(time)).collect();
    assert!(new.is_empty(), "{new:#?}");
}
