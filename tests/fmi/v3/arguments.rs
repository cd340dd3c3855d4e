//! Pointers, lengths, flags and numbers that are not what they should be.

use crate::support::*;
use std::ffi::{c_char, c_int};
use std::ptr::{null, null_mut};

fn started(fmu: &Fmu) -> Instance<'_> {
    let instance = fmu.instance();
    instance.initialize();
    instance
}

/// Calls that must be refused: each on an instance of its own, which a reset brings back.
fn refused(fmu: &Fmu, calls: &[(&str, &dyn Fn(Component) -> c_int)]) {
    for (expected, call) in calls {
        let instance = started(fmu);
        let before = instance.outputs();
        assert_eq!(call(instance.component), ERROR, "{expected}");
        let message = instance.only_error();
        assert!(message.contains(expected), "{expected}: {message}");
        assert_eq!(instance.outputs(), before, "{expected}");
        instance.calls(&[fmi3Reset]);
        instance.initialize();
        assert_eq!(instance.stepped(0.0, 0.1).0, OK, "{expected}");
    }
}

#[test]
fn null_and_lengths_of_values() {
    let fmu = Fmu::v3(SCENE);
    let (vr, input) = ([fmu.vr("left.displacement[1]"); 2], fmu.vr("ground.acceleration"));
    let mut reals = [0.0; 2];
    let (real, set) = (reals.as_mut_ptr(), [0.0; 2].as_ptr());
    let count = fmu.vr("impacts");
    let flag = fmu.vr("contact[1].active");
    // SAFETY: arrays with room for what is announced, or null.
    unsafe {
        refused(
            &fmu,
            &[
                ("valueReferences = 0x0", &|c| fmi3GetFloat64(c, null(), 1, real, 1)),
                ("values = 0x0", &|c| fmi3GetFloat64(c, vr.as_ptr(), 1, null_mut(), 1)),
                ("nValues = 2: expected 1", &|c| fmi3GetFloat64(c, vr.as_ptr(), 1, real, 2)),
                ("nValues = 1: expected 2", &|c| fmi3GetFloat64(c, vr.as_ptr(), 2, real, 1)),
                ("nValues = 0: expected 1", &|c| fmi3GetFloat64(c, vr.as_ptr(), 1, real, 0)),
                ("nValues = 1: expected 0", &|c| fmi3GetFloat64(c, vr.as_ptr(), 0, real, 1)),
                ("elements", &|c| fmi3GetFloat64(c, vr.as_ptr(), usize::MAX, real, usize::MAX)),
                ("nValues = 2: expected 1", &|c| fmi3GetInt32(c, &raw const count, 1, [0; 2].as_mut_ptr(), 2)),
                ("values = 0x0", &|c| fmi3GetInt32(c, &raw const count, 1, null_mut(), 1)),
                ("nValues = 2: expected 1", &|c| fmi3GetBoolean(c, &raw const flag, 1, [0; 2].as_mut_ptr(), 2)),
                ("values = 0x0", &|c| fmi3GetBoolean(c, &raw const flag, 1, null_mut(), 1)),
                ("valueReferences = 0x0", &|c| fmi3SetFloat64(c, null(), 1, set, 1)),
                ("values = 0x0", &|c| fmi3SetFloat64(c, &raw const input, 1, null(), 1)),
                ("nValues = 2: expected 1", &|c| fmi3SetFloat64(c, &raw const input, 1, set, 2)),
                ("NaN", &|c| fmi3SetFloat64(c, &raw const input, 1, &f64::NAN, 1)),
                ("inf", &|c| fmi3SetFloat64(c, &raw const input, 1, &f64::INFINITY, 1)),
            ],
        );
    }
}

#[test]
fn null_and_lengths_of_strings() {
    let fmu = Fmu::v3(RECORD_SCENE);
    let vr = fmu.vr("ground.record");
    let texts = [c"".as_ptr(), c"".as_ptr()];
    // SAFETY: arrays with room for what is announced, or null.
    unsafe {
        refused(
            &fmu,
            &[
                ("values = 0x0", &|c| fmi3GetString(c, &raw const vr, 1, null_mut(), 1)),
                ("nValues = 2: expected 1", &|c| fmi3GetString(c, &raw const vr, 1, texts.clone().as_mut_ptr(), 2)),
                ("values = 0x0", &|c| fmi3SetString(c, &raw const vr, 1, null(), 1)),
                ("nValues = 2: expected 1", &|c| fmi3SetString(c, &raw const vr, 1, texts.as_ptr(), 2)),
                ("values[0] is null", &|c| fmi3SetString(c, &raw const vr, 1, &null::<c_char>(), 1)),
                ("values[0]", &|c| fmi3SetString(c, &raw const vr, 1, &c"\xff.csv".as_ptr(), 1)),
            ],
        );
    }
}

#[test]
fn null_places_of_a_step_are_refused_before_it() {
    let fmu = Fmu::v3(SCENE);
    for missing in 0..4 {
        let instance = started(&fmu);
        let mut found = UNTOUCHED;
        let place = |i: usize, place: *mut u8| if i == missing { null_mut() } else { place };
        let last = if missing == 3 { null_mut() } else { &raw mut found.last };
        let Stepped { event, terminate, early, .. } = &mut found;
        let (event, terminate, early) = (place(0, event), place(1, terminate), place(2, early));
        // SAFETY: places, or null.
        let status = unsafe { fmi3DoStep(instance.component, 0.0, 0.1, 1, event, terminate, early, last) };
        assert_eq!(status, ERROR);
        let name = ["eventHandlingNeeded", "terminateSimulation", "earlyReturn", "lastSuccessfulTime"][missing];
        assert_eq!(instance.only_error(), format!("fmi3DoStep: {name} = 0x0: expected 1 elements"));
        assert_eq!((found, instance.real("time")), (UNTOUCHED, 0.0));
    }
}

#[test]
fn null_places_of_an_update_are_refused() {
    let fmu = Fmu::v3(SCENE);
    let names = [
        "discreteStatesNeedUpdate",
        "terminateSimulation",
        "nominalsOfContinuousStatesChanged",
        "valuesOfContinuousStatesChanged",
        "nextEventTimeDefined",
        "nextEventTime",
    ];
    for (missing, name) in names.into_iter().enumerate() {
        let instance = fmu.with_flags(true, true);
        instance.initialize();
        let (mut flags, mut next) = ([77_u8; 5], -77.0);
        let mut places = flags.each_mut().map(|flag| &raw mut *flag);
        if let Some(place) = places.get_mut(missing) {
            *place = null_mut();
        }
        let [a, b, c, d, e] = places;
        let last = if missing == 5 { null_mut() } else { &raw mut next };
        // SAFETY: places, or null.
        assert_eq!(unsafe { fmi3UpdateDiscreteStates(instance.component, a, b, c, d, e, last) }, ERROR);
        assert!(instance.only_error().starts_with(&format!("fmi3UpdateDiscreteStates: {name} = 0x0")));
        assert_eq!((flags, next), ([77; 5], -77.0));
    }
}

#[test]
fn flags_are_0_or_1() {
    let fmu = Fmu::v3(SCENE);
    for value in [2, 255] {
        let text = |name: &str| format!("{name} = {value}: expected fmi3False (0) or fmi3True (1)");
        let (of_logging, of_step) = (text("loggingOn"), text("noSetFMUStatePriorToCurrentPoint"));
        let mut found = UNTOUCHED;
        let Stepped { event, terminate, early, last } = &mut found;
        let places = (&raw mut *event, &raw mut *terminate, &raw mut *early, &raw mut *last);
        // SAFETY: places, and no categories.
        unsafe {
            refused(
                &fmu,
                &[
                    (&of_logging, &|c| fmi3SetDebugLogging(c, value, 0, null())),
                    (&of_step, &|c| fmi3DoStep(c, 0.0, 0.1, value, places.0, places.1, places.2, places.3)),
                ],
            );
        }
        for (tolerance, stop, name) in [(value, 0, "toleranceDefined"), (0, value, "stopTimeDefined")] {
            let instance = fmu.instance();
            // SAFETY: a live instance.
            let status = unsafe { fmi3EnterInitializationMode(instance.component, tolerance, 0.0, 0.0, stop, 1.0) };
            assert_eq!((status, instance.only_error().contains(&text(name))), (ERROR, true));
        }
    }
}

#[test]
fn times_and_tolerances_that_are_none() {
    let fmu = Fmu::v3(SCENE);
    for (tolerance, start, stop, expected) in [
        (None, f64::NAN, None, "startTime"),
        (None, f64::INFINITY, None, "startTime"),
        (None, 0.0, Some(-1.0), "stopTime"),
        (None, 0.0, Some(f64::NAN), "stopTime"),
        (Some(-1.0), 0.0, None, "tolerance"),
        (Some(f64::NAN), 0.0, None, "tolerance"),
    ] {
        let instance = fmu.instance();
        let of = |value: Option<f64>| (value.is_some().into(), value.unwrap_or_default());
        let ((with_tolerance, tolerance), (with_stop, stop)) = (of(tolerance), of(stop));
        // SAFETY: a live instance.
        let status = unsafe {
            fmi3EnterInitializationMode(instance.component, with_tolerance, tolerance, start, with_stop, stop)
        };
        assert_eq!(status, ERROR, "{expected}");
        assert!(instance.only_error().starts_with(&format!("fmi3EnterInitializationMode: {expected} = ")));
    }
    let instance = fmu.instance();
    // SAFETY: a live instance; what is not defined may be anything.
    let status = unsafe { fmi3EnterInitializationMode(instance.component, 0, f64::NAN, 0.0, 0, f64::NAN) };
    assert_eq!(status, OK);
}

#[test]
fn states_that_are_none() {
    let fmu = Fmu::v3(SCENE);
    let mut size = 0;
    let size = &raw mut size;
    let mut bytes = [0_u8; 4];
    let bytes = bytes.as_mut_ptr();
    let unknown = std::ptr::without_provenance_mut(4711);
    // SAFETY: places, or null; a state is never followed.
    unsafe {
        refused(
            &fmu,
            &[
                ("FMUState = 0x0", &|c| fmi3GetFMUState(c, null_mut())),
                ("fmi3GetFMUState", &|c| fmi3GetFMUState(c, &mut { unknown })),
                ("fmi3SetFMUState", &|c| fmi3SetFMUState(c, null_mut())),
                ("fmi3SetFMUState", &|c| fmi3SetFMUState(c, unknown)),
                ("fmi3FreeFMUState", &|c| fmi3FreeFMUState(c, &mut { unknown })),
                ("fmi3SerializedFMUStateSize", &|c| fmi3SerializedFMUStateSize(c, null_mut(), size)),
                ("fmi3SerializeFMUState", &|c| fmi3SerializeFMUState(c, unknown, bytes, 4)),
                ("FMUState = 0x0", &|c| fmi3DeserializeFMUState(c, bytes, 4, null_mut())),
                ("serializedState = 0x0", &|c| fmi3DeserializeFMUState(c, null(), 4, &mut null_mut())),
                ("fmi3DeserializeFMUState", &|c| fmi3DeserializeFMUState(c, bytes, 4, &mut null_mut())),
            ],
        );
    }
    let instance = started(&fmu);
    let mut state = instance.recorded();
    let n = instance.serialized(state).len();
    // SAFETY: places, or null, with room for as many bytes as announced.
    unsafe {
        let c = instance.component;
        assert_eq!(fmi3FreeFMUState(c, null_mut()), OK);
        assert_eq!(fmi3FreeFMUState(c, &mut null_mut()), OK);
        assert_eq!(fmi3SerializedFMUStateSize(c, state, null_mut()), ERROR);
        assert_eq!(instance.only_error(), "fmi3SerializedFMUStateSize: size = 0x0: expected 1 elements");
        assert_eq!(fmi3SerializeFMUState(c, state, vec![0; n + 1].as_mut_ptr(), n + 1), ERROR);
        assert_eq!(instance.only_error(), format!("fmi3SerializeFMUState: size = {}: expected {n}", n + 1));
        assert_eq!(fmi3SerializeFMUState(c, state, null_mut(), n), ERROR);
        assert_eq!(fmi3FreeFMUState(c, &raw mut state), OK);
    }
    assert!(state.is_null());
}

#[test]
fn lengths_of_derivatives() {
    let fmu = Fmu::v3(SCENE);
    let u = ["left.displacement[1]", "left.acceleration[1]", "left.velocity[1]"].map(|name| fmu.vr(name));
    let k = ["ground.acceleration", "left.force[1]"].map(|name| fmu.vr(name));
    let (u, k, s) = (u.as_ptr(), k.as_ptr(), [1.0; 3].as_ptr());
    let mut places = [0.0; 3];
    let out = &raw mut places[0];
    let orders = [1; 3].as_ptr();
    // SAFETY: arrays with room for what is announced, or null.
    unsafe {
        refused(
            &fmu,
            &[
                ("nSeed = 3: expected 2", &|c| fmi3GetDirectionalDerivative(c, u, 3, k, 2, s, 3, out, 3)),
                ("nSensitivity = 2: expected 3", &|c| fmi3GetDirectionalDerivative(c, u, 3, k, 2, s, 2, out, 2)),
                ("nSeed = 2: expected 3", &|c| fmi3GetAdjointDerivative(c, u, 3, k, 2, s, 2, out, 2)),
                ("nSensitivity = 3: expected 2", &|c| fmi3GetAdjointDerivative(c, u, 3, k, 2, s, 3, out, 3)),
                ("unknowns = 0x0", &|c| fmi3GetDirectionalDerivative(c, null(), 3, k, 2, s, 2, out, 3)),
                ("knowns = 0x0", &|c| fmi3GetDirectionalDerivative(c, u, 3, null(), 2, s, 2, out, 3)),
                ("seed = 0x0", &|c| fmi3GetDirectionalDerivative(c, u, 3, k, 2, null(), 2, out, 3)),
                ("sensitivity = 0x0", &|c| fmi3GetDirectionalDerivative(c, u, 3, k, 2, s, 2, null_mut(), 3)),
                ("unknowns = 0x0", &|c| fmi3GetAdjointDerivative(c, null(), 3, k, 2, s, 3, out, 2)),
                ("knowns = 0x0", &|c| fmi3GetAdjointDerivative(c, u, 3, null(), 2, s, 3, out, 2)),
                ("seed = 0x0", &|c| fmi3GetAdjointDerivative(c, u, 3, k, 2, null(), 3, out, 2)),
                ("sensitivity = 0x0", &|c| fmi3GetAdjointDerivative(c, u, 3, k, 2, s, 3, null_mut(), 2)),
                ("nValues = 2: expected 3", &|c| fmi3GetOutputDerivatives(c, u, 3, orders, out, 2)),
                ("orders = 0x0", &|c| fmi3GetOutputDerivatives(c, u, 3, null(), out, 3)),
                ("valueReferences = 0x0", &|c| fmi3GetOutputDerivatives(c, null(), 3, orders, out, 3)),
                ("values = 0x0", &|c| fmi3GetOutputDerivatives(c, u, 3, orders, null_mut(), 3)),
            ],
        );
    }
    assert_eq!(places, [0.0; 3], "nothing is written");
}

#[test]
fn categories_that_are_none() {
    let fmu = Fmu::v3(SCENE);
    // SAFETY: an array with a null string, or null.
    unsafe {
        refused(
            &fmu,
            &[
                ("categories = 0x0", &|c| fmi3SetDebugLogging(c, 1, 1, null())),
                ("categories[0] is null", &|c| fmi3SetDebugLogging(c, 1, 1, &null::<c_char>())),
            ],
        );
    }
}
