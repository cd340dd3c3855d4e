//! Which kinds of step each scene takes, and why others were refused: the scenes of `invariants/scenes.rs` and the examples,
//! pinned in `kinds.txt`. A feature that no longer meets a kind of step, or takes another one, is seen here; no number that
//! the engine shows depends on it.

use crate::common::{self, Run};
use crate::invariants::scenes;
use pounding::engine::{Counters, Kind, Refusal};
use pounding::scene;
use std::fmt::Write;
use std::path::Path;

const PINNED: &str = include_str!("kinds.txt");

/// Reasons that no scene of the table gives: that of a benchmark, and those that rounding decides about.
const RARE: [Refusal; 3] = [Refusal::SwitchedOff, Refusal::SlowEntry, Refusal::NotReleased];

/// Without a ground motion: what is rare on a record. Name, duration in s, left building, right building, contacts.
const LET_GO: [(&str, f64, &str, &str, &[&str]); 4] = [
    (
        "let go where they do not meet",
        20.0,
        "mass = [3e4, 2e4]\nstiffness = [3e7, 2e7]\ndamping = { ratio = 0.01 }\ninitial_displacement = [0.01, 0.02]",
        "mass = [2e4]\nstiffness = [4e7]\ndamping = { ratio = 0.01 }",
        &["left_floor = 1\nright_floor = 1\ngap = 0.1\nlaw = \"hertz\"\nstiffness = 1e9"],
    ),
    (
        "two laws at the same instant",
        0.5,
        "mass = [3e4, 2e4]\nstiffness = [3e7, 2e7]\ndamping = { ratio = 0.01 }\ninitial_velocity = [1.0, 1.0]",
        "mass = [3e4, 2e4]\nstiffness = [3e7, 2e7]\ndamping = { ratio = 0.01 }\ninitial_velocity = [-1.0, -1.0]",
        &[
            "left_floor = 1\nright_floor = 1\ngap = 0.0\nlaw = \"hertz\"\nstiffness = 1e9",
            "left_floor = 2\nright_floor = 2\ngap = 0.0\nlaw = \"hertz\"\nstiffness = 1e9\nexponent = 1.7",
        ],
    ),
    (
        "an entry at next to no velocity",
        0.5,
        "mass = [3e4, 2e4]\nstiffness = [3e7, 2e7]\ndamping = { ratio = 0.01 }\ninitial_velocity = [1e-9, 1.0]",
        "mass = [2e4]\nstiffness = [4e7]\ndamping = { ratio = 0.01 }",
        &["left_floor = 1\nright_floor = 1\ngap = 0.0\nlaw = \"hertz\"\nstiffness = 1e7"],
    ),
    (
        "a dashpot that lets nothing go",
        0.01,
        "mass = [1e3]\nstiffness = [1e5]\ndamping = { ratio = 0.05 }\ninitial_velocity = [0.1]",
        "mass = [1e3]\nstiffness = [1e5]\ndamping = { ratio = 0.05 }",
        &["left_floor = 1\nright_floor = 1\ngap = -1e-3\nlaw = \"jankowski\"\nstiffness = 1e8\nrestitution = 1e-12"],
    ),
];

/// Kinds and reasons of one run, with how often.
fn told(name: &str, counters: &Counters) -> String {
    let mut line = name.to_owned();
    let of_kinds = Kind::ALL.map(|kind| (format!("{kind:?}"), counters.taken(kind)));
    let of_reasons = Refusal::ALL.map(|why| (format!("not {why:?}"), counters.refused(why)));
    for (what, count) in of_kinds.into_iter().chain(of_reasons).filter(|(_, count)| *count > 0) {
        write!(line, "\n    {what} {count}").unwrap();
    }
    line + "\n"
}

/// One run of each scene.
fn runs() -> Vec<(String, Counters)> {
    let examples = Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap().join("examples/scenes");
    let mut names: Vec<_> = std::fs::read_dir(&examples).unwrap().map(|entry| entry.unwrap().path()).collect();
    names.retain(|path| path.extension().is_some_and(|extension| extension == "toml"));
    names.sort();
    let of_example = |path: &Path| {
        let (scene, record) = scene::load(path).unwrap();
        let counters = Run::new(&scene, record.as_ref()).to(10.0).state.counters();
        (format!("example {}", path.file_stem().unwrap().to_string_lossy()), counters)
    };
    let of_let_go = |&(name, stop, left, right, contacts): &(&str, f64, &str, &str, &[&str])| {
        let contacts: String = contacts.iter().map(|contact| format!("[[contact]]\n{contact}\n")).collect();
        let scene = common::scene(&format!("name = \"Go\"\n[left]\n{left}\n[right]\n{right}\n{contacts}"));
        (name.to_owned(), Run::new(&scene, None).to(stop).state.counters())
    };
    let own = names.iter().map(|path| of_example(path)).chain(LET_GO.iter().map(of_let_go));
    own.chain(scenes::ALL.iter().map(|row| (row.name.to_owned(), row.plain().counters))).collect()
}

#[test]
fn each_scene_takes_its_kinds_of_step() {
    let got: String = runs().iter().map(|(name, counters)| told(name, counters)).collect();
    if got != PINNED {
        let kept = Path::new(env!("CARGO_TARGET_TMPDIR")).join("kinds.txt");
        std::fs::write(&kept, &got).unwrap();
        let changed = got.lines().zip(PINNED.lines()).find(|(got, pinned)| got != pinned);
        panic!(
            "{changed:?}; all of it is in {}: if each change is meant, it replaces tests/physics/kinds.txt",
            kept.display()
        );
    }
}

/// Each kind and each reason is that of some scene: there is none that no test takes.
#[test]
fn each_kind_and_each_reason_has_a_scene() {
    let is_there = |what: String| PINNED.lines().any(|line| line.trim_start().starts_with(&(what.clone() + " ")));
    let kinds = Kind::ALL.iter().filter(|kind| !is_there(format!("{kind:?}"))).count();
    let missing: Vec<_> = Refusal::ALL.into_iter().filter(|why| !is_there(format!("not {why:?}"))).collect();
    assert_eq!((kinds, &missing[..]), (0, &RARE[..]));
}
