//! Pointers and references that are not what they should be.

use crate::support::{DISCARD, ERROR, Fmu, Instance, OK, SCENE};
use std::ffi::{c_char, c_int, c_void};
use std::ptr::{null, null_mut};

fn started(fmu: &Fmu) -> Instance<'_> {
    let instance = fmu.instance();
    instance.start();
    instance
}

#[test]
fn null_arrays_are_good_for_no_elements_only() {
    let fmu = Fmu::new(SCENE);
    let (vr, value) = (fmu.vr("ground.acceleration"), 1.0);
    for function in ["fmi2GetReal", "fmi2GetInteger", "fmi2GetBoolean", "fmi2GetString"] {
        assert_eq!(started(&fmu).get_raw::<f64>(function, null(), 0, null_mut()), OK, "{function}");
        assert_eq!(started(&fmu).get_raw::<f64>(function, null(), 1, &mut 0.0), ERROR, "{function}");
        assert_eq!(started(&fmu).get_raw::<f64>(function, &raw const vr, 1, null_mut()), ERROR, "{function}");
    }
    for function in ["fmi2SetReal", "fmi2SetInteger", "fmi2SetBoolean", "fmi2SetString"] {
        assert_eq!(started(&fmu).set_raw::<f64>(function, null(), 0, null()), OK, "{function}");
        assert_eq!(started(&fmu).set_raw::<f64>(function, null(), 1, &raw const value), ERROR, "{function}");
        assert_eq!(started(&fmu).set_raw::<f64>(function, &raw const vr, 1, null()), ERROR, "{function}");
    }
}

#[test]
fn a_size_that_no_array_has_is_refused() {
    let fmu = Fmu::new(SCENE);
    let (vr, value) = ([0_u32; 2], [0.0; 2]);
    for n in [usize::MAX, usize::MAX / 2, usize::MAX / 8 + 1] {
        assert_eq!(started(&fmu).set_raw("fmi2SetReal", vr.as_ptr(), n, value.as_ptr()), ERROR);
        assert_eq!(started(&fmu).get_raw::<f64>("fmi2GetReal", vr.as_ptr(), n, &mut 0.0), ERROR);
    }
}

#[test]
fn unknown_references_and_wrong_types_are_all_named() {
    let fmu = Fmu::new(SCENE);
    let instance = started(&fmu);
    let references = [9999, fmu.vr("impacts"), u32::MAX, fmu.vr("left.mass[1]")];
    assert_eq!(instance.get::<f64>("fmi2GetReal", &references), Err(ERROR));
    let log = instance.log();
    let messages = log.iter().map(|line| line.message.as_str()).collect::<Vec<_>>();
    assert_eq!(messages.len(), 3, "{messages:?}");
    assert!(messages[0].starts_with("fmi2GetReal: value reference 9999"), "{messages:?}");
    assert!(messages[1].contains("impacts") && messages[1].contains("Integer, not Real"), "{messages:?}");
    assert!(messages[2].contains("4294967295"), "{messages:?}");

    for (function, name) in [
        ("fmi2GetInteger", "left.mass[1]"),
        ("fmi2GetBoolean", "impacts"),
        ("fmi2GetReal", "contact[1].active"),
        ("fmi2GetString", "ground.acceleration"),
    ] {
        let mut value = 0_u64;
        let status = started(&fmu).get_raw(function, &fmu.vr(name), 1, &raw mut value);
        assert_eq!(status, ERROR, "{function} of {name}");
    }
    let text = c"".as_ptr();
    for (function, name, value) in [
        ("fmi2SetInteger", "left.mass[1]", (&raw const text).cast::<u8>()),
        ("fmi2SetBoolean", "ground.acceleration", (&raw const text).cast()),
        ("fmi2SetString", "left.mass[1]", (&raw const text).cast()),
        ("fmi2SetReal", "impacts", (&raw const text).cast()),
    ] {
        let instance = fmu.instance();
        instance.enter();
        assert_eq!(instance.set_raw(function, &fmu.vr(name), 1, value), ERROR, "{function} of {name}");
        assert!(instance.log()[0].message.contains(", not "), "{function} of {name}");
        assert_eq!(instance.real("left.mass[1]"), 3.65);
    }
}

#[test]
fn strings_must_be_utf8_and_there() {
    let record_fmu = Fmu::new(crate::support::RECORD_SCENE);
    let vr = record_fmu.vr("ground.record");
    for text in [null::<c_char>(), c"\xff.csv".as_ptr()] {
        let instance = record_fmu.instance();
        assert_eq!(instance.set_raw("fmi2SetString", &raw const vr, 1, &raw const text), ERROR);
        assert!(instance.log()[0].message.contains("value[0]"));
    }
}

#[test]
fn flags_and_kinds_outside_their_enumeration_are_refused() {
    let fmu = Fmu::new(SCENE);
    type Logging = unsafe extern "C" fn(*mut c_void, c_int, usize, *const c_void) -> c_int;
    let instance = started(&fmu);
    // SAFETY: no categories.
    let status = unsafe { fmu.symbol::<Logging>("fmi2SetDebugLogging")(instance.component, 7, 0, null()) };
    assert_eq!(status, ERROR);
    for kind in [-1, 4, c_int::MAX] {
        assert_eq!(started(&fmu).status("fmi2GetRealStatus", kind, &mut 0.0), ERROR);
    }
}

#[test]
fn status_information() {
    let fmu = Fmu::new(SCENE);
    let instance = started(&fmu);
    assert_eq!(instance.step(0.0, 0.25), OK);
    let (mut time, mut terminated) = (-1.0, -1);
    assert_eq!(instance.status("fmi2GetRealStatus", 2, &mut time), OK);
    assert_eq!(time, 0.25);
    assert_eq!(instance.status("fmi2GetBooleanStatus", 3, &mut terminated), OK);
    assert_eq!(terminated, 0);
    assert_eq!(instance.status("fmi2GetStatus", 0, &mut 0), DISCARD);
    assert_eq!(instance.status("fmi2GetRealStatus", 3, &mut time), DISCARD);
    assert_eq!(instance.step(0.25, 0.25), OK, "a discarded question does not stop the simulation");
    assert_eq!(instance.status::<f64>("fmi2GetRealStatus", 2, null_mut()), ERROR);
}
