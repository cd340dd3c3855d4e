//! Every way in which a contact can begin and end, by name; each with an answer in closed form.

use crate::common::problems::two_masses::{Mass, TwoMasses};
use crate::common::{Run, assert_close, record, scene};
use pounding::engine::{BuildingId, EngineError, Output};
use pounding::scene::Scene;
use std::f64::consts::PI;

/// Left: 1 kg on a spring of (2 pi)^2 N/m, so one period a second, undamped. Right: at rest. No ground motion but an input.
fn pendulum(left: &str, contacts: &str) -> Scene {
    let stiffness = 4.0 * PI * PI;
    scene(&format!(
        "name = \"Pendulum\"
        [left]
        mass = [1.0]
        stiffness = [{stiffness:?}]
        damping = {{ ratio = 0.0 }}
        {left}
        [right]
        mass = [1.0e3]
        stiffness = [1.0e7]
        damping = {{ ratio = 0.0 }}
        {contacts}"
    ))
}

fn wall(gap: f64) -> String {
    format!("[[contact]]\nleft_floor = 1\nright_floor = 1\ngap = {gap:?}\nlaw = \"linear\"\nstiffness = 1.0e6")
}

#[test]
fn free_vibration_stays_in_phase_over_1000_periods() {
    for step in [0.01, 0.37, 1000.0] {
        let mut run = Run::new(&pendulum("initial_displacement = [0.01]", ""), None);
        let count = (1000.0_f64 / step).round() as usize;
        for k in 1..=count {
            run.to(k as f64 * step);
        }
        let t = run.state.time();
        // The frequency itself is rounded: 1000 periods turn that into a phase.
        let error = (run.displacement(BuildingId::LEFT, 0) - 0.01 * (2.0 * PI * t).cos()).abs();
        assert!(error < 0.01 * 2e-12, "step {step}: {error:e}");
    }
}

#[test]
fn a_held_ground_acceleration_is_a_shifted_vibration() {
    let mut run = Run::new(&pendulum("", ""), None);
    run.state.set_ground_acceleration(2.0);
    run.in_steps(0.13, 1.3);
    let w = 2.0 * PI;
    let exact = -2.0 / (w * w) * (1.0 - (w * 1.3).cos());
    assert_close(run.displacement(BuildingId::LEFT, 0), exact, 1e-13, "displacement");
    // Absolute acceleration: what an accelerometer on the floor reads, -w^2 u without damping.
    assert_close(run.read(Output::Acceleration(BuildingId::LEFT, 0)), -w * w * exact, 1e-13, "acceleration");
    assert_close(run.read(Output::BaseShear(BuildingId::LEFT)), w * w * exact, 1e-13, "base shear");
    // From now on the ground rests: the vibration goes on about 0.
    let (u, v) = (run.displacement(BuildingId::LEFT, 0), run.velocity(BuildingId::LEFT, 0));
    run.state.set_ground_acceleration(0.0);
    run.to(1.7);
    assert_close(run.displacement(BuildingId::LEFT, 0), u * (w * 0.4).cos() + v / w * (w * 0.4).sin(), 1e-12, "after");
}

#[test]
fn a_floor_force_is_a_shifted_vibration() {
    let mut run = Run::new(&pendulum("", "[inputs]\nfloor_forces = true\n[outputs]\nenergy = true"), None);
    run.state.set_floor_force(BuildingId::LEFT, 0, 3.0);
    run.in_steps(0.11, 1.1);
    let w = 2.0 * PI;
    let exact = 3.0 / (w * w) * (1.0 - (w * 1.1).cos());
    assert_close(run.displacement(BuildingId::LEFT, 0), exact, 1e-13, "displacement");
    let energy = run.energy();
    assert_close(energy.external, 3.0 * exact, 1e-13, "work of the force");
    assert!(energy.residual.abs() < 1e-14, "{energy:?}");
}

#[test]
fn a_record_is_a_ramp_between_its_samples_and_nothing_outside() {
    // A ramp from 0 to 4 m/s2 in 0.5 s, one sample interval; then nothing.
    let record = record(0.5, &[0.0, 4.0]);
    let mut scene = pendulum("", "");
    scene.ground.record = Some("ramp.csv".into());
    let w = 2.0 * PI;
    // -w^2 u = a t/0.5 (t - sin(w t)/w) on the ramp.
    let on_ramp = |t: f64| -8.0 / (w * w) * (t - (w * t).sin() / w);
    let slope = |t: f64| -8.0 / (w * w) * (1.0 - (w * t).cos());
    for step in [0.05, 0.5, 0.9] {
        let mut run = Run::new(&scene, Some(&record));
        let mut t = 0.0;
        while t < 1.8 {
            t += step;
            run.to(t);
            let exact = if t <= 0.5 {
                on_ramp(t)
            } else {
                on_ramp(0.5) * (w * (t - 0.5)).cos() + slope(0.5) / w * (w * (t - 0.5)).sin()
            };
            let error = (run.displacement(BuildingId::LEFT, 0) - exact).abs();
            assert!(error < 1e-15, "t = {t}: {error:e}");
            let ground = if t < 0.5 { 8.0 * t } else { 0.0 };
            assert!((run.point.ground_acceleration - ground).abs() < 1e-14 || (t - 0.5).abs() < 1e-12);
        }
    }
}

#[test]
fn a_run_may_start_within_after_and_long_before_the_record() {
    let record = record(0.5, &[0.0, 4.0]);
    let mut scene = pendulum("initial_displacement = [0.01]", "");
    scene.ground.record = Some("ramp.csv".into());
    let w = 2.0 * PI;
    // Before and after: free vibration. The frequency's rounding and t - start are all that is left.
    for (start, duration) in [(-3.25, 3.0), (0.75, 2.3), (1.0e6, 2.3)] {
        let mut run = Run::from(&scene, Some(&record), start);
        run.to(start + duration);
        let exact = 0.01 * (w * duration).cos();
        let rounding = 0.01 * w * f64::EPSILON * start.abs();
        assert!((run.displacement(BuildingId::LEFT, 0) - exact).abs() < 1e-16 + 1e-15 + rounding, "from {start}");
    }
    // Within: from t = 0.2 the ramp has 1.6 m/s2 already.
    let mut run = Run::from(&scene, Some(&record), 0.2);
    run.to(0.45);
    let t = 0.25;
    let exact = 0.01 * (w * t).cos() - 1.6 / (w * w) * (1.0 - (w * t).cos()) - 8.0 / (w * w) * (t - (w * t).sin() / w);
    assert_close(run.displacement(BuildingId::LEFT, 0), exact, 1e-13, "within");
}

/// Times at which 0.01 sin(2 pi t) first reaches a gap.
fn entry(gap: f64) -> f64 {
    (gap / 0.01_f64).asin() / (2.0 * PI)
}

#[test]
fn an_entry_anywhere_in_a_communication_step_is_at_the_same_instant() {
    let speed = 0.01 * 2.0 * PI;
    for step in [1e-4, 0.013, 0.1, entry(0.004), 0.24] {
        let mut run = Run::new(&pendulum(&format!("initial_velocity = [{speed:?}]"), &wall(0.004)), None);
        run.in_steps(step, 0.24);
        assert_eq!(run.episodes.len(), 1, "step {step}");
        // One input-driven communication step after another rounds; 1 fs is what is left after thousands.
        assert!((run.episodes[0].start - entry(0.004)).abs() < 1e-15, "step {step}: {}", run.episodes[0].start);
        let rate = speed * (1.0_f64 - 0.16).sqrt();
        assert_close(run.episodes[0].approach_velocity, rate, 1e-13, "approach velocity");
    }
}

#[test]
fn entry_and_release_within_one_interval_are_both_seen() {
    // 3 ms of contact within one step of 0.24 s, and within one of 20 s there are many.
    let speed = 0.01 * 2.0 * PI;
    let scene = pendulum(&format!("initial_velocity = [{speed:?}]"), &wall(0.004));
    let mut run = Run::new(&scene, None);
    run.to(0.24);
    let episode = run.episodes[0];
    assert!(episode.end.unwrap() - episode.start < 4e-3 && run.contact(0).impacts == 1);
    assert_eq!(episode.dissipated_energy, 0.0);
    let mut long = Run::new(&scene, None);
    long.to(20.0);
    let mut short = Run::new(&scene, None);
    short.in_steps(0.001, 20.0);
    assert_eq!(long.contact(0).impacts, short.contact(0).impacts);
    assert!(long.contact(0).impacts >= 20);
    let difference = (long.displacement(BuildingId::LEFT, 0) - short.displacement(BuildingId::LEFT, 0)).abs();
    // Elastic impacts for ever: rounding grows, but slowly.
    assert!(difference < 1e-11, "{difference:e}");
}

#[test]
fn a_graze_of_a_picometre_is_an_impact_and_a_miss_by_one_is_none() {
    for step in [0.001, 0.1, 0.5] {
        let swing = |gap: f64| {
            let mut run = Run::new(&pendulum("initial_displacement = [-0.01]", &wall(gap)), None);
            run.in_steps(step, 0.7);
            run
        };
        let graze = swing(0.01 - 1e-12);
        assert_eq!(graze.episodes.len(), 1, "step {step}");
        // Half the touch lasts acos(1 - 1e-10) / w; the contact hardly feels it.
        let half = (1.0_f64 - 1e-10).acos() / (2.0 * PI);
        assert_close(graze.episodes[0].approach_velocity, 0.01 * 2.0 * PI * (2.0 * PI * half).sin(), 1e-4, "speed");
        assert!(swing(0.01 + 1e-12).episodes.is_empty(), "step {step}");
    }
}

#[test]
fn an_entry_at_the_end_of_a_step_belongs_to_one_episode() {
    // The step ends where the contact begins, up to the last bit in either direction.
    let speed = 0.01 * 2.0 * PI;
    for ulps in -3..=3_i64 {
        let t = f64::from_bits((entry(0.004).to_bits() as i64 + ulps) as u64);
        let mut run = Run::new(&pendulum(&format!("initial_velocity = [{speed:?}]"), &wall(0.004)), None);
        run.to(t).to(0.24);
        assert_eq!(run.contact(0).impacts, 1, "{ulps} ulps off");
        assert!((run.episodes[0].start - entry(0.004)).abs() < 1e-16 * 3.0);
    }
}

#[test]
fn a_pair_pressed_together_at_the_start_is_an_episode_from_then_on() {
    // Two free masses, a linear spring of 1e6 N/m compressed by 1 mm: a quarter of a cosine, then apart.
    let mass = Mass::free(2.0, 0.0);
    let pressed = TwoMasses::new(mass, mass, -0.001, "law = \"linear\"\nstiffness = 1.0e6");
    let scene = scene(&TwoMasses { energy: false, ..pressed }.toml());
    let mut run = Run::new(&scene, None);
    let w = 1000.0;
    run.to(0.0005);
    assert!(run.contact(0).active && run.contact(0).impacts == 1);
    assert_close(run.contact(0).force, 1000.0 * f64::cos(w * 0.0005), 1e-12, "force");
    run.to(0.01);
    let episode = run.episodes[0];
    assert_eq!((episode.start, episode.approach_velocity), (0.0, 0.0));
    assert_close(episode.end.unwrap(), PI / 2.0 / w, 1e-12, "release");
    assert_close(episode.separation_velocity, 0.001 * w, 1e-12, "separation");
    assert_close(episode.peak_force, 1000.0, 1e-14, "peak force");
    assert_eq!(episode.peak_time, 0.0);
    // The spring has given back what it held: half a joule came out of the contact.
    assert_close(episode.dissipated_energy, -0.5, 1e-12, "work on the contact");
    assert!(!run.contact(0).active);
}

#[test]
fn floors_that_touch_without_pressing_are_not_in_contact() {
    // Gap 0 and two equal buildings: they sway together and never press.
    let scene = scene(
        "name = \"Twins\"
        [left]
        mass = [2.0, 3.0]
        stiffness = [500.0, 400.0]
        damping = { ratio = 0.02 }
        [right]
        mass = [2.0, 3.0]
        stiffness = [500.0, 400.0]
        damping = { ratio = 0.02 }
        [[contact]]
        left_floor = 2
        right_floor = 2
        gap = 0.0
        law = \"hertz\"
        stiffness = 1.0e6",
    );
    let mut run = Run::new(&scene, None);
    for k in 0..200 {
        run.state.set_ground_acceleration((f64::from(k) * 0.37).sin());
        run.to(f64::from(k + 1) * 0.05);
    }
    assert_eq!(run.point.impacts, 0);
    assert!(run.displacement(BuildingId::LEFT, 1).abs() > 1e-3);
}

#[test]
fn two_pairs_that_meet_at_the_same_instant_both_begin_there() {
    // Rigid-body motion of two equal floors towards two equal floors.
    let mut toml = String::from("name = \"Pairs\"\n");
    for (side, speed) in [("left", 0.5), ("right", 0.0)] {
        toml += &format!(
            "[{side}]\nmass = [10.0, 10.0]\nstiffness_matrix = [[1.0e-9, 0.0], [0.0, 1.0e-9]]
            damping = {{ ratio = 0.0 }}\ninitial_velocity = [{speed:?}, {speed:?}]\n"
        );
    }
    for law in ["law = \"linear\"\nstiffness = 1.0e6", "law = \"hertz\"\nstiffness = 1.0e8"] {
        let mut toml = toml.clone();
        for floor in [1, 2] {
            toml += &format!("[[contact]]\nleft_floor = {floor}\nright_floor = {floor}\ngap = 0.01\n{law}\n");
        }
        let mut run = Run::new(&scene(&toml), None);
        run.to(0.1);
        assert_eq!(run.episodes.len(), 2, "{law}");
        for (episode, floor) in run.episodes.iter().zip([0, 1]) {
            assert_close(episode.start, 0.02, 1e-14, "entry");
            assert_close(episode.separation_velocity, 0.5, 1e-12, "equal masses swap velocities");
            assert!(run.velocity(BuildingId::LEFT, floor).abs() < 1e-12);
            assert_close(run.velocity(BuildingId::RIGHT, floor), 0.5, 1e-12, "right floor");
        }
    }
}

/// Gap 0 and a ground motion that starts from nothing: the floors part, or press, at the fifth power of time.
#[test]
fn floors_that_touch_at_rest_are_pressed_by_the_motion_alone() {
    for law in ["law = \"linear\"\nstiffness = 1.0e10", "law = \"hertz\"\nstiffness = 5.0e11\nexponent = 1.3"] {
        for (left, right) in [((2e4, 4e9), (1e6, 5e9)), ((17.0, 1.2e6), (9e4, 2e9)), ((3e3, 2e7), (3e2, 4e4))] {
            for sign in [1.0, -1.0] {
                let on_spring = |(mass, stiffness), damping| Mass { damping, ..Mass::on_spring(mass, stiffness, 0.0) };
                let mut scene = scene(&TwoMasses::new(on_spring(left, 0.05), on_spring(right, 0.02), 0.0, law).toml());
                scene.ground.record = Some("r.csv".into());
                let motion: Vec<f64> = (0..50).map(|k| sign * (f64::from(k) * 0.31).sin()).collect();
                let mut run = Run::new(&scene, Some(&record(0.02, &motion)));
                run.to(1e-6).to(1e-3);
                let early = run.contact(0);
                // Damping tells first: the building with more damping per mass lags behind.
                assert!(early.penetration.abs() < 1e-9 && early.force.abs() < 1.0, "{law}: {early:?}");
                run.to(1.0);
                let residual = run.energy().residual;
                assert!(residual.abs() < 1e-12, "{law} {left:?} {right:?} {sign}: residual {residual:e}");
                assert!(run.point.impacts > 0);
            }
        }
    }
}

#[test]
fn a_motion_whose_energy_overflows_is_refused() {
    let mut run = Run::new(&pendulum("", "[inputs]\nfloor_forces = true\n[outputs]\nenergy = true"), None);
    run.state.set_floor_force(BuildingId::LEFT, 0, 1e300);
    // Displacements of 1e299 m are finite, their squares are not.
    let refused = (1..=20).find_map(|k| run.model.advance(&mut run.state, f64::from(k) * 0.05, &mut |_| ()).err());
    let refused = refused.unwrap();
    assert!(refused.to_string().contains("double precision"));
    assert!(matches!(refused, EngineError::Overflow { time, contact: None } if time > 0.0), "{refused:?}");
}
