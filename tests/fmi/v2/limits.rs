//! The limits of the description: inputs beyond them are refused, outputs keep to them.

use crate::support::*;
use fmi::model_description::fmi2::{ScalarVariable, VariableType};
use std::time::{Duration, Instant};

/// Least and largest value of a variable.
fn limits(variable: &ScalarVariable) -> (f64, f64) {
    let (min, max) = match &variable.variableType {
        VariableType::Real { min, max, .. } | VariableType::Integer { min, max, .. } => (min, max),
        _ => (&None, &None),
    };
    let number = |text: &Option<String>, otherwise: f64| text.as_ref().map_or(otherwise, |text| text.parse().unwrap());
    (number(min, f64::NEG_INFINITY), number(max, f64::INFINITY))
}

#[test]
fn inputs_go_up_to_a_hundred_thousand_g() {
    let fmu = Fmu::new(SCENE);
    for (name, most) in [("ground.acceleration", 1e6), ("left.force[1]", 3.65e6), ("right.force[3]", 3.65e6)] {
        assert_eq!(limits(fmu.description.variable_by_name(name).unwrap()), (-most, most), "{name}");
        let instance = fmu.instance();
        // From the beginning on, and as far as the limits go.
        assert_eq!(instance.set_real(name, most), OK);
        instance.start();
        for (k, value) in [-most, most, 0.0].into_iter().enumerate() {
            assert_eq!(instance.set_real(name, value), OK);
            assert_eq!(instance.step(k as f64 * 0.01, 0.01), OK, "{:?}", instance.log());
        }
        for value in [most * 1.000_001, -most * 1.000_001, 1e20, f64::NAN, f64::INFINITY] {
            let instance = fmu.instance();
            instance.start();
            assert_eq!(instance.set_real(name, value), ERROR);
            let message = &instance.log()[0].message;
            let expected = format!("{name} = {value:?}: expected a number from -{most:e} to {most:e}");
            assert!(message.contains(&expected), "{message}");
            assert_eq!(instance.real(name), 0.0);
        }
        let instance = fmu.instance();
        assert_eq!(instance.set_real(name, -1e20), ERROR, "before the initialisation too");
    }
}

#[test]
fn a_line_is_refused_where_it_leads_too_far() {
    let fmu = Fmu::new(SCENE);
    let instance = fmu.instance();
    instance.start();
    let (acceleration, force) = ("ground.acceleration", "left.force[2]");
    assert_eq!(instance.set_rate(acceleration, 1, 1e9), OK, "how far it leads is up to the step");
    assert_eq!(instance.set_rate(force, 1, -1e9), OK);
    assert_eq!(instance.step(0.0, 0.000_5), OK);
    let state = instance.recorded();
    assert_eq!((instance.real(acceleration), instance.real(force)), (5e5, -5e5));
    let clock = Instant::now();
    assert_eq!(instance.step(0.000_5, 1.0), ERROR);
    assert!(clock.elapsed() < Duration::from_secs(5));
    let log: Vec<String> = instance.log().into_iter().map(|line| line.message).collect();
    let end = "at the end of the step, 1.0005 s";
    let expected = "expected a number from";
    assert_eq!(log.len(), 2, "{log:?}");
    assert!(log[0].contains(&format!("{end}, {acceleration} = 1000500000.0: {expected} -1e6 to 1e6")), "{log:?}");
    assert!(log[1].contains(&format!("{end}, {force} = -1000500000.0: {expected} -3.65e6 to 3.65e6")), "{log:?}");
    // A step that leads to where they end, and one with the inputs held.
    assert_eq!(instance.set_state(state), OK);
    assert_eq!(instance.step(0.000_5, 0.000_5), OK, "{:?}", instance.log());
    for name in [acceleration, force] {
        assert_eq!(instance.set_real(name, 0.0), OK);
    }
    assert_eq!(instance.step(0.001, 1.0), OK);
    // Nothing is left of a line that was refused.
    assert_eq!(instance.real(acceleration), 0.0);
}

#[test]
fn outputs_keep_to_their_limits() {
    let mut compressions = 0;
    for law in [
        "law = \"stereomechanical\"\nrestitution = 0.3",
        "law = \"linear\"\nstiffness = 1.0e6",
        "law = \"kelvin_voigt\"\nstiffness = 1.0e6\nrestitution = 0.5",
        "law = \"kelvin_voigt_no_tension\"\nstiffness = 1.0e6\nrestitution = 0.5",
        "law = \"hertz\"\nstiffness = 1.0e6",
        "law = \"jankowski\"\nstiffness = 1.0e6\nrestitution = 0.5",
        "law = \"hertz_damped\"\nstiffness = 1.0e6\nrestitution = 0.5\ndamping_formula = \"exact\"",
    ] {
        let scene = SCENE.replacen("law = \"kelvin_voigt\"\nstiffness = 1.0e6\nrestitution = 0.65", law, 1);
        assert!(scene.contains(law));
        let fmu = Fmu::new(&scene);
        let force = limits(fmu.description.variable_by_name("contact[1].force").unwrap());
        assert_eq!(force.0, if law.contains("\"kelvin_voigt\"") { f64::NEG_INFINITY } else { 0.0 }, "{law}");
        compressions += drive(&fmu.instance());
    }
    assert!(compressions > 500, "{compressions}");
    drive(&Fmu::new(RECORD_SCENE).instance());
}

/// Runs 2 s in short steps and looks at every output; how often the first contact was seen to push.
fn drive(instance: &Instance<'_>) -> usize {
    let (start, step, mut pushes) = (1.0, 1.0 / 4096.0, 0);
    instance.start_at(start, None);
    let variables = &instance.fmu.description.modelVariables;
    let bounded: Vec<_> = variables.iter().filter(|v| limits(v) != (f64::NEG_INFINITY, f64::INFINITY)).collect();
    for k in 0..8192 {
        assert_eq!(instance.step(start + f64::from(k) * step, step), OK, "{:?}", instance.log());
        for variable in &bounded {
            let value = match variable.variableType {
                VariableType::Integer { .. } => f64::from(instance.integer(&variable.name)),
                _ => instance.real(&variable.name),
            };
            let (min, max) = limits(variable);
            assert!((min..=max).contains(&value), "{} = {value:e} at step {k}", variable.name);
        }
        pushes += usize::from(instance.real("contact[1].force") > 0.0);
    }
    pushes
}

#[test]
fn an_overflow_names_its_contact() {
    // The second contact alone begins 1 km deep, on a spring whose force is no number.
    let scene = SCENE
        .replace("gap = 0.002\nlaw = \"hertz\"\nstiffness = 1.0e6", "gap = -1e3\nlaw = \"hertz\"\nstiffness = 1e305");
    assert_ne!(scene, SCENE);
    let fmu = Fmu::new(&scene);
    let instance = fmu.instance();
    instance.start();
    instance.log();
    assert_eq!(instance.step(0.0, 0.1), ERROR);
    let log = instance.log();
    let message = &log.last().unwrap().message;
    let expected = " s at contact[2], whose stiffness is 1e305";
    assert!(message.contains(expected), "{message}");
}
