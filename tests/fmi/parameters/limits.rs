//! Smallest, largest and nominal values of the description, against what the library has.

use crate::support::*;
use fmi::model_description::fmi2::VariableType;

fn number(text: &Option<String>) -> Option<f64> {
    text.as_ref().map(|text| text.parse().unwrap())
}

#[test]
fn every_number_has_a_nominal_value_of_its_size() {
    for scene in [RICH, SCENE, YIELDING] {
        for variable in &Fmu::new(scene).description.modelVariables {
            let VariableType::Real { nominal, .. } = &variable.variableType else { continue };
            let nominal = number(nominal).unwrap_or_else(|| panic!("{}: none", variable.name));
            assert!(nominal > 0.0 && nominal.is_finite(), "{}: {nominal}", variable.name);
            let start = number(variable.variableType.start()).filter(|start| *start != 0.0);
            let ratio = start.map_or(1.0, |start| start.abs() / nominal);
            assert!((0.1..=10.0).contains(&ratio), "{}: {start:?}, nominal {nominal}", variable.name);
        }
    }
}

#[test]
fn nominal_frequencies_are_of_the_size_of_the_frequencies() {
    let fmu = Fmu::new(RICH);
    let instance = fmu.instance();
    instance.enter();
    for variable in fmu.description.modelVariables.iter().filter(|v| v.name.contains(".frequency[")) {
        let VariableType::Real { nominal, .. } = &variable.variableType else { panic!("{}", variable.name) };
        let ratio = instance.real(&variable.name) / number(nominal).unwrap();
        assert!((0.3..3.0).contains(&ratio), "{}: {ratio}", variable.name);
    }
}

#[test]
fn limits_are_declared_and_kept_through_a_run() {
    for scene in [RICH, SCENE, YIELDING] {
        let fmu = Fmu::new(scene);
        let instance = fmu.instance();
        instance.start();
        for k in 0..40 {
            assert_eq!(instance.step(f64::from(k) * 0.025, 0.025), OK);
            for variable in &fmu.description.modelVariables {
                let VariableType::Real { min, max, .. } = &variable.variableType else { continue };
                let value = instance.real(&variable.name);
                let (min, max) = (number(min).unwrap_or(f64::MIN), number(max).unwrap_or(f64::MAX));
                assert!((min..=max).contains(&value), "{}: {value}", variable.name);
            }
        }
        for (name, expected) in [
            ("energy.kinetic", (Some(0.0), None)),
            ("energy.strain", (Some(0.0), None)),
            ("energy.impact", (None, None)),
            ("contact[1].gap", (None, None)),
            ("contact[1].restitution", (Some(0.0), Some(1.0))),
            ("contact[2].exponent", (Some(1.0), Some(3.0))),
            ("left.peak_drift[1]", (Some(0.0), None)),
            ("left.mass[1]", (Some(0.0), None)),
            ("solver.relative_tolerance", (Some(1e-15), Some(1e-2))),
        ] {
            let variable = fmu.description.variable_by_name(name).unwrap();
            let VariableType::Real { min, max, .. } = &variable.variableType else { panic!("{name}") };
            assert_eq!((number(min), number(max)), expected, "{name}");
        }
    }
}
