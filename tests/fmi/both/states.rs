//! Snapshots: which there are, what they hold, and pointers that are none.

use crate::support::*;
use pounding::FmiVersion;
use std::ptr::{null, null_mut, without_provenance_mut};

fn in_motion(fmu: &Fmu) -> Instance<'_> {
    let instance = fmu.instance();
    instance.start();
    instance.run(0.0, 0.01, 10);
    instance.log();
    instance
}

#[test]
fn a_snapshot_is_recorded_anew_in_place_of_an_earlier_one() {
    for fmu in Fmu::both(SCENE) {
        let instance = in_motion(&fmu);
        let mut state = instance.recorded();
        let first = state;
        let untouched = instance.recorded();
        assert_ne!(first, untouched);
        let early = instance.outputs();
        instance.run(0.1, 0.01, 10);
        let late = instance.outputs();
        assert_eq!(instance.get_state(&raw mut state), OK);
        assert_eq!(state, first, "it is the same snapshot");
        instance.run(0.2, 0.01, 10);
        assert_eq!(instance.set_state(state), OK);
        assert_eq!(instance.outputs(), late);
        assert_eq!(instance.set_state(untouched), OK);
        assert_eq!(instance.outputs(), early);
        // From bytes likewise.
        let bytes = instance.serialized(state);
        assert_eq!(instance.deserialize_from(bytes.as_ptr(), bytes.len(), &raw mut state), OK);
        assert_eq!(state, first);
    }
}

/// A call with a pointer that is no live snapshot of the instance.
fn assert_unknown(instance: &Instance<'_>, mut state: State, what: &str) {
    let (before, mut size) = (state, 0);
    let mut bytes = [0; 64];
    let serialized = instance.serialized(instance.recorded());
    for (call, status) in [
        ("get", instance.get_state(&raw mut state)),
        ("set", instance.set_state(state)),
        ("free", instance.free_state(&raw mut state)),
        ("size", instance.serialized_size(state, &raw mut size)),
        ("serialize", instance.serialize_to(state, bytes.as_mut_ptr(), bytes.len())),
        ("deserialize", instance.deserialize_from(serialized.as_ptr(), serialized.len(), &raw mut state)),
    ] {
        assert_eq!(status, ERROR, "{what}: {call}");
        assert_eq!(state, before, "{what}: {call}");
    }
    let (log, name) = (instance.log(), instance.fmu.either("FMUstate", "FMUState"));
    assert_eq!(log.len(), 6, "{what}: {log:?}");
    assert!(
        log.iter().all(|line| line.message.contains(&format!("{name} = {before:?}: expected one"))),
        "{what}: {log:?}"
    );
}

#[test]
fn what_is_no_live_snapshot_of_the_instance_is_refused() {
    for fmu in Fmu::both(SCENE) {
        let (instance, other) = (in_motion(&fmu), in_motion(&fmu));
        let good = instance.recorded();
        let mut freed = instance.recorded();
        let stale = freed;
        assert_eq!(instance.free_state(&raw mut freed), OK);
        assert!(freed.is_null());
        for (state, what) in [
            (stale, "freed"),
            (other.recorded(), "of another instance"),
            (without_provenance_mut(1), "1"),
            (without_provenance_mut(usize::MAX), "-1"),
            (instance.component, "the component"),
            (good.wrapping_byte_add(1 << 20), "beside a good one"),
        ] {
            assert_unknown(&instance, state, what);
            assert_eq!(instance.set_state(good), OK, "{what}");
        }
        // What has taken the memory of a freed one is not it.
        let new = instance.recorded();
        assert_ne!(new, stale);
        assert_eq!(instance.set_state(stale), ERROR);
        assert_eq!(instance.set_state(new), OK);
    }
}

#[test]
fn nothing_is_no_snapshot_and_may_be_freed() {
    for fmu in Fmu::both(SCENE) {
        let instance = in_motion(&fmu);
        let (mut nothing, mut size): (State, usize) = (null_mut(), 0);
        assert_eq!(instance.free_state(null_mut()), OK);
        assert_eq!(instance.free_state(&raw mut nothing), OK);
        assert!(nothing.is_null() && instance.log().is_empty());
        let bytes = instance.serialized(instance.recorded());
        for (call, status) in [
            ("set", instance.set_state(null_mut())),
            ("get", instance.get_state(null_mut())),
            ("size", instance.serialized_size(null_mut(), &raw mut size)),
            ("serialize", instance.serialize_to(null_mut(), null_mut(), 0)),
            ("deserialize to nowhere", instance.deserialize_from(bytes.as_ptr(), bytes.len(), null_mut())),
            ("deserialize from nowhere", instance.deserialize_from(null(), bytes.len(), &raw mut nothing)),
            ("deserialize all of memory", instance.deserialize_from(bytes.as_ptr(), usize::MAX, &raw mut nothing)),
        ] {
            assert_eq!(status, ERROR, "{call}");
        }
        assert!(nothing.is_null());
        assert_eq!(instance.log().len(), 7);
        let state = instance.recorded();
        assert_eq!(instance.serialized_size(state, null_mut()), ERROR);
        assert_eq!(instance.serialize_to(state, null_mut(), bytes.len()), ERROR);
        for size in [0, bytes.len() - 1, bytes.len() + 1] {
            let mut room = vec![7; bytes.len() + 1];
            instance.log();
            assert_eq!(instance.serialize_to(state, room.as_mut_ptr(), size), ERROR, "{size}");
            assert!(room.iter().all(|byte| *byte == 7));
            assert!(instance.log()[0].message.contains(&format!("expected {}", bytes.len())));
        }
    }
}

/// A call that is allowed in none of the phases, and so tells where the instance is.
fn phase(instance: &Instance<'_>) -> String {
    instance.log();
    match instance.fmu.version {
        FmiVersion::V2 => assert_eq!(instance.call(fmi2CancelStep), ERROR),
        // Without Event Mode.
        FmiVersion::V3 => assert_eq!(instance.call(fmi3EnterStepMode), ERROR),
    }
    let message = instance.only_error();
    let (_, phase) = message.split_once("called in phase ").unwrap();
    phase.split(':').next().unwrap().to_owned()
}

#[test]
fn a_snapshot_holds_the_phase() {
    const PHASES_2: [&str; 5] = ["Instantiated", "Initialization", "StepComplete", "Terminated", "Error"];
    const PHASES_3: [&str; 5] = ["Instantiated", "Initialization Mode", "Step Mode", "Terminated", "Terminated"];
    for fmu in Fmu::both(SCENE) {
        let instance = fmu.instance();
        let mut states = vec![instance.recorded()];
        instance.enter();
        states.push(instance.recorded());
        assert_eq!(instance.exit(), OK);
        states.push(instance.recorded());
        assert_eq!(instance.terminate(), OK);
        states.push(instance.recorded());
        assert_eq!(instance.step(0.0, 0.1), ERROR);
        states.push(instance.recorded());
        let states: Vec<_> = fmu.either(PHASES_2, PHASES_3).into_iter().zip(states).collect();
        for &(expected, state) in states.iter().rev().chain(&states) {
            let copy = instance.deserialized(&instance.serialized(state));
            for state in [state, copy] {
                assert_eq!(instance.set_state(state), OK);
                assert_eq!(phase(&instance), expected);
            }
        }
        assert_eq!(instance.set_state(states[0].1), OK);
        instance.start();
        assert_eq!(instance.step(0.0, 0.1), OK);
    }
}

#[test]
fn a_snapshot_holds_parameters_inputs_and_the_end() {
    for fmu in Fmu::both(SCENE) {
        let instance = fmu.instance();
        let changed = [("contact[1].gap", 0.004), ("right.damping_ratio", 0.07), ("left.force[1]", -3.0)];
        for (name, value) in changed {
            assert_eq!(instance.set_real(name, value), OK);
        }
        assert_eq!(instance.set_real("solver.relative_tolerance", 1e-9), OK);
        instance.start_at(2.0, Some(3.0));
        assert_eq!(instance.set_real("ground.acceleration", 0.5), OK);
        let states = {
            let state = instance.recorded();
            [state, instance.deserialized(&instance.serialized(state))]
        };
        let expected = instance.run(2.0, 0.05, 20);
        for state in states {
            for reset in [false, true] {
                assert_eq!(instance.reset(), OK);
                if !reset {
                    instance.start();
                    assert_eq!(instance.set_real("ground.acceleration", 1.0), OK);
                }
                assert_eq!(instance.set_state(state), OK);
                for (name, value) in changed.into_iter().chain([("ground.acceleration", 0.5)]) {
                    assert_eq!(instance.real(name), value, "{name}");
                }
                assert_eq!(instance.run(2.0, 0.05, 20), expected);
                assert_eq!(instance.step(3.0, 0.1), ERROR, "beyond the end");
                assert!(instance.log().iter().any(|line| line.message.contains("stopTime = 3")));
            }
        }
    }
}

#[test]
fn a_snapshot_holds_the_record_that_runs_even_without_its_file() {
    for fmu in Fmu::both(RECORD_SCENE) {
        let path = fmu.directory.path().join("other.csv");
        let instance = fmu.instance();
        std::fs::write(&path, "time_s,accel_m_s2\n0,0\n0.1,3\n0.3,-4\n1.7,1\n2,0\n").unwrap();
        assert_eq!(instance.set_string("ground.record", path.to_str().unwrap()), OK);
        let early = instance.recorded();
        instance.start();
        instance.run(0.0, 0.02, 30);
        let bytes = [early, instance.recorded()].map(|state| instance.serialized(state));
        let expected = instance.run(0.6, 0.02, 40);
        std::fs::remove_file(&path).unwrap();
        let other = fmu.instance();
        let [early, late] = bytes.map(|bytes| other.deserialized(&bytes));
        assert_eq!(other.set_state(late), OK);
        assert_eq!(other.string("ground.record"), path.to_str().unwrap());
        assert_eq!(other.run(0.6, 0.02, 40), expected);
        assert_eq!(other.set_state(early), OK);
        // The scene's record is scaled to a peak, and so is whatever other record is chosen from here on.
        let scaled_to = || other.real("ground.scale");
        other.enter();
        let scale = scaled_to();
        assert_eq!(other.set_string("ground.record", ""), OK);
        assert_ne!(scaled_to(), scale);
        let fresh = fmu.instance();
        fresh.enter();
        assert_eq!(scaled_to(), fresh.real("ground.scale"));
    }
}

#[test]
fn the_choice_of_messages_is_no_part_of_a_snapshot() {
    for fmu in Fmu::both(SCENE) {
        let instance = in_motion(&fmu);
        let state = instance.recorded();
        assert_eq!(instance.set_debug_logging(false, &[]), OK);
        assert_eq!(instance.set_state(state), OK);
        instance.run(0.1, 0.05, 20);
        assert!(instance.log().is_empty());
        assert_eq!(instance.set_debug_logging(true, &[]), OK);
        assert_eq!(instance.set_state(state), OK);
        instance.run(0.1, 0.05, 20);
        assert!(!instance.log().is_empty());
    }
}

#[test]
fn what_is_said_of_earlier_states_at_a_step_frees_none() {
    for fmu in Fmu::both(SCENE) {
        let instance = in_motion(&fmu);
        let state = instance.recorded();
        let before = instance.outputs();
        // `step` passes noSetFMUStatePriorToCurrentPoint = true.
        instance.run(0.1, 0.05, 5);
        assert_eq!(instance.set_state(state), OK);
        assert_eq!(instance.outputs(), before);
    }
}

#[test]
fn snapshots_end_with_their_instance() {
    for fmu in Fmu::both(SCENE) {
        let instance = in_motion(&fmu);
        let states = [(); 100].map(|()| instance.recorded());
        drop(instance);
        let instance = in_motion(&fmu);
        assert!(states.into_iter().all(|state| instance.set_state(state) == ERROR));
    }
}

#[test]
fn after_an_error_values_can_be_read_and_a_state_set() {
    for fmu in Fmu::both(SCENE) {
        let instance = fmu.instance();
        instance.start();
        assert_eq!(instance.step(0.0, 0.05), OK);
        let (state, outputs) = (instance.recorded(), instance.outputs());
        assert_eq!(instance.step(9.0, 0.05), ERROR);
        assert_eq!(instance.outputs(), outputs);
        assert_eq!(instance.set_real("ground.acceleration", 1.0), ERROR);
        assert_eq!(instance.set_state(state), OK);
        assert_eq!(instance.step(0.05, 0.05), OK, "{:?}", instance.log());
    }
}
