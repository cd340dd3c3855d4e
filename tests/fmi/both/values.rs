//! Start values, parameters and inputs.

use crate::support::*;
use fmi::model_description::fmi2::{Causality, VariableType};
use pounding::variables::Type;
use std::ffi::c_int;
use std::fs;

#[test]
fn the_start_values_of_the_description_are_those_of_the_library() {
    for fmu in [SCENE, RECORD_SCENE].into_iter().flat_map(Fmu::both) {
        let instance = fmu.instance();
        instance.enter();
        let mut compared = 0;
        for variable in &fmu.description.modelVariables {
            let Some(start) = variable.variableType.start() else { continue };
            match &variable.variableType {
                VariableType::Real { .. } => {
                    assert_eq!(instance.real(&variable.name), start.parse::<f64>().unwrap(), "{}", variable.name);
                }
                VariableType::String { .. } => assert_eq!(&instance.string(&variable.name), start, "{}", variable.name),
                other => panic!("{}: a start value of type {}", variable.name, other.name()),
            }
            compared += 1;
        }
        assert!(compared > 10, "{compared}");
    }
}

#[test]
fn everything_can_be_read_in_initialization_mode() {
    for fmu in [SCENE, RECORD_SCENE].into_iter().flat_map(Fmu::both) {
        let instance = fmu.instance();
        instance.enter();
        for variable in &fmu.description.modelVariables {
            match variable.variableType {
                VariableType::Real { .. } => assert!(instance.real(&variable.name).is_finite(), "{}", variable.name),
                VariableType::Integer { .. } => assert_eq!(instance.integer(&variable.name), 0),
                VariableType::Boolean { .. } => assert_eq!(instance.boolean(&variable.name), 0),
                _ => assert_eq!(instance.string(&variable.name), ""),
            }
        }
    }
}

#[test]
fn initial_outputs_follow_the_parameters_and_inputs_at_hand() {
    for fmu in Fmu::both(SCENE) {
        let instance = fmu.instance();
        instance.enter();
        let before = instance.real("left.frequency[1]");
        // Two equal storeys: w^2 = (3 - sqrt 5)/2 k/m.
        let expected = ((3.0 - 5.0_f64.sqrt()) / 2.0 * 2910.0 / 3.65).sqrt() / std::f64::consts::TAU;
        assert!((before - expected).abs() < 1e-12 * expected, "{before} {expected}");
        for name in ["left.stiffness[1]", "left.stiffness[2]"] {
            assert_eq!(instance.set_real(name, 4.0 * 2910.0), OK);
        }
        assert!((instance.real("left.frequency[1]") - 2.0 * before).abs() < 1e-12 * before);
        let at_rest = instance.real("right.acceleration[3]");
        assert_eq!(instance.set_real("right.force[3]", 7.3), OK);
        assert!((instance.real("right.acceleration[3]") - at_rest - 2.0).abs() < 1e-12, "7.3 N on 3.65 kg");
        assert_eq!(instance.set_real("contact[1].gap", 0.5), OK);
        assert_eq!(instance.real("contact[1].penetration"), -0.5);
    }
}

#[test]
fn refused_values_are_named_and_the_previous_ones_stay() {
    for fmu in Fmu::both(SCENE) {
        for (name, value, expected) in [
            ("ground.acceleration", f64::NAN, "ground.acceleration = NaN: expected a number from -1e6 to 1e6"),
            ("left.force[1]", f64::INFINITY, "left.force[1] = inf"),
            ("left.mass[2]", -1.0, "left.mass[2] = -1"),
            ("left.mass[2]", f64::NEG_INFINITY, "left.mass[2] = -inf"),
            ("contact[1].restitution", 1.4, "contact[1].restitution = 1.4: expected 0 < e <= 1"),
            ("contact[2].exponent", 0.5, "contact[2].exponent = 0.5"),
            ("right.damping_ratio", -0.1, "right.damping"),
            ("solver.relative_tolerance", 0.0, "solver.relative_tolerance"),
            ("left.frequency[1]", 3.0, "left.frequency[1]: computed"),
            ("left.displacement[1]", 0.1, "left.displacement[1]: computed"),
        ] {
            let instance = fmu.instance();
            instance.enter();
            let before = instance.real(name);
            assert_eq!(instance.set_real(name, value), ERROR, "{name}");
            let log = instance.log();
            assert!(log.len() == 1 && log[0].message.contains(expected), "{name}: {log:?}");
            assert_eq!(instance.real(name), before, "{name}");
        }
    }
}

#[test]
fn a_call_with_one_bad_value_sets_none_and_names_every_problem() {
    for fmu in Fmu::both(SCENE) {
        let instance = fmu.instance();
        instance.enter();
        let names = ["left.mass[1]", "contact[1].restitution", "left.mass[2]", "ground.acceleration"];
        let references = names.map(|name| fmu.vr(name));
        assert_eq!(instance.set_reals(&references, &[5.0, 2.0, -3.0, 1.0]), ERROR);
        let log = instance.log();
        assert_eq!(log.len(), 2, "{log:?}");
        assert_eq!(instance.reals(&references), Ok(vec![3.65, 0.65, 3.65, 0.0]));
    }
}

#[test]
fn fixed_parameters_are_fixed_after_initialization() {
    for fmu in Fmu::both(SCENE) {
        let instance = fmu.instance();
        instance.start();
        assert_eq!(instance.set_real("contact[1].gap", 0.01), ERROR);
        assert!(instance.log()[0].message.contains("contact[1].gap: a fixed parameter"));
        assert_eq!(instance.real("contact[1].gap"), 0.002);
    }
}

/// Some importers set all parameters before the initialisation and once more after it.
#[test]
fn a_fixed_parameter_is_set_again_to_what_it_is() {
    for fmu in Fmu::both(RECORD_SCENE) {
        let (again, once) = (fmu.instance(), fmu.instance());
        let record = fmu.resources().join("record.csv").to_str().unwrap().to_owned();
        for instance in [&again, &once] {
            assert_eq!(instance.set_real("contact[1].gap", 0.0), OK);
            assert_eq!(instance.set_string("ground.record", &record), OK);
            instance.start();
        }
        let references: Vec<u32> = fmu.reals(&Causality::Parameter).iter().map(|name| fmu.vr(name)).collect();
        let mut run = Vec::new();
        for k in 0..10 {
            let values = again.reals(&references).unwrap();
            assert_eq!(again.set_reals(&references, &values), OK, "{:?}", again.log());
            assert_eq!(again.set_string("ground.record", &record), OK, "{:?}", again.log());
            run.extend(again.run(f64::from(k) * 0.1, 0.1, 1));
        }
        assert_eq!(run, once.run(0.0, 0.1, 10));
        assert!(references.len() > 10 && once.integer("impacts") > 0);
    }
}

#[test]
fn where_one_parameter_would_change_after_the_initialisation_nothing_does() {
    for fmu in Fmu::both(RECORD_SCENE) {
        let (record, gap) = (fmu.vr("ground.record"), fmu.vr("contact[1].gap"));
        let restitution = (fmu.vr("contact[1].restitution"), 0.5_f64);
        let refused = |set: &dyn Fn(&Instance<'_>) -> c_int, name: &str| {
            let instance = fmu.instance();
            assert_eq!(instance.set_real("contact[1].gap", 0.0), OK);
            instance.start();
            let before = instance.outputs();
            assert_eq!(set(&instance), ERROR, "{name}");
            let expected = format!("{name}: a fixed parameter can only be set before the end of initialisation");
            assert!(instance.only_error().ends_with(&expected), "{name}");
            assert_eq!(instance.reals(&[gap, restitution.0]), Ok(vec![0.0, restitution.1]));
            assert_eq!((instance.string("ground.record"), instance.outputs()), (String::new(), before));
        };
        let pair =
            |gap_m: f64, e: f64| move |instance: &Instance<'_>| instance.set_reals(&[gap, restitution.0], &[gap_m, e]);
        refused(&pair(-0.0, restitution.1), "contact[1].gap");
        refused(&pair(0.0, restitution.1.next_up()), "contact[1].restitution");
        refused(&|instance| instance.set_string("ground.record", "record.csv"), "ground.record");
        let both = |instance: &Instance<'_>| instance.set_strings(&[record; 2], &["", "record.csv"]);
        refused(&both, "ground.record");
    }
}

/// Sets what differs and runs; the scene that says the same runs beside it.
fn assert_same_run(scene: &str, parameters: &[(&str, f64)], replacements: &[(&str, &str)], in_initialization: bool) {
    let said = replacements.iter().fold(scene.to_owned(), |text, (from, to)| {
        assert!(text.contains(from), "{from}");
        text.replacen(from, to, 1)
    });
    for (fmu, said) in Fmu::both(scene).iter().zip(&Fmu::both(&said)) {
        assert_same_instance(&fmu.instance(), &said.instance(), parameters, in_initialization);
    }
}

fn assert_same_instance(
    set: &Instance<'_>,
    expected: &Instance<'_>,
    parameters: &[(&str, f64)],
    in_initialization: bool,
) {
    let apply = |instance: &Instance<'_>| {
        for (name, value) in parameters {
            assert_eq!(instance.set_real(name, *value), OK, "{name}: {:?}", instance.log());
        }
    };
    if in_initialization {
        set.enter();
        set.outputs();
        apply(set);
        assert_eq!(set.exit(), OK);
    } else {
        apply(set);
        set.start();
    }
    expected.start();
    assert_eq!(set.outputs(), expected.outputs());
    assert_eq!(set.run(0.0, 0.05, 30), expected.run(0.0, 0.05, 30));
    assert!(set.integer("impacts") > 0, "nothing has happened");
}

#[test]
fn parameters_work_as_if_the_scene_had_said_so() {
    for in_initialization in [false, true] {
        assert_same_run(
            SCENE,
            &[
                ("left.mass[2]", 4.0),
                ("left.stiffness[1]", 3000.0),
                ("right.damping_ratio", 0.03),
                ("contact[1].gap", 0.001),
                ("contact[1].restitution", 0.5),
                ("contact[2].stiffness", 2e6),
                ("contact[2].exponent", 1.7),
                ("solver.relative_tolerance", 1e-10),
            ],
            &[
                ("mass = [3.65, 3.65]", "mass = [3.65, 4.0]"),
                ("stiffness = [2910.0, 2910.0]", "stiffness = [3000.0, 2910.0]"),
                ("ratio = 0.02", "ratio = 0.03"),
                ("gap = 0.002", "gap = 0.001"),
                ("restitution = 0.65", "restitution = 0.5"),
                ("law = \"hertz\"\nstiffness = 1.0e6", "law = \"hertz\"\nexponent = 1.7\nstiffness = 2.0e6"),
                ("[outputs]", "[solver]\nrelative_tolerance = 1e-10\n[outputs]"),
            ],
            in_initialization,
        );
        let scale = [("ground.scale", 1.5)];
        assert_same_run(RECORD_SCENE, &scale, &[("pga = 3.0", "scale = 1.5")], in_initialization);
    }
}

#[test]
fn the_restitution_of_rigid_floors_may_be_0_and_of_no_others() {
    let (hertz, rigid) = ("law = \"hertz\"\nstiffness = 1.0e6", "law = \"stereomechanical\"\nrestitution = 0.5");
    let scene = SCENE.replace(hertz, rigid);
    let said = [("law = \"stereomechanical\"\nrestitution = 0.5", "law = \"stereomechanical\"\nrestitution = 0.0")];
    assert_same_run(&scene, &[("contact[2].restitution", 0.0)], &said, true);
    let both = Fmu::both(&scene);
    for (name, value, expected) in [
        ("contact[1].restitution", 0.0, "contact[1].restitution = 0.0: expected 0 < e <= 1"),
        ("contact[2].restitution", -0.1, "contact[2].restitution = -0.1: expected 0 <= e <= 1"),
        ("contact[2].restitution", 1.1, "contact[2].restitution = 1.1: expected 0 <= e <= 1"),
        ("contact[2].gap", -0.001, "contact[2].gap = -0.001: expected at least 0.0 for law stereomechanical"),
    ] {
        for fmu in &both {
            let instance = fmu.instance();
            assert_eq!(instance.set_real(name, value), ERROR, "{name}");
            let message = instance.only_error();
            assert!(message.contains(expected), "{name}: {message}");
        }
    }
}

#[test]
fn another_record_runs_instead() {
    for fmu in Fmu::both(RECORD_SCENE) {
        let other = fmu.directory.path().join("other.csv");
        // The record of the FMU at half its size: scaled to the same peak it is the same motion.
        let halved = record().lines().skip(1).fold("time_s,accel_m_s2\n".to_owned(), |text, line| {
            let (time, acceleration) = line.split_once(',').unwrap();
            format!("{text}{time},{}\n", acceleration.parse::<f64>().unwrap() / 2.0)
        });
        fs::write(&other, halved).unwrap();
        let (instance, reference) = (fmu.instance(), fmu.instance());
        assert_eq!(instance.set_string("ground.record", other.to_str().unwrap()), OK, "{:?}", instance.log());
        instance.start();
        reference.start();
        assert_eq!(instance.string("ground.record"), other.to_str().unwrap());
        assert_eq!(instance.real("ground.scale"), 2.0 * reference.real("ground.scale"));
        assert_eq!(instance.run(0.0, 0.1, 10), reference.run(0.0, 0.1, 10));
    }
}

/// A table in braces, as a scene has it, says what the file does not.
#[test]
fn another_record_may_be_a_table() {
    for fmu in Fmu::both(RECORD_SCENE) {
        let place = |name: &str| fmu.directory.path().join(name);
        let (bare, whole) = (place("bare.txt"), place("whole.csv"));
        fs::write(&bare, "by hand\n1 -2\n3 0.5\n").unwrap();
        let rows: String = [1.0, -2.0, 3.0, 0.5]
            .iter()
            .zip(["0", "0.25", "0.5", "0.75"])
            .map(|(a, t)| format!("{t},{}\n", a * 9.80665))
            .collect();
        fs::write(&whole, format!("time_s,accel_m_s2\n{rows}")).unwrap();
        let table = |unit: &str| format!("{{ file = '{}', step = 0.25, unit = \"{unit}\" }}", bare.display());
        let run = |record: &str| {
            let instance = fmu.instance();
            assert_eq!(instance.set_string("ground.record", record), OK, "{:?}", instance.log());
            instance.start();
            assert_eq!(instance.string("ground.record"), record);
            instance.run(0.0, 0.1, 10)
        };
        assert_eq!(run(&table("g")), run(whole.to_str().unwrap()));
        let instance = fmu.instance();
        assert_eq!(instance.set_string("ground.record", &table("kg")), ERROR);
        let message = instance.only_error();
        assert!(message.contains("ground.record.unit = \"kg\": expected a unit of acceleration"), "{message}");
    }
}

#[test]
fn an_empty_path_brings_the_first_record_back() {
    for fmu in Fmu::both(RECORD_SCENE) {
        let other = fmu.directory.path().join("other.csv");
        fs::write(&other, "time_s,accel_m_s2\n0.0,0.0\n0.5,3.0\n1.0,0.0\n").unwrap();
        let run = |paths: &[&str]| {
            let instance = fmu.instance();
            for path in paths {
                assert_eq!(instance.set_string("ground.record", path), OK, "{:?}", instance.log());
            }
            instance.start();
            instance.run(0.0, 0.1, 10)
        };
        let other = other.to_str().unwrap();
        let first = run(&[]);
        assert_ne!(run(&[other]), first);
        assert_eq!(run(&[other, ""]), first);
    }
}

#[test]
fn a_record_that_cannot_be_used_is_refused() {
    for fmu in Fmu::both(RECORD_SCENE) {
        let (bad, zero) = (fmu.directory.path().join("bad.csv"), fmu.directory.path().join("zero.csv"));
        fs::write(&bad, "time_s,accel_m_s2\n0.0,1.0\n0.0,2.0\n").unwrap();
        fs::write(&zero, "time_s,accel_m_s2\n0.0,0.0\n1.0,0.0\n").unwrap();
        let directory = fmu.directory.path().to_str().unwrap();
        for path in [bad.to_str().unwrap(), zero.to_str().unwrap(), "/nowhere/at/all.at2", directory, "/dev/zero"] {
            let instance = fmu.instance();
            assert_eq!(instance.set_string("ground.record", path), ERROR, "{path}");
            assert!(instance.log()[0].message.contains("ground."), "{path}");
            assert_eq!(instance.reset(), OK);
            instance.start();
            assert_eq!(instance.string("ground.record"), "");
        }
    }
}

#[test]
fn strings_live_until_the_next_call() {
    for fmu in Fmu::both(RECORD_SCENE) {
        let instance = fmu.instance();
        instance.start();
        let vr = [fmu.vr("ground.record"); 3];
        let texts = instance.strings(&vr).unwrap();
        assert_eq!(instance.step(0.0, 0.1), OK);
        // SAFETY: strings of the FMU; no further call that gets strings has been made.
        assert!(texts.iter().all(|text| unsafe { **text } == 0));
    }
}

#[test]
fn reading_does_not_change_what_comes() {
    for fmu in Fmu::both(SCENE) {
        let (curious, other) = (fmu.instance(), fmu.instance());
        curious.enter();
        curious.outputs();
        assert_eq!(curious.exit(), OK);
        other.start();
        curious.run(0.0, 0.05, 39);
        for k in 0..39 {
            assert_eq!(other.step(f64::from(k) * 0.05, 0.05), OK);
        }
        assert_eq!(curious.run(1.95, 0.05, 1), other.run(1.95, 0.05, 1));
    }
}

#[test]
fn a_string_is_read_as_it_was_set() {
    for fmu in Fmu::both(RECORD_SCENE) {
        let (instance, path) = (fmu.instance(), fmu.resources().join("record.csv"));
        instance.enter();
        assert_eq!(instance.set_string("ground.record", path.to_str().unwrap()), OK, "{:?}", instance.log());
        assert_eq!(instance.string("ground.record"), path.to_str().unwrap());
    }
}

#[test]
fn wrong_types_and_unknown_references_are_all_named() {
    for fmu in Fmu::both(SCENE) {
        let instance = fmu.instance();
        instance.enter();
        // The first reference that there is not.
        let end = fmu.vr("time") + fmu.either(0, 1);
        let references = [end, fmu.vr("impacts"), u32::MAX, fmu.vr("contact[1].active"), fmu.vr("left.mass[1]")];
        assert_eq!(instance.reals(&references), Err(ERROR));
        let log = instance.log();
        let messages = log.iter().map(|line| line.message.as_str()).collect::<Vec<_>>();
        let (name, real, integer) =
            fmu.either(("fmi2GetReal", "Real", "Integer"), ("fmi3GetFloat64", "Float64", "Int32"));
        assert_eq!(messages.len(), 4, "{messages:?}");
        let among = |expected: &str| messages.iter().any(|message| message.contains(expected));
        assert_eq!(messages[0], format!("{name}: value reference {end}: expected one below {end}"));
        assert!(messages[1].contains("impacts") && messages[1].ends_with(&format!("is {integer}, not {real}")));
        assert!(among(&format!("is Boolean, not {real}")) && among("4294967295"), "{messages:?}");
    }
}

/// What is said of a variable that is read or set by the function of another type; nothing is read or set.
#[test]
fn each_type_has_its_function() {
    for fmu in Fmu::both(RECORD_SCENE) {
        let instance = fmu.instance();
        instance.enter();
        for (reference, row) in fmu.table.iter() {
            let vr = [reference];
            let found = [
                instance.reals(&vr).is_ok(),
                instance.integers(&vr).is_ok(),
                instance.booleans(&vr).is_ok(),
                instance.strings(&vr).is_ok_and(|texts| !texts[0].is_null()),
            ];
            let is = |ty: Type| row.ty == ty;
            let expected = [matches!(row.ty, Type::Real(_)), is(Type::Integer), is(Type::Boolean), is(Type::String)];
            assert_eq!(found, expected, "{}", row.name);
            assert_eq!(instance.log().len(), 3, "{}: one message for each wrong type", row.name);
        }
    }
}
