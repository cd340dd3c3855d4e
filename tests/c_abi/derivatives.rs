//! Derivatives of inputs and outputs with respect to time, and of outputs with respect to inputs.

use crate::support::{ERROR, Fmu, Instance, OK, RECORD_SCENE, SCENE};
use fmi::model_description::fmi2::{Causality, VariableType};
use pounding::engine::{Model, Point, Side};
use std::ffi::{c_int, c_void};
use std::ptr::{null, null_mut};

type Derivatives<T> = unsafe extern "C" fn(*mut c_void, *const u32, usize, *const c_int, T) -> c_int;
type Directional =
    unsafe extern "C" fn(*mut c_void, *const u32, usize, *const u32, usize, *const f64, *mut f64) -> c_int;

fn set_rate(instance: &Instance<'_>, name: &str, order: c_int, rate: f64) -> c_int {
    let set = instance.fmu.symbol::<Derivatives<*const f64>>("fmi2SetRealInputDerivatives");
    // SAFETY: one element each.
    unsafe { set(instance.component, &instance.fmu.vr(name), 1, &raw const order, &raw const rate) }
}

fn rate(instance: &Instance<'_>, name: &str, order: c_int) -> Result<f64, c_int> {
    let (get, mut value) = (instance.fmu.symbol::<Derivatives<*mut f64>>("fmi2GetRealOutputDerivatives"), f64::NAN);
    // SAFETY: one element each.
    let status = unsafe { get(instance.component, &instance.fmu.vr(name), 1, &raw const order, &raw mut value) };
    if status == OK { Ok(value) } else { Err(status) }
}

fn directional(instance: &Instance<'_>, unknowns: &[u32], knowns: &[u32], seed: &[f64]) -> Result<Vec<f64>, c_int> {
    let get = instance.fmu.symbol::<Directional>("fmi2GetDirectionalDerivative");
    let mut values = vec![f64::NAN; unknowns.len()];
    let (nu, nk) = (unknowns.len(), knowns.len());
    // SAFETY: arrays of as many elements as the call says.
    let status = unsafe {
        let (unknowns, knowns) = (unknowns.as_ptr(), knowns.as_ptr());
        get(instance.component, unknowns, nu, knowns, nk, seed.as_ptr(), values.as_mut_ptr())
    };
    if status == OK { Ok(values) } else { Err(status) }
}

/// Names of the variables of a causality that are numbers.
fn reals(fmu: &Fmu, causality: &Causality) -> Vec<String> {
    let variables = fmu.description.modelVariables.iter();
    let reals = variables
        .filter(|v| v.causality == *causality && matches!(v.variableType, VariableType::Real { .. }))
        .map(|v| v.name.clone());
    reals.collect()
}

#[test]
fn an_input_goes_on_as_a_line_until_it_is_set_again() {
    let fmu = Fmu::new(SCENE);
    let instance = fmu.instance();
    let value = || instance.real("left.force[2]");
    // Before the start time is known, the derivative before the value.
    assert_eq!(set_rate(&instance, "left.force[2]", 1, 4.0), OK);
    assert_eq!(instance.set_real("left.force[2]", 1.0), OK);
    assert_eq!(instance.setup(10.0, None), OK);
    assert_eq!(instance.call("fmi2EnterInitializationMode"), OK);
    assert_eq!(value(), 1.0);
    assert_eq!(instance.call("fmi2ExitInitializationMode"), OK);
    for (step, expected) in [(0.25, 2.0), (0.5, 4.0)] {
        let time = 10.0 + (value() - 1.0) / 4.0;
        assert_eq!(instance.step(time, step), OK, "{:?}", instance.log());
        assert_eq!(value(), expected);
    }
    // A new slope alone: on from here.
    assert_eq!(set_rate(&instance, "left.force[2]", 1, -8.0), OK);
    assert_eq!(value(), 4.0);
    assert_eq!(instance.step(10.75, 0.25), OK);
    assert_eq!(value(), 2.0);
    // A new value alone: held.
    assert_eq!(instance.set_real("left.force[2]", 7.0), OK);
    assert_eq!(instance.step(11.0, 0.25), OK);
    assert_eq!(value(), 7.0);
    assert_eq!(instance.call("fmi2Reset"), OK);
    instance.start();
    assert_eq!(instance.step(0.0, 0.25), OK);
    assert_eq!(value(), 0.0);
}

/// What the engine makes of the same lines, whenever they are set before the first step.
#[test]
fn lines_reach_the_engine() {
    let fmu = Fmu::new(SCENE);
    let lines = [("ground.acceleration", 0.5, -3.0), ("left.force[2]", 4.0, 20.0), ("right.force[3]", 0.0, -9.0)];
    let model = Model::new(&fmu.package.scene, None).unwrap();
    let mut state = model.start(0.0);
    state.set_ground_acceleration(0.5);
    state.set_ground_acceleration_rate(-3.0);
    state.set_floor_force(Side::Left, 1, 4.0);
    state.set_floor_force_rate(Side::Left, 1, 20.0);
    state.set_floor_force_rate(Side::Right, 2, -9.0);
    let mut point = Point::default();
    model.advance(&mut state, 0.7, &mut |_| ()).unwrap();
    model.observe(&state, &mut point);
    for phase in 0..4 {
        let instance = fmu.instance();
        let set = |now: usize| {
            for (name, value, slope) in lines.into_iter().filter(|_| now == phase) {
                assert_eq!(instance.set_real(name, value), OK);
                assert_eq!(set_rate(&instance, name, 1, slope), OK);
            }
        };
        set(0);
        instance.enter();
        set(1);
        // From here on there is a run.
        instance.outputs();
        set(2);
        assert_eq!(instance.call("fmi2ExitInitializationMode"), OK);
        set(3);
        assert_eq!(instance.step(0.0, 0.7), OK);
        assert_eq!(instance.real("left.velocity[2]"), model.velocity(&point, Side::Left, 1), "phase {phase}");
        assert_eq!(instance.real("right.acceleration[3]"), model.acceleration(&point, Side::Right, 2));
        assert_eq!(instance.real("contact[1].impulse"), point.contacts[0].impulse);
        assert_eq!(instance.real("ground.acceleration"), 0.5 - 3.0 * 0.7);
    }
}

#[test]
fn derivatives_that_cannot_be_set_are_all_named_and_none_is_taken() {
    let fmu = Fmu::new(SCENE);
    for (name, order, value, expected) in [
        ("left.force[1]", 0, 1.0, "left.force[1]: derivative of order 0: expected order 1"),
        ("left.force[1]", 2, 1.0, "left.force[1]: derivative of order 2: expected order 1"),
        ("ground.acceleration", -1, 1.0, "ground.acceleration: derivative of order -1"),
        ("ground.acceleration", 1, f64::NAN, "ground.acceleration: derivative NaN: expected a finite number"),
        ("ground.acceleration", 1, f64::INFINITY, "ground.acceleration: derivative inf"),
        ("left.displacement[1]", 1, 1.0, "left.displacement[1]: expected an input"),
        ("left.mass[1]", 1, 1.0, "left.mass[1]: expected an input"),
        ("impacts", 1, 1.0, "impacts: expected an input"),
    ] {
        let instance = fmu.instance();
        instance.start();
        assert_eq!(set_rate(&instance, name, order, value), ERROR, "{name}");
        let log = instance.log();
        assert!(log.len() == 1 && log[0].message.contains(expected), "{name}: {log:?}");
    }
    let instance = fmu.instance();
    instance.enter();
    let references = [fmu.vr("left.force[1]"), 9999, fmu.vr("left.force[2]")];
    let set = fmu.symbol::<Derivatives<*const f64>>("fmi2SetRealInputDerivatives");
    let (orders, values) = ([1, 1, 3], [5.0, 1.0, 1.0]);
    // SAFETY: three elements each.
    let status = unsafe { set(instance.component, references.as_ptr(), 3, orders.as_ptr(), values.as_ptr()) };
    assert_eq!((status, instance.log().len()), (ERROR, 2));
}

#[test]
fn arrays_that_are_not_there() {
    let fmu = Fmu::new(SCENE);
    let (vr, order, mut value) = (fmu.vr("ground.acceleration"), 1, 1.0);
    let (vr, order, value) = (&raw const vr, &raw const order, &raw mut value);
    let set = fmu.symbol::<Derivatives<*const f64>>("fmi2SetRealInputDerivatives");
    let get = fmu.symbol::<Derivatives<*mut f64>>("fmi2GetRealOutputDerivatives");
    let direct = fmu.symbol::<Directional>("fmi2GetDirectionalDerivative");
    let with = |call: &dyn Fn(*mut c_void) -> c_int| {
        let instance = fmu.instance();
        instance.start();
        call(instance.component)
    };
    // SAFETY: null, or one element each; null is what is tested.
    unsafe {
        for (vr, order, value) in [(null(), order, value), (vr, null(), value), (vr, order, null_mut())] {
            assert_eq!(with(&|c| set(c, vr, 1, order, value)), ERROR);
            assert_eq!(with(&|c| get(c, vr, 1, order, value)), ERROR);
            assert_eq!(with(&|c| set(c, vr, usize::MAX, order, value)), ERROR);
        }
        assert_eq!(with(&|c| set(c, null(), 0, null(), null())), OK);
        assert_eq!(with(&|c| get(c, null(), 0, null(), null_mut())), OK);
        assert_eq!(with(&|c| direct(c, null(), 0, null(), 0, null(), null_mut())), OK);
        assert_eq!(with(&|c| direct(c, null(), 0, vr, 1, value, null_mut())), OK, "no unknowns");
        assert_eq!(with(&|c| direct(c, null(), 1, vr, 1, value, value)), ERROR);
        assert_eq!(with(&|c| direct(c, null(), 0, null(), 1, value, null_mut())), ERROR);
        assert_eq!(with(&|c| direct(c, null(), 0, vr, 1, null(), null_mut())), ERROR);
        let unknown = fmu.vr("left.displacement[1]");
        assert_eq!(with(&|c| direct(c, &raw const unknown, 1, vr, 1, value, null_mut())), ERROR);
        assert_eq!(with(&|c| direct(c, &raw const unknown, usize::MAX / 2, vr, 1, value, value)), ERROR);
    }
}

/// Differences over a short step against the derivatives at both of its ends.
#[test]
fn output_derivatives_are_what_the_outputs_do_next() {
    for scene in [SCENE, RECORD_SCENE] {
        let fmu = Fmu::new(scene);
        let instance = fmu.instance();
        instance.start();
        let (h, mut time, mut compared, mut closed) = (1e-6, 0.0_f64, 0, 0);
        let names = reals(&fmu, &Causality::Output);
        let is_smooth = |name: &String| {
            let past = ["peak", "approach", "energy."].iter().any(|part| name.contains(part));
            !past || name.contains("dissipated")
        };
        let contacts = (1..=2).filter(|p| fmu.description.variable_by_name(&format!("contact[{p}].force")).is_ok());
        let contacts: Vec<_> = contacts.collect();
        let count = || contacts.iter().map(|p| instance.integer(&format!("contact[{p}].impacts"))).sum::<i32>();
        let active = || {
            let active = |p: &i32| instance.get::<i32>("fmi2GetBoolean", &[fmu.vr(&format!("contact[{p}].active"))]);
            contacts.iter().map(|p| active(p).unwrap()[0]).collect::<Vec<_>>()
        };
        while time < 0.6 {
            if scene == SCENE {
                for (name, factor) in [("ground.acceleration", 3.0), ("left.force[1]", 5.0), ("right.force[3]", -4.0)] {
                    assert_eq!(instance.set_real(name, factor * (9.0 * time).sin()), OK);
                    assert_eq!(set_rate(&instance, name, 1, factor * 9.0 * (9.0 * time).cos()), OK);
                }
            }
            let shown = || names.iter().map(|name| instance.real(name)).collect::<Vec<_>>();
            let rates = |order| {
                let rate = |name: &String| if is_smooth(name) { rate(&instance, name, order).unwrap() } else { 0.0 };
                names.iter().map(rate).collect::<Vec<_>>()
            };
            let (before, first, second, state) = (shown(), rates(1), rates(2), (active(), count()));
            assert_eq!(instance.step(time, h), OK);
            let (after, first_after, second_after) = (shown(), rates(1), rates(2));
            // At a sample of the record the ground's motion has a corner.
            let is_corner = ((time / 0.02).round() * 0.02 - time).abs() < 2.0 * h;
            if !is_corner && state == (active(), count()) {
                for i in (0..names.len()).filter(|&i| is_smooth(&names[i])) {
                    // The trapezoidal rule with the end slopes' own slopes: off by h^5.
                    let slope = 0.5 * (first[i] + first_after[i]) + h / 12.0 * (second[i] - second_after[i]);
                    let noise = 1e-15 * (before[i].abs() + after[i].abs()) / h;
                    let error = ((after[i] - before[i]) / h - slope).abs();
                    let size = first[i].abs().max(first_after[i].abs()).max(h * second[i].abs());
                    assert!(error <= 1e-6 * size + 100.0 * noise + 1e-6, "{} at {time}: {error:e}", names[i]);
                    let bend = (first_after[i] - first[i]) / h;
                    let size = second[i].abs().max(second_after[i].abs());
                    let noise = 1e-15 * first[i].abs().max(first_after[i].abs()) / h;
                    let error = (bend - 0.5 * (second[i] + second_after[i])).abs();
                    assert!(
                        error <= 1e-4 * size + 1000.0 * noise + 1e-3,
                        "{} at {time}: {error:e} of {size}",
                        names[i]
                    );
                    compared += 1;
                }
                closed += i32::from(state.0.contains(&1));
            }
            let next = time + 0.0007;
            assert_eq!(instance.step(time + h, next - (time + h)), OK);
            time = next;
        }
        assert!(compared > 5000 && closed > 10, "{compared} comparisons, {closed} of them in contact");
    }
}

#[test]
fn derivatives_that_are_other_outputs() {
    let fmu = Fmu::new(SCENE);
    let instance = fmu.instance();
    instance.start();
    for (name, value) in [("ground.acceleration", 1.3), ("right.force[2]", -2.0)] {
        assert_eq!(instance.set_real(name, value), OK);
    }
    let mut closed = false;
    for k in 0..200 {
        assert_eq!(instance.step(f64::from(k) * 0.003, 0.003), OK);
        for (side, floors) in [("left", 2), ("right", 3)] {
            for i in 1..=floors {
                let of = |quantity: &str| format!("{side}.{quantity}[{i}]");
                assert_eq!(rate(&instance, &of("displacement"), 1), Ok(instance.real(&of("velocity"))));
                let relative = instance.real(&of("acceleration")) - 1.3;
                for (quantity, order) in [("displacement", 2), ("velocity", 1)] {
                    let found = rate(&instance, &of(quantity), order).unwrap();
                    assert!((found - relative).abs() < 1e-11 * relative.abs().max(10.0), "{found} and {relative}");
                }
            }
        }
        for p in 1..=2 {
            let of = |quantity: &str| format!("contact[{p}].{quantity}");
            let force = instance.real(&of("force"));
            assert_eq!(rate(&instance, &of("impulse"), 1), Ok(force));
            assert_eq!(rate(&instance, &of("impulse"), 2), rate(&instance, &of("force"), 1));
            let closing = rate(&instance, &of("penetration"), 1).unwrap();
            let facing = instance.real(&format!("left.velocity[{p}]")) - instance.real(&format!("right.velocity[{p}]"));
            assert!((closing - facing).abs() < 1e-12, "{closing} and {facing}");
            assert_eq!(rate(&instance, &of("dissipated_energy"), 1), Ok(force * closing));
            closed |= force != 0.0;
        }
    }
    assert!(closed);
}

#[test]
fn output_derivatives_that_there_are_not() {
    let fmu = Fmu::new(SCENE);
    for (name, order, expected) in [
        ("left.displacement[1]", 0, "derivative of order 0: expected order 1 to 2"),
        ("left.displacement[1]", 3, "derivative of order 3: expected order 1 to 2"),
        ("left.displacement[1]", c_int::MIN, "expected order 1 to 2"),
        ("left.peak_drift[1]", 1, "left.peak_drift[1]: no derivative"),
        ("contact[1].peak_force", 1, "contact[1].peak_force: no derivative"),
        ("energy.kinetic", 1, "energy.kinetic: no derivative"),
        ("impacts", 1, "impacts (value reference"),
        ("contact[1].active", 1, "is Boolean, not Real"),
        ("left.mass[1]", 1, "left.mass[1]: expected an output"),
        ("left.force[1]", 1, "left.force[1]: expected an output"),
    ] {
        let instance = fmu.instance();
        instance.start();
        assert_eq!(rate(&instance, name, order), Err(ERROR), "{name}");
        let log = instance.log();
        assert!(log.len() == 1 && log[0].message.contains(expected), "{name}: {log:?}");
    }
}

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
    let (outputs, inputs) = (reals(fmu, &Causality::Output), reals(fmu, &Causality::Input));
    let unknowns: Vec<u32> = outputs.iter().map(|name| fmu.vr(name)).collect();
    let shown = || instance.get::<f64>("fmi2GetReal", &unknowns).unwrap();
    let variable = |index: u32| fmu.description.variable_by_index(index).unwrap().name.as_str();
    let depends = |output: &str, input: &str| {
        let unknown = fmu.description.outputs.iter().find(|unknown| variable(unknown.index) == output).unwrap();
        unknown.dependencies.as_ref().unwrap().iter().any(|known| variable(*known) == input)
    };
    let mut answering = 0;
    for input in &inputs {
        let derivatives = directional(instance, &unknowns, &[fmu.vr(input)], &[1.0]).unwrap();
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
    let fmu = Fmu::new(SCENE);
    let instance = fmu.instance();
    instance.enter();
    assert_eq!(compare_partial(&instance), 5, "one acceleration by each force");
    assert_eq!(instance.call("fmi2ExitInitializationMode"), OK);
    for k in 0..60 {
        assert_eq!(instance.step(f64::from(k) * 0.01, 0.01), OK);
        assert_eq!(compare_partial(&instance), 5);
    }
}

#[test]
fn rigid_floors_answer_together() {
    let fmu = Fmu::new(RIGID);
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

#[test]
fn seeds_add_up() {
    let fmu = Fmu::new(SCENE);
    let instance = fmu.instance();
    instance.start();
    let vr = |names: &[&str]| names.iter().map(|name| fmu.vr(name)).collect::<Vec<_>>();
    let unknowns = vr(&["right.acceleration[3]", "left.acceleration[1]", "left.velocity[1]", "right.acceleration[3]"]);
    let knowns = vr(&["right.force[3]", "left.force[1]", "ground.acceleration", "right.force[3]"]);
    let found = directional(&instance, &unknowns, &knowns, &[7.3, -3.65, 100.0, 3.65]).unwrap();
    let expected = [3.0, -1.0, 0.0, 3.0];
    assert!(found.iter().zip(expected).all(|(found, expected)| (found - expected).abs() < 1e-15), "{found:?}");
    assert_eq!(directional(&instance, &unknowns, &[], &[]), Ok(vec![0.0; 4]));
}

#[test]
fn initial_unknowns_follow_parameters() {
    let fmu = Fmu::new(SCENE);
    let instance = fmu.instance();
    instance.enter();
    let derivative = |unknown: &str, known: &str| directional(&instance, &[fmu.vr(unknown)], &[fmu.vr(known)], &[1.0]);
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

#[test]
fn unknowns_and_knowns_that_are_none() {
    let fmu = Fmu::new(SCENE);
    for (in_initialization, unknown, known, seed, expected) in [
        (false, "left.force[1]", "left.force[1]", 1.0, "unknown left.force[1]: expected an output of type Real"),
        (false, "impacts", "left.force[1]", 1.0, "unknown impacts: expected an output of type Real"),
        (false, "left.frequency[1]", "left.force[1]", 1.0, "unknown left.frequency[1]"),
        (false, "left.velocity[1]", "left.mass[1]", 1.0, "known left.mass[1]: expected an input"),
        (false, "left.velocity[1]", "left.velocity[1]", 1.0, "known left.velocity[1]: expected an input"),
        (false, "left.velocity[1]", "left.force[1]", f64::NAN, "left.force[1]: seed NaN: expected a finite number"),
        (true, "left.velocity[1]", "left.velocity[1]", 1.0, "known left.velocity[1]: expected an input or a parameter"),
        (
            true,
            "left.mass[1]",
            "left.force[1]",
            1.0,
            "unknown left.mass[1]: expected an output or a calculated parameter",
        ),
        (true, "left.base_shear", "left.stiffness[1]", 1.0, "left.base_shear with respect to left.stiffness[1]: no"),
    ] {
        let instance = fmu.instance();
        instance.enter();
        if !in_initialization {
            assert_eq!(instance.call("fmi2ExitInitializationMode"), OK);
        }
        assert_eq!(directional(&instance, &[fmu.vr(unknown)], &[fmu.vr(known)], &[seed]), Err(ERROR), "{unknown}");
        let log = instance.log();
        assert!(log.len() == 1 && log[0].message.contains(expected), "{unknown}: {log:?}");
    }
    let instance = fmu.instance();
    instance.start();
    assert_eq!(directional(&instance, &[9999], &[8888], &[1.0]), Err(ERROR));
    assert_eq!(instance.log().len(), 2);
}
