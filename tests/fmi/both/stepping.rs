//! Communication steps as masters make them.

use crate::support::*;
use pounding::FmiVersion;

#[test]
fn two_instances_taken_in_turn_are_two_alone() {
    for fmu in Fmu::both(SCENE) {
        let (a, b) = (fmu.instance(), fmu.instance());
        let alone = |force: f64| {
            let instance = fmu.instance();
            instance.start();
            assert_eq!(instance.set_real("left.force[2]", force), OK);
            instance.run(0.0, 0.05, 40)
        };
        a.start();
        b.start();
        assert_eq!(a.set_real("left.force[2]", 1.0), OK);
        assert_eq!(b.set_real("left.force[2]", -2.0), OK);
        let (mut of_a, mut of_b) = (Vec::new(), Vec::new());
        for k in 0..40 {
            of_a.extend(a.run(f64::from(k) * 0.05, 0.05, 1));
            of_b.extend(b.run(f64::from(k) * 0.05, 0.05, 1));
        }
        assert!(a.integer("impacts") > 0 && of_a != of_b);
        assert_eq!(of_a, alone(1.0));
        assert_eq!(of_b, alone(-2.0));
    }
}

#[test]
fn many_threads_with_their_own_instances_are_one() {
    let run = |version: usize| {
        let fmu = &Fmu::both(RECORD_SCENE)[version];
        let instance = fmu.instance();
        instance.start();
        instance.run(0.0, 0.02, 100)
    };
    let expected = run(0);
    let results = std::thread::scope(|scope| {
        let threads = [0, 0, 1, 1].map(|version| scope.spawn(move || run(version)));
        threads.map(|thread| thread.join().unwrap())
    });
    assert!(results.iter().all(|result| *result == expected));
}

#[test]
fn a_reset_is_a_new_beginning() {
    for fmu in Fmu::both(SCENE) {
        let (used, new) = (fmu.instance(), fmu.instance());
        assert_eq!(used.set_real("left.mass[1]", 5.0), OK);
        used.start_at(3.0, Some(4.0));
        assert_eq!(used.set_real("ground.acceleration", 2.0), OK);
        assert_eq!(used.step(3.0, 0.5), OK);
        assert_eq!(used.step(3.5, 1.0), ERROR, "past the stop time");
        assert_eq!(used.reset(), OK);
        used.start();
        new.start();
        assert_eq!(used.outputs(), new.outputs());
        assert_eq!(used.run(0.0, 0.05, 40), new.run(0.0, 0.05, 40));
        // The experiment of FMI 2.0 need not be set up again.
        assert_eq!(used.reset(), OK);
        match fmu.version {
            FmiVersion::V2 => used.calls(&[fmi2EnterInitializationMode]),
            FmiVersion::V3 => used.enter(),
        }
        let new = fmu.instance();
        new.enter();
        assert_eq!(used.outputs(), new.outputs());
    }
}

#[test]
fn communication_points_follow_each_other_within_rounding() {
    for fmu in Fmu::both(SCENE) {
        for (start, current, status) in [
            (0.0, 0.0, OK),
            (0.0, 0.9e-9, OK),
            (0.0, -0.9e-9, OK),
            (0.0, 1.1e-9, ERROR),
            (0.0, 1e-6, ERROR),
            (0.0, 1.0, ERROR),
            (1e6, 1e6 + 0.9e-3, OK),
            (1e6, 1e6 - 1.1e-3, ERROR),
            (-5.0, -5.0 + 4e-9, OK),
            (-5.0, -5.0 + 6e-9, ERROR),
            (0.0, f64::NAN, ERROR),
            (0.0, f64::INFINITY, ERROR),
        ] {
            let instance = fmu.instance();
            instance.start_at(start, None);
            assert_eq!(instance.step(current, 0.1), status, "from {start} at {current}");
            if status == ERROR {
                let message = &instance.log()[0].message;
                assert!(message.contains(&format!("{current}")) && message.contains(&format!("{start}")), "{message}");
            }
        }
    }
}

#[test]
fn time_that_is_summed_does_not_drift_away() {
    for fmu in Fmu::both(SCENE) {
        let instance = fmu.instance();
        instance.start();
        let mut time = 0.0;
        for _ in 0..1000 {
            assert_eq!(instance.step(time, 0.001), OK);
            time += 0.001;
        }
        assert_ne!(time, 1.0);
        assert_eq!(instance.step(1.0, 0.001), OK);
    }
}

#[test]
fn a_step_smaller_than_the_rounding_of_time_goes_nowhere() {
    for fmu in Fmu::both(SCENE) {
        let instance = fmu.instance();
        instance.start_at(1e6, None);
        let before = instance.outputs();
        assert_eq!(instance.step(1e6 - 1e-4, 1e-12), OK);
        assert_eq!(instance.outputs(), before);
        assert_eq!(instance.time(), 1e6, "time does not run back");
        assert_eq!(instance.step(1e6, 0.01), OK);
        assert_ne!(instance.outputs(), before);
    }
}

#[test]
fn step_sizes_must_be_finite_and_positive() {
    for fmu in Fmu::both(SCENE) {
        for step in [0.0, -0.1, f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            let instance = fmu.instance();
            instance.start();
            assert_eq!(instance.step(0.0, step), ERROR, "{step}");
            assert!(instance.log()[0].message.contains("communicationStepSize"), "{step}");
        }
    }
}

#[test]
fn the_announced_end_is_the_end() {
    for fmu in Fmu::both(SCENE) {
        for (last, status) in [(0.1, OK), (0.1 + 0.9e-9, OK), (0.1 + 1e-6, ERROR), (5.0, ERROR)] {
            let instance = fmu.instance();
            instance.start_at(0.0, Some(0.2));
            assert_eq!(instance.step(0.0, 0.1), OK);
            assert_eq!(instance.step(0.1, last), status, "{last}");
        }
    }
}

#[test]
fn an_experiment_must_make_sense() {
    for fmu in Fmu::both(SCENE) {
        for (tolerance, start, stop, problems) in [
            (None, 1e6, None, 0),
            (None, -3.0, Some(-3.0), 0),
            (Some(1e-4), 0.0, Some(1.0), 0),
            (Some(0.0), 0.0, None, 0),
            (Some(-1e-4), 0.0, None, 1),
            (None, 2.0, Some(1.0), 1),
            (None, f64::NAN, None, 1),
            (None, f64::INFINITY, None, 1),
            (Some(f64::NAN), 0.0, Some(f64::INFINITY), 2),
        ] {
            let instance = fmu.instance();
            let status = instance.set_up(tolerance, start, stop);
            assert_eq!(status, if problems == 0 { OK } else { ERROR });
            assert_eq!(instance.log().len(), problems, "{tolerance:?} {start} {stop:?}");
        }
    }
}

#[test]
fn values_may_be_set_before_the_experiment_is_set_up() {
    for fmu in Fmu::both(SCENE) {
        let (early, late) = (fmu.instance(), fmu.instance());
        for name in ["ground.acceleration", "right.force[1]", "contact[1].gap"] {
            assert_eq!(early.set_real(name, 0.25), OK);
        }
        early.start();
        late.enter();
        for name in ["ground.acceleration", "right.force[1]", "contact[1].gap"] {
            assert_eq!(late.set_real(name, 0.25), OK);
        }
        assert_eq!(late.exit(), OK);
        // 3.65 kg at rest at the start: the force alone accelerates it, and the ground does once time goes on.
        assert!((early.real("right.acceleration[1]") - 0.25 / 3.65).abs() < 1e-15);
        assert_eq!(early.step(0.0, 1e-6), OK);
        assert_eq!(late.step(0.0, 1e-6), OK);
        let velocity = early.real("right.velocity[3]");
        assert!((velocity + 0.25e-6).abs() < 1e-12, "{velocity}");
        assert_eq!(early.run(1e-6, 0.05, 40), late.run(1e-6, 0.05, 40));
        assert_eq!(early.real("ground.acceleration"), 0.25);
    }
}

/// Without a record nothing knows the time: a run from 1e6 s is that from 0 s, to the rounding of its times.
#[test]
fn a_late_start_is_a_start() {
    for fmu in Fmu::both(SCENE) {
        for start in [0.0, 1e6] {
            let instance = fmu.instance();
            assert_eq!(instance.enter_from(start, Some(start + 0.125)), OK);
            assert_eq!(instance.real("left.velocity[2]"), 0.5);
            assert_eq!(instance.exit(), OK);
            for k in 0..16 {
                assert_eq!(instance.step(start + f64::from(k) / 128.0, 1.0 / 128.0), OK);
            }
            let fresh = fmu.instance();
            fresh.start();
            let reference = fresh.run(0.0, 1.0 / 128.0, 16);
            let (late, reference) = (instance.outputs(), reference.last().unwrap().clone());
            for (a, b) in late.iter().zip(&reference) {
                let (a, b) = (f64::from_bits(*a), f64::from_bits(*b));
                assert!((a - b).abs() <= 1e-8 * (1.0 + b.abs()), "{a} {b}");
            }
        }
    }
}
