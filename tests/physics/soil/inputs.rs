//! What answers to an input at the same instant: accelerations, and reactions between floors that are held together. What the
//! directional derivatives say is a closed form, and what is read changes by as much.

use super::closed_forms::{ONE, one_storey};
use crate::common::{Run, press, scene};
use pounding::engine::{BuildingId, ContactOutput, FoundationOutput as F, Input, Output, Response};
use pounding::scene::Scene;

/// Adds so much to an input and compares the change of each output with what is expected, and with what the derivatives say.
fn assert_answers(run: &mut Run, (input, change): (Input, f64), expected: &[(Output, f64)]) {
    let mut response = Response::default();
    run.now().respond([(input, change)], &mut response);
    let before: Vec<f64> = expected.iter().map(|(output, _)| run.read(*output)).collect();
    let told = run.state.inputs().get(input).at(run.state.time());
    run.state.set_input(input, told + change);
    run.model.observe(&run.state, &mut run.point);
    for ((output, expected), before) in expected.iter().zip(before) {
        let (answer, changed) = (run.model.response_of(&response, *output), run.read(*output) - before);
        let rounding = 1e-13 * (expected.abs() + before.abs().max(change.abs()));
        assert!((answer - expected).abs() <= rounding, "{input:?} on {output:?}: {answer:e} not {expected:e}");
        assert!((changed - expected).abs() <= rounding, "{input:?} on {output:?} changes {changed:e} not {expected:e}");
    }
    run.state.set_input(input, told);
    run.model.observe(&run.state, &mut run.point);
}

const FOUNDATION: Output = Output::Foundation(BuildingId::LEFT, F::Acceleration);
const FLOORS: [Output; 2] = [Output::Acceleration(BuildingId::LEFT, 0), Output::Acceleration(BuildingId::RIGHT, 0)];
const REACTION: Output = Output::Contact(0, ContactOutput::Force);

/// Soil and storey do not know of the ground's acceleration, nor of a force on a floor, yet.
#[test]
fn a_foundation_that_is_free_answers_to_no_input() {
    let mut scene = one_storey(6e4, 9e5, Some(2.4e9));
    scene.floor_forces = true;
    let mut run = Run::new(&scene, None);
    run.state.set_ground_acceleration(1.0);
    run.to(0.1);
    assert!(run.read(FOUNDATION).abs() > 1e-3);
    assert_answers(&mut run, (Input::GroundAcceleration, 1e3), &[(FOUNDATION, 0.0), (FLOORS[0], 0.0)]);
    let force = Input::Force(BuildingId::LEFT, 0);
    assert_answers(&mut run, (force, 1e3), &[(FOUNDATION, 0.0), (FLOORS[0], 1e3 / ONE.0)]);
}

/// kg, kg m2, m: a floor on either side, the foundation on the left, its storey, and where that is hit.
const FLOOR: f64 = 2e5;
const MASS: f64 = 8e4;
const INERTIA: f64 = 2e6;
const HEIGHT: f64 = 6.0;
const LEVEL: f64 = 3.5;

/// The columns of a storey that leans with its foundation are pressed against the floor of a building on a fixed base.
fn columns(sway: &str, more: &str) -> Scene {
    let contact = "gap = 0.0\nlaw = \"stereomechanical\"\nrestitution = 0.0\n";
    let wall = if more.is_empty() { String::new() } else { format!("[[contact]]\n{more}{contact}") };
    let mut scene = scene(&format!(
        "name = \"Columns\"\n[left]\nmass = [{FLOOR:?}]\nheight = [{HEIGHT:?}]\nstiffness = [4e7]\n\
         damping = {{ ratio = 0.05 }}\n[left.foundation]\nmass = {MASS:?}\ninertia = {INERTIA:?}\n{sway}\
         rocking = {{ stiffness = 2e9, dashpot = 1e8 }}\n[right]\nmass = [{FLOOR:?}]\nheight = [{LEVEL:?}]\n\
         stiffness = [4e7]\ndamping = {{ ratio = 0.05 }}\n[[contact]]\nleft_storey = 1\nright_floor = 1\n{contact}{wall}"
    ));
    scene.floor_forces = true;
    scene
}

const SWAY: &str = "sway = { stiffness = 2e8, dashpot = 2e6 }\n";

/// Weights of floor, foundation and rotation in the motion of the columns, and 1/m of each of them.
fn shares() -> [(f64, f64); 3] {
    let s = LEVEL / HEIGHT;
    let n = s * s * (3.0 - 2.0 * s);
    [(n, 1.0 / FLOOR), (1.0 - n, 1.0 / MASS), ((s - n) * HEIGHT, 1.0 / INERTIA)]
}

/// 1/m against a force on the columns.
fn inverse_mass(shares: &[(f64, f64)]) -> f64 {
    shares.iter().map(|(weight, inverse)| weight * weight * inverse).sum()
}

/// The ground pushes floors and foundations alike and no rotation: a reaction on the columns does not follow it at once. A
/// force on the floor goes through the columns to the foundation.
#[test]
fn a_force_on_a_floor_that_presses_columns_reaches_their_foundation() {
    let mut run = Run::new(&columns(SWAY, ""), None);
    press(&mut run, 4e5);
    run.state.set_ground_acceleration(0.3);
    run.to(0.05);
    assert!(run.contact(0).active && run.contact(0).force > 1e5, "{:?}", run.contact(0));
    let [(n, of_floor), (below, of_foundation), _] = shares();
    let reaction = -1e3 * of_floor / (inverse_mass(&shares()) + of_floor);
    let answers = [
        (REACTION, reaction),
        (FOUNDATION, -below * reaction * of_foundation),
        (FLOORS[0], -n * reaction * of_floor),
        (FLOORS[1], (1e3 + reaction) * of_floor),
    ];
    assert_answers(&mut run, (Input::Force(BuildingId::RIGHT, 0), 1e3), &answers);
    let answers = [(REACTION, 0.0), (FOUNDATION, 0.0), (FLOORS[0], 0.0), (FLOORS[1], 0.0)];
    assert_answers(&mut run, (Input::GroundAcceleration, 1.0), &answers);
}

/// A floor between columns and a wall moves with the ground at once, and has them follow it.
#[test]
fn columns_that_are_held_to_the_ground_have_their_foundation_follow_it() {
    let mut run = Run::new(&columns(SWAY, "right_floor = 1\nwall = \"right\"\n"), None);
    run.state.set_floor_force(BuildingId::LEFT, 0, 8e5);
    run.to(0.05);
    assert!((0..2).all(|p| run.contact(p).active && run.contact(p).force > 1e5), "{:?}", run.contacts());
    let [(n, of_floor), (below, of_foundation), _] = shares();
    let reaction = -1.0 / inverse_mass(&shares());
    let answers = [
        (REACTION, reaction),
        (Output::Contact(1, ContactOutput::Force), reaction - FLOOR),
        (FOUNDATION, -below * reaction * of_foundation),
        (FLOORS[0], -n * reaction * of_floor),
        (FLOORS[1], 1.0),
    ];
    assert_answers(&mut run, (Input::GroundAcceleration, 1.0), &answers);
}

/// The lower end of the columns is the ground where their foundation rocks without sway; their rotation is not pushed.
#[test]
fn the_ground_has_its_share_in_columns_whose_foundation_only_rocks() {
    let mut run = Run::new(&columns("", ""), None);
    press(&mut run, 4e5);
    run.to(0.05);
    assert!(run.contact(0).active && run.contact(0).force > 1e5, "{:?}", run.contact(0));
    let [floor, (below, _), rotation] = shares();
    let (n, of_floor) = floor;
    let reaction = below / (inverse_mass(&[floor, rotation]) + of_floor);
    let answers = [(REACTION, reaction), (FLOORS[0], -n * reaction * of_floor), (FLOORS[1], reaction * of_floor)];
    assert_answers(&mut run, (Input::GroundAcceleration, 1.0), &answers);
}
