//! Values that are taken: the run is, to the last bit, that of the scene that says the same.

use super::scene::edited;
use crate::support::*;
use fmi::model_description::fmi2::{Causality, VariableType};
use std::fs;

/// Every Real parameter and its value.
fn parameters(fmu: &Fmu) -> Vec<(&str, f64)> {
    let variables = fmu.description.modelVariables.iter();
    let reals = variables.filter(|v| v.causality == Causality::Parameter && v.name != "ground.record");
    reals.map(|v| (v.name.as_str(), v.variableType.start().as_ref().unwrap().parse().unwrap())).collect()
}

/// Another value that a scene may have.
fn other(name: &str, value: f64) -> f64 {
    match name.rsplit('.').next().unwrap() {
        "relative_tolerance" => 1e-6,
        "restitution" => 0.9 * value,
        "exponent" => value + 0.25,
        _ => 1.25 * value,
    }
}

/// Calculated parameters and outputs at the start, then outputs along the run.
fn run(instance: &Instance<'_>) -> Vec<Vec<u64>> {
    let variables = instance.fmu.description.modelVariables.iter();
    let calculated = variables.filter(|v| v.causality == Causality::CalculatedParameter);
    let calculated = calculated.map(|v| instance.real(&v.name).to_bits()).collect();
    let mut seen = vec![calculated, instance.outputs()];
    seen.extend(instance.run(0.0, 0.05, 20));
    seen
}

/// Sets parameters in one of the phases in which it is allowed, and runs.
pub fn run_with(fmu: &Fmu, parameters: &[(&str, f64)], in_initialization: bool) -> Vec<Vec<u64>> {
    let instance = fmu.instance();
    let set = || {
        let references = parameters.iter().map(|(name, _)| fmu.vr(name)).collect::<Vec<_>>();
        let values = parameters.iter().map(|(_, value)| *value).collect::<Vec<_>>();
        let status = instance.set_reals(&references, &values);
        assert_eq!(status, OK, "{parameters:?}: {:?}", instance.log());
        for (name, value) in parameters {
            assert_eq!(instance.real(name).to_bits(), value.to_bits(), "{name}");
        }
    };
    if in_initialization {
        instance.enter();
        instance.outputs();
        set();
    } else {
        let references = parameters.iter().map(|(name, _)| fmu.vr(name)).collect::<Vec<_>>();
        let values = parameters.iter().map(|(_, value)| *value).collect::<Vec<_>>();
        let status = instance.set_reals(&references, &values);
        assert_eq!(status, OK, "{parameters:?}: {:?}", instance.log());
        instance.enter();
    }
    assert_eq!(instance.exit(), OK, "{:?}", instance.log());
    run(&instance)
}

#[test]
fn each_parameter_works_as_if_the_scene_had_said_so() {
    let fmu = Fmu::new(RICH);
    let unchanged = run_with(&fmu, &[], false);
    let parameters = parameters(&fmu);
    // 10 of the buildings, 2 damping ratios, 6 gaps, 5 stiffnesses, 2 exponents, 5 restitutions, scale, tolerance.
    assert_eq!(parameters.len(), 32, "{parameters:?}");
    for &(name, value) in &parameters {
        let change = [(name, other(name, value))];
        let said = Fmu::new(&edited(&change));
        let expected = run_with(&said, &[], false);
        for in_initialization in [false, true] {
            assert!(run_with(&fmu, &change, in_initialization) == expected, "{change:?} {in_initialization}");
        }
        assert!(expected != unchanged, "{name} has no effect");
    }
}

#[test]
fn positions_and_dashpots_work_as_if_the_scene_had_said_so() {
    let fmu = Fmu::new(UNEVEN);
    let unchanged = run_with(&fmu, &[], false);
    for (name, value, from, to) in [
        ("contact[1].position", 0.6, "right_position = 0.3", "right_position = 0.6"),
        ("contact[2].position", 0.25, "left_storey = 1", "left_storey = 1\nleft_position = 0.25"),
        ("left.dashpot[2]", 5.5, "dashpots = [3.0, 2.0]", "dashpots = [3.0, 5.5]"),
    ] {
        assert!(UNEVEN.contains(from));
        let expected = run_with(&Fmu::new(&UNEVEN.replace(from, to)), &[], false);
        for in_initialization in [false, true] {
            assert!(run_with(&fmu, &[(name, value)], in_initialization) == expected, "{name} {in_initialization}");
        }
        assert!(expected != unchanged, "{name} has no effect");
    }
    for (name, value, expected) in [
        ("contact[1].position", 1.0, "fmi2SetReal: contact[1].position = 1.0: expected 0 < s < 1"),
        ("left.dashpot[1]", -1.0, "fmi2SetReal: left.dashpot[1] = -1.0: expected a finite dashpot >= 0 N s/m"),
    ] {
        let instance = fmu.instance();
        assert_eq!(instance.set_real(name, value), ERROR);
        assert_eq!(instance.log().last().unwrap().message, expected);
    }
}

#[test]
fn yield_forces_and_ratios_work_as_if_the_scene_had_said_so() {
    let fmu = Fmu::new(YIELDING);
    let unchanged = run_with(&fmu, &[], false);
    for (name, value, from, to) in [
        ("left.yield_force[1]", 13.5, "[18.0, 12.0]", "[13.5, 12.0]"),
        // More than it is strained by at the start.
        ("left.yield_force[2]", 31.0, "[18.0, 12.0]", "[18.0, 31.0]"),
        ("right.yield_force[1]", 1e9, "[15.0, inf]", "[1e9, inf]"),
        ("left.post_yield_ratio[1]", 0.0, "[0.1, 0.05]", "[0.0, 0.05]"),
        ("left.post_yield_ratio[2]", 0.5, "[0.1, 0.05]", "[0.1, 0.5]"),
        ("right.post_yield_ratio[1]", 0.999, "[0.2, 0.3]", "[0.999, 0.3]"),
    ] {
        assert!(YIELDING.contains(from));
        let expected = run_with(&Fmu::new(&YIELDING.replace(from, to)), &[], false);
        for in_initialization in [false, true] {
            assert!(run_with(&fmu, &[(name, value)], in_initialization) == expected, "{name} {in_initialization}");
        }
        assert!(expected != unchanged, "{name} has no effect");
    }
    const FORCE: &str = "expected a force > 0 N, or inf for a storey that stays elastic";
    for (name, value, expected) in [
        ("left.yield_force[2]", 0.0, format!("left.yield_force[2] = 0.0: {FORCE}")),
        ("left.yield_force[1]", f64::NAN, format!("left.yield_force[1] = nan: {FORCE}")),
        ("left.post_yield_ratio[1]", 1.0, "left.post_yield_ratio[1] = 1.0: expected 0 <= r < 1".to_owned()),
        ("right.post_yield_ratio[1]", -0.1, "right.post_yield_ratio[1] = -0.1: expected 0 <= r < 1".to_owned()),
    ] {
        let instance = fmu.instance();
        assert_eq!(instance.set_real(name, value), ERROR);
        assert_eq!(instance.log().last().unwrap().message, format!("fmi2SetReal: {expected}"));
    }
    for name in ["right.yield_force[2]", "right.post_yield_ratio[2]", "right.yielding[2]", "right.storey_shear[2]"] {
        assert!(fmu.description.variable_by_name(name).is_err(), "{name} of a storey that stays elastic");
    }
}

/// The variables of the storey stay: its shear is that of its drift, and it has never yielded, also from bytes.
#[test]
fn an_infinite_yield_force_keeps_a_storey_elastic() {
    let fmu = Fmu::new(YIELDING);
    let (instance, other) = (fmu.instance(), fmu.instance());
    assert_eq!(instance.set_real("left.yield_force[1]", f64::INFINITY), OK, "{:?}", instance.log());
    instance.enter();
    assert_eq!(instance.exit(), OK, "{:?}", instance.log());
    instance.run(0.0, 0.05, 20);
    assert_eq!(other.set_state(other.deserialized(&instance.serialized(instance.recorded()))), OK);
    for instance in [instance, other] {
        let shear = instance.real("left.stiffness[1]") * instance.real("left.displacement[1]");
        let shown = instance.real("left.storey_shear[1]");
        assert!((shown - shear).abs() <= 1e-14 * shear.abs() && shear.abs() > 0.1, "{shown} instead of {shear}");
        for name in ["plastic_drift", "residual_drift", "ductility", "hysteretic_energy", "cumulative_plastic_drift"] {
            assert_eq!(instance.real(&format!("left.{name}[1]")), 0.0, "{name}");
        }
        assert_eq!(instance.integer("left.yielding[1]"), 0);
    }
}

#[test]
fn all_parameters_can_be_set_in_one_call() {
    let fmu = Fmu::new(RICH);
    let changes = parameters(&fmu).into_iter().map(|(name, value)| (name, other(name, value))).collect::<Vec<_>>();
    let said = run_with(&Fmu::new(&edited(&changes)), &[], false);
    for in_initialization in [false, true] {
        assert!(run_with(&fmu, &changes, in_initialization) == said, "{in_initialization}");
    }
}

#[test]
fn another_record_works_as_if_the_scene_had_said_so() {
    let text = "time_s,accel_m_s2\n0.0,0.5\n0.31,-3.0\n0.5,2.0\n1.5,0.0\n";
    let expected = run_with(&Fmu::with_record(RICH, text.as_bytes()), &[], false);

    let fmu = Fmu::new(RICH);
    assert!(expected != run_with(&fmu, &[], false), "the record has no effect");
    let other = fmu.directory.path().join("other.csv");
    fs::write(&other, text).unwrap();
    for in_initialization in [false, true] {
        let instance = fmu.instance();
        let set = || assert_eq!(instance.set_string("ground.record", other.to_str().unwrap()), OK);
        if in_initialization {
            instance.enter();
            instance.outputs();
            set();
        } else {
            set();
            instance.enter();
        }
        assert_eq!(instance.string("ground.record"), other.to_str().unwrap());
        assert_eq!(instance.exit(), OK);
        assert!(run(&instance) == expected, "{in_initialization}");
    }
}

#[test]
fn a_reset_brings_every_parameter_back() {
    let fmu = Fmu::new(RICH);
    let (parameters, unchanged) = (parameters(&fmu), run_with(&fmu, &[], false));
    let other_record = fmu.directory.path().join("other.csv");
    fs::write(&other_record, "time_s,accel_m_s2\n0.0,0.5\n1.5,0.0\n").unwrap();
    let instance = fmu.instance();
    for &(name, value) in &parameters {
        assert_eq!(instance.set_real(name, other(name, value)), OK, "{name}: {:?}", instance.log());
    }
    assert_eq!(instance.set_string("ground.record", other_record.to_str().unwrap()), OK);
    instance.start();
    assert!(run(&instance) != unchanged);
    for after_an_error in [false, true] {
        if after_an_error {
            assert_eq!(instance.set_real("left.mass[1]", -1.0), ERROR);
        }
        assert_eq!(instance.reset(), OK);
        instance.start();
        for (name, value) in &parameters {
            assert_eq!(instance.real(name).to_bits(), value.to_bits(), "{name}");
        }
        assert_eq!(instance.string("ground.record"), "");
        assert!(run(&instance) == unchanged);
    }
}

/// No master writes the start values of the description into the library.
#[test]
fn every_start_value_is_that_of_the_library() {
    for scene in [RICH, SCENE, RECORD_SCENE, YIELDING] {
        let fmu = Fmu::new(scene);
        let instance = fmu.instance();
        instance.enter();
        for variable in &fmu.description.modelVariables {
            let settable = matches!(variable.causality, Causality::Parameter | Causality::Input);
            assert_eq!(variable.variableType.has_start(), settable, "{}", variable.name);
            let (name, Some(start)) = (&variable.name, variable.variableType.start()) else { continue };
            match variable.variableType {
                VariableType::Real { .. } => {
                    assert_eq!(instance.real(name).to_bits(), start.parse::<f64>().unwrap().to_bits(), "{name}");
                }
                VariableType::String { .. } => assert_eq!(&instance.string(name), start, "{name}"),
                _ => panic!("{name}: no input or parameter has this type"),
            }
        }
    }
}
