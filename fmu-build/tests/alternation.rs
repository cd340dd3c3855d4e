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
    let target = executable.ancestors().find(|above| above.join("quick").is_dir()).expect("a target directory");
    let files = std::fs::read_dir(target.join("quick/deps")).unwrap().map(|entry| entry.unwrap());
    // Beside them is what each file was made of, which cargo writes anew each time.
    let files = files.filter(|file| file.path().extension().is_none_or(|extension| extension != "d"));
    files.map(|file| (file.path(), file.metadata().unwrap().modified().unwrap())).collect()
}

/// `check` is compiled with what building does without, and shares the engine with it. What `simulate` and the benchmarks
/// compile lies in another directory, `release`.
#[test]
fn turns_of_building_and_checking_compile_nothing() {
    let directory = TempDir::new().unwrap();
    let path = |name: &str| directory.path().join(name).to_str().unwrap().to_owned();
    let (scene, fmu) = (path("scene.toml"), path("turns.fmu"));
    // Nothing of it looks like a slip.
    let examples = concat!(env!("CARGO_MANIFEST_DIR"), "/../examples");
    let example = std::fs::read_to_string(format!("{examples}/scenes/feup.toml")).unwrap();
    std::fs::write(&scene, example.replace("../records/", &format!("{examples}/records/"))).unwrap();
    let build =
        || assert_eq!(cargo(&["fmu", &scene, "-o", &fmu]), "", "in a pipe not even the first one says anything");
    let check = || assert_eq!(cargo(&["fmu", "check", &fmu]), "");
    build();
    let of_engine = || compiled().into_iter().filter(|(path, _)| path.to_string_lossy().contains("libpounding-"));
    let engine: Vec<_> = of_engine().collect();
    check();
    assert!(!engine.is_empty() && of_engine().eq(engine), "check compiles the engine again");
    let before = compiled();
    let turn = || {
        build();
        check();
    };
    (0..4).for_each(|_| turn());
    let after = compiled();
    let new: Vec<_> = after.iter().filter(|(path, time)| before.get(*path) != Some(time)).collect();
    assert!(new.is_empty(), "{new:#?}");
}
