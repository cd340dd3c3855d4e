//! The table of allowed calls, FMI 2.0.4, section 4.2.4, over every pair of phase and function.

use crate::support::{DISCARD, ERROR, Fmu, Instance, OK, SCENE, State};
use std::ffi::{c_int, c_void};
use std::ptr::{null, null_mut};

const PHASES: [&str; 5] = ["Instantiated", "Initialization", "StepComplete", "Terminated", "Error"];

/// Function, the phases above in which it is allowed, and what an allowed call with harmless arguments returns.
const TABLE: [(&str, &str, c_int); 30] = [
    ("fmi2SetDebugLogging", "xxxxx", OK),
    ("fmi2SetupExperiment", "x----", OK),
    ("fmi2EnterInitializationMode", "x----", OK),
    ("fmi2ExitInitializationMode", "-x---", OK),
    ("fmi2Terminate", "--x--", OK),
    ("fmi2Reset", "xxxxx", OK),
    ("fmi2GetReal", "-xxxx", OK),
    ("fmi2GetInteger", "-xxxx", OK),
    ("fmi2GetBoolean", "-xxxx", OK),
    ("fmi2GetString", "-xxxx", OK),
    ("fmi2SetReal", "xxx--", OK),
    ("fmi2SetInteger", "xxx--", OK),
    ("fmi2SetBoolean", "xxx--", OK),
    ("fmi2SetString", "xxx--", OK),
    ("fmi2GetFMUstate", "xxxxx", OK),
    ("fmi2SetFMUstate", "xxxxx", OK),
    ("fmi2FreeFMUstate", "xxxxx", OK),
    ("fmi2SerializedFMUstateSize", "xxxxx", OK),
    ("fmi2SerializeFMUstate", "xxxxx", OK),
    ("fmi2DeSerializeFMUstate", "xxxxx", OK),
    ("fmi2GetDirectionalDerivative", "-xxxx", OK),
    ("fmi2SetRealInputDerivatives", "xxx--", OK),
    ("fmi2GetRealOutputDerivatives", "--xxx", OK),
    ("fmi2DoStep", "--x--", OK),
    ("fmi2CancelStep", "-----", OK),
    ("fmi2GetStatus", "--xx-", DISCARD),
    ("fmi2GetRealStatus", "--xx-", OK),
    ("fmi2GetIntegerStatus", "--xx-", DISCARD),
    ("fmi2GetBooleanStatus", "--xx-", OK),
    ("fmi2GetStringStatus", "--xx-", DISCARD),
];

#[test]
fn every_call_in_every_phase() {
    let fmu = Fmu::new(SCENE);
    for (function, allowed, status) in TABLE {
        for (phase, allowed) in PHASES.into_iter().zip(allowed.chars()) {
            let instance = in_phase(&fmu, phase);
            let (state, bytes) = some_state(&instance);
            let found = call(&instance, function, state, &bytes);
            let log = instance.log();
            let refused = log.iter().any(|line| line.message.contains(&format!("called in phase {phase}")));
            assert_eq!(refused, allowed == '-', "{function} in {phase}: {log:?}");
            assert_eq!(found, if allowed == '-' { ERROR } else { status }, "{function} in {phase}: {log:?}");
            let unsupported = log.iter().any(|line| line.message.contains("does not declare"));
            assert_eq!(unsupported, allowed == 'x' && status == ERROR, "{function} in {phase}: {log:?}");
        }
    }
}

#[test]
fn without_a_component_everything_is_an_error_but_the_end() {
    let fmu = Fmu::new(SCENE);
    let mut instance = fmu.instance();
    let component = std::mem::replace(&mut instance.component, null_mut());
    for (function, ..) in TABLE {
        assert_eq!(call(&instance, function, null_mut(), &[]), ERROR, "{function}");
    }
    let free = fmu.symbol::<unsafe extern "C" fn(*mut c_void)>("fmi2FreeInstance");
    // SAFETY: null is allowed.
    unsafe { free(null_mut()) };
    instance.component = component;
}

#[test]
fn a_refused_call_leaves_the_error_phase_by_a_reset() {
    let fmu = Fmu::new(SCENE);
    let instance = fmu.instance();
    instance.start();
    assert_eq!(instance.set_real("left.mass[1]", 4.0), ERROR);
    assert_eq!(instance.step(0.0, 0.1), ERROR);
    assert_eq!(instance.call("fmi2Terminate"), ERROR);
    assert_eq!(instance.real("left.mass[1]"), 3.65);
    assert_eq!(instance.call("fmi2Reset"), OK);
    instance.start();
    assert_eq!(instance.step(0.0, 0.1), OK);
}

#[test]
fn setup_may_be_left_out() {
    let fmu = Fmu::new(SCENE);
    let instance = fmu.instance();
    assert_eq!(instance.call("fmi2EnterInitializationMode"), OK);
    assert_eq!(instance.call("fmi2ExitInitializationMode"), OK);
    assert_eq!(instance.step(0.0, 0.1), OK);
}

fn in_phase<'f>(fmu: &'f Fmu, phase: &str) -> Instance<'f> {
    let instance = fmu.instance();
    let steps: &[(&str, c_int)] = match phase {
        "Instantiated" => &[],
        "Initialization" => &[("fmi2EnterInitializationMode", OK)],
        "StepComplete" => &[("fmi2EnterInitializationMode", OK), ("fmi2ExitInitializationMode", OK)],
        "Terminated" => {
            &[("fmi2EnterInitializationMode", OK), ("fmi2ExitInitializationMode", OK), ("fmi2Terminate", OK)]
        }
        _ => &[("fmi2EnterInitializationMode", OK), ("fmi2EnterInitializationMode", ERROR)],
    };
    for (function, status) in steps {
        assert_eq!(instance.call(function), *status, "{function}");
    }
    instance.log();
    instance
}

/// A snapshot and the bytes of one.
fn some_state(instance: &Instance<'_>) -> (State, Vec<u8>) {
    let state = instance.recorded();
    (state, instance.serialized(state))
}

/// A call with arguments that are never a reason to refuse it.
fn call(instance: &Instance<'_>, function: &str, mut state: State, bytes: &[u8]) -> c_int {
    type Directional =
        unsafe extern "C" fn(*mut c_void, *const u32, usize, *const u32, usize, *const f64, *mut f64) -> c_int;
    type Derivatives = unsafe extern "C" fn(*mut c_void, *const u32, usize, *const c_int, *const f64) -> c_int;
    type Status = unsafe extern "C" fn(*mut c_void, c_int, *mut f64) -> c_int;
    let (fmu, c) = (instance.fmu, instance.component);
    let (mut value, mut size) = (0.0, 0);
    match function {
        "fmi2SetupExperiment" => instance.setup(0.0, None),
        "fmi2DoStep" => instance.step(0.0, 0.01),
        "fmi2SetDebugLogging" => {
            type Logging = unsafe extern "C" fn(*mut c_void, c_int, usize, *const c_void) -> c_int;
            // SAFETY: no categories.
            unsafe { fmu.symbol::<Logging>(function)(c, 1, 0, null()) }
        }
        "fmi2GetFMUstate" => instance.get_state(&raw mut state),
        "fmi2SetFMUstate" => instance.set_state(state),
        "fmi2FreeFMUstate" => instance.free_state(&raw mut state),
        "fmi2SerializedFMUstateSize" => instance.serialized_size(state, &raw mut size),
        "fmi2SerializeFMUstate" => instance.serialize_to(state, bytes.to_vec().as_mut_ptr(), bytes.len()),
        "fmi2DeSerializeFMUstate" => instance.deserialize_from(bytes.as_ptr(), bytes.len(), &raw mut state),
        "fmi2GetDirectionalDerivative" => {
            // SAFETY: no elements.
            unsafe { fmu.symbol::<Directional>(function)(c, null(), 0, null(), 0, null(), null_mut()) }
        }
        "fmi2SetRealInputDerivatives" | "fmi2GetRealOutputDerivatives" => {
            // SAFETY: no elements.
            unsafe { fmu.symbol::<Derivatives>(function)(c, null(), 0, null(), null()) }
        }
        _ if function.ends_with("Status") => {
            let kind = match function {
                "fmi2GetRealStatus" => 2,
                "fmi2GetBooleanStatus" => 3,
                "fmi2GetStringStatus" => 1,
                _ => 0,
            };
            // SAFETY: the value has room for any of the types.
            unsafe { fmu.symbol::<Status>(function)(c, kind, &raw mut value) }
        }
        _ if function.starts_with("fmi2Get") => instance.get_raw::<f64>(function, null(), 0, null_mut()),
        _ if function.starts_with("fmi2Set") => instance.set_raw::<f64>(function, null(), 0, null()),
        _ => instance.call(function),
    }
}
