//! A wall moves with the ground: what that makes of the motion up to it, of reactions, and of impulses that go through
//! floors which are held against it. Against closed forms.

use crate::common::{Run, assert_close, record, scene};
use pounding::engine::{BuildingId, ContactOutput, Input, Output, Response};
use std::f64::consts::PI;

/// A single mass, kg, of that period, s, and more of the scene.
fn mass_and(mass: f64, period: f64, more: &str) -> String {
    let stiffness = mass * (2.0 * PI / period) * (2.0 * PI / period);
    format!(
        "name = \"Wall\"\n[left]\nmass = [{mass:?}]\nstiffness = [{stiffness:?}]\ndamping = {{ ratio = 0.0 }}\n{more}\n"
    )
}

fn wall(side: &str, gap: f64, law: &str) -> String {
    format!("[[contact]]\nleft_floor = 1\nwall = \"{side}\"\ngap = {gap:?}\n{law}\n")
}

#[test]
fn a_ground_that_begins_to_accelerate_carries_the_wall_to_the_mass() {
    // u = -(a/w^2) (1 - cos w t) under an acceleration a from 0 on: at the gap when cos w t = 1 - gap w^2 / a.
    let (period, gap) = (1.5, 0.02);
    let omega = 2.0 * PI / period;
    for acceleration in [0.5, 5.0, -5.0] {
        let towards = if acceleration > 0.0 { "left" } else { "right" };
        let law = "law = \"linear\"\nstiffness = 1e9";
        let text = mass_and(1e3, period, "[ground]\nrecord = \"step.csv\"") + &wall(towards, gap, law);
        let motion = record(0.01, &[acceleration; 101]);
        let mut run = Run::new(&scene(&text), Some(&motion));
        run.to(1.0);
        let expected = (1.0 - gap * omega * omega / acceleration.abs()).acos() / omega;
        assert_close(run.episodes[0].start, expected, 1e-12, &format!("entry under {acceleration} m/s2"));
    }
}

#[test]
fn an_impulse_goes_through_a_floor_that_is_held_against_a_wall() {
    // The right mass leans on a wall; the left one meets it and rebounds as if from the wall itself, with e of its speed.
    let (mass, speed, e, push) = (2.0, 0.4, 0.5, 30.0);
    let rigid = |meeting: &str, gap: f64, e: f64| {
        format!("[[contact]]\n{meeting}\ngap = {gap:?}\nlaw = \"stereomechanical\"\nrestitution = {e:?}\n")
    };
    let free = |side: &str, mass: f64, velocity: f64| {
        format!(
            "[{side}]\nmass = [{mass:?}]\nstiffness = [1e-20]\ndamping = {{ ratio = 0.0 }}\ninitial_velocity = [{velocity:?}]\n"
        )
    };
    let text = format!(
        "name = \"Through\"\n{}{}{}{}[inputs]\nfloor_forces = true\n[outputs]\nenergy = true\n",
        free("left", mass, speed),
        free("right", 3.0, 0.0),
        rigid("left_floor = 1\nright_floor = 1", 0.1, e),
        rigid("right_floor = 1\nwall = \"right\"", 0.0, 0.2),
    );
    let mut run = Run::new(&scene(&text), None);
    run.state.set_floor_force(BuildingId::RIGHT, 0, push);
    run.to(0.1);
    let held = run.contact(1);
    assert!(held.active && held.impacts == 1, "{held:?}");
    run.to(0.5);
    let (hit, leaning) = (run.contact(0), run.contact(1));
    assert_eq!(hit.impacts, 1);
    assert_close(run.velocity(BuildingId::LEFT, 0), -e * speed, 1e-14, "rebound");
    assert_close(hit.impulse, mass * (1.0 + e) * speed, 1e-14, "impulse of the impact");
    assert_close(leaning.impulse, push * 0.5 + hit.impulse, 1e-13, "impulse on the wall");
    assert!(leaning.active && leaning.impacts == 1, "the sustained contact goes on: {leaning:?}");
    assert!(run.displacement(BuildingId::RIGHT, 0).abs() < 1e-15 && run.velocity(BuildingId::RIGHT, 0).abs() < 1e-15);
    assert_close(leaning.force, push, 1e-14, "reaction of the wall");
    assert!(run.energy().residual.abs() < 1e-14, "{:?}", run.energy());
}

#[test]
fn a_reaction_of_a_wall_answers_to_the_ground_at_once() {
    // Held against the wall on its right, the mass goes with the ground: R = -m a - k u, u the gap.
    let (mass, period) = (1e3, 1.0);
    let law = "law = \"stereomechanical\"\nrestitution = 0.0";
    let text = mass_and(mass, period, "initial_displacement = [0.0]") + &wall("right", 0.0, law);
    let mut run = Run::new(&scene(&text), None);
    run.state.set_ground_acceleration(-2.0);
    run.to(0.3);
    assert!(run.contact(0).active);
    assert_close(run.contact(0).force, 2.0 * mass, 1e-13, "reaction");
    assert_close(run.read(Output::Acceleration(BuildingId::LEFT, 0)), -2.0, 1e-13, "acceleration");
    let mut response = Response::default();
    run.now().respond([(Input::GroundAcceleration, 1.0)], &mut response);
    let answer = |output| run.model.response_of(&response, output);
    assert_close(answer(Output::Contact(0, ContactOutput::Force)), -mass, 1e-14, "reaction by ground acceleration");
    assert_close(answer(Output::Acceleration(BuildingId::LEFT, 0)), 1.0, 1e-14, "acceleration by that of the ground");
}
