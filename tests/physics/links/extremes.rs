//! Slip forces, ratios and stiffnesses so large or small that a simpler link is met.

use super::devices::{Difference, between, bits, linked, motion, of_link, shaken, slipping};
use crate::common::{Run, record};
use pounding::engine::LinkOutput;
use pounding::record::Record;
use pounding::scene::Link;

const FRAMES: &str = "[left]\nmass = [4e4, 3e4]\nstiffness = [3e7, 2e7]\ndamping = { ratio = 0.03 }\n\
                      [right]\nmass = [3e4, 2e4, 2e4]\nstiffness = [5e7, 3e7, 4e7]\ndamping = { ratio = 0.05 }\n\
                      [[contact]]\nleft_floor = 2\nright_floor = 2\ngap = 0.01\nlaw = \"kelvin_voigt\"\nstiffness = 2e8\n\
                      restitution = 0.65\n";

/// N; with it the brace slips to and fro.
const USUAL: f64 = 1e4;

/// 5 s at 64 Hz.
fn shaking() -> Record {
    let t = |k: i32| f64::from(k) / 64.0;
    record(1.0 / 64.0, &(0..=320).map(|k| 3.0 * (9.0 * t(k)).sin() + 2.0 * (23.0 * t(k)).sin()).collect::<Vec<_>>())
}

/// A brace of 30 MN/m at floor 2 beside a dashpot at floor 1.
fn run(brace: Option<Link>) -> Run {
    let links: Vec<Link> = brace.into_iter().chain([between(1, 1, 0.0, 2e5)]).collect();
    shaken(linked(FRAMES, &links), &shaking())
}

fn brace() -> Link {
    between(2, 2, 3e7, 0.0)
}

/// The largest difference of two runs, which end with their energies accounted for.
fn apart(mut one: Run, mut other: Run) -> (f64, [Run; 2]) {
    let mut difference = Difference::default();
    for k in 1..=100 {
        let time = 0.05 * f64::from(k);
        difference.add(&motion(one.to(time)), &motion(other.to(time)));
    }
    assert!(one.energy().residual.abs() < 1e-12 && other.energy().residual.abs() < 1e-12);
    assert_eq!(one.point.impacts, other.point.impacts);
    (difference.worst(), [one, other])
}

#[test]
fn the_usual_slip_force_slips() {
    let (worst, [one, _]) = apart(run(Some(slipping(brace(), USUAL, 0.0))), run(Some(brace())));
    println!("{worst:.1e}, {} m", of_link(&one, 0, LinkOutput::SlipTravel));
    assert!(worst > 0.1 && of_link(&one, 0, LinkOutput::SlipTravel) > 10.0 * USUAL / 3e7, "{worst:.1e}");
}

#[test]
fn a_force_that_is_never_reached_is_none() {
    for (force, ratio) in [(1e12 * USUAL, 0.0), (1e12 * USUAL, 0.5), (1e300, 0.0)] {
        let (worst, [one, _]) = apart(run(Some(slipping(brace(), force, ratio))), run(Some(brace())));
        assert!(worst < 1e-13, "{force:e} N: off by {worst:.1e}");
        assert_eq!(of_link(&one, 0, LinkOutput::SlipTravel), 0.0);
    }
}

/// What is left of the spring is its share that does not slip.
#[test]
fn a_force_that_every_motion_exceeds_leaves_the_share_that_stays() {
    for ratio in [0.0, 0.2] {
        let left = (ratio > 0.0).then(|| between(2, 2, ratio * 3e7, 0.0));
        let one = run(Some(slipping(brace(), 1e-12 * USUAL, ratio)));
        let other = run(left.clone());
        let (worst, [one, _]) = apart(one, other);
        assert!(worst < 1e-10, "ratio {ratio}: off by {worst:.1e}");
        assert!(of_link(&one, 0, LinkOutput::SlipTravel) > 1e-3);
    }
}

/// A spring that keeps nearly all of its stiffness.
#[test]
fn a_ratio_beside_one_is_a_spring() {
    let (worst, _) = apart(run(Some(slipping(brace(), USUAL, 1.0 - 1e-13))), run(Some(brace())));
    assert!(worst < 1e-11, "off by {worst:.1e}");
}

/// From braces that are hardly there to a hundred times the usual, slip forces from a millionth of the usual to a thousand
/// times: each run ends with its energy accounted for, the same in one step and in many.
#[test]
fn braces_and_slip_forces_of_every_size() {
    for stiffness in [3e1, 3e4, 3e7, 3e9] {
        for force in [USUAL * 1e-6, USUAL * 1e-3, USUAL, 1e3 * USUAL] {
            for ratio in [0.0, 0.3] {
                let brace = slipping(between(2, 2, stiffness, 0.0), force, ratio);
                let mut steps = run(Some(brace.clone()));
                let mut whole = run(Some(brace));
                steps.in_steps(0.01, 5.0);
                let residual = whole.to(5.0).energy().residual;
                let what = format!("{stiffness:e} N/m, {force:e} N, ratio {ratio}");
                assert!(residual.abs() < 1e-11, "{what}: {residual:e}");
                assert!(bits(&steps, 2) == bits(&whole, 2), "{what}");
            }
        }
    }
}
