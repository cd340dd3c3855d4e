//! Derivatives of inputs and outputs with respect to time.

use crate::support::{DISCARD, ERROR, Fmu, Instance, OK, RECORD_SCENE, SCENE, YIELDING};
use fmi::model_description::fmi2::{Causality, VariableType};
use pounding::engine::{Model, Output, Point, Side};
use std::ffi::{c_int, c_void};
use std::ptr::{null, null_mut};

type Derivatives<T> = unsafe extern "C" fn(*mut c_void, *const u32, usize, *const c_int, T) -> c_int;
pub type Directional =
    unsafe extern "C" fn(*mut c_void, *const u32, usize, *const u32, usize, *const f64, *mut f64) -> c_int;

/// Sets a derivative of an input.
pub fn set_rate(instance: &Instance<'_>, name: &str, order: c_int, rate: f64) -> c_int {
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

/// Names of the variables of a causality that are numbers.
pub fn reals(fmu: &Fmu, causality: &Causality) -> Vec<String> {
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
    let now = model.observe(&state, &mut point);
    for phase in 0..4 {
        let instance = fmu.instance();
        let set = |phase_now: usize| {
            for (name, value, slope) in lines.into_iter().filter(|_| phase_now == phase) {
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
        assert_eq!(instance.real("left.velocity[2]"), now.read(Output::Velocity(Side::Left, 1)), "phase {phase}");
        assert_eq!(instance.real("right.acceleration[3]"), now.read(Output::Acceleration(Side::Right, 2)));
        assert_eq!(instance.real("contact[1].impulse"), now.contact(0).impulse);
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
    for scene in [SCENE, RECORD_SCENE, YIELDING] {
        let fmu = Fmu::new(scene);
        let instance = fmu.instance();
        instance.start();
        let (h, mut time, mut compared, mut closed, mut grown, mut yielded) = (1e-6, 0.0_f64, 0, 0, 0, 0);
        let names = reals(&fmu, &Causality::Output);
        let is_smooth = |name: &String| !name.contains("residual");
        let contacts = (1..=2).filter(|p| fmu.description.variable_by_name(&format!("contact[{p}].force")).is_ok());
        let contacts: Vec<_> = contacts.collect();
        let count = || contacts.iter().map(|p| instance.integer(&format!("contact[{p}].impacts"))).sum::<i32>();
        let active = || {
            let active = |p: &i32| instance.get::<i32>("fmi2GetBoolean", &[fmu.vr(&format!("contact[{p}].active"))]);
            contacts.iter().map(|p| active(p).unwrap()[0]).collect::<Vec<_>>()
        };
        let yielding = fmu.description.modelVariables.iter().filter(|v| v.name.contains(".yielding["));
        let yielding = yielding.map(|v| v.name.as_str()).collect::<Vec<_>>();
        let senses = || yielding.iter().map(|name| instance.integer(name)).collect::<Vec<_>>();
        while time < 0.6 {
            if scene != RECORD_SCENE {
                let last = format!("right.force[{}]", if scene == SCENE { 3 } else { 2 });
                for (name, factor) in [("ground.acceleration", 3.0), ("left.force[1]", 5.0), (last.as_str(), -4.0)] {
                    assert_eq!(instance.set_real(name, factor * (9.0 * time).sin()), OK);
                    assert_eq!(set_rate(&instance, name, 1, factor * 9.0 * (9.0 * time).cos()), OK);
                }
            }
            let shown = || names.iter().map(|name| instance.real(name)).collect::<Vec<_>>();
            let rates = |order| {
                let rate = |name: &String| if is_smooth(name) { rate(&instance, name, order).unwrap() } else { 0.0 };
                names.iter().map(rate).collect::<Vec<_>>()
            };
            let (before, first, second, state) = (shown(), rates(1), rates(2), (active(), count(), senses()));
            assert_eq!(instance.step(time, h), OK);
            let (after, first_after, second_after) = (shown(), rates(1), rates(2));
            // At a sample of the record the ground's motion has a corner.
            let is_corner = ((time / 0.02).round() * 0.02 - time).abs() < 2.0 * h;
            if !is_corner && state == (active(), count(), senses()) {
                // A peak that begins to grow, or ends, within the step has a corner there.
                let grows = |i: usize| first[i] != 0.0 && first_after[i] != 0.0;
                // An acceleration jumps with a force that is set.
                let jumps = |i: usize| scene != RECORD_SCENE && names[i].contains("peak_acceleration");
                let is_peak = |i: usize| names[i].contains("t.peak_") || names[i].contains(".ductility");
                let has_corner = |i: usize| is_peak(i) && !grows(i) || jumps(i);
                grown += (0..names.len()).filter(|&i| is_peak(i) && grows(i)).count();
                for i in (0..names.len()).filter(|&i| is_smooth(&names[i]) && !has_corner(i)) {
                    // The trapezoidal rule with the end slopes' own slopes: off by h^5.
                    let slope = 0.5 * (first[i] + first_after[i]) + h / 12.0 * (second[i] - second_after[i]);
                    let noise = 1e-15 * (before[i].abs() + after[i].abs()) / h;
                    let error = ((after[i] - before[i]) / h - slope).abs();
                    let size = first[i].abs().max(first_after[i].abs()).max(h * second[i].abs());
                    assert!(
                        error <= 1e-6 * size + 100.0 * noise + 1e-6,
                        "{} at {time}: {error:e} {} {} {:?} {:?} {:?}",
                        names[i],
                        before[i],
                        after[i],
                        first[i],
                        first_after[i],
                        state
                    );
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
                yielded += i32::from(state.2.iter().any(|sense| *sense != 0));
            }
            let next = time + 0.0007;
            assert_eq!(instance.step(time + h, next - (time + h)), OK);
            time = next;
        }
        assert!(compared > 5000 && closed > 10, "{compared} comparisons, {closed} of them in contact");
        assert!(grown > 300, "{grown} peaks that grow");
        assert!(scene != YIELDING || yielded > 100, "storeys yield at {yielded} times");
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
            assert_eq!(rate(&instance, &of("approach_velocity"), 1), Ok(0.0));
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
        ("impacts", 1, "impacts (value reference"),
        ("contact[1].active", 1, "is Boolean, not Real"),
        ("left.mass[1]", 1, "left.mass[1]: expected an output"),
        ("left.force[1]", 1, "left.force[1]: expected an output"),
    ] {
        let instance = fmu.instance();
        instance.start();
        assert_eq!(rate(&instance, name, order), Err(DISCARD), "{name}");
        let log = instance.log();
        assert!(log.len() == 1 && log[0].message.contains(expected), "{name}: {log:?}");
        assert_eq!((log[0].category.as_str(), instance.step(0.0, 0.1)), ("logStatusDiscard", OK));
    }
}
