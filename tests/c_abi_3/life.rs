//! The life of an instance, and the standing of its flags in it.

use crate::linked_3::*;
use crate::support::SCENE;

/// Outputs after each of a few steps.
fn run(instance: &Instance<'_>) -> Vec<Vec<u64>> {
    let after = |k| {
        assert_eq!(instance.step(f64::from(k) * 0.05, 0.05).0, OK, "{:?}", instance.log());
        instance.outputs()
    };
    (0..20).map(after).collect()
}

#[test]
fn a_reset_instance_is_a_fresh_one() {
    let fmu = Fmu::new(SCENE);
    let (fresh, used) = (fmu.instance(false, false), fmu.instance(false, false));
    fresh.initialize();
    let expected = run(&fresh);
    assert_eq!(used.set_real("left.mass[1]", 4.0), OK);
    assert_eq!(used.enter(1.0, Some(2.0)), OK);
    used.calls(&[fmi3ExitInitializationMode]);
    assert_eq!(used.set_real("ground.acceleration", 1.0), OK);
    assert_eq!(used.step(1.0, 0.5).0, OK);
    assert_eq!(used.step(1.5, 1.0).0, ERROR, "past the stop time");
    used.calls(&[fmi3Reset]);
    used.initialize();
    assert_eq!(run(&used), expected);
}

#[test]
fn the_flags_outlive_a_reset() {
    let fmu = Fmu::new(SCENE);
    let instance = fmu.instance(true, true);
    for _ in 0..2 {
        instance.start_with_events();
        let (status, stepped) = instance.step(0.0, 1.0);
        assert_eq!((status, stepped.event, stepped.early), (OK, 1, 1));
        instance.calls(&[fmi3Reset]);
    }
    assert_eq!(instance.enter(0.0, None), OK);
    instance.calls(&[fmi3ExitInitializationMode, fmi3Terminate, fmi3Reset]);
}

#[test]
fn after_an_error_values_can_be_read_and_a_state_set() {
    let fmu = Fmu::new(SCENE);
    let instance = fmu.instance(false, false);
    instance.initialize();
    assert_eq!(instance.step(0.0, 0.05).0, OK);
    let (state, outputs) = (instance.recorded(), instance.outputs());
    assert_eq!(instance.step(9.0, 0.05).0, ERROR);
    assert_eq!(instance.outputs(), outputs);
    assert_eq!(instance.set_real("ground.acceleration", 1.0), ERROR);
    assert_eq!(instance.set_state(state), OK);
    assert_eq!(instance.step(0.05, 0.05).0, OK, "{:?}", instance.log());
}

#[test]
fn instances_do_not_know_each_other() {
    let fmu = Fmu::new(SCENE);
    let alone = fmu.instance(false, false);
    alone.initialize();
    let expected = run(&alone);
    let (first, second) = (fmu.instance(false, false), fmu.instance(true, true));
    first.initialize();
    second.start_with_events();
    assert_eq!(second.set_real("ground.acceleration", 3.0), OK);
    assert_eq!(second.step(0.0, 1.0).0, OK);
    assert_eq!(run(&first), expected);
}
