//! What the fuzzing targets check (`fuzz/`), without coverage to guide them: over their seeds, over seeds with damage, and
//! over random bytes. This needs no more than a stable compiler.

mod calls;
mod record;
mod scene;
mod state;

use proptest::prelude::*;
use proptest::sample::Index;
use proptest::test_runner::{RngAlgorithm, TestRng, TestRunner};
use std::fs;
use std::path::Path;

/// The seeds of a target, by name.
fn seeds(target: &str) -> Vec<Vec<u8>> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap().join("fuzz/seeds").join(target);
    let mut paths: Vec<_> = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    paths.iter().map(|path| fs::read(path).unwrap()).collect()
}

/// A stretch that is replaced: where, how much of it, and by what.
type Damage = (Index, usize, Vec<u8>);

fn damage() -> impl Strategy<Value = Vec<Damage>> {
    let piece = prop_oneof![
        2 => proptest::collection::vec(any::<u8>(), 0..6),
        1 => "[-+.,eE0-9\\n\\[\\]{}\"=# ]{0,8}".prop_map(String::into_bytes),
    ];
    proptest::collection::vec((any::<Index>(), 0_usize..20, piece), 0..5)
}

fn damaged(seeds: &[Vec<u8>], which: Index, damage: &[Damage]) -> Vec<u8> {
    let mut bytes = which.get(seeds).clone();
    for (start, length, piece) in damage {
        let start = start.index(bytes.len() + 1);
        let end = (start + length).min(bytes.len());
        bytes.splice(start..end, piece.iter().copied());
    }
    bytes
}

/// Every seed as it is, then some with damage: the same each time, so that a failure is seen again.
fn try_out(target: &str, seeds: &[Vec<u8>], cases: u32, check: impl Fn(&[u8])) {
    seeds.iter().for_each(|seed| check(seed));
    let config = ProptestConfig { cases, failure_persistence: None, ..ProptestConfig::default() };
    let inputs = (any::<Index>(), damage());
    let result = TestRunner::new_with_rng(config, TestRng::deterministic_rng(RngAlgorithm::ChaCha)).run(
        &inputs,
        |(which, damage)| {
            check(&damaged(seeds, which, &damage));
            Ok(())
        },
    );
    result.unwrap_or_else(|failure| panic!("{target}: {failure}"));
}

#[test]
fn scenes() {
    try_out("scene", &seeds("scene"), 5000, scene::check);
}

#[test]
fn records() {
    try_out("record_csv", &seeds("record_csv"), 3000, |bytes| record::check("fuzz.csv", bytes));
    try_out("record_at2", &seeds("record_at2"), 5000, |bytes| record::check("fuzz.at2", bytes));
    try_out("record_other", &seeds("record_other"), 5000, |bytes| record::check("fuzz", bytes));
    try_out("record_channel", &seeds("record_other"), 2000, |bytes| record::check("fuzz#2", bytes));
}

#[test]
fn states() {
    let seeds = state::seeds();
    if let Some(folder) = std::env::var_os("WRITE_STATE_SEEDS") {
        (0..).zip(&seeds).for_each(|(k, seed)| fs::write(Path::new(&folder).join(format!("state-{k}")), seed).unwrap());
    }
    seeds.iter().for_each(|seed| state::check_seed(seed));
    try_out("state", &seeds, 3000, state::check);
}

#[test]
fn sequences_that_have_found_something() {
    seeds("calls").iter().for_each(|seed| calls::check(seed));
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, ..ProptestConfig::default() })]

    #[test]
    fn sequences_of_any_calls(calls in proptest::collection::vec(any::<u8>(), 1..120)) {
        calls::check(&[&[0], &calls[..]].concat());
    }

    #[test]
    fn sequences_of_legal_calls(calls in proptest::collection::vec(any::<u8>(), 1..200)) {
        calls::check(&[&[1], &calls[..]].concat());
    }

    #[test]
    fn sequences_of_any_calls_of_fmi3(first: u8, calls in proptest::collection::vec(any::<u8>(), 1..120)) {
        calls::check(&[&[first & !1 | 2], &calls[..]].concat());
    }

    #[test]
    fn sequences_of_legal_calls_of_fmi3(first: u8, calls in proptest::collection::vec(any::<u8>(), 1..200)) {
        calls::check(&[&[first | 3], &calls[..]].concat());
    }
}
