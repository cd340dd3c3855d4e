//! The tables of allowed calls over every pair of phase and function: FMI 2.0.4, section 4.2.4, and FMI 3.0.2, sections
//! 2.3.1 and 4.2.1.

use super::calls::{TABLE_2, TABLE_3, call};
use crate::support::*;
use std::ptr::null_mut;

/// As messages name them; the last is that after an error, which FMI 3.0 calls Terminated too.
const PHASES_2: &[&str] = &["Instantiated", "Initialization", "StepComplete", "Terminated", "Error"];
const PHASES_3: &[&str] =
    &["Instantiated", "Initialization Mode", "Event Mode", "Step Mode", "Terminated", "Terminated"];

/// The calls that lead to each phase.
const WAYS_2: &[&[Plain]] = &[
    &[],
    &[fmi2EnterInitializationMode],
    &[fmi2EnterInitializationMode, fmi2ExitInitializationMode],
    &[fmi2EnterInitializationMode, fmi2ExitInitializationMode, fmi2Terminate],
    &[fmi2EnterInitializationMode],
];
const WAYS_3: &[&[Plain]] = &[
    &[],
    &[enter_3],
    &[enter_3, fmi3ExitInitializationMode],
    &[enter_3, fmi3ExitInitializationMode, fmi3EnterStepMode],
    &[enter_3, fmi3ExitInitializationMode, fmi3EnterStepMode, fmi3Terminate],
    &[enter_3],
];

unsafe extern "C" fn enter_3(c: Component) -> i32 {
    // SAFETY: a live instance.
    unsafe { fmi3EnterInitializationMode(c, 0, 0.0, 0.0, 0, 0.0) }
}

/// An instance in a phase; the last one is reached by a call that is not allowed.
fn in_phase(fmu: &Fmu, place: usize) -> Instance<'_> {
    let instance = fmu.with_flags(true, true);
    let ways = fmu.either(WAYS_2, WAYS_3);
    instance.calls(ways[place]);
    if place == ways.len() - 1 {
        assert_eq!(instance.call(ways[place][0]), ERROR);
    }
    instance.log();
    instance
}

#[test]
fn every_call_in_every_phase() {
    for fmu in Fmu::both(RECORD_SCENE) {
        let (table, phases) = (fmu.either(TABLE_2, TABLE_3), fmu.either(PHASES_2, PHASES_3));
        for &(function, allowed, status) in table {
            assert_eq!(allowed.len(), phases.len(), "{function}");
            for (place, (phase, allowed)) in phases.iter().zip(allowed.chars()).enumerate() {
                let instance = in_phase(&fmu, place);
                let state = instance.recorded();
                let bytes = instance.serialized(state);
                let found = call(&instance, function, state, &bytes);
                let log = instance.log();
                let at = format!("{function} in {phase}: {log:?}");
                assert_eq!(found, if allowed == '-' { ERROR } else { status }, "{at}");
                let start = format!("{function}: called in phase {phase}: expected ");
                let refused = log.iter().any(|line| line.message.starts_with(&start));
                // What is not offered at all is refused for that.
                let not_offered = log.iter().any(|line| line.message.starts_with(&format!("{function}: this FMU ")));
                assert_eq!(refused || not_offered, allowed == '-', "{at}");
                assert_eq!(not_offered, function == "fmi3GetFloat32", "{at}");
                if allowed == '-' {
                    assert_eq!(instance.step(0.0, 0.01), ERROR, "an error ends the run: {at}");
                }
            }
        }
    }
}

#[test]
fn without_an_instance_everything_is_an_error_but_the_end() {
    for fmu in Fmu::both(RECORD_SCENE) {
        let mut instance = fmu.with_flags(true, true);
        let component = std::mem::replace(&mut instance.component, null_mut());
        for (function, ..) in fmu.either(TABLE_2, TABLE_3) {
            assert_eq!(call(&instance, function, null_mut(), &[]), ERROR, "{function}");
        }
        // SAFETY: null is allowed.
        unsafe { (instance.functions().free_instance)(null_mut()) };
        instance.component = component;
    }
}

#[test]
fn a_refused_call_leaves_the_error_phase_by_a_reset() {
    for fmu in Fmu::both(SCENE) {
        let instance = fmu.instance();
        instance.start();
        assert_eq!(instance.set_real("left.mass[1]", 4.0), ERROR);
        assert!(instance.only_error().contains("left.mass[1]: a fixed parameter can only be set"));
        assert_eq!(instance.step(0.0, 0.1), ERROR);
        assert_eq!(instance.terminate(), ERROR);
        assert_eq!(instance.real("left.mass[1]"), 3.65);
        assert_eq!(instance.reset(), OK);
        instance.start();
        assert_eq!(instance.step(0.0, 0.1), OK);
    }
}

#[test]
fn parameters_only_before_the_end_of_initialisation() {
    for fmu in Fmu::both(RECORD_SCENE) {
        for (place, phase) in fmu.either(PHASES_2, PHASES_3).iter().enumerate() {
            let (instance, status) = (in_phase(&fmu, place), if place < 2 { OK } else { ERROR });
            assert_eq!(instance.set_real("left.mass[1]", 4.0), status, "{phase}");
            let is_before_the_end = !phase.contains("Terminated") && *phase != "Error";
            if status == ERROR && is_before_the_end {
                assert!(instance.only_error().contains("a fixed parameter can only be set"));
            }
        }
    }
}

#[test]
fn setup_may_be_left_out_in_fmi_2() {
    let fmu = Fmu::new(SCENE);
    let instance = fmu.instance();
    instance.calls(&[fmi2EnterInitializationMode, fmi2ExitInitializationMode]);
    assert_eq!(instance.step(0.0, 0.1), OK);
}
