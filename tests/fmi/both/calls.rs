//! Every function that takes an instance, by name: where it is allowed, and a call that is never refused for its arguments.

use crate::support::*;
use pounding::FmiVersion;
use std::ffi::c_int;
use std::ptr::{null, null_mut};

/// Function, the phases in which it is allowed, and what an allowed call with harmless arguments returns.
type Row = (&'static str, &'static str, c_int);

/// Columns: instantiated, initialization, step complete, terminated, error.
pub const TABLE_2: &[Row] = &[
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

/// Columns: instantiated, initialization, event, step, terminated, error.
pub const TABLE_3: &[Row] = &[
    ("fmi3SetDebugLogging", "xxxxxx", OK),
    ("fmi3EnterInitializationMode", "x-----", OK),
    ("fmi3ExitInitializationMode", "-x----", OK),
    ("fmi3EnterEventMode", "---x--", OK),
    ("fmi3EnterStepMode", "--x---", OK),
    ("fmi3UpdateDiscreteStates", "--x---", OK),
    ("fmi3DoStep", "---x--", OK),
    ("fmi3Terminate", "--xx--", OK),
    ("fmi3Reset", "xxxxxx", OK),
    ("fmi3GetFloat64", "xxxxxx", OK),
    ("fmi3GetInt32", "xxxxxx", OK),
    ("fmi3GetBoolean", "xxxxxx", OK),
    ("fmi3GetString", "xxxxxx", OK),
    ("fmi3SetFloat64", "xxxx--", OK),
    ("fmi3SetString", "xxxx--", OK),
    ("fmi3GetFMUState", "xxxxxx", OK),
    ("fmi3SetFMUState", "xxxxxx", OK),
    ("fmi3FreeFMUState", "xxxxxx", OK),
    ("fmi3SerializedFMUStateSize", "xxxxxx", OK),
    ("fmi3SerializeFMUState", "xxxxxx", OK),
    ("fmi3DeserializeFMUState", "xxxxxx", OK),
    ("fmi3GetDirectionalDerivative", "-xxxxx", OK),
    ("fmi3GetAdjointDerivative", "-xxxxx", OK),
    ("fmi3GetOutputDerivatives", "---xxx", OK),
    ("fmi3GetFloat32", "------", OK),
];

/// A call with arguments that are never a reason to refuse it.
pub fn call(instance: &Instance<'_>, function: &str, state: State, bytes: &[u8]) -> c_int {
    match instance.fmu.version {
        FmiVersion::V2 => call_2(instance, function, state, bytes),
        FmiVersion::V3 => call_3(instance, function, state, bytes),
    }
}

fn call_2(instance: &Instance<'_>, function: &str, mut state: State, bytes: &[u8]) -> c_int {
    let (c, n, mut size) = (instance.component, bytes.len(), 0);
    // SAFETY: a live instance or null, no elements, and places for what is written.
    unsafe {
        match function {
            "fmi2SetDebugLogging" => fmi2SetDebugLogging(c, 1, 0, null()),
            "fmi2SetupExperiment" => fmi2SetupExperiment(c, 0, 0.0, 0.0, 0, 0.0),
            "fmi2EnterInitializationMode" => fmi2EnterInitializationMode(c),
            "fmi2ExitInitializationMode" => fmi2ExitInitializationMode(c),
            "fmi2Terminate" => fmi2Terminate(c),
            "fmi2Reset" => fmi2Reset(c),
            "fmi2GetReal" => fmi2GetReal(c, null(), 0, null_mut()),
            "fmi2GetInteger" => fmi2GetInteger(c, null(), 0, null_mut()),
            "fmi2GetBoolean" => fmi2GetBoolean(c, null(), 0, null_mut()),
            "fmi2GetString" => fmi2GetString(c, null(), 0, null_mut()),
            "fmi2SetReal" => fmi2SetReal(c, null(), 0, null()),
            "fmi2SetInteger" => fmi2SetInteger(c, null(), 0, null()),
            "fmi2SetBoolean" => fmi2SetBoolean(c, null(), 0, null()),
            "fmi2SetString" => fmi2SetString(c, null(), 0, null()),
            "fmi2GetFMUstate" => fmi2GetFMUstate(c, &raw mut state),
            "fmi2SetFMUstate" => fmi2SetFMUstate(c, state),
            "fmi2FreeFMUstate" => fmi2FreeFMUstate(c, &raw mut state),
            "fmi2SerializedFMUstateSize" => fmi2SerializedFMUstateSize(c, state, &raw mut size),
            "fmi2SerializeFMUstate" => fmi2SerializeFMUstate(c, state, bytes.to_vec().as_mut_ptr(), n),
            "fmi2DeSerializeFMUstate" => fmi2DeSerializeFMUstate(c, bytes.as_ptr(), n, &raw mut state),
            "fmi2GetDirectionalDerivative" => fmi2GetDirectionalDerivative(c, null(), 0, null(), 0, null(), null_mut()),
            "fmi2SetRealInputDerivatives" => fmi2SetRealInputDerivatives(c, null(), 0, null(), null()),
            "fmi2GetRealOutputDerivatives" => fmi2GetRealOutputDerivatives(c, null(), 0, null(), null_mut()),
            "fmi2DoStep" => fmi2DoStep(c, 0.0, 0.01, 1),
            "fmi2CancelStep" => fmi2CancelStep(c),
            "fmi2GetStatus" => fmi2GetStatus(c, 0, &mut 0),
            "fmi2GetRealStatus" => fmi2GetRealStatus(c, 2, &mut 0.0),
            "fmi2GetIntegerStatus" => fmi2GetIntegerStatus(c, 0, &mut 0),
            "fmi2GetBooleanStatus" => fmi2GetBooleanStatus(c, 3, &mut 0),
            "fmi2GetStringStatus" => fmi2GetStringStatus(c, 1, &mut null()),
            _ => panic!("{function}"),
        }
    }
}

fn call_3(instance: &Instance<'_>, function: &str, mut state: State, bytes: &[u8]) -> c_int {
    let (c, n, mut size) = (instance.component, bytes.len(), 0);
    // SAFETY: a live instance or null, no elements, and places for what is written.
    unsafe {
        match function {
            "fmi3SetDebugLogging" => fmi3SetDebugLogging(c, 1, 0, null()),
            "fmi3EnterInitializationMode" => instance.enter_from(0.0, None),
            "fmi3ExitInitializationMode" => fmi3ExitInitializationMode(c),
            "fmi3EnterEventMode" => fmi3EnterEventMode(c),
            "fmi3EnterStepMode" => fmi3EnterStepMode(c),
            "fmi3UpdateDiscreteStates" => instance.update().0,
            "fmi3DoStep" => instance.step(0.0, 0.001),
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
