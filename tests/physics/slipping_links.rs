//! Links whose springs slip, between buildings that yield or do not, and between a floor and a wall: against exponentials of
//! matrices between events that are found by bisection, and closed forms.

use crate::common::problems::frames::zigzag;
use crate::common::{Run, record, scene};
use crate::piecewise::assert_same_motion;
use pounding::engine::{LinkOutput, Output, Side};
use pounding::scene::{Link, Scene, Slip};

const LEFT: &str = "[left]\nmass = [4e4, 4e4, 3e4]\nstiffness = [3e7, 2.5e7, 2e7]\ndamping = { ratio = 0.05 }\n\
                    yield_force = [2.5e5, 2e5, 1.2e5]\npost_yield_ratio = [0.05, 0.0, 0.2]\n";
const RIGHT: &str = "[right]\nmass = [3e4, 2.5e4]\nstiffness = [1.2e7, 1e7]\ndamping = { ratio = 0.04 }\n";
const YIELDING: &str = "yield_force = [inf, 8e4]\npost_yield_ratio = 0.03\n";
const LAWS: [&str; 3] = [
    "law = \"linear\"\nstiffness = 1e8",
    "law = \"kelvin_voigt\"\nstiffness = 1e8\nrestitution = 0.6",
    "law = \"stereomechanical\"\nrestitution = 0.7",
];

/// Between floors counted from 1; 0 is the ground.
fn link((left, right): (usize, usize), (stiffness, dashpot): (f64, f64), slip: Option<(f64, f64)>) -> Link {
    let slip = slip.map(|(force, ratio)| Slip { force, ratio });
    Link { left: left.checked_sub(1), right: right.checked_sub(1), stiffness, dashpot, slip }
}

fn scene_of(text: &str, links: &[Link]) -> Scene {
    let mut scene = scene(&format!("name = \"Linked\"\n[outputs]\nenergy = true\n{text}"));
    scene.links = links.to_vec();
    scene
}

/// Compares all floors, storeys and links with the other way at uneven times, to 5e-11 of the largest displacement.
#[track_caller]
fn check(text: &str, links: &[Link], factor: f64, (yields, impacts): (usize, usize)) {
    let mut scene = scene_of(text, links);
    scene.ground.record = Some("zigzag.csv".into());
    // Exact in binary, of many frequencies.
    let motion = record(1.0 / 32.0, &(0..160).map(|k| factor * zigzag(k)).collect::<Vec<_>>());
    let times: Vec<f64> = (1..=110).map(|k| 0.05 * f64::from(k) + 0.003 * f64::from(k * 7 % 5)).collect();
    let other = assert_same_motion(&scene, &motion, &times, 5e-11);
    assert!(other.yields >= yields, "{} yields", other.yields);
    assert!(other.impacts >= impacts, "{} impacts", other.impacts);
}

/// A friction damper and a yielding device between frames of which none, one or both yield.
#[test]
fn between_frames() {
    let links = [
        link((2, 2), (3e7, 0.0), Some((6e4, 0.0))),
        link((1, 1), (5e6, 2e5), None),
        link((3, 1), (8e6, 1e5), Some((4e4, 0.1))),
    ];
    let elastic = LEFT.replace("yield_force = [2.5e5, 2e5, 1.2e5]\npost_yield_ratio = [0.05, 0.0, 0.2]\n", "");
    check(&format!("{elastic}{RIGHT}"), &links, 0.2, (60, 0));
    check(&format!("{LEFT}{RIGHT}"), &links, 0.25, (80, 0));
    check(&format!("{LEFT}{RIGHT}{YIELDING}"), &links, 0.25, (80, 0));
    check(&format!("{LEFT}{RIGHT}{YIELDING}"), &links[1..2], 0.25, (40, 0));
}

#[test]
fn beside_contacts_of_every_linear_law() {
    let links = [link((1, 1), (3e7, 0.0), Some((6e4, 0.0))), link((2, 2), (0.0, 1e5), None)];
    for law in LAWS {
        let contacts = format!("[[contact]]\nleft_floor = 2\nright_floor = 2\ngap = 0.004\n{law}\n");
        check(&format!("{LEFT}{RIGHT}{YIELDING}{contacts}"), &links, 0.25, (40, 3));
    }
}

/// From a floor to the ground on one side: the other building stays a body by itself, with storeys that yield.
#[test]
fn to_walls() {
    let links = [link((2, 0), (2e7, 5e4), Some((5e4, 0.05))), link((0, 1), (1e7, 0.0), Some((3e4, 0.0)))];
    check(&format!("{LEFT}{RIGHT}{YIELDING}"), &links, 0.25, (60, 0));
    check(&format!("{LEFT}{RIGHT}{YIELDING}"), &links[..1], 0.25, (60, 0));
}
