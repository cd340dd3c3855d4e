//! Every function in every phase: the tables of FMI 3.0.2, sections 2.3.1 and 4.2.1.

use crate::linked_3::*;
use crate::support::RECORD_SCENE;
use std::ffi::c_int;
use std::ptr::{null, null_mut};

/// As messages name them; the last is that after an error.
const PHASES: [&str; 6] =
    ["Instantiated", "Initialization Mode", "Event Mode", "Step Mode", "Terminated", "Terminated"];

/// Function, and the phases above in which it is allowed.
pub const TABLE: [(&str, &str); 25] = [
    ("fmi3SetDebugLogging", "xxxxxx"),
    ("fmi3EnterInitializationMode", "x-----"),
    ("fmi3ExitInitializationMode", "-x----"),
    ("fmi3EnterEventMode", "---x--"),
    ("fmi3EnterStepMode", "--x---"),
    ("fmi3UpdateDiscreteStates", "--x---"),
    ("fmi3DoStep", "---x--"),
    ("fmi3Terminate", "--xx--"),
    ("fmi3Reset", "xxxxxx"),
    ("fmi3GetFloat64", "xxxxxx"),
    ("fmi3GetInt32", "xxxxxx"),
    ("fmi3GetBoolean", "xxxxxx"),
    ("fmi3GetString", "xxxxxx"),
    ("fmi3SetFloat64", "xxxx--"),
    ("fmi3SetString", "xxxx--"),
    ("fmi3GetFMUState", "xxxxxx"),
    ("fmi3SetFMUState", "xxxxxx"),
    ("fmi3FreeFMUState", "xxxxxx"),
    ("fmi3SerializedFMUStateSize", "xxxxxx"),
    ("fmi3SerializeFMUState", "xxxxxx"),
    ("fmi3DeserializeFMUState", "xxxxxx"),
    ("fmi3GetDirectionalDerivative", "-xxxxx"),
    ("fmi3GetAdjointDerivative", "-xxxxx"),
    ("fmi3GetOutputDerivatives", "---xxx"),
    ("fmi3GetFloat32", "------"),
];

#[test]
fn every_call_in_every_phase() {
    let fmu = Fmu::new(RECORD_SCENE);
    for (function, allowed) in TABLE {
        for (place, allowed) in allowed.chars().enumerate() {
            let instance = in_phase(&fmu, place);
            let state = instance.recorded();
            let bytes = instance.serialized(state);
            let found = call(&instance, function, state, &bytes);
            let log = instance.log();
            let at = format!("{function} in {}: {log:?}", PHASES[place]);
            assert_eq!(found, if allowed == 'x' { OK } else { ERROR }, "{at}");
            if allowed == '-' {
                let start = format!("{function}: called in phase {}: expected in ", PHASES[place]);
                assert!(log[0].message.starts_with(&start) || function == "fmi3GetFloat32", "{at}");
                assert_eq!(call(&instance, "fmi3DoStep", null_mut(), &[]), ERROR, "an error ends the run: {at}");
            }
        }
    }
}

#[test]
fn without_an_instance_everything_is_an_error_but_the_end() {
    let fmu = Fmu::new(RECORD_SCENE);
    let mut instance = fmu.instance(true, true);
    let component = std::mem::replace(&mut instance.component, null_mut());
    for (function, _) in TABLE {
        assert_eq!(call(&instance, function, null_mut(), &[]), ERROR, "{function}");
    }
    // SAFETY: null is allowed.
    unsafe { fmi3FreeInstance(null_mut()) };
    instance.component = component;
}

#[test]
fn parameters_only_before_the_end_of_initialisation() {
    let fmu = Fmu::new(RECORD_SCENE);
    for (place, status) in [OK, OK, ERROR, ERROR].into_iter().enumerate() {
        let instance = in_phase(&fmu, place);
        assert_eq!(instance.set_real("left.mass[1]", 4.0), status, "{}", PHASES[place]);
        if status == ERROR {
            assert!(instance.only_error().contains("a fixed parameter can only be set"));
        }
    }
}

#[test]
fn without_event_mode_there_is_none() {
    let fmu = Fmu::new(RECORD_SCENE);
    for early_return_allowed in [false, true] {
        let instance = fmu.instance(false, early_return_allowed);
        instance.initialize();
        assert_eq!(instance.step(0.0, 0.1).0, OK, "initialisation leads to Step Mode");
        assert_eq!(instance.call(fmi3EnterEventMode), ERROR);
        assert!(instance.only_error().contains("eventModeUsed"), "the message names the flag");
        assert_eq!(instance.step(0.1, 0.1).0, ERROR);
    }
}

#[test]
fn initialisation_leads_to_event_mode_where_it_is_used() {
    let fmu = Fmu::new(RECORD_SCENE);
    for early_return_allowed in [false, true] {
        let instance = fmu.instance(true, early_return_allowed);
        instance.initialize();
        assert_eq!(instance.step(0.0, 0.1), (ERROR, UNTOUCHED));
        assert_eq!(instance.only_error(), "fmi3DoStep: called in phase Event Mode: expected in Step Mode");
    }
    let instance = fmu.instance(true, true);
    instance.start_with_events();
    assert_eq!(instance.call(fmi3EnterStepMode), ERROR, "a second time");
}

fn in_phase(fmu: &Fmu, place: usize) -> Instance<'_> {
    let instance = fmu.instance(true, true);
    if (1..5).contains(&place) {
        assert_eq!(instance.enter(0.0, None), OK);
    }
    let further: [&[Plain]; 6] = [
        &[],
        &[],
        &[fmi3ExitInitializationMode],
        &[fmi3ExitInitializationMode, fmi3EnterStepMode],
        &[fmi3ExitInitializationMode, fmi3EnterStepMode, fmi3Terminate],
        &[],
    ];
    instance.calls(further[place]);
    if place == 5 {
        assert_eq!(instance.call(fmi3Terminate), ERROR);
    }
    instance.log();
    instance
}

/// A call with arguments that are never a reason to refuse it.
pub fn call(instance: &Instance<'_>, function: &str, mut state: FmuState, bytes: &[u8]) -> c_int {
    let (c, n, mut size) = (instance.component, bytes.len(), 0);
    // SAFETY: a live instance or null, no elements, and places for what is written.
    unsafe {
        match function {
            "fmi3SetDebugLogging" => fmi3SetDebugLogging(c, 1, 0, null()),
            "fmi3EnterInitializationMode" => instance.enter(0.0, None),
            "fmi3ExitInitializationMode" => fmi3ExitInitializationMode(c),
            "fmi3EnterEventMode" => fmi3EnterEventMode(c),
            "fmi3EnterStepMode" => fmi3EnterStepMode(c),
            "fmi3UpdateDiscreteStates" => instance.update().0,
            "fmi3DoStep" => instance.step(0.0, 0.001).0,
            "fmi3Terminate" => fmi3Terminate(c),
            "fmi3Reset" => fmi3Reset(c),
            "fmi3GetFloat64" => fmi3GetFloat64(c, null(), 0, null_mut(), 0),
            "fmi3GetInt32" => fmi3GetInt32(c, null(), 0, null_mut(), 0),
            "fmi3GetBoolean" => fmi3GetBoolean(c, null(), 0, null_mut(), 0),
            "fmi3GetString" => fmi3GetString(c, null(), 0, null_mut(), 0),
            "fmi3SetFloat64" => fmi3SetFloat64(c, null(), 0, null(), 0),
            "fmi3SetString" => fmi3SetString(c, null(), 0, null(), 0),
            "fmi3GetFMUState" => fmi3GetFMUState(c, &raw mut state),
            "fmi3SetFMUState" => fmi3SetFMUState(c, state),
            "fmi3FreeFMUState" => fmi3FreeFMUState(c, &raw mut state),
            "fmi3SerializedFMUStateSize" => fmi3SerializedFMUStateSize(c, state, &raw mut size),
            "fmi3SerializeFMUState" => fmi3SerializeFMUState(c, state, bytes.to_vec().as_mut_ptr(), n),
            "fmi3DeserializeFMUState" => fmi3DeserializeFMUState(c, bytes.as_ptr(), n, &raw mut state),
            "fmi3GetDirectionalDerivative" => {
                fmi3GetDirectionalDerivative(c, null(), 0, null(), 0, null(), 0, null_mut(), 0)
            }
            "fmi3GetAdjointDerivative" => fmi3GetAdjointDerivative(c, null(), 0, null(), 0, null(), 0, null_mut(), 0),
            "fmi3GetOutputDerivatives" => fmi3GetOutputDerivatives(c, null(), 0, null(), null_mut(), 0),
            "fmi3GetFloat32" => fmi3GetFloat32(c, null(), 0, null_mut(), 0),
            _ => panic!("{function}"),
        }
    }
}
