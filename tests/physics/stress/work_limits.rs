//! Limits of work: whatever a scene asks for, a communication step ends after a bounded amount of work, and what it says
//! then names the key to change. And what need not be worked for is not.

use crate::common::problems::two_masses::{Mass, TwoMasses};
use crate::common::{Run, assert_close, press, scene};
use pounding::engine::{BuildingId, EngineError};
use pounding::scene::Scene;
use std::time::Instant;

/// Two masses of 1 t, at the top of springs of that stiffness, with forces on their floors.
fn masses(stiffness: f64, damping: f64, speed: f64, gap: f64, law: &str) -> Scene {
    let right = Mass { damping, ..Mass::on_spring(1e3, stiffness, 0.0) };
    let masses = TwoMasses::new(Mass { velocity: speed, ..right }, right, gap, law);
    scene(&TwoMasses { floor_forces: true, ..masses }.toml())
}

/// The message with which a step to `until` is given up after a tenth of a second of work.
fn message(scene: &Scene, force: f64, until: f64) -> String {
    let mut run = Run::new(scene, None);
    run.model.limit_work(0.1);
    press(&mut run, force);
    let clock = Instant::now();
    let given_up = run.model.advance(&mut run.state, until, &mut |_| ());
    // The limit counts work, which a busy machine in a debug build does more slowly than it says: by much less than this.
    assert!(clock.elapsed().as_secs_f64() < 20.0, "{:?}", clock.elapsed());
    given_up.expect_err("more than a tenth of a second of work").to_string()
}

#[track_caller]
fn assert_names(message: &str, names: &[&str]) {
    for name in names {
        assert!(message.contains(name), "no word of {name}: {message}");
    }
}

#[test]
fn a_stiff_dashpot_is_named_with_its_restitution() {
    // xi of eq. 8 is 0.6 / e: with e = 1e-12 the contact creeps for an age at rates of 1e12 1/s.
    let law = "law = \"jankowski\"\nstiffness = 1.0e9\nrestitution = 1.0e-12";
    let message = message(&masses(1e-20, 0.0, 0.5, 0.01, law), 1e3, 1.0);
    assert_names(&message, &["contact[1].restitution (now 1e-12)", "damping", "smaller communication steps"]);
}

#[test]
fn a_floor_on_the_approach_velocity_that_is_too_low_is_named() {
    let law = "law = \"hertz_damped\"\nstiffness = 1.0e9\nrestitution = 0.1\ndamping_formula = \"ye\"";
    let scene = masses(1e-20, 0.0, 0.0, 0.0, &format!("{law}\n[solver]\nmin_approach_velocity = 1.0e-14"));
    assert_names(&message(&scene, 1e3, 10.0), &["solver.min_approach_velocity (now 1e-14)", "contact[1].restitution"]);
}

#[test]
fn a_stiff_spring_that_is_pressed_for_long_is_named() {
    // 4e5 rad/s for 1e5 s.
    let message = message(&masses(1e-20, 0.0, 0.0, -1e-6, "law = \"linear\"\nstiffness = 1.0e14"), 1e9, 1e5);
    assert_names(&message, &["contact[1].stiffness (now 1e14)", "spring"]);
}

#[test]
fn floors_that_rebound_for_ever_are_named_with_their_restitution() {
    // Pressed together at 1 m/s2 each and elastic: thrown apart at 1 um/s they meet again after a microsecond, for ever.
    let law = "law = \"stereomechanical\"\nrestitution = 1.0";
    let message = message(&masses(1e-20, 0.0, 1e-6, 0.0, law), 1e3, 1e3);
    assert_names(&message, &["contact[1].restitution (now 1e0)", "impacts"]);
    let springs = "law = \"linear\"\nstiffness = 1.0e14";
    let message = self::message(&masses(1e-20, 0.0, 1e-6, 0.0, springs), 1e3, 1e6);
    assert_names(&message, &["contact[1]"]);
}

#[test]
fn a_building_that_is_too_stiff_or_damped_is_named() {
    let law = "law = \"linear\"\nstiffness = 1.0e6";
    // Pressed harder than the contact pushes them apart: at rest they would cost nothing.
    let stiff = message(&masses(1e18, 0.0, 0.0, -1e-3, law), 2e3, 1e3);
    assert_names(&stiff, &["left.stiffness", "left.mass"]);
    let damped = message(&masses(1e6, 1e5, 0.0, -1e-3, law), 2e3, 1e3);
    assert_names(&damped, &["left.damping"]);
}

/// With a record time goes on in steps as long as between its samples: for a day that is too much, and no stiffness is to
/// blame. Nor is its end where it is not over.
#[test]
fn a_run_far_beyond_its_record_is_named() {
    let mut scene = masses(1e6, 0.02, 0.0, 0.01, "law = \"linear\"\nstiffness = 1.0e6");
    scene.ground.record = Some("motion.csv".into());
    for (start, until) in [(0.0, 1e4), (0.0, 1e6), (-1e6, 1e4)] {
        let mut run = Run::from(&scene, Some(&crate::common::record(0.01, &[0.0, 0.1, 0.0])), start);
        run.model.limit_work(0.1);
        let given_up = run.model.advance(&mut run.state, until, &mut |_| ()).expect_err("a million steps");
        assert_names(&given_up.to_string(), &["the record", "smaller communication steps"]);
        assert!(!given_up.to_string().contains("stiffness"), "{given_up}");
    }
    let mut run = Run::new(&scene, Some(&crate::common::record(0.01, &[0.0, 0.1].repeat(10_000))));
    run.model.limit_work(1e-4);
    let given_up = run.model.advance(&mut run.state, 199.0, &mut |_| ()).expect_err("twenty thousand samples");
    assert!(!given_up.to_string().contains("beyond the record"), "{given_up}");
    let EngineError::TooMuchWork(given_up) = given_up else { panic!("{given_up:?}") };
    assert!(given_up.start == 0.0 && given_up.time > 0.0 && given_up.time < 199.0, "{given_up:?}");
    assert!(given_up.steps > 0 && given_up.in_contact == 0 && given_up.impacts == 0, "{given_up:?}");
}

/// The account of a motion under a load that changes is integrated at the pace of the fastest mode: for twelve days that
/// is too much, and what costs it is said.
#[test]
fn an_energy_account_that_takes_too_long_is_named() {
    let mut run = Run::new(&masses(1e6, 0.02, 0.0, 1.0, "law = \"linear\"\nstiffness = 1.0e6"), None);
    run.model.limit_work(0.1);
    run.state.set_floor_force_rate(BuildingId::LEFT, 0, 1e-2);
    let given_up = run.model.advance(&mut run.state, 1e6, &mut |_| ()).expect_err("an account of 3e7 pieces");
    assert_names(&given_up.to_string(), &["outputs.energy", "left.stiffness"]);
}

#[test]
fn absurd_inputs_end_too() {
    for law in ["law = \"linear\"\nstiffness = 1.0e9", "law = \"hertz\"\nstiffness = 1.0e9"] {
        for acceleration in [1e10, 1e20, 1e100, 1e200, 1e300] {
            let mut scene = masses(1e6, 0.02, 0.0, 0.01, law);
            scene.buildings[0].mass[0] = 2e3;
            let mut run = Run::new(&scene, None);
            run.model.limit_work(0.1);
            let clock = Instant::now();
            for k in 1..=20 {
                run.state.set_ground_acceleration(acceleration);
                let end = run.model.advance(&mut run.state, 0.1 * f64::from(k), &mut |_| ());
                if let Err(error) = end {
                    let known = ["double precision", "contact[1]", "communication steps"];
                    assert!(known.iter().any(|words| error.to_string().contains(words)), "{acceleration:e}: {error}");
                    break;
                }
            }
            assert!(clock.elapsed().as_secs_f64() < 20.0, "{law}, {acceleration:e}: {:?}", clock.elapsed());
        }
    }
}

/// A hundred thousand rebounds in one step, thrown up at 1 mm/s against 2 m/s2: one each millisecond, none lost.
#[test]
fn a_hundred_thousand_rebounds_in_one_step_are_counted() {
    let law = "law = \"stereomechanical\"\nrestitution = 1.0";
    let mut run = Run::new(&masses(1e-20, 0.0, 1e-3, 0.0, law), None);
    press(&mut run, 1e3);
    run.to(100.000_5);
    assert_eq!(run.point.impacts, 100_001);
    let last = run.episodes.last().unwrap();
    assert_close(last.approach_velocity, 1e-3, 1e-9, "as fast as the first");
    // A rounding error, 2e-16, for each.
    assert!(run.energy().residual.abs() < 2e-11, "{:?}", run.energy());
}

/// A step of twelve days: what has died out, or never reaches the other floor, costs nothing.
#[test]
fn quiet_time_costs_nothing_however_long() {
    let law = "law = \"hertz\"\nstiffness = 1.0e9";
    // Damped: some contacts, then rest at what the force holds.
    let mut damped = Run::new(&masses(1e6, 0.02, 2.0, 0.01, law), None);
    damped.state.set_floor_force(BuildingId::LEFT, 0, 2e3);
    damped.to(1e6);
    assert!(damped.point.impacts > 3, "{}", damped.point.impacts);
    assert_close(damped.displacement(BuildingId::LEFT, 0), 2e-3, 1e-12, "held");
    let energy = damped.energy();
    assert!(energy.residual.abs() < 1e-11, "{energy:?}");
    assert!(damped.state.counters().narrow_phase_pieces < 20_000, "{:?}", damped.state.counters());
    // Undamped, below the gap: u = v / w sin(w t), its phase of 3e7 rad known to 4 eps of it.
    let mut undamped = Run::new(&masses(1e6, 0.0, 0.3, 0.01, law), None);
    undamped.to(1e6);
    let w = 1e3_f64.sqrt();
    let exact = 0.3 / w * (w * 1e6).sin();
    let error = (undamped.displacement(BuildingId::LEFT, 0) - exact).abs();
    assert!(error < 0.3 / w * 4.0 * f64::EPSILON * w * 1e6, "{error:e}");
    assert_eq!(undamped.point.impacts, 0);
    assert!(undamped.state.counters().narrow_phase_pieces < 10, "{:?}", undamped.state.counters());
    assert!(undamped.energy().residual.abs() < 1e-11, "{:?}", undamped.energy());
    // A load that grows until it brings the floors together must not be slept through: k u = F t, u = gap.
    let mut growing = masses(1e6, 0.02, 0.0, 0.01, law);
    growing.energy = false;
    let mut growing = Run::new(&growing, None);
    growing.state.set_floor_force(BuildingId::LEFT, 0, 0.0);
    growing.state.set_floor_force_rate(BuildingId::LEFT, 0, 1e-2);
    growing.to(1.0001e6);
    let start =
        growing.model.open_episode(&growing.state, 0).map_or_else(|| growing.episodes[0].start, |open| open.start);
    assert_close(start, 1e6, 1e-6, "brought together");
}

/// Runs a scene for 2 s: it must come to its end, with its energy accounted for.
fn shake(scene_text: &str) {
    let mut scene = scene(scene_text);
    scene.ground.record = Some("motion.csv".into());
    let t = |k: i32| f64::from(k) / 64.0;
    let motion: Vec<f64> = (0..=128).map(|k| 4.0 * (9.0 * t(k)).sin() + 2.0 * (31.0 * t(k)).sin()).collect();
    let mut run = Run::new(&scene, Some(&crate::common::record(1.0 / 64.0, &motion)));
    let clock = Instant::now();
    run.to(2.0);
    assert!(clock.elapsed().as_secs_f64() < 20.0, "{:?}", clock.elapsed());
    assert!(run.point.impacts > 10, "{}", run.point.impacts);
    assert!(run.energy().residual.abs() < 1e-11, "{:?}", run.energy());
}

/// Four light storeys pressed against four heavy ones by very stiff contacts of three laws, and a rigid one beside them:
/// for a while a rate is nothing but rounding, in which the search for its passages through 0 once had no end.
#[test]
fn a_rate_that_is_rounding_is_not_searched_for_ever() {
    shake(include_str!("pressed_by_four.toml"));
}

/// Two pairs of one floor touch at rest and part and meet by rounding: contacts of 1e-79 m that last 1e-49 s, after
/// which a series in that unit of time once went on for milliseconds and overflowed.
#[test]
fn contacts_that_are_rounding_leave_no_trace() {
    shake(include_str!("touching_by_two.toml"));
}
