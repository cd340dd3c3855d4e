//! Frames of several storeys that yield, shaken, with linear contacts, impulses, columns, walls and isolators: against
//! exponentials of matrices between events that are found by bisection.

use crate::common::problems::frames::zigzag;
use crate::common::{record, scene};
use crate::piecewise::assert_same_motion;
use pounding::record::Record;
use pounding::scene::Scene;

/// Exact in binary, of many frequencies.
fn shaking(factor: f64) -> Record {
    record(1.0 / 32.0, &(0..160).map(|k| factor * zigzag(k)).collect::<Vec<_>>())
}

fn scene_of(text: &str) -> Scene {
    let mut scene = scene(&format!("name = \"Frames\"\n[outputs]\nenergy = true\n{text}"));
    scene.ground.record = Some("zigzag.csv".into());
    scene
}

/// Uneven times up to 5.5 s.
fn times() -> Vec<f64> {
    (1..=110).map(|k| 0.05 * f64::from(k) + 0.003 * f64::from(k * 7 % 5)).collect()
}

/// Which is compared at all of these times, to 5e-11 of the largest displacement; at least so many yields and impacts.
#[track_caller]
fn check(text: &str, factor: f64, yields: usize, impacts: usize) {
    let motion = shaking(factor);
    let other = assert_same_motion(&scene_of(text), &motion, &times(), 5e-11);
    assert!(other.yields >= yields, "{} yields", other.yields);
    assert!(other.impacts >= impacts, "{} impacts", other.impacts);
}

const LEFT: &str = "[left]\nmass = [4e4, 4e4, 3e4]\nstiffness = [3e7, 2.5e7, 2e7]\ndamping = { ratio = 0.05 }\n\
                    yield_force = [2.5e5, 2e5, 1.2e5]\npost_yield_ratio = [0.05, 0.0, 0.2]\n";
const RIGHT: &str = "[right]\nmass = [3e4, 2.5e4]\nstiffness = [1.2e7, 1e7]\ndamping = { ratio = 0.04 }\n\
                     yield_force = [inf, 8e4]\npost_yield_ratio = 0.03\n";

fn contact(meets: &str, gap: f64, law: &str) -> String {
    format!("[[contact]]\n{meets}\ngap = {gap:?}\n{law}\n")
}

const LINEAR: &str = "law = \"linear\"\nstiffness = 1e8";
const KELVIN_VOIGT: &str = "law = \"kelvin_voigt\"\nstiffness = 1e8\nrestitution = 0.6";
const RIGID: &str = "law = \"stereomechanical\"\nrestitution = 0.7";

#[test]
fn apart() {
    check(LEFT, 0.25, 40, 0);
    check(&format!("{LEFT}{RIGHT}"), 0.1, 30, 0);
}

#[test]
fn floors_that_meet_under_every_linear_law() {
    for law in [LINEAR, KELVIN_VOIGT, RIGID] {
        let contacts = contact("left_floor = 1\nright_floor = 1", 0.01, law)
            + &contact("left_floor = 2\nright_floor = 2", 0.015, law);
        check(&format!("{LEFT}{RIGHT}{contacts}"), 0.2, if law == RIGID { 15 } else { 50 }, 10);
    }
}

/// Columns of a storey that yields, and of the first storey, whose lower end is the ground.
#[test]
fn columns_of_storeys_that_yield() {
    let right = RIGHT.replace("[inf, 8e4]", "[9e4, 8e4]");
    for law in [LINEAR, KELVIN_VOIGT, RIGID] {
        let contacts = contact("left_floor = 1\nright_storey = 1\nright_position = 0.6", 0.008, law)
            + &contact("left_floor = 2\nright_storey = 2\nright_position = 0.3", 0.012, law)
            + &contact("left_storey = 2\nleft_position = 0.7\ncolumn_shape = \"straight\"\nright_floor = 2", 0.02, law);
        check(&format!("{LEFT}{right}{contacts}"), 0.2, 30, 10);
    }
}

/// The first storey is a lead-rubber bearing: soft after a small yield drift, dashpots there and in the frame, walls beside it.
#[test]
fn an_isolator_between_walls() {
    let dashpots = "{ dashpots = [3e4, 2e5, 2e5, 1e5] }";
    let matrix = "{ matrix = [[2.3e5, -2e5, 0, 0], [-2e5, 4e5, -2e5, 0], [0, -2e5, 3e5, -1e5], [0, 0, -1e5, 1e5]] }";
    for damping in [dashpots, matrix] {
        let frame = format!(
            "[left]\nmass = [5e4, 4e4, 4e4, 3e4]\nstiffness = [2e7, 8e7, 7e7, 6e7]\ndamping = {damping}\n\
             yield_force = [8e4, inf, 9e5, inf]\npost_yield_ratio = [0.1, 0.0, 0.05, 0.0]\n"
        );
        for law in [LINEAR, KELVIN_VOIGT, RIGID] {
            let walls = contact("left_floor = 1\nwall = \"right\"", 0.04, law)
                + &contact("left_floor = 1\nwall = \"left\"", 0.05, law);
            check(&format!("{frame}{walls}"), 0.25, 6, 8);
        }
    }
}

/// One storey yields below others that are a thousand times as stiff.
#[test]
fn a_soft_storey_below_stiff_ones() {
    for damping in ["{ ratio = 0.02 }", "{ ratio = 0.0 }"] {
        let frame = format!(
            "[left]\nmass = [2e4, 2e4, 2e4]\nstiffness = [6e6, 6e9, 6e9]\ndamping = {damping}\n\
             yield_force = [8e4, inf, inf]\npost_yield_ratio = 0.02\n"
        );
        check(&frame, 0.15, 8, 0);
    }
}

/// Contacts of more than 16 floors are followed floor by floor, and so are their yields.
#[test]
fn many_storeys() {
    let tower = |side: &str, n: usize, mass: f64, stiffness: f64, first: f64| {
        let force: Vec<f64> = (0..n).map(|i| first * (1.0 - i as f64 / n as f64) + 1e5).collect();
        format!(
            "[{side}]\nmass = {:?}\nstiffness = {:?}\ndamping = {{ ratio = 0.05 }}\nyield_force = {force:?}\n\
             post_yield_ratio = 0.05\n",
            vec![mass; n],
            vec![stiffness; n]
        )
    };
    let towers = tower("left", 14, 5e4, 8e7, 3e5) + &tower("right", 12, 5e4, 3e7, 2e5);
    for law in [LINEAR, RIGID] {
        let contacts = contact("left_floor = 8\nright_floor = 8", 0.004, law)
            + &contact("left_floor = 6\nright_floor = 6", 0.004, law);
        check(&format!("{towers}{contacts}"), 0.25, 100, 3);
    }
}
