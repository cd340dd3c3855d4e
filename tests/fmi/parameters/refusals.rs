//! Values that are refused: for the same reasons and in the same words as in a scene, under the variable's name.

use super::scene::edited;
use crate::support::*;
use fmi::model_description::fmi2::Causality;
use pounding::scene::Scene;
use std::fs;

/// What the scene with its record says about a value, under the name that the parameter has.
fn refusal_of_scene(fmu: &Fmu, name: &str, value: f64) -> Option<String> {
    let record = &fmu.package.record.as_ref().unwrap().record;
    let scaled = Scene::from_toml(&edited(&[(name, value)])).and_then(|s| Ok(s.ground.scaling.factor(record)?));
    let error = scaled.err()?;
    let [problem] = error.problems.as_slice() else { panic!("{name} = {value}: {error}") };
    Some(format!("fmi2SetReal: {name} = {}: expected {}", problem.found, problem.expected))
}

#[test]
fn the_library_refuses_what_the_scene_refuses_in_the_same_words() {
    let fmu = Fmu::new(RICH);
    let parameters = fmu.description.modelVariables.iter().filter(|v| v.causality == Causality::Parameter);
    let mut refused = 0;
    for variable in parameters.filter(|v| v.name != "ground.record") {
        let name = variable.name.as_str();
        for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, -1.0, -0.0, 0.0, 1e-16, 0.01, 1.0, 1.1, 3.5, 1e300] {
            let instance = fmu.instance();
            let status = instance.set_real(name, value);
            let log = instance.log();
            let log = log.iter().map(|line| line.message.as_str()).collect::<Vec<_>>();
            match refusal_of_scene(&fmu, name, value) {
                None => assert_eq!((status, log.as_slice()), (OK, &[][..]), "{name} = {value}"),
                Some(expected) => {
                    assert_eq!((status, log.as_slice()), (ERROR, &[expected.as_str()][..]), "{name} = {value}");
                    refused += 1;
                }
            }
        }
    }
    assert!(refused > 100, "{refused}");
}

#[test]
fn everything_wrong_in_one_call_is_named_and_nothing_is_changed() {
    let fmu = Fmu::new(RICH);
    let wrong = [
        ("left.mass[1]", -1.0, "left.mass[1] = -1.0: expected a finite mass > 0 kg"),
        ("right.stiffness[3]", f64::NAN, "right.stiffness[3] = nan: expected a finite stiffness > 0 N/m"),
        ("left.damping_ratio", -0.5, "left.damping_ratio = -0.5: expected a finite damping ratio >= 0"),
        ("ground.scale", f64::INFINITY, "ground.scale = inf: expected a finite factor"),
        ("contact[1].restitution", 1.4, "contact[1].restitution = 1.4: expected 0 < e <= 1"),
        ("contact[2].exponent", 9.0, "contact[2].exponent = 9.0: expected 1 <= n <= 3"),
        ("contact[3].gap", f64::NAN, "contact[3].gap = nan: expected a finite distance in m"),
        ("contact[4].stiffness", 0.0, "contact[4].stiffness = 0.0: expected a finite stiffness > 0"),
        ("solver.relative_tolerance", 0.5, "solver.relative_tolerance = 0.5: expected 1e-15 < tolerance <= 1e-2"),
        ("left.frequency[1]", 2.0, "left.frequency[1]: computed by the FMU, it cannot be set"),
        // Right by itself, but not taken in such company.
        ("left.mass[2]", 4.0, ""),
    ];
    let references = wrong.map(|(name, ..)| fmu.vr(name));
    let values = wrong.map(|(_, value, _)| value);
    for in_initialization in [false, true] {
        let (instance, reference) = (fmu.instance(), fmu.instance());
        reference.enter();
        if in_initialization {
            instance.enter();
        }
        let unknown = [&references[..], &[9999]].concat();
        let values = [&values[..], &[1.0]].concat();
        assert_eq!(instance.set_reals(&unknown, &values), ERROR);
        let log = instance.log();
        let has = |text: &str| log.iter().any(|line| line.message == format!("fmi2SetReal: {text}"));
        for (name, _, expected) in wrong.iter().filter(|(.., expected)| !expected.is_empty()) {
            assert!(has(expected), "{name}: {log:#?}");
        }
        assert!(log.iter().any(|line| line.message.contains("value reference 9999")), "{log:#?}");
        assert_eq!(log.len(), wrong.len(), "{log:#?}");
        // In the phase Error values can be read to find out why.
        for (name, ..) in wrong {
            assert_eq!(instance.real(name).to_bits(), reference.real(name).to_bits(), "{name}");
        }
    }
}

#[test]
fn a_record_without_a_peak_is_refused_under_the_name_of_the_record() {
    let fmu = Fmu::new(RECORD_SCENE);
    let zero = fmu.directory.path().join("zero.csv");
    fs::write(&zero, "time_s,accel_m_s2\n0.0,0.0\n1.0,0.0\n").unwrap();
    let instance = fmu.instance();
    assert_eq!(instance.set_string("ground.record", zero.to_str().unwrap()), ERROR);
    let log = instance.log();
    let expected = format!("fmi2SetString: ground.record = {zero:?}: expected a record with a peak");
    assert!(log.len() == 1 && log[0].message.starts_with(&expected), "{log:?}");
}

#[test]
fn nothing_can_be_set_after_initialisation_but_the_inputs() {
    for scene in [RICH, SCENE, YIELDING] {
        let fmu = Fmu::new(scene);
        for variable in &fmu.description.modelVariables {
            let (name, instance) = (&variable.name, fmu.instance());
            let is_input = variable.causality == Causality::Input;
            instance.start();
            let status = match variable.variableType.name() {
                "Real" => instance.set_real(name, 0.53),
                "String" => instance.set_string(name, "other.csv"),
                // SAFETY: of both: a live instance, one reference and one value.
                "Integer" => unsafe { fmi2SetInteger(instance.component, &fmu.vr(name), 1, &1) },
                // SAFETY: as above.
                _ => unsafe { fmi2SetBoolean(instance.component, &fmu.vr(name), 1, &1) },
            };
            assert_eq!(status, if is_input { OK } else { ERROR }, "{name}");
            let log = instance.log();
            let said = log.iter().filter(|line| line.message.contains(&format!("{name}: "))).count();
            assert_eq!((log.len(), said), if is_input { (0, 0) } else { (1, 1) }, "{name}: {log:?}");
        }
    }
}

/// A mass and a stiffness belong together where gravity acts on a storey that leans, and a master sets one after the other.
#[test]
fn what_several_parameters_are_wrong_about_is_told_at_the_end_of_initialisation() {
    let fmu =
        Fmu::new(&YIELDING.replace(
            "stiffness = [2910.0, 2000.0]",
            "stiffness = [2910.0, 2000.0]\nheight = [0.5, 0.4]\np_delta = true",
        ));
    for (stiffness, expected) in [(2e9, OK), (2910.0, ERROR)] {
        let instance = fmu.instance();
        assert_eq!(instance.set_real("left.mass[1]", 12e6), OK, "{:?}", instance.log());
        assert_eq!(instance.set_real("left.stiffness[1]", stiffness), OK);
        assert_eq!(instance.set_real("left.yield_force[1]", 1e6), OK);
        assert_eq!(instance.enter_from(0.0, None), OK);
        assert_eq!(instance.exit(), expected, "{:?}", instance.log());
        let told = instance.log().iter().any(|line| line.message.contains("left.p_delta: expected storeys that stand"));
        assert_eq!(told, expected == ERROR);
    }
}
