//! What is not looked at because floors cannot close that fast changes nothing: entries at the speed that the bound
//! allows, and runs that look at every pair, to the last bit.

use crate::common::problems::frames::zigzag;
use crate::common::problems::two_masses::{FREE, Mass, TwoMasses};
use crate::common::{Run, assert_close, record, scene};
use pounding::record::Record;
use pounding::scene::Scene;
use std::f64::consts::{FRAC_1_SQRT_2, FRAC_PI_4, PI};

/// Exact in binary.
const STEP: f64 = 1.0 / 64.0;

/// A body of 1 kg on the left, on a spring, and one on the right on another.
fn oscillator([stiffness, right]: [f64; 2], speed: f64, gap: f64) -> Scene {
    let left = Mass { velocity: speed, ..Mass::on_spring(1.0, stiffness, 0.0) };
    let right = Mass::on_spring(1.0, right, 0.0);
    let masses = TwoMasses::new(left, right, gap, "law = \"linear\"\nstiffness = 1.0e4");
    let mut scene = scene(&TwoMasses { energy: false, ..masses }.toml());
    scene.ground.record = Some("r.csv".into());
    scene
}

/// s, start of the first contact; and what it took.
fn entry(scene: &Scene, record: &Record, stop: f64) -> (f64, pounding::engine::Counters) {
    let mut run = Run::new(scene, Some(record));
    run.to(stop);
    assert!(!run.episodes.is_empty(), "no contact");
    (run.episodes[0].start, run.state.counters())
}

#[test]
fn a_body_at_the_speed_of_the_bound_enters_on_time() {
    // Free: it closes as fast as its amplitude says, in the last instant for which nothing is dismissed.
    for k in 1..150 {
        for (speed, beyond) in [(0.37, 0.0), (2.0, 1e-9), (2.0, -1e-9), (11.0, 0.3)] {
            let time = (f64::from(k) + beyond) * STEP;
            let (start, counters) =
                entry(&oscillator([FREE, 1.0], speed, speed * time), &record(STEP, &[0.0; 200]), 5.0);
            assert_close(start, time, 1e-11, "entry");
            assert!(counters.flights_cleared() as f64 >= 0.4 * f64::from(k) - 1.0, "{k}: {counters:?}");
        }
    }
}

#[test]
fn a_body_that_the_ground_sets_in_motion_enters_on_time() {
    // At rest for 40 samples, then a constant acceleration to the left.
    let samples: Vec<f64> = (0..200).map(|k| if k > 40 { -3.0 } else { 0.0 }).collect();
    for k in (1..100).step_by(7) {
        let free = f64::from(k) * 0.01;
        // A ramp of one sample first: v = 3 STEP / 2 and u = 3 STEP^2 / 6 at its end.
        let moved = STEP * STEP / 2.0 + 1.5 * STEP * free + 1.5 * free * free;
        let (start, _) = entry(&oscillator([FREE, 1e12], 0.0, moved), &record(STEP, &samples), 5.0);
        assert_close(start, 41.0 * STEP + free, 1e-9, "entry");
    }
}

#[test]
fn a_body_that_the_ground_kicks_enters_on_time() {
    // One sample of -200 m/s2 at t = STEP: -(its impulse) is the body's speed from 2 STEP on, as if from STEP on.
    let mut samples = [0.0; 200];
    samples[1] = -200.0;
    let speed = 200.0 * STEP;
    for k in 2..120 {
        let time = (f64::from(k) + 0.83) * STEP;
        let scene = oscillator([FREE, 1e12], 0.0, speed * (time - STEP));
        let (start, _) = entry(&scene, &record(STEP, &samples), 5.0);
        assert_close(start, time, 1e-9, "entry");
    }
}

#[test]
fn a_body_that_gathers_speed_enters_on_time() {
    // It starts at an angle of -45 degrees, where displacement and velocity share its amplitude, and enters at another.
    for k in 1..60 {
        let (angle, omega) = (0.02 + 0.008 * f64::from(k), 0.7 + 0.1 * f64::from(k));
        let mut scene = oscillator([omega * omega, 1.0], omega * FRAC_1_SQRT_2, angle.sin());
        scene.buildings[0].initial_displacement = vec![-FRAC_1_SQRT_2];
        let (start, _) = entry(&scene, &record(STEP, &[0.0; 200]), 5.0);
        assert_close(start, (angle + FRAC_PI_4) / omega, 1e-11, "entry");
    }
}

#[test]
fn a_body_that_turns_round_enters_on_time() {
    // It starts away from the other one, and comes back through its start.
    for k in 1..120 {
        let omega = 0.9 + 0.2 * f64::from(k);
        let (speed, angle) = (0.3, 0.004 * f64::from(k));
        let scene = oscillator([omega * omega, 1.0], -speed, speed / omega * angle.sin());
        let (start, counters) = entry(&scene, &record(STEP, &[0.0; 400]), 6.0);
        assert_close(start, (PI + angle) / omega, 1e-11, "entry");
        assert!(counters.flights_cleared() > 0 || k > 60, "{k}: {counters:?}");
    }
}

#[test]
fn bodies_that_the_ground_kicks_towards_each_other_enter_on_time() {
    let mut samples = [0.0; 200];
    samples[1] = -20.0;
    for k in 1..100 {
        // The right body falls behind by its spring; no closed form, but a run that looks at every pair.
        let mut scene = oscillator([FREE, 2.0 * f64::from(k)], -0.01, 0.01);
        let record = record(STEP, &samples);
        let (start, _) = entry(&scene, &record, 3.0);
        scene.floor_forces = true;
        let (expected, looked) = entry(&scene, &record, 3.0);
        assert_close(start, expected, 1e-12, "entry");
        assert_eq!(looked.flights_cleared(), 0);
    }
}

#[test]
fn a_floor_that_another_drags_along_by_damping_enters_on_time() {
    // Floor 1 has all the speed, and the modes are nearly floors: damping alone passes half of it on to floor 2.
    for k in 1..40 {
        let text = format!(
            "name = \"D\"\n[left]\nmass = [1.0, 1.0]\nstiffness = [1.0, 1.0e-2]\ninitial_velocity = [1.0, 0.0]
            damping = {{ matrix = [[1000.0, -1000.0], [-1000.0, 1000.0]] }}
            [right]\nmass = [1.0, 1.0]\nstiffness = [1.0, 1.0]\ndamping = {{ ratio = 0.0 }}
            [[contact]]\nleft_floor = 2\nright_floor = 2\ngap = {:?}\nlaw = \"linear\"\nstiffness = 1.0e4\n",
            0.005 * f64::from(k)
        );
        let mut scene = scene(&text);
        scene.ground.record = Some("r.csv".into());
        let (start, counters) = entry(&scene, &record(STEP, &[0.0; 200]), 2.0);
        // A master that may push floors: every pair is looked at all the time.
        scene.floor_forces = true;
        let (expected, looked) = entry(&scene, &record(STEP, &[0.0; 200]), 2.0);
        assert_close(start, expected, 1e-9, "entry");
        assert!(counters.flights_cleared() > 0 || k < 4, "{k}: {counters:?}");
        assert_eq!(looked.flights_cleared(), 0);
    }
}

#[test]
fn a_floor_that_the_moving_ground_drags_along_enters_on_time() {
    // Two free bodies at rest, one with a dashpot to the ground, which is kicked away from under both of them: it keeps
    // up with the ground, the other one does not.
    let mut samples = [0.0; 200];
    samples[1] = 64.0;
    for k in 1..60 {
        let (c, gap) = (0.3 * f64::from(k), 0.002 * f64::from(k));
        let text = format!(
            "name = \"K\"\n[left]\nmass = [1.0]\nstiffness = [1.0]\ndamping = {{ ratio = {:?} }}
            [right]\nmass = [1.0]\nstiffness = [1.0e-20]\ndamping = {{ ratio = 0.0 }}
            [[contact]]\nleft_floor = 1\nright_floor = 1\ngap = {gap:?}\nlaw = \"linear\"\nstiffness = 1.0e4\n",
            0.5 * c
        );
        let mut scene = scene(&text);
        scene.ground.record = Some("r.csv".into());
        let (start, counters) = entry(&scene, &record(STEP, &samples), 3.0);
        scene.floor_forces = true;
        let (expected, looked) = entry(&scene, &record(STEP, &samples), 3.0);
        assert_close(start, expected, 1e-12, "entry");
        assert!(counters.flights_cleared() > 0 || k < 4, "{k}: {counters:?}");
        assert_eq!(looked.flights_cleared(), 0);
    }
}

#[test]
fn a_body_that_turns_round_just_beyond_the_gap_is_not_dismissed() {
    // It is slow and near its turn, on a spring that pulls it back at once: apart now and some samples later.
    for k in 1..60 {
        let (omega, speed) = (1.0 + 0.2 * f64::from(k), 0.01 * f64::from(k));
        let reach = (1.0 + speed * speed / (omega * omega)).sqrt();
        let impacts = |gap: f64| {
            let mut scene = oscillator([omega * omega, 1.0], speed, gap);
            scene.buildings[0].initial_displacement = vec![1.0];
            Run::new(&scene, Some(&record(STEP, &[0.0; 200]))).to(2.0).point.impacts
        };
        assert!(impacts(reach * (1.0 - 1e-9)) >= 1, "{k}: missed");
        assert_eq!(impacts(reach * (1.0 + 1e-9)), 0, "{k}");
    }
}

/// A body that swings once from each sample to the next stands still at all of them: their motion tells nothing of what is
/// in between, where it meets one that comes slowly nearer.
#[test]
fn a_swing_between_two_samples_is_seen() {
    let (swing, gap, speed, quickness) = (0.01, 0.05, 0.1, 2.0 * PI / STEP);
    let mut scene = oscillator([quickness * quickness, FREE], 0.0, gap);
    scene.buildings[0].initial_displacement = vec![-swing];
    scene.buildings[1].initial_velocity = vec![-speed];
    let overlap = |time: f64| -swing * (quickness * time).cos() - gap + speed * time;
    let top = (0..).map(|k| (f64::from(k) + 0.5) * STEP).find(|top| overlap(*top) > 0.0).unwrap();
    let (mut apart, mut together) = (top - 0.5 * STEP, top);
    for _ in 0..60 {
        let middle = 0.5 * (apart + together);
        if overlap(middle) > 0.0 { together = middle } else { apart = middle }
    }
    assert!(top > 20.0 * STEP);
    let (start, _) = entry(&scene, &record(STEP, &[0.0; 200]), 1.0);
    assert_close(start, apart, 1e-11, "entry");
}

#[test]
fn a_graze_is_not_dismissed() {
    // 0.5 m/s and 7 rad/s: it reaches 1/14 m, at many places of the segment.
    for start in 1..40 {
        let stiffness = 49.0 * (1.0 + 0.013 * f64::from(start));
        let reach = 0.5 / stiffness.sqrt();
        let impacts = |gap: f64| {
            let mut run = Run::new(&oscillator([stiffness, 1.0], 0.5, gap), Some(&record(STEP, &[0.0; 200])));
            run.to(1.0).point.impacts
        };
        assert!(impacts(reach * (1.0 - 1e-10)) >= 1, "{start}: missed");
        assert_eq!(impacts(reach * (1.0 + 1e-10)), 0, "{start}: never reached");
    }
}

/// 3 and 6 storeys with three contacts.
fn towers(law: &str, damping: &str, gap: f64, extra: &str) -> Scene {
    let building = |storeys: usize, mass: f64, stiffness: f64, damping: &str| {
        format!("mass = {:?}\nstiffness = {:?}\n{damping}", vec![mass; storeys], vec![stiffness; storeys])
    };
    let contact = |floor| format!("[[contact]]\nleft_floor = {floor}\nright_floor = {floor}\ngap = {gap:?}\n{law}\n");
    let mut scene = scene(&format!(
        "name = \"T\"\n[left]\n{}\n[right]\n{}\n{}{}{}{extra}",
        building(3, 25e3, 3.46e6, damping),
        building(6, 4e4, 2.2e7, "damping = { ratio = 0.03 }"),
        contact(1),
        contact(2),
        contact(3)
    ));
    scene.ground.record = Some("r.csv".into());
    scene
}

fn shaking(samples: usize) -> Record {
    record(STEP, &(0..samples).map(|k| zigzag(k) / 6.0).collect::<Vec<_>>())
}

#[test]
fn a_run_that_looks_at_every_pair_has_the_same_bits() {
    let coupled = "damping = { matrix = [[4e4, -1e4, 0.0], [-1e4, 3e4, -1e4], [0.0, -1e4, 2e4]] }";
    for damping in ["damping = { ratio = 0.05 }", coupled] {
        for law in [
            "law = \"linear\"\nstiffness = 2.0e8",
            "law = \"hertz\"\nstiffness = 2.0e9",
            "law = \"jankowski\"\nstiffness = 2.0e9\nrestitution = 0.6",
            "law = \"stereomechanical\"\nrestitution = 0.6",
        ] {
            let plain = towers(law, damping, 0.03, "");
            // A master that may push floors, and never does. Where damping couples modes, flights are those of the modes then, and
            // otherwise those of complex modes: they round in another way.
            let mut driven = plain.clone();
            driven.floor_forces = true;
            // With its account open.
            let mut accounted = plain.clone();
            accounted.energy = true;
            let [plain, driven, accounted] = [plain, driven, accounted].map(|scene| {
                // Beyond the end of the record, where it comes to rest.
                let mut run = Run::new(&scene, Some(&shaking(500)));
                run.to(11.0);
                run
            });
            assert!(plain.point.impacts >= 10, "{law}, {damping}: {} impacts", plain.point.impacts);
            assert_eq!(plain.bits(), accounted.bits(), "{law}, {damping}");
            match damping == coupled && !law.contains("stereomechanical") {
                false => {
                    assert_eq!(plain.bits(), driven.bits(), "{law}, {damping}");
                    assert_eq!(plain.episodes, driven.episodes, "{law}, {damping}");
                }
                true => {
                    assert_eq!(plain.episodes.len(), driven.episodes.len(), "{law}, {damping}");
                    for (one, other) in plain.episodes.iter().zip(&driven.episodes) {
                        assert!((one.start - other.start).abs() < 1e-10, "{law}, {damping}: {one:?} not {other:?}");
                    }
                }
            }
            assert_eq!(plain.episodes, accounted.episodes, "{law}, {damping}");
            let [plain, driven, mut accounted] = [plain, driven, accounted].map(|run| run.state.counters());
            assert_eq!(driven.flights_cleared(), 0);
            assert!(4 * plain.flights_cleared() > plain.flight_steps(), "{law}, {damping}: {plain:?}");
            accounted.energy_steps = 0;
            assert_eq!(plain, accounted);
        }
    }
}

#[test]
fn what_an_impact_sets_in_motion_is_looked_at_again() {
    // A floor hits the first one of a light tower, whose top is then quick, and was at rest before like its neighbour.
    for k in 1..30 {
        let top = 0.01 * f64::from(k);
        let text = format!(
            "name = \"W\"\n[left]\nmass = [100.0, 1.0]\nstiffness = [1.0e6, 400.0]\ndamping = {{ ratio = 0.0 }}
            [right]\nmass = [1.0e4, 1.0e4]\nstiffness = [1.0, 1.0e-6]\ndamping = {{ ratio = 0.0 }}
            initial_velocity = [-1.0, 0.0]
            [[contact]]\nleft_floor = 1\nright_floor = 1\ngap = 1.0e-3\nlaw = \"linear\"\nstiffness = 1.0e7
            [[contact]]\nleft_floor = 2\nright_floor = 2\ngap = {top:?}\nlaw = \"linear\"\nstiffness = 1.0e4\n"
        );
        let mut scene = scene(&text);
        scene.ground.record = Some("r.csv".into());
        let mut run = Run::new(&scene, Some(&record(STEP, &[0.0; 200])));
        run.to(1.0);
        scene.floor_forces = true;
        let mut looked = Run::new(&scene, Some(&record(STEP, &[0.0; 200])));
        looked.to(1.0);
        let counts = [&run, &looked].map(|run| run.contacts().iter().map(|c| c.impacts).collect::<Vec<_>>());
        assert_eq!(counts[0], counts[1], "gap {top}");
        assert!(counts[0][1] > 0 || k > 5, "gap {top}");
        assert_eq!(run.episodes.len(), looked.episodes.len());
        for (a, b) in run.episodes.iter().zip(&looked.episodes) {
            assert_close(a.start, b.start, 1e-9, "start");
        }
    }
}
