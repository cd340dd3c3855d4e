//! The same contacts written down in another way move the same.

use crate::common::{Run, record, scene};
use pounding::engine::Episode;
use pounding::scene::Scene;

/// Slow and quick, to both sides, m/s2.
fn shaking() -> pounding::record::Record {
    let wave = |k: i32| {
        let t = 0.02 * f64::from(k);
        (3.0 * (6.0 * t).sin() + 2.0 * (15.0 * t).sin()) * (-0.4 * t).exp()
    };
    record(0.02, &(0..250).map(wave).collect::<Vec<_>>())
}

/// Two buildings with heights, all of whose levels are exact in binary: no rounding in a position but that of its quotient.
/// Left levels -3, 0.25, 4, 7.25, 10.5, 13.5, 17 m; right 0.5, 4, 7.5, 11.25, 15.25 m.
fn buildings_with_heights() -> String {
    building("left", "base_level = -3.0", &[3.25, 3.75, 3.25, 3.25, 3.0, 3.5], 2e5, 1.5e8)
        + &building("right", "base_level = 0.5", &[3.5, 3.5, 3.75, 4.0], 1.5e5, 4e8)
        + "[ground]\nrecord = \"record.csv\"\n"
}

fn building(side: &str, base: &str, heights: &[f64], mass: f64, stiffness: f64) -> String {
    let all = |value: f64| vec![value; heights.len()];
    format!(
        "[{side}]\n{base}\nheight = {heights:?}\nmass = {:?}\nstiffness = {:?}\ndamping = {{ ratio = 0.05 }}\n",
        all(mass),
        all(stiffness)
    )
}

const LAW: &str =
    "gap = 0.01\nlaw = \"hertz_damped\"\nstiffness = 1e9\nrestitution = 0.65\ndamping_formula = \"exact\"\n";

/// Bits at several times, and every episode.
fn history(scene: &Scene) -> (Vec<Vec<u64>>, Vec<Episode>) {
    let mut run = Run::new(scene, Some(&shaking()));
    let bits = [0.7, 1.5, 2.9, 5.0].map(|time| run.to(time).bits()).to_vec();
    (bits, run.episodes.clone())
}

#[track_caller]
fn assert_same_bits(one: &str, other: &str, contacts: usize) {
    let head = format!("name = \"Heights\"\n{}", buildings_with_heights());
    let [one, other] = [one, other].map(|contacts| scene(&format!("{head}{contacts}")));
    assert_eq!((one.contacts.len(), other.contacts.len()), (contacts, contacts));
    let (one, other) = (history(&one), history(&other));
    assert!(one.1.len() > contacts, "{} impacts", one.1.len());
    assert!(one == other, "the same contacts move the floors in another way");
}

/// Numbers of the left floor or storey and of the right one, and where a slab is in a storey.
fn by_hand(left: &str, right: &str, position: Option<(&str, f64)>) -> String {
    let position = position.map(|(side, share)| format!("{side}_position = {share:?}\n")).unwrap_or_default();
    format!("[[contact]]\nleft_{left}\nright_{right}\n{position}{LAW}")
}

#[test]
fn a_position_that_is_left_out_is_that_of_the_levels() {
    let contacts = |first: Option<(&str, f64)>, second: Option<(&str, f64)>| {
        by_hand("floor = 3", "storey = 2", first) + &by_hand("storey = 6", "floor = 4", second)
    };
    assert_same_bits(&contacts(None, None), &contacts(Some(("right", 3.25 / 3.5)), Some(("left", 0.5))), 2);
}

#[test]
fn facing_buildings_have_the_contacts_that_one_writes_by_hand() {
    let common = by_hand("floor = 2", "floor = 1", None);
    let third = by_hand("floor = 3", "storey = 2", Some(("right", 3.25 / 3.5)))
        + &by_hand("storey = 4", "floor = 2", Some(("left", 0.25 / 3.25)));
    let above = by_hand("floor = 4", "storey = 3", Some(("right", 0.8)))
        + &by_hand("storey = 5", "floor = 3", Some(("left", 0.25)))
        + &by_hand("floor = 5", "storey = 4", Some(("right", 0.5625)))
        + &by_hand("storey = 6", "floor = 4", Some(("left", 0.5)));
    assert_same_bits(&format!("[facing]\n{LAW}"), &(common.clone() + &third + &above), 7);
    // Floors 3 and 2, 0.25 m apart, meet each other.
    let level = by_hand("floor = 3", "floor = 2", None);
    assert_same_bits(&format!("[facing]\nlevel_tolerance = 0.25\n{LAW}"), &(common + &level + &above), 6);
}
