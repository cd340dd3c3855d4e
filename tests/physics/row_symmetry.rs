//! What may not change a motion: looking at it from the other side, or writing down the same contacts in another way.

use crate::common::{Run, record, scene};
use pounding::engine::{Episode, Side};
use pounding::scene::Scene;

/// Slow and quick, to both sides, m/s2.
fn shaking(sign: f64) -> pounding::record::Record {
    let wave = |k: i32| {
        let t = 0.02 * f64::from(k);
        sign * (3.0 * (6.0 * t).sin() + 2.0 * (15.0 * t).sin()) * (-0.4 * t).exp()
    };
    record(0.02, &(0..250).map(wave).collect::<Vec<_>>())
}

/// Two frames of a few storeys, contacts of every kind, several on one floor.
const FRAMES: &str = r#"
name = "Frames"
[left]
mass = [3.65, 3.65, 3.0]
stiffness = [2910.0, 2910.0, 2500.0]
damping = { ratio = 0.05 }
[right]
mass = [5.0, 4.0]
stiffness = [7500.0, 6800.0]
damping = { dashpots = [12.0, 11.0] }
[ground]
record = "record.csv"
[[contact]]
left_floor = 1
right_storey = 1
right_position = 0.8
gap = 0.004
law = "jankowski"
stiffness = 5e5
restitution = 0.6
[[contact]]
left_floor = 2
right_floor = 2
gap = 0.006
law = "stereomechanical"
restitution = 0.4
[[contact]]
left_storey = 3
left_position = 0.4
right_floor = 2
column_shape = "straight"
gap = 0.007
law = "hertz_damped"
stiffness = 4e5
restitution = 0.7
damping_formula = "ye"
[[contact]]
left_floor = 3
wall = "left"
gap = 0.02
law = "kelvin_voigt"
stiffness = 4e4
restitution = 0.6
[[contact]]
right_floor = 1
wall = "left"
gap = 0.003
law = "hertz"
stiffness = 2e5
"#;

/// Left and right exchanged, and the ground's motion turned round: the floors move the other way, the contacts do the same.
/// Sums over floors are made in another order, so each step is another by rounding; frames that are damped keep that as it
/// is (their golden relatives have sensitivities up to 9), and what a hundred contacts leave is below 1e-13 of the largest.
#[test]
fn the_mirror_image_of_a_scene_moves_like_it() {
    let mirrored = FRAMES.replace("left", "other").replace("right", "left").replace("other", "right");
    let (mut here, mut there) =
        (Run::new(&scene(FRAMES), Some(&shaking(1.0))), Run::new(&scene(&mirrored), Some(&shaking(-1.0))));
    let mut largest = 0.0_f64;
    for k in 1..=60 {
        here.to(0.1 * f64::from(k));
        there.to(0.1 * f64::from(k));
        for (side, floors) in [(Side::Left, 3), (Side::Right, 2)] {
            for floor in 0..floors {
                let (u, v) = (here.displacement(side, floor), here.velocity(side, floor));
                let (w, x) = (there.displacement(side.opposite(), floor), there.velocity(side.opposite(), floor));
                largest = largest.max(u.abs());
                assert!((u + w).abs() < 1e-13 * 0.05, "floor {floor} at {k}: {u} and {w}");
                assert!((v + x).abs() < 1e-13 * 0.5, "floor {floor} at {k}: {v} and {x}");
            }
        }
    }
    assert!(largest > 0.02, "{largest}");
    for p in 0..5 {
        let of = |run: &Run| -> Vec<Episode> {
            run.episodes.iter().filter(|episode| episode.contact == p && episode.impulse > 1e-9).copied().collect()
        };
        let (here, there) = (of(&here), of(&there));
        assert!(here.len() >= 2, "contact {p}: {}", here.len());
        assert_eq!(here.len(), there.len(), "contact {p}");
        for (one, other) in here.iter().zip(&there) {
            assert!((one.start - other.start).abs() < 1e-12, "contact {p}: {one:?} and {other:?}");
            assert!((one.impulse - other.impulse).abs() < 1e-12, "contact {p}: {one:?} and {other:?}");
            assert!((one.approach_velocity - other.approach_velocity).abs() < 1e-12, "{one:?} and {other:?}");
        }
    }
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
    let mut run = Run::new(scene, Some(&shaking(1.0)));
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
