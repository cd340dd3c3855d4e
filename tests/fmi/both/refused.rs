//! The functions for what these FMUs do not offer: each an error, by its name.

use crate::support::*;
use pounding::FmiVersion;
use std::ffi::c_int;
use std::ptr::null_mut;

/// A call of each that takes an instance, with a place where nothing may be written.
fn calls(version: FmiVersion, c: Component, place: *mut u64) -> Vec<(&'static str, c_int)> {
    macro_rules! calls {
        ($($name:ident($($argument:expr),*);)+) => {
            // SAFETY: a live instance or null, and places that have room for one element of any type.
            vec![$((stringify!($name), unsafe { $name(c $(, $argument)*) })),+]
        };
    }
    let vr = &raw const REFERENCE;
    match version {
        FmiVersion::V2 => calls! {
            fmi2EnterEventMode();
            fmi2NewDiscreteStates(place.cast());
            fmi2EnterContinuousTimeMode();
            fmi2CompletedIntegratorStep(1, place.cast(), place.cast());
            fmi2SetTime(0.0);
            fmi2SetContinuousStates(place.cast(), 1);
            fmi2GetDerivatives(place.cast(), 1);
            fmi2GetEventIndicators(place.cast(), 1);
            fmi2GetContinuousStates(place.cast(), 1);
            fmi2GetNominalsOfContinuousStates(place.cast(), 1);
        },
        FmiVersion::V3 => calls! {
            fmi3GetFloat32(vr, 1, place.cast(), 1);
            fmi3GetInt8(vr, 1, place.cast(), 1);
            fmi3GetUInt8(vr, 1, place.cast(), 1);
            fmi3GetInt16(vr, 1, place.cast(), 1);
            fmi3GetUInt16(vr, 1, place.cast(), 1);
            fmi3GetUInt32(vr, 1, place.cast(), 1);
            fmi3GetInt64(vr, 1, place.cast(), 1);
            fmi3GetUInt64(vr, 1, place, 1);
            fmi3GetBinary(vr, 1, place.cast(), place.cast(), 1);
            fmi3GetClock(vr, 1, place.cast());
            fmi3SetFloat32(vr, 1, place.cast(), 1);
            fmi3SetInt8(vr, 1, place.cast(), 1);
            fmi3SetUInt8(vr, 1, place.cast(), 1);
            fmi3SetInt16(vr, 1, place.cast(), 1);
            fmi3SetUInt16(vr, 1, place.cast(), 1);
            fmi3SetInt32(vr, 1, place.cast(), 1);
            fmi3SetUInt32(vr, 1, place.cast(), 1);
            fmi3SetInt64(vr, 1, place.cast(), 1);
            fmi3SetUInt64(vr, 1, place, 1);
            fmi3SetBoolean(vr, 1, place.cast(), 1);
            fmi3SetBinary(vr, 1, place.cast(), place.cast(), 1);
            fmi3SetClock(vr, 1, place.cast());
            fmi3GetNumberOfVariableDependencies(0, place.cast());
            fmi3GetVariableDependencies(0, place.cast(), place.cast(), place.cast(), place.cast(), 1);
            fmi3EnterConfigurationMode();
            fmi3ExitConfigurationMode();
            fmi3GetIntervalDecimal(vr, 1, place.cast(), place.cast());
            fmi3GetIntervalFraction(vr, 1, place, place, place.cast());
            fmi3GetShiftDecimal(vr, 1, place.cast());
            fmi3GetShiftFraction(vr, 1, place, place);
            fmi3SetIntervalDecimal(vr, 1, place.cast());
            fmi3SetIntervalFraction(vr, 1, place, place);
            fmi3SetShiftDecimal(vr, 1, place.cast());
            fmi3SetShiftFraction(vr, 1, place, place);
            fmi3EvaluateDiscreteStates();
            fmi3EnterContinuousTimeMode();
            fmi3CompletedIntegratorStep(1, place.cast(), place.cast());
            fmi3SetTime(0.0);
            fmi3SetContinuousStates(place.cast(), 1);
            fmi3GetContinuousStateDerivatives(place.cast(), 1);
            fmi3GetEventIndicators(place.cast(), 1);
            fmi3GetContinuousStates(place.cast(), 1);
            fmi3GetNominalsOfContinuousStates(place.cast(), 1);
            fmi3GetNumberOfEventIndicators(place.cast());
            fmi3GetNumberOfContinuousStates(place.cast());
            fmi3ActivateModelPartition(0, 0.0);
        },
    }
}

static REFERENCE: u32 = 0;

#[test]
fn each_is_an_error_that_names_it_and_ends_the_run() {
    for fmu in Fmu::both(SCENE) {
        let instance = fmu.instance();
        instance.start();
        let mut place = 0x5a5a_5a5a_5a5a_5a5a;
        let found = calls(fmu.version, instance.component, &raw mut place);
        let log = instance.log();
        let count = fmu.either(10, 46);
        assert_eq!((found.len(), log.len()), (count, count));
        for ((name, status), line) in found.into_iter().zip(log) {
            assert_eq!((status, line.status), (ERROR, ERROR), "{name}");
            assert!(line.message.starts_with(&format!("{name}: this FMU ")), "{name}: {}", line.message);
            let says_why = line.message.ends_with("is for co-simulation only, it has no Model Exchange");
            assert_eq!(says_why, fmu.version == FmiVersion::V2, "{}", line.message);
        }
        assert_eq!(place, 0x5a5a_5a5a_5a5a_5a5a, "nothing is written");
        assert_eq!(instance.step(0.0, 0.1), ERROR, "after an error a run is over");
        assert_eq!(instance.reset(), OK);
        instance.start();
        assert_eq!(instance.step(0.0, 0.1), OK);
    }
}

/// Also with null where there ought to be a place, and without an instance.
#[test]
fn without_an_instance_or_a_place_each_is_an_error() {
    for fmu in Fmu::both(SCENE) {
        let (instance, mut place) = (fmu.instance(), 0);
        for (c, place) in [(null_mut(), &raw mut place), (null_mut(), null_mut()), (instance.component, null_mut())] {
            for (name, status) in calls(fmu.version, c, place) {
                assert_eq!(status, ERROR, "{name}");
            }
        }
    }
}
