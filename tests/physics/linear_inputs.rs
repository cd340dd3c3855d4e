//! Inputs that are linear in time from when they are set: in flight, in contact, between rigid floors, in the account of
//! energy; against closed forms and against the same motion of the ground as a record.

use crate::common::{Run, assert_close, record, scene};
use pounding::engine::BuildingId;
use pounding::record::Record;
use pounding::scene::Scene;
use std::f64::consts::PI;

const W: f64 = 2.0 * PI;

/// Left: `left` kg on a spring, right: `right` kg likewise, with forces on the floors and an account of energy.
fn bodies((left, left_stiffness): (f64, f64), (right, right_stiffness): (f64, f64), more: &str) -> Scene {
    let body = |mass: f64, stiffness: f64| {
        format!("mass = [{mass:?}]\nstiffness = [{stiffness:?}]\ndamping = {{ ratio = 0.0 }}")
    };
    scene(&format!(
        "name = \"Bodies\"\n[inputs]\nfloor_forces = true\n[outputs]\nenergy = true\n[left]\n{}\n[right]\n{}\n{more}",
        body(left, left_stiffness),
        body(right, right_stiffness)
    ))
}

fn contact(gap: f64, law: &str) -> String {
    format!("[[contact]]\nleft_floor = 1\nright_floor = 1\ngap = {gap:?}\n{law}")
}

fn ramp(run: &mut Run, side: BuildingId, force: f64, rate: f64) {
    run.state.set_floor_force(side, 0, force);
    run.state.set_floor_force_rate(side, 0, rate);
}

/// u under a force f + r t on 1 kg with w = 2 pi, from rest.
fn on_spring(f: f64, r: f64, t: f64) -> f64 {
    (f * (1.0 - (W * t).cos()) + r * (t - (W * t).sin() / W)) / (W * W)
}

#[test]
fn a_ramp_in_flight_is_exact_in_any_communication_step() {
    for start in [0.0, 1e6] {
        for step in [0.01, 0.31, 3.1] {
            let mut run = Run::from(&bodies((1.0, W * W), (1e3, 1e7), ""), None, start);
            ramp(&mut run, BuildingId::LEFT, 2.0, -5.0);
            run.state.set_ground_acceleration(-1.0);
            run.state.set_ground_acceleration_rate(0.7);
            run.in_steps(step, start + 3.1);
            // The ground pushes 1 kg with minus its acceleration. Far from 0 the end itself is rounded.
            let allowed = if start == 0.0 { 2e-14 } else { 1e-10 };
            assert_close(run.displacement(BuildingId::LEFT, 0), on_spring(3.0, -5.7, 3.1), allowed, "displacement");
            assert_close(run.point.ground_acceleration, -1.0 + 0.7 * 3.1, allowed, "acceleration of the ground");
            let energy = run.energy();
            assert!(energy.residual.abs() < 1e-13, "step {step}: {energy:?}");
        }
    }
}

#[test]
fn the_work_of_a_ramp_is_that_of_its_closed_form() {
    let mut run = Run::new(&bodies((1.0, W * W), (1e3, 1e7), ""), None);
    let (f, r, t) = (2.0, -5.0, 1.3);
    ramp(&mut run, BuildingId::LEFT, f, r);
    run.to(t);
    // Integral of (f + r t) du/dt, du/dt = f sin(w t) / w + r (1 - cos(w t)) / w^2.
    let (s, c) = (W * t).sin_cos();
    let first = f * f / W * (1.0 - c) + f * r / W * (t - s / W);
    let second = f * r / W * (s / W - t * c) + r * r / W * (0.5 * t * t * W - (c - 1.0) / W - t * s) / W;
    assert_close(run.energy().external, (first + second) / W, 1e-13, "work");
}

/// Two equal storeys: modes (1, g) and (g, -1) with g = (1 + sqrt 5) / 2, w^2 = k/m (2 - g) and k/m (g + 1).
#[test]
fn a_ramp_on_one_floor_moves_all_modes() {
    let storeys = "mass = [2.0, 2.0]\nstiffness = [800.0, 800.0]\ndamping = { ratio = 0.0 }";
    let text = format!("name = \"A\"\n[inputs]\nfloor_forces = true\n[left]\n{storeys}\n[right]\n{storeys}");
    let mut run = Run::new(&scene(&text), None);
    run.state.set_floor_force_rate(BuildingId::RIGHT, 1, 30.0);
    run.in_steps(0.17, 1.7);
    let g = 0.5 * (1.0 + 5.0_f64.sqrt());
    let mode = |w2: f64, shape: [f64; 2]| {
        let (w, norm) = (w2.sqrt(), 2.0 * (1.0 + g * g));
        let q = 30.0 * shape[1] / norm * (1.7 - (w * 1.7).sin() / w) / w2;
        shape.map(|shape| shape * q)
    };
    let (low, high) = (mode(400.0 * (2.0 - g), [1.0, g]), mode(400.0 * (g + 1.0), [g, -1.0]));
    for floor in 0..2 {
        assert_close(run.displacement(BuildingId::RIGHT, floor), low[floor] + high[floor], 1e-13, "displacement");
        assert_eq!(run.displacement(BuildingId::LEFT, floor), 0.0);
    }
}

/// Free bodies that stay in contact: their distance is a mass m on the spring of the contact, pushed by F m / m_left.
#[test]
fn a_ramp_in_contact_is_exact() {
    for (law, exact) in [("linear", true), ("kelvin_voigt", false)] {
        let (m1, m2, k) = (3.0_f64, 5.0, 4e4);
        let restitution = if exact { "" } else { "restitution = 0.6" };
        let text = contact(0.0, &format!("law = \"{law}\"\nstiffness = {k:?}\n{restitution}"));
        for step in [0.0007, 0.4] {
            let mut run = Run::new(&bodies((m1, 1e-20), (m2, 1e-20), &text), None);
            let (f, r, t) = (6.0, 11.0, 0.4);
            ramp(&mut run, BuildingId::LEFT, f, r);
            run.in_steps(step, t);
            let m = m1 * m2 / (m1 + m2);
            // d'' + c/m d' + k/m d = (f + r t) / m1: a ramp p + s t with what is left over swinging and dying.
            let (w2, zeta) =
                (k / m, if exact { 0.0 } else { -(0.6_f64.ln()) / (PI * PI + 0.6_f64.ln().powi(2)).sqrt() });
            let (w, c) = (w2.sqrt(), 2.0 * zeta * w2.sqrt());
            let (s, wd, b) = (r / m1 / w2, w * (1.0 - zeta * zeta).sqrt(), zeta * w);
            let p = f / m1 / w2 - c * s / w2;
            let swing = (-b * t).exp() * (-p * (wd * t).cos() - (s + b * p) / wd * (wd * t).sin());
            let d = p + s * t + swing;
            let centre = (0.5 * f * t * t + r * t * t * t / 6.0) / (m1 + m2);
            let contact = run.contact(0);
            assert!(contact.active && contact.impacts == 1, "{law}: {contact:?}");
            assert_close(contact.penetration, d, 2e-12, law);
            assert_close(run.displacement(BuildingId::LEFT, 0), centre + m / m1 * d, 1e-12, law);
            assert_close(run.displacement(BuildingId::RIGHT, 0), centre - m / m2 * d, 1e-12, law);
            let energy = run.energy();
            assert!(energy.residual.abs() < 1e-12, "{law}: {energy:?}");
        }
    }
}

/// Rigid floors that a falling force presses together: the reaction falls with it, and ends when it is 0.
#[test]
fn rigid_floors_part_when_a_falling_force_says() {
    let (m1, m2, f, r) = (3.0_f64, 5.0, 4.0, -2.0);
    let text = contact(0.0, "law = \"stereomechanical\"\nrestitution = 0.3");
    for step in [0.05, 0.7, 3.0] {
        let mut run = Run::new(&bodies((m1, 1e-20), (m2, 1e-20), &text), None);
        ramp(&mut run, BuildingId::LEFT, f, r);
        run.to(0.5);
        assert_close(run.contact(0).force, m2 / (m1 + m2) * (f + r * 0.5), 1e-13, "reaction");
        run.in_steps(step, 3.0);
        assert!(!run.contact(0).active && run.episodes.len() == 1, "{:?}", run.episodes);
        assert_close(run.episodes[0].end.unwrap(), 2.0, 1e-14, "release");
        assert_close(run.episodes[0].impulse, m2 / (m1 + m2) * 4.0, 1e-13, "impulse");
        // Together until 2 s; then the left one goes on under its force alone.
        let (x, v) = (16.0 / 3.0 / (m1 + m2), 4.0 / (m1 + m2));
        assert_close(run.displacement(BuildingId::RIGHT, 0), x + v, 1e-13, "right");
        assert_close(run.displacement(BuildingId::LEFT, 0), x + v + r / 6.0 / m1, 1e-13, "left");
        assert!(run.energy().residual.abs() < 1e-13);
    }
}

/// The force falls to 0 exactly at a communication point, and jumps there: the floors are pressed together again.
#[test]
fn floors_that_are_let_go_at_a_jump_are_pressed_together_again() {
    let text = contact(0.0, "law = \"stereomechanical\"\nrestitution = 0.0");
    let mut run = Run::new(&bodies((3.0, 1e-20), (5.0, 1e-20), &text), None);
    ramp(&mut run, BuildingId::LEFT, 4.0, -2.0);
    run.to(2.0);
    run.state.set_floor_force(BuildingId::LEFT, 0, 8.0);
    for k in 1..=10 {
        run.to(2.0 + 0.1 * f64::from(k));
        let contact = run.contact(0);
        assert!(contact.active && contact.penetration.abs() < 1e-15, "{contact:?}");
        assert_close(contact.force, 5.0, 1e-13, "reaction");
    }
}

/// A swing that passes the wall by `depth` in the middle of one communication step, under a force that falls meanwhile.
#[test]
fn a_short_touch_under_a_ramp_is_found_and_a_miss_is_none() {
    for fall in [1.0, 3.0, 10.0] {
        for depth in [1e-6, 1e-9, 1e-12, -1e-12, -1e-9] {
            // u = -a v t + (1 + a) v sin(w t) / w under the force -a v w^2 t.
            let (v, a) = (0.3, fall);
            let u = |t: f64| -a * v * t + (1.0 + a) * v * (W * t).sin() / W;
            let top = (a / (1.0 + a)).acos() / W;
            let text = format!(
                "{}\n[left]\nmass = [1.0]\nstiffness = [{:?}]\ndamping = {{ ratio = 0.0 }}\ninitial_velocity = [{v:?}]",
                contact(u(top) - depth, "law = \"linear\"\nstiffness = 1.0e6"),
                W * W
            );
            let right = "[right]\nmass = [1.0e3]\nstiffness = [1.0e7]\ndamping = { ratio = 0.0 }";
            let scene = scene(&format!("name = \"T\"\n[inputs]\nfloor_forces = true\n{right}\n{text}"));
            for step in [0.3, 0.6, 0.9] {
                let mut run = Run::new(&scene, None);
                ramp(&mut run, BuildingId::LEFT, 0.0, -a * v * W * W);
                run.to(step * 0.6);
                assert_eq!(run.point.impacts, u64::from(depth > 0.0), "fall {fall}, depth {depth:e}, step {step}");
            }
        }
    }
}

/// The ramp alone makes the left body swing; the right one goes along with the rest of its motion, so that
/// d = -r sin(w t) / w^3 - gap. Values and slopes at both ends of the step tell nothing of the swing between.
#[test]
fn a_touch_that_only_the_ramp_brings_about_is_found() {
    let r = 50.0;
    let size = r / (W * W * W);
    for depth in [0.5 * size, 1e-9, -1e-9] {
        let text = contact(size - depth, "law = \"linear\"\nstiffness = 1.0e6");
        let mut scene = bodies((1.0, W * W), (1e3, 1e-20), &text);
        scene.buildings[1].initial_velocity = vec![r / (W * W)];
        let mut run = Run::new(&scene, None);
        run.state.set_floor_force_rate(BuildingId::LEFT, 0, r);
        run.to(1.5);
        assert_eq!(run.point.impacts > 0, depth > 0.0, "depth {depth:e}");
    }
}

/// Two and three storeys, close together, on the same ground.
fn frames(law: &str, damping: &str, more: &str) -> Scene {
    let frame = |floors: usize, damping: &str| {
        format!("mass = {:?}\nstiffness = {:?}\ndamping = {damping}", vec![3.65; floors], vec![2910.0; floors])
    };
    let contacts: String = [1, 2]
        .map(|floor| format!("[[contact]]\nleft_floor = {floor}\nright_floor = {floor}\ngap = 0.004\n{law}\n"))
        .concat();
    let (left, right) = (frame(2, damping), frame(3, "{ ratio = 0.02 }"));
    scene(&format!("name = \"F\"\n{more}\n[left]\n{left}\n[right]\n{right}\n{contacts}[outputs]\nenergy = true"))
}

fn shaking() -> Record {
    let sample = |k: i32| 3.0 * (f64::from(k) * 0.21).sin() + 1.5 * (f64::from(k) * 0.97).sin();
    record(0.02, &(0..100).map(sample).collect::<Vec<_>>())
}

const LAWS: [&str; 8] = [
    "law = \"stereomechanical\"\nrestitution = 0.5",
    "law = \"linear\"\nstiffness = 2.0e5",
    "law = \"kelvin_voigt\"\nstiffness = 1.0e5\nrestitution = 0.5",
    "law = \"kelvin_voigt_no_tension\"\nstiffness = 1.0e5\nrestitution = 0.5",
    "law = \"hertz\"\nstiffness = 1.0e6",
    "law = \"jankowski\"\nstiffness = 1.0e6\nrestitution = 0.5",
    "law = \"hertz_damped\"\nstiffness = 1.0e6\nrestitution = 0.5\ndamping_formula = \"exact\"",
    "law = \"hertz_damped\"\nstiffness = 1.0e6\nexponent = 1.3\nrestitution = 0.5\ndamping_formula = \"ye\"",
];

/// What both buildings show, and how hard they have met.
fn shown(run: &Run) -> Vec<f64> {
    let floors =
        [BuildingId::LEFT, BuildingId::RIGHT].map(|side| (0..run.model.floors(side)).map(move |floor| (side, floor)));
    let floors = floors.into_iter().flatten();
    floors.map(|(side, floor)| run.displacement(side, floor)).collect()
}

/// Runs beside each other, sample by sample; the largest difference of a displacement relative to the largest one.
fn difference(inside: &mut Run, driven: &mut Run, record: &Record, set: impl Fn(&mut Run, f64, f64)) -> f64 {
    let (mut apart, mut largest) = (0.0_f64, 0.0_f64);
    for k in 0..record.times.len() - 1 {
        let length = record.times[k + 1] - record.times[k];
        let [a, b] = [0, 1].map(|i| record.accelerations[k + i]);
        set(driven, a, (b - a) / length);
        let end = record.times[k + 1];
        // Splitting a step does not matter.
        driven.to(record.times[k] + 0.3 * length).to(end);
        inside.to(end);
        for (a, b) in shown(inside).iter().zip(shown(driven)) {
            apart = apart.max((a - b).abs());
            largest = largest.max(a.abs());
        }
        let energy = driven.energy();
        assert!(energy.residual.abs() < 1e-12, "{energy:?}");
    }
    assert!(inside.point.impacts > 5, "{} impacts", inside.point.impacts);
    assert_eq!(inside.point.impacts, driven.point.impacts);
    apart / largest
}

/// Damped so well that elastic impacts amplify rounding errors little.
const COUPLED: &str = "{ matrix = [[12.0, -4.0], [-4.0, 6.0]] }";

#[test]
fn a_linear_ground_acceleration_is_a_record() {
    let record = shaking();
    for law in LAWS {
        for damping in ["{ ratio = 0.05 }", COUPLED] {
            let driven = frames(law, damping, "");
            let mut inside = driven.clone();
            inside.ground.record = Some("r.csv".into());
            let set = |run: &mut Run, acceleration: f64, rate: f64| {
                run.state.set_ground_acceleration(acceleration);
                run.state.set_ground_acceleration_rate(rate);
            };
            let mut runs = (Run::new(&inside, Some(&record)), Run::new(&driven, None));
            let error = difference(&mut runs.0, &mut runs.1, &record, set);
            assert!(error < 2e-14, "{law}, {damping}: {error:e}");
        }
    }
}

#[test]
fn linear_forces_in_proportion_to_the_masses_are_a_moving_ground() {
    let record = shaking();
    for law in LAWS {
        for damping in ["{ ratio = 0.05 }", COUPLED] {
            let mut inside = frames(law, damping, "");
            inside.ground.record = Some("r.csv".into());
            let driven = frames(law, damping, "[inputs]\nfloor_forces = true");
            let mut runs = (Run::new(&inside, Some(&record)), Run::new(&driven, None));
            let set = |run: &mut Run, acceleration: f64, rate: f64| {
                for (side, floors) in [(BuildingId::LEFT, 2), (BuildingId::RIGHT, 3)] {
                    for floor in 0..floors {
                        run.state.set_floor_force(side, floor, -3.65 * acceleration);
                        run.state.set_floor_force_rate(side, floor, -3.65 * rate);
                    }
                }
            };
            let error = difference(&mut runs.0, &mut runs.1, &record, set);
            assert!(error < 2e-14, "{law}, {damping}: {error:e}");
            let [inside, driven] = [runs.0, runs.1].map(|run| run.energy());
            assert!((driven.external - inside.input).abs() < 1e-12 * inside.input, "{inside:?} and {driven:?}");
            assert_eq!(driven.input, 0.0);
        }
    }
}

/// With the record inside, forces end at communication points and the ground's slope at samples: both cut the steps.
#[test]
fn linear_forces_add_to_a_record() {
    let record = shaking();
    let halved = Record { accelerations: record.accelerations.iter().map(|a| 0.5 * a).collect(), ..record.clone() };
    let law = LAWS[6];
    let mut inside = frames(law, "{ ratio = 0.01 }", "");
    inside.ground.record = Some("r.csv".into());
    let mut driven = frames(law, "{ ratio = 0.01 }", "[inputs]\nfloor_forces = true");
    driven.ground.record = Some("r.csv".into());
    let mut runs = (Run::new(&inside, Some(&record)), Run::new(&driven, Some(&halved)));
    let set = |run: &mut Run, acceleration: f64, rate: f64| {
        for (side, floors) in [(BuildingId::LEFT, 2), (BuildingId::RIGHT, 3)] {
            for floor in 0..floors {
                run.state.set_floor_force(side, floor, -0.5 * 3.65 * acceleration);
                run.state.set_floor_force_rate(side, floor, -0.5 * 3.65 * rate);
            }
        }
    };
    let error = difference(&mut runs.0, &mut runs.1, &record, set);
    assert!(error < 1e-13, "{error:e}");
}

/// Tall buildings are followed floor by floor in contact.
#[test]
fn linear_forces_on_tall_buildings() {
    let tower = |floors: usize, stiffness: f64| {
        let storeys = (vec![25e3; floors], vec![stiffness; floors]);
        let damping = "{ rayleigh = { ratio = 0.05, modes = [1, 2] } }";
        format!("mass = {:?}\nstiffness = {:?}\ndamping = {damping}", storeys.0, storeys.1)
    };
    let towers = |more: &str| {
        let law = "law = \"hertz\"\nstiffness = 2.0e9";
        let pair =
            [8, 9].map(|i| format!("[[contact]]\nleft_floor = {i}\nright_floor = {i}\ngap = 0.003\n{law}\n")).concat();
        let (left, right) = (tower(10, 3e7), tower(9, 6e7));
        scene(&format!("name = \"T\"\n{more}\n[left]\n{left}\n[right]\n{right}\n[outputs]\nenergy = true\n{pair}"))
    };
    let record = shaking();
    let mut inside = towers("");
    inside.ground.record = Some("r.csv".into());
    let mut runs = (Run::new(&inside, Some(&record)), Run::new(&towers("[inputs]\nfloor_forces = true"), None));
    let set = |run: &mut Run, acceleration: f64, rate: f64| {
        for (side, floors) in [(BuildingId::LEFT, 10), (BuildingId::RIGHT, 9)] {
            for floor in 0..floors {
                run.state.set_floor_force(side, floor, -25e3 * acceleration);
                run.state.set_floor_force_rate(side, floor, -25e3 * rate);
            }
        }
    };
    let error = difference(&mut runs.0, &mut runs.1, &record, set);
    assert!(error < 1e-13, "{error:e}");
}

#[test]
fn a_slope_beyond_all_numbers_is_reported() {
    let mut run = Run::new(&bodies((1.0, W * W), (1e3, 1e7), ""), None);
    ramp(&mut run, BuildingId::LEFT, 0.0, 1e308);
    let error = run.model.advance(&mut run.state, 100.0, &mut |_| ()).unwrap_err();
    assert!(error.to_string().contains("exceeds what double precision can hold"), "{error}");
}
