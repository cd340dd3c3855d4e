//! Derivatives of outputs with respect to inputs, and of initial unknowns with respect to parameters.

use crate::support::*;
use fmi::model_description::fmi2::Causality;

/// Three rigid pairs: both floors of the left building against both of the right one, but for one.
const RIGID: &str = r#"
name = "Rigid"
[left]
mass = [3.0, 2.0]
stiffness = [400.0, 300.0]
damping = { ratio = 0.05 }
[right]
mass = [4.0, 2.5]
stiffness = [500.0, 250.0]
damping = { ratio = 0.05 }
[inputs]
floor_forces = true
[[contact]]
left_floor = 1
right_floor = 1
gap = 0.0
law = "stereomechanical"
restitution = 0.2
[[contact]]
left_floor = 2
right_floor = 2
gap = 0.0
law = "stereomechanical"
restitution = 0.2
[[contact]]
left_floor = 1
right_floor = 2
gap = 0.0
law = "stereomechanical"
restitution = 0.2
"#;

/// All partial derivatives against differences of what is read after an input has been changed; none where the
/// description says that there is no dependency. Returns how many are not 0.
fn compare_partial(instance: &Instance<'_>) -> usize {
    let fmu = instance.fmu;
    let (outputs, inputs) = (fmu.reals(&Causality::Output), fmu.reals(&Causality::Input));
    let unknowns: Vec<u32> = outputs.iter().map(|name| fmu.vr(name)).collect();
    let shown = || instance.reals(&unknowns).unwrap();
    let variable = |index: u32| fmu.description.variable_by_index(index).unwrap().name.as_str();
    let depends = |output: &str, input: &str| {
        let unknown = fmu.description.outputs.iter().find(|unknown| variable(unknown.index) == output).unwrap();
        unknown.dependencies.as_ref().unwrap().iter().any(|known| variable(*known) == input)
    };
    let mut answering = 0;
    for input in &inputs {
        let derivatives = instance.directional(&unknowns, &[fmu.vr(input)], &[1.0]).unwrap();
        let (value, change) = (instance.real(input), 0.125);
        assert_eq!(instance.set_real(input, value + change), OK);
        let above = shown();
        assert_eq!(instance.set_real(input, value - change), OK);
        let below = shown();
        assert_eq!(instance.set_real(input, value), OK);
        for (i, output) in outputs.iter().enumerate() {
            let difference = (above[i] - below[i]) / (2.0 * change);
            let error = (derivatives[i] - difference).abs();
            let noise = 1e-13 * (1.0 + above[i].abs());
            assert!(error < noise, "{output} by {input}: {} instead of {difference}", derivatives[i]);
            answering += usize::from(derivatives[i] != 0.0);
            assert!(derivatives[i] == 0.0 || depends(output, input), "{output} by {input} is not in the description");
        }
    }
    answering
}

#[test]
fn directional_derivatives_are_those_of_what_answers_at_once() {
    for fmu in Fmu::both(SCENE) {
        let instance = fmu.instance();
        instance.enter();
        assert_eq!(compare_partial(&instance), 5, "one acceleration by each force");
        assert_eq!(instance.exit(), OK);
        for k in 0..60 {
            assert_eq!(instance.step(f64::from(k) * 0.01, 0.01), OK);
            assert_eq!(compare_partial(&instance), 5);
        }
    }
}

#[test]
fn rigid_floors_answer_together() {
    for fmu in Fmu::both(RIGID) {
        let instance = fmu.instance();
        instance.start();
        // Presses the first pair alone, then others too.
        let mut seen = std::collections::BTreeSet::new();
        for (k, (lower, upper)) in
            [(30.0, 0.0), (30.0, 30.0), (0.0, 40.0), (60.0, -10.0), (-30.0, -30.0)].iter().enumerate()
        {
            assert_eq!(instance.set_real("left.force[1]", *lower), OK);
            assert_eq!(instance.set_real("left.force[2]", *upper), OK);
            for n in 0..400 {
                let time = (400 * k + n) as f64 * 0.005;
                assert_eq!(instance.step(time, 0.005), OK, "{:?}", instance.log());
                let forces = [1, 2, 3].map(|p| instance.real(&format!("contact[{p}].force")));
                // Where a reaction is near 0 a difference passes it.
                if forces.iter().all(|force| *force == 0.0 || *force > 0.5) {
                    let pressing = forces.iter().filter(|force| **force > 0.0).count();
                    let answering = compare_partial(&instance);
                    assert!(answering > 4 || pressing == 0, "{answering}");
                    seen.insert(pressing);
                }
            }
        }
        assert!(seen.len() > 2, "numbers of pairs that press: {seen:?}");
        // Pressed together, then pulled apart from now on: the pairs are open before the next step has found it.
        for force in [30.0, -60.0] {
            for floor in ["left.force[1]", "left.force[2]"] {
                assert_eq!(instance.set_real(floor, force), OK);
            }
            if force > 0.0 {
                for n in 0..200 {
                    assert_eq!(instance.step(f64::from(n) * 0.005 + 10.0, 0.005), OK, "{:?}", instance.log());
                }
                assert!(compare_partial(&instance) > 4);
            }
        }
        assert_eq!([1, 2, 3].map(|p| instance.real(&format!("contact[{p}].force"))), [0.0; 3]);
        assert_eq!(compare_partial(&instance), 4);
    }
}

/// Corrections accelerate both floors of their storey or its foundation, and shears are less by them; on soil and with
/// a matrix.
#[test]
fn corrections_answer_at_once() {
    for fmu in Fmu::both(CORRECTED) {
        let instance = fmu.instance();
        instance.enter();
        // Of four floors by forces, of the left ones by 3 corrections, of their foundation and shears by 1, 1 and 2, of
        // the right ones and their base shear by 2 and 2.
        let expected = 4 + (3 + 1 + 1 + 2) + (2 + 2);
        assert_eq!(compare_partial(&instance), expected);
        assert_eq!(instance.exit(), OK);
        for k in 0..60 {
            assert_eq!(instance.set_real("left.storey_correction[2]", f64::from(k % 7)), OK);
            assert_eq!(instance.step(f64::from(k) * 0.01, 0.01), OK);
            assert_eq!(compare_partial(&instance), expected);
        }
        assert!(instance.integer("impacts") > 0);
    }
}

/// Through floors that are held together a correction reaches the other building.
#[test]
fn corrections_push_rigid_floors_together() {
    for fmu in Fmu::both(&RIGID.replace("[inputs]\n", "[inputs]\nrestoring_corrections = true\n")) {
        let instance = fmu.instance();
        instance.start();
        assert_eq!(instance.set_real("left.storey_correction[1]", 30.0), OK);
        let mut pressing = 0;
        for n in 0..400 {
            assert_eq!(instance.step(f64::from(n) * 0.005, 0.005), OK, "{:?}", instance.log());
            let forces = [1, 2, 3].map(|p| instance.real(&format!("contact[{p}].force")));
            if forces.iter().all(|force| *force == 0.0 || *force > 0.5) {
                compare_partial(&instance);
                pressing += usize::from(forces[0] > 0.0 || forces[2] > 0.0);
            }
        }
        assert!(pressing > 20, "{pressing}");
    }
}

#[test]
fn seeds_add_up() {
    for fmu in Fmu::both(SCENE) {
        let instance = fmu.instance();
        instance.start();
        let vr = |names: &[&str]| names.iter().map(|name| fmu.vr(name)).collect::<Vec<_>>();
        let unknowns =
            vr(&["right.acceleration[3]", "left.acceleration[1]", "left.velocity[1]", "right.acceleration[3]"]);
        let knowns = vr(&["right.force[3]", "left.force[1]", "ground.acceleration", "right.force[3]"]);
        let found = instance.directional(&unknowns, &knowns, &[7.3, -3.65, 100.0, 3.65]).unwrap();
        let expected = [3.0, -1.0, 0.0, 3.0];
        assert!(found.iter().zip(expected).all(|(found, expected)| (found - expected).abs() < 1e-15), "{found:?}");
        assert_eq!(instance.directional(&unknowns, &[], &[]), Ok(vec![0.0; 4]));
    }
}

#[test]
fn initial_unknowns_follow_parameters() {
    for fmu in Fmu::both(SCENE) {
        let instance = fmu.instance();
        instance.enter();
        let derivative =
            |unknown: &str, known: &str| instance.directional(&[fmu.vr(unknown)], &[fmu.vr(known)], &[1.0]);
        for side in ["left", "right"] {
            for mode in 1..=2 {
                for parameter in ["left.mass[1]", "left.mass[2]", "left.stiffness[1]", "left.stiffness[2]"] {
                    let unknown = format!("{side}.frequency[{mode}]");
                    let found = derivative(&unknown, parameter).unwrap()[0];
                    let value = instance.real(parameter);
                    let at = |value: f64| {
                        assert_eq!(instance.set_real(parameter, value), OK);
                        instance.real(&unknown)
                    };
                    let h = 1e-3 * value;
                    let difference =
                        (8.0 * (at(value + h) - at(value - h)) - at(value + 2.0 * h) + at(value - 2.0 * h)) / 12.0 / h;
                    at(value);
                    assert!(
                        (found - difference).abs() <= 1e-9 * found.abs(),
                        "{unknown} by {parameter}: {found} {difference}"
                    );
                    assert_eq!(found != 0.0, side == "left");
                }
            }
        }
        assert_eq!(derivative("contact[2].penetration", "contact[2].gap"), Ok(vec![-1.0]));
        assert_eq!(derivative("contact[2].penetration", "contact[1].gap"), Ok(vec![0.0]));
        assert_eq!(derivative("left.displacement[1]", "left.mass[1]"), Ok(vec![0.0]));
    }
}

/// A question without an answer is discarded with a message; the run is that of an instance that nobody has asked.
#[test]
fn unknowns_and_knowns_that_are_none() {
    for fmu in Fmu::both(SCENE) {
        let unasked = fmu.instance();
        unasked.start();
        let reference = unasked.run(0.0, 0.1, 8);
        for (in_initialization, unknown, known, seed, expected) in [
            (
                false,
                "left.force[1]",
                "left.force[1]",
                1.0,
                fmu.either(
                    "unknown left.force[1]: expected an output of type Real",
                    "unknown left.force[1]: expected an output of type Float64",
                ),
            ),
            (
                false,
                "impacts",
                "left.force[1]",
                1.0,
                fmu.either(
                    "unknown impacts: expected an output of type Real",
                    "unknown impacts: expected an output of type Float64",
                ),
            ),
            (false, "left.frequency[1]", "left.force[1]", 1.0, "unknown left.frequency[1]"),
            (false, "left.velocity[1]", "left.mass[1]", 1.0, "known left.mass[1]: expected an input"),
            (false, "left.velocity[1]", "left.velocity[1]", 1.0, "known left.velocity[1]: expected an input"),
            (false, "left.velocity[1]", "left.force[1]", f64::NAN, "left.force[1]: seed NaN: expected a finite number"),
            (
                true,
                "left.velocity[1]",
                "left.velocity[1]",
                1.0,
                "known left.velocity[1]: expected an input or a parameter",
            ),
            (
                true,
                "left.mass[1]",
                "left.force[1]",
                1.0,
                "unknown left.mass[1]: expected an output or a calculated parameter",
            ),
            (
                true,
                "left.base_shear",
                "left.stiffness[1]",
                1.0,
                "left.base_shear with respect to left.stiffness[1]: no",
            ),
        ] {
            let instance = fmu.instance();
            instance.enter();
            if !in_initialization {
                assert_eq!(instance.exit(), OK);
            }
            assert_eq!(instance.directional(&[fmu.vr(unknown)], &[fmu.vr(known)], &[seed]), Err(DISCARD), "{unknown}");
            let log = instance.log();
            assert!(log.len() == 1 && log[0].message.contains(expected), "{unknown}: {log:?}");
            assert_eq!(log[0].category, "logStatusDiscard");
            if in_initialization {
                assert_eq!(instance.exit(), OK);
            }
            assert!(instance.run(0.0, 0.1, 8) == reference, "{unknown}: another run");
        }
        let instance = fmu.instance();
        instance.start();
        assert_eq!(instance.directional(&[9999], &[8888], &[1.0]), Err(DISCARD));
        assert_eq!(instance.log().len(), 2);
    }
}
