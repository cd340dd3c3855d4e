//! Every output is what the engine says, under the name that the users know.

use crate::support::*;
use fmi::model_description::fmi2::Causality;
use pounding::engine::{BuildingId, ContactPoint, Model, Output, PeakOf, Point, State};
use std::collections::HashMap;

/// Names and values of all outputs and frequencies; counts and Booleans as numbers.
fn expected(model: &Model, state: &State) -> HashMap<String, f64> {
    let mut point = Point::default();
    let now = model.observe(state, &mut point);
    let mut values = HashMap::from([("impacts".to_owned(), now.read(Output::Impacts))]);
    for (side, name) in [(BuildingId::LEFT, "left"), (BuildingId::RIGHT, "right")] {
        let mut add = |quantity: &str, value| values.insert(format!("{name}.{quantity}"), value);
        add("base_shear", now.read(Output::BaseShear(side)));
        add("peak_base_shear", now.read(Output::Peak(PeakOf::BaseShear(side))));
        for floor in 0..model.floors(side) {
            let mut add = |quantity: &str, value| add(&format!("{quantity}[{}]", floor + 1), value);
            add("displacement", now.read(Output::Displacement(side, floor)));
            add("velocity", now.read(Output::Velocity(side, floor)));
            add("acceleration", now.read(Output::Acceleration(side, floor)));
            add("peak_displacement", now.read(Output::Peak(PeakOf::Displacement(side, floor))));
            add("peak_drift", now.read(Output::Peak(PeakOf::Drift(side, floor))));
            add("peak_acceleration", now.read(Output::Peak(PeakOf::Acceleration(side, floor))));
            add("frequency", model.natural_frequencies(side)[floor]);
        }
    }
    for p in 1..=model.contacts() {
        let contact = now.contact(p - 1);
        let ContactPoint { force, penetration, active, impacts, peak_force, impulse, .. } = contact;
        let ContactPoint { dissipated_energy, approach_velocity, .. } = contact;
        for (name, value) in [
            ("force", force),
            ("penetration", penetration),
            ("active", f64::from(active)),
            ("impacts", impacts as f64),
            ("peak_force", peak_force),
            ("impulse", impulse),
            ("dissipated_energy", dissipated_energy),
            ("approach_velocity", approach_velocity),
        ] {
            values.insert(format!("contact[{p}].{name}"), value);
        }
    }
    if let Some(energy) = now.energy() {
        for (name, value) in [
            ("input", energy.input),
            ("kinetic", energy.kinetic),
            ("strain", energy.strain),
            ("viscous", energy.viscous),
            ("impact", energy.impact),
            ("external", energy.external),
            ("residual", energy.residual),
        ] {
            values.insert(format!("energy.{name}"), value);
        }
    }
    values
}

fn found(instance: &Instance<'_>) -> HashMap<String, f64> {
    let variables = instance.fmu.description.modelVariables.iter();
    let computed = variables.filter(|v| matches!(v.causality, Causality::Output | Causality::CalculatedParameter));
    let values = computed.map(|variable| {
        let vr = [variable.valueReference];
        let value = match variable.variableType.name() {
            "Real" => instance.real(&variable.name),
            "Integer" => f64::from(instance.integer(&variable.name)),
            _ => f64::from(instance.booleans(&vr).unwrap()[0]),
        };
        (variable.name.clone(), value)
    });
    values.collect()
}

/// The same steps with the C interface and with the engine; at one of them at least one contact is closed.
fn compare(scene: &str, inputs: &[(&str, f64)], apply: impl Fn(&mut State)) {
    let fmu = Fmu::new(scene);
    let instance = fmu.instance();
    instance.start();
    let model = Model::new(&fmu.package.scene, fmu.package.record.as_ref().map(|packaged| &packaged.record)).unwrap();
    let mut state = model.start(0.0);
    assert!(inputs.iter().all(|(name, value)| instance.set_real(name, *value) == OK));
    apply(&mut state);
    let (mut closed, mut time, step) = (false, 0.0, 0.001);
    for _ in 0..1500 {
        assert_eq!(instance.step(time, step), OK, "{:?}", instance.log());
        time += step;
        model.advance(&mut state, time, &mut |_| ()).unwrap();
        let expected = expected(&model, &state);
        let is_closed = (1..=2).any(|p| expected.get(&format!("contact[{p}].active")) == Some(&1.0));
        if is_closed != closed || time >= 1.5 {
            closed |= is_closed;
            let mut found = found(&instance);
            // The one output that is no quantity of the solution.
            let ground = found.remove("ground.acceleration");
            assert_eq!(found, expected, "at {time} s");
            assert_eq!(ground.is_some(), fmu.package.record.is_some());
        }
    }
    assert!(closed);
}

#[test]
fn under_inputs() {
    compare(SCENE, &[("ground.acceleration", -0.7), ("right.force[2]", -1.5), ("left.force[1]", 2.5)], |state| {
        state.set_ground_acceleration(-0.7);
        state.set_floor_force(BuildingId::RIGHT, 1, -1.5);
        state.set_floor_force(BuildingId::LEFT, 0, 2.5);
    });
}

#[test]
fn under_a_record() {
    compare(RECORD_SCENE, &[], |_| ());
}

#[test]
fn the_ground_acceleration_is_that_of_the_scaled_record() {
    let fmu = Fmu::new(RECORD_SCENE);
    let instance = fmu.instance();
    instance.start();
    let record = &fmu.package.record.as_ref().unwrap().record;
    let factor = 3.0 / record.accelerations.iter().fold(0.0_f64, |peak, a| peak.max(a.abs()));
    // Half way between two samples it is their mean.
    assert_eq!(instance.step(0.0, (record.times[7] + record.times[8]) / 2.0), OK);
    let mean = (record.accelerations[7] + record.accelerations[8]) / 2.0 * factor;
    assert!((instance.real("ground.acceleration") - mean).abs() < 1e-12 * mean.abs());
}
