//! What the library exports of FMI 3.0.

use crate::support::{Fmu, SCENE, library_path};
use object::Object;
use std::collections::BTreeSet;
use std::ffi::{CStr, c_char};

/// The functions of `fmi3Functions.h`, without their prefix.
const FUNCTIONS: &str = "GetVersion SetDebugLogging InstantiateModelExchange InstantiateCoSimulation \
    InstantiateScheduledExecution FreeInstance EnterInitializationMode ExitInitializationMode EnterEventMode Terminate \
    Reset GetFloat32 GetFloat64 GetInt8 GetUInt8 GetInt16 GetUInt16 GetInt32 GetUInt32 GetInt64 GetUInt64 GetBoolean \
    GetString GetBinary GetClock SetFloat32 SetFloat64 SetInt8 SetUInt8 SetInt16 SetUInt16 SetInt32 SetUInt32 SetInt64 \
    SetUInt64 SetBoolean SetString SetBinary SetClock GetNumberOfVariableDependencies GetVariableDependencies \
    GetFMUState SetFMUState FreeFMUState SerializedFMUStateSize SerializeFMUState DeserializeFMUState \
    GetDirectionalDerivative GetAdjointDerivative EnterConfigurationMode ExitConfigurationMode GetIntervalDecimal \
    GetIntervalFraction GetShiftDecimal GetShiftFraction SetIntervalDecimal SetIntervalFraction SetShiftDecimal \
    SetShiftFraction EvaluateDiscreteStates UpdateDiscreteStates EnterContinuousTimeMode CompletedIntegratorStep \
    SetTime SetContinuousStates GetContinuousStateDerivatives GetEventIndicators GetContinuousStates \
    GetNominalsOfContinuousStates GetNumberOfEventIndicators GetNumberOfContinuousStates EnterStepMode \
    GetOutputDerivatives DoStep ActivateModelPartition";

fn names() -> BTreeSet<String> {
    FUNCTIONS.split_whitespace().map(|name| format!("fmi3{name}")).collect()
}

#[test]
fn all_functions_and_nothing_but_functions_are_exported() {
    assert_eq!(names().len(), 75);
    let bytes = std::fs::read(library_path()).unwrap();
    let file = object::File::parse(&*bytes).unwrap();
    // On macOS C symbols begin with an underscore.
    let name = |name: Option<&[u8]>| String::from_utf8_lossy(name.unwrap()).trim_start_matches('_').to_owned();
    let exported = file.exports().unwrap().map(|export| name(export.unwrap().name().name()));
    // `c_abi/symbols.rs` has those of FMI 2.0.
    assert_eq!(exported.filter(|name| !name.starts_with("fmi2")).collect::<BTreeSet<_>>(), names());
}

#[test]
fn every_function_is_found_by_name() {
    let fmu = Fmu::new(SCENE);
    for name in names() {
        let _ = fmu.symbol::<unsafe extern "C" fn()>(&name);
    }
}

#[test]
fn the_version() {
    let fmu = Fmu::new(SCENE);
    let version = fmu.symbol::<unsafe extern "C" fn() -> *const c_char>("fmi3GetVersion");
    // SAFETY: it takes nothing and returns a constant string.
    assert_eq!(unsafe { CStr::from_ptr(version()) }, c"3.0");
}
