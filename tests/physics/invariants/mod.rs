//! What must not matter: every scene of `scenes.rs` under every change of `changes.rs` that applies to it, and run in every
//! way of `ways.rs`. A new feature gets all of them by a row in `scenes.rs`; a new change is a test here.

pub mod case;
pub mod changes;
pub mod compare;
pub mod scenes;
pub mod ways;

use case::{Case, Units};
use compare::Pair;
use scenes::Row;
use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// What a change leaves of a motion.
#[derive(Clone, Copy, PartialEq)]
enum Leaves {
    /// Every bit of it.
    Bits,
    /// All but rounding: sums are made in another order, or powers rounded.
    Rounding,
}

/// Tries each scene, and tells all those that fail, also by a panic.
fn try_each(what: &str, least: usize, of: impl Fn(&Row) -> Option<Result<(), String>>) {
    let (mut tried, mut failed) = (0, Vec::new());
    for row in scenes::ALL.iter() {
        let result = catch_unwind(AssertUnwindSafe(|| of(row))).unwrap_or_else(|panic| Some(Err(message(&*panic))));
        tried += usize::from(result.is_some());
        if let Some(Err(wrong)) = result {
            failed.push(format!("{} x {what}: {wrong}", row.name));
        }
    }
    assert!(failed.is_empty(), "{} of {tried} scenes:\n{}", failed.len(), failed.join("\n"));
    assert!(tried >= least, "{what}: tried with {tried} scenes only");
}

fn message(panic: &(dyn Any + Send)) -> String {
    let text = panic.downcast_ref::<&str>().map(|text| (*text).to_owned());
    text.or_else(|| panic.downcast_ref::<String>().cloned()).unwrap_or_default()
}

/// Each scene under a change that leaves so much of it.
fn try_change(what: &str, least: usize, change: impl Fn(&Row) -> Option<(Case, Leaves)>) {
    try_each(what, least, |row| {
        let (changed, leaves) = change(row)?;
        let (plain, other) = (row.plain(), changed.history());
        let pair = Pair { case: &row.case, plain, changed: &changed, other: &other };
        Some(match leaves {
            Leaves::Bits => pair.have_same_bits(),
            Leaves::Rounding => pair.are_close(row.rounding),
        })
    });
}

/// A scene is there for what happens in it.
#[test]
fn what_each_scene_is_there_for_happens() {
    try_each("itself", 40, |row| Some(row.happens()));
}

#[test]
fn left_and_right() {
    try_change("left and right", 40, |row| Some((changes::mirrored(&row.case), Leaves::Rounding)));
}

#[test]
fn the_other_way() {
    try_change("the other way", 4, |row| Some((changes::the_other_way(&row.case)?, Leaves::Bits)));
}

#[test]
fn the_order_of_contacts_and_links() {
    try_change("order", 20, |row| Some((changes::in_another_order(&row.case)?, Leaves::Rounding)));
}

/// Powers of two of which every root that the laws take is one, too.
#[test]
fn units() {
    for (mass, length, time) in [(4.0_f64.powi(-5), 1.0, 1.0), (4.0_f64.powi(3), 16.0, 4.0), (1.0, 1.0 / 256.0, 0.25)] {
        let units = Units { mass, length, time };
        let leaves = |case: &Case| if changes::scales_exactly(&case.scene) { Leaves::Bits } else { Leaves::Rounding };
        try_change(&format!("{units:?}"), 40, |row| Some((changes::in_units(&row.case, units), leaves(&row.case))));
    }
}

#[test]
fn twelve_days_later() {
    // Of a run that has ended, the end is the time of a collapse, which is rounded.
    try_change("twelve days later", 30, |row| {
        changes::later(&row.case).filter(|_| !row.collapses).map(|later| (later, Leaves::Bits))
    });
}

#[test]
fn whether_peaks_are_watched() {
    try_change("without peaks", 30, |row| Some((changes::without_peaks(&row.case)?, Leaves::Bits)));
}

#[test]
fn whether_energy_is_accounted_for() {
    try_change("without an account", 30, |row| Some((changes::without_account(&row.case)?, Leaves::Bits)));
}

/// Far away, or by next to nothing.
#[test]
fn a_contact_out_of_reach() {
    for (what, margin, law, is_first) in [
        ("out of reach", 1e3, "law = \"hertz\"\nstiffness = 1e9", true),
        ("just out of reach", 1e-4, "law = \"hertz\"\nstiffness = 1e9", false),
        ("a rigid one just out of reach", 1e-4, "law = \"stereomechanical\"\nrestitution = 0.5", true),
    ] {
        try_change(what, 40, |row| {
            let (floors, nearest) = ways::nearest(&row.case)?;
            let leaves = if changes::leaves_bits(&row.case.scene, law) { Leaves::Bits } else { Leaves::Rounding };
            Some((changes::with_contact(&row.case, floors, nearest + margin, law, is_first), leaves))
        });
    }
}

#[test]
fn whether_a_run_is_read() {
    try_each("unread", 40, |row| Some(ways::unread(row)));
}

#[test]
fn communication_steps() {
    for step in [0.37, 1.0 / 64.0, 0.0125, 0.0037, 0.001] {
        try_each(&format!("steps of {step} s"), 30, |row| ways::in_steps(row, step));
    }
}

#[test]
fn steps_of_a_nanosecond_at_events() {
    try_each("steps of a nanosecond", 25, ways::at_events);
}

#[test]
fn saved_states() {
    try_each("saved", 40, |row| Some(ways::saved(row)));
}

#[test]
fn copies_and_ways_back() {
    try_each("copied and taken back", 40, |row| Some(ways::copied_and_taken_back(row)));
}
