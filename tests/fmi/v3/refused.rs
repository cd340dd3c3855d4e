//! The functions for what these FMUs do not offer: each an error, by its name.

use crate::support::*;
use std::ffi::c_int;
use std::ptr::{null, null_mut};

/// A call of each that takes an instance, with a place where nothing may be written.
fn calls(c: Component, place: *mut u64) -> Vec<(&'static str, c_int)> {
    macro_rules! calls {
        ($($name:ident($($argument:expr),*);)+) => {
            // SAFETY: a live instance or null, and places that have room for one element of any type.
            vec![$((stringify!($name), unsafe { $name(c $(, $argument)*) })),+]
        };
    }
    let vr = &raw const REFERENCE;
    calls! {
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
    }
}

static REFERENCE: u32 = 0;

#[test]
fn each_is_an_error_that_names_it_and_ends_the_run() {
    let fmu = Fmu::v3(SCENE);
    let instance = fmu.with_flags(true, true);
    instance.start();
    let mut place = 0x5a5a_5a5a_5a5a_5a5a;
    let found = calls(instance.component, &raw mut place);
    let log = instance.log();
    assert_eq!((found.len(), log.len()), (46, 46));
    for ((name, status), line) in found.into_iter().zip(log) {
        assert_eq!((status, line.status), (ERROR, ERROR), "{name}");
        assert!(line.message.starts_with(&format!("{name}: this FMU ")), "{name}: {}", line.message);
    }
    assert_eq!(place, 0x5a5a_5a5a_5a5a_5a5a, "nothing is written");
    assert_eq!(instance.stepped(0.0, 0.1).0, ERROR, "after an error the instance is in Terminated");
    instance.calls(&[fmi3Reset]);
    instance.start();
}

#[test]
fn without_an_instance_each_is_an_error() {
    let mut place = 0;
    for (name, status) in calls(null_mut(), &raw mut place) {
        assert_eq!(status, ERROR, "{name}");
    }
}

#[test]
fn the_other_two_kinds_of_fmu_give_no_instance() {
    let (name, log) = (c"x".as_ptr(), Log::default());
    for logger in [None, Some(note_3 as unsafe extern "C" fn(_, _, _, _))] {
        let c = environment(&log);
        // SAFETY: strings that end with a zero or null, and a log that outlives the calls.
        unsafe {
            assert!(fmi3InstantiateModelExchange(name, name, name, 0, 0, c, logger).is_null());
            assert!(fmi3InstantiateModelExchange(null(), null(), null(), 2, 2, c, logger).is_null());
            assert!(fmi3InstantiateScheduledExecution(name, name, name, 0, 0, c, logger, None, None, None).is_null());
        }
    }
    let lines = log.lines.take();
    let starts =
        ["fmi3InstantiateModelExchange: ", "fmi3InstantiateModelExchange: ", "fmi3InstantiateScheduledExecution: "];
    assert_eq!(lines.len(), starts.len());
    for (line, start) in lines.iter().zip(starts) {
        assert!(line.message.starts_with(start) && line.message.ends_with("fmi3InstantiateCoSimulation"), "{line:?}");
        assert_eq!((line.status, line.category.as_str()), (ERROR, "logStatusError"));
    }
}
