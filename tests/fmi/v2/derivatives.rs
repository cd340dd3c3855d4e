//! Derivatives of inputs with respect to time, which FMI 2.0 has alone, and those of outputs along runs with them.

use crate::support::*;
use fmi::model_description::fmi2::Causality;
use pounding::engine::{BuildingId, Model, Output, Point};

#[test]
fn an_input_goes_on_as_a_line_until_it_is_set_again() {
    let fmu = Fmu::new(SCENE);
    let instance = fmu.instance();
    let value = || instance.real("left.force[2]");
    // Before the start time is known, the derivative before the value.
    assert_eq!(instance.set_rate("left.force[2]", 1, 4.0), OK);
    assert_eq!(instance.set_real("left.force[2]", 1.0), OK);
    assert_eq!(instance.enter_from(10.0, None), OK);
    assert_eq!(value(), 1.0);
    assert_eq!(instance.exit(), OK);
    for (step, expected) in [(0.25, 2.0), (0.5, 4.0)] {
        let time = 10.0 + (value() - 1.0) / 4.0;
        assert_eq!(instance.step(time, step), OK, "{:?}", instance.log());
        assert_eq!(value(), expected);
    }
    // A new slope alone: on from here.
    assert_eq!(instance.set_rate("left.force[2]", 1, -8.0), OK);
    assert_eq!(value(), 4.0);
    assert_eq!(instance.step(10.75, 0.25), OK);
    assert_eq!(value(), 2.0);
    // A new value alone: held.
    assert_eq!(instance.set_real("left.force[2]", 7.0), OK);
    assert_eq!(instance.step(11.0, 0.25), OK);
    assert_eq!(value(), 7.0);
    assert_eq!(instance.reset(), OK);
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
    state.set_floor_force(BuildingId::LEFT, 1, 4.0);
    state.set_floor_force_rate(BuildingId::LEFT, 1, 20.0);
    state.set_floor_force_rate(BuildingId::RIGHT, 2, -9.0);
    let mut point = Point::default();
    model.advance(&mut state, 0.7, &mut |_| ()).unwrap();
    let now = model.observe(&state, &mut point);
    for phase in 0..4 {
        let instance = fmu.instance();
        let set = |phase_now: usize| {
            for (name, value, slope) in lines.into_iter().filter(|_| phase_now == phase) {
                assert_eq!(instance.set_real(name, value), OK);
                assert_eq!(instance.set_rate(name, 1, slope), OK);
            }
        };
        set(0);
        instance.enter();
        set(1);
        // From here on there is a run.
        instance.outputs();
        set(2);
        assert_eq!(instance.exit(), OK);
        set(3);
        assert_eq!(instance.step(0.0, 0.7), OK);
        assert_eq!(instance.real("left.velocity[2]"), now.read(Output::Velocity(BuildingId::LEFT, 1)), "phase {phase}");
        assert_eq!(instance.real("right.acceleration[3]"), now.read(Output::Acceleration(BuildingId::RIGHT, 2)));
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
        assert_eq!(instance.set_rate(name, order, value), ERROR, "{name}");
        let log = instance.log();
        assert!(log.len() == 1 && log[0].message.contains(expected), "{name}: {log:?}");
    }
    let instance = fmu.instance();
    instance.enter();
    let references = [fmu.vr("left.force[1]"), 9999, fmu.vr("left.force[2]")];
    let (vr, orders, values) = (references.as_ptr(), [1, 1, 3], [5.0, 1.0, 1.0]);
    // SAFETY: three elements each.
    let status = unsafe { fmi2SetRealInputDerivatives(instance.component, vr, 3, orders.as_ptr(), values.as_ptr()) };
    assert_eq!((status, instance.log().len()), (ERROR, 2));
}

/// Differences over a short step against the derivatives at both of its ends.
#[test]
fn output_derivatives_are_what_the_outputs_do_next() {
    for scene in [SCENE, RECORD_SCENE, YIELDING] {
        let fmu = Fmu::new(scene);
        let instance = fmu.instance();
        instance.start();
        let (h, mut time, mut compared, mut closed, mut grown, mut yielded) = (1e-6, 0.0_f64, 0, 0, 0, 0);
        let names = fmu.reals(&Causality::Output);
        let is_smooth = |name: &String| !name.contains("residual");
        let contacts = (1..=2).filter(|p| fmu.description.variable_by_name(&format!("contact[{p}].force")).is_ok());
        let contacts: Vec<_> = contacts.collect();
        let count = || contacts.iter().map(|p| instance.integer(&format!("contact[{p}].impacts"))).sum::<i32>();
        let active = || contacts.iter().map(|p| instance.boolean(&format!("contact[{p}].active"))).collect::<Vec<_>>();
        let yielding = fmu.description.modelVariables.iter().filter(|v| v.name.contains(".yielding["));
        let yielding = yielding.map(|v| v.name.as_str()).collect::<Vec<_>>();
        let senses = || yielding.iter().map(|name| instance.integer(name)).collect::<Vec<_>>();
        while time < 0.6 {
            if scene != RECORD_SCENE {
                let last = format!("right.force[{}]", if scene == SCENE { 3 } else { 2 });
                for (name, factor) in [("ground.acceleration", 3.0), ("left.force[1]", 5.0), (last.as_str(), -4.0)] {
                    assert_eq!(instance.set_real(name, factor * (9.0 * time).sin()), OK);
                    assert_eq!(instance.set_rate(name, 1, factor * 9.0 * (9.0 * time).cos()), OK);
                }
            }
            let shown = || names.iter().map(|name| instance.real(name)).collect::<Vec<_>>();
            let rates = |order| {
                let rate = |name: &String| if is_smooth(name) { instance.rate(name, order).unwrap() } else { 0.0 };
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
