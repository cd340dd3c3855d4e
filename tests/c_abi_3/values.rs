//! Values by their references: types, the time, what is set.

use crate::linked_3::*;
use crate::support::{RECORD_SCENE, RICH, SCENE};
use pounding::variables::Type;
use std::ffi::{CStr, c_char, c_int};
use std::ptr::null;

#[test]
fn each_type_has_its_function() {
    let fmu = Fmu::new(RECORD_SCENE);
    let instance = fmu.instance(false, false);
    for (reference, row) in fmu.table.iter() {
        let mut text = null::<c_char>();
        // SAFETY: one reference and one place.
        let string = unsafe { fmi3GetString(instance.component, &raw const reference, 1, &raw mut text, 1) };
        let found = [
            instance.get(fmi3GetFloat64, &[reference], 0.0).is_ok(),
            instance.get(fmi3GetInt32, &[reference], 0).is_ok(),
            instance.get(fmi3GetBoolean, &[reference], 0).is_ok(),
            string == OK,
        ];
        let expected =
            [matches!(row.ty, Type::Real(_)), row.ty == Type::Integer, row.ty == Type::Boolean, row.ty == Type::String];
        assert_eq!(found, expected, "{}", row.name);
        assert_eq!(instance.log().len(), 3, "{}: one message for each wrong type", row.name);
        assert_eq!(row.ty == Type::String, !text.is_null());
    }
}

#[test]
fn wrong_types_and_unknown_references_are_all_named() {
    let fmu = Fmu::new(SCENE);
    let instance = fmu.instance(false, false);
    let time = fmu.vr("time");
    let references = [time + 1, fmu.vr("impacts"), fmu.vr("contact[1].active"), u32::MAX, time];
    assert_eq!(instance.get(fmi3GetFloat64, &references, 0.0), Err(ERROR));
    let log = instance.log();
    let messages = log.iter().map(|line| line.message.as_str()).collect::<Vec<_>>();
    assert_eq!(messages.len(), 4, "{messages:?}");
    let start = format!("fmi3GetFloat64: value reference {}: expected one below {}", time + 1, time + 1);
    assert_eq!(messages[0], start);
    assert!(messages[1].contains("impacts") && messages[1].ends_with("is Int32, not Float64"), "{messages:?}");
    assert!(messages[2].ends_with("is Boolean, not Float64"), "{messages:?}");
    assert!(messages[3].contains("4294967295"), "{messages:?}");
    assert_eq!(instance.get(fmi3GetInt32, &[time], 0), Err(ERROR));
    assert!(instance.only_error().ends_with("is Float64, not Int32"));
}

#[test]
fn the_time_is_a_variable_that_is_read_and_never_set() {
    let fmu = Fmu::new(SCENE);
    assert_eq!(fmu.vr("time"), u32::try_from(fmu.table.iter().count()).unwrap());
    let instance = fmu.instance(false, false);
    assert_eq!(instance.real("time"), 0.0);
    assert_eq!(instance.enter(-1.5, None), OK);
    assert_eq!(instance.real("time"), -1.5);
    instance.calls(&[fmi3ExitInitializationMode]);
    assert_eq!(instance.step(-1.5, 0.25).0, OK);
    instance.log();
    assert_eq!(instance.real("time"), -1.25);
    assert_eq!(instance.set_real("time", 0.0), ERROR);
    assert!(instance.only_error().contains("time: computed by the FMU"));
    assert_eq!(instance.real("time"), -1.25);
}

#[test]
fn booleans_are_of_one_byte() {
    let fmu = Fmu::new(SCENE);
    let instance = fmu.instance(false, false);
    instance.initialize();
    let vr = [fmu.vr("contact[1].active"), fmu.vr("contact[2].active")];
    let mut values = [77_u8; 4];
    // SAFETY: two references, and room for two values and more.
    let status = unsafe { fmi3GetBoolean(instance.component, vr.as_ptr(), 2, values.as_mut_ptr(), 2) };
    assert_eq!((status, values), (OK, [0, 0, 77, 77]));
}

#[test]
fn start_values_can_be_read_and_set_before_initialisation() {
    let fmu = Fmu::new(RICH);
    let looked_at = fmu.instance(false, false);
    let before = looked_at.outputs();
    let frequency = looked_at.real("left.frequency[1]");
    for instance in [&looked_at, &fmu.instance(false, false)] {
        assert_eq!(instance.set_real("left.mass[1]", 4.0), OK);
        assert_eq!(instance.set_real("ground.scale", 1.5), OK);
    }
    assert!(looked_at.real("left.frequency[1]") < frequency);
    assert_ne!(looked_at.outputs(), before);
    let run = |instance: &Instance<'_>| {
        instance.initialize();
        (0..50)
            .map(|k| {
                assert_eq!(instance.step(f64::from(k) * 0.02, 0.02).0, OK);
                instance.outputs()
            })
            .collect::<Vec<_>>()
    };
    let other = fmu.instance(false, false);
    assert_eq!(other.set_real("left.mass[1]", 4.0), OK);
    assert_eq!(other.set_real("ground.scale", 1.5), OK);
    assert_eq!(run(&looked_at), run(&other), "looking changes nothing");
}

#[test]
fn inputs_before_initialisation_move_with_the_start_time() {
    let fmu = Fmu::new(SCENE);
    let run = |early: bool, looks: bool| {
        let instance = fmu.instance(false, false);
        if early {
            assert_eq!(instance.set_real("ground.acceleration", 2.0), OK);
        }
        if looks {
            instance.outputs();
        }
        assert_eq!(instance.enter(5.0, None), OK);
        if !early {
            assert_eq!(instance.set_real("ground.acceleration", 2.0), OK);
        }
        instance.calls(&[fmi3ExitInitializationMode]);
        assert_eq!(instance.step(5.0, 0.5).0, OK);
        instance.outputs()
    };
    assert_eq!(run(true, false), run(false, false));
    assert_eq!(run(true, true), run(false, false));
}

#[test]
fn a_string_is_set_and_read_until_the_next_call() {
    let fmu = Fmu::new(RECORD_SCENE);
    let instance = fmu.instance(false, false);
    let (vr, path) = (fmu.vr("ground.record"), fmu.resources().join("record.csv"));
    let path = path.to_str().unwrap();
    assert_eq!(instance.set_string("ground.record", path), OK, "{:?}", instance.log());
    let mut text = null::<c_char>();
    // SAFETY: one reference and one place; the string lives until the next call.
    let found = unsafe {
        assert_eq!(fmi3GetString(instance.component, &raw const vr, 1, &raw mut text, 1), OK);
        CStr::from_ptr(text).to_str().unwrap().to_owned()
    };
    assert_eq!(found, path);
}

#[test]
fn nothing_is_set_where_one_value_is_refused() {
    let fmu = Fmu::new(SCENE);
    let instance = fmu.instance(false, false);
    let vr = ["left.mass[1]", "left.displacement[1]", "left.mass[2]"].map(|name| fmu.vr(name));
    // SAFETY: three references and three values.
    let status = unsafe { fmi3SetFloat64(instance.component, vr.as_ptr(), 3, [1.0; 3].as_ptr(), 3) };
    assert_eq!(status, ERROR);
    assert!(instance.only_error().contains("left.displacement[1]: computed by the FMU"));
    assert_eq!((instance.real("left.mass[1]"), instance.real("left.mass[2]")), (3.65, 3.65));
}

#[test]
fn without_flags_the_bits_are_those_of_fmi_2() {
    let fmu = Fmu::new(RECORD_SCENE);
    let instance = fmu.instance(false, false);
    instance.initialize();
    let two = crate::support::Fmu::new(RECORD_SCENE);
    let of_2 = two.instance();
    of_2.start();
    for k in 0..100 {
        let time = f64::from(k) * 0.02;
        assert_eq!((instance.step(time, 0.02).0, of_2.step(time, 0.02)), (OK, OK));
        let reals = |get: &dyn Fn(&[u32]) -> Vec<f64>| {
            get(&fmu.outputs(|ty| matches!(ty, Type::Real(_)))).into_iter().map(f64::to_bits).collect::<Vec<_>>()
        };
        assert_eq!(
            reals(&|vr| instance.get(fmi3GetFloat64, vr, 0.0).unwrap()),
            reals(&|vr| of_2.get("fmi2GetReal", vr).unwrap()),
            "after step {k}"
        );
        let impacts: c_int = of_2.integer("impacts");
        assert_eq!(instance.integer("impacts"), impacts);
    }
}
