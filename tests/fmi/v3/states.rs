//! States of FMI 3.0: at events, in Event Mode, as bytes, and in instances with other flags.

use crate::support::*;

/// Time and outputs at the next events and after each.
fn go_on(instance: &Instance<'_>) -> Vec<(f64, Vec<u64>)> {
    let mut rows = Vec::new();
    for _ in 0..6 {
        let (status, stepped) = instance.stepped(instance.real("time"), 1.0);
        assert_eq!(status, OK, "{:?}", instance.log());
        rows.push((stepped.last, instance.outputs()));
        if stepped.event == 1 {
            instance.handle();
            rows.push((stepped.last, instance.outputs()));
        }
    }
    rows
}

#[test]
fn a_state_at_an_event_goes_on_to_the_same_bits() {
    let fmu = Fmu::v3(SCENE);
    let instance = fmu.with_flags(true, true);
    instance.start();
    assert_eq!(instance.stepped(0.0, 1.0).1.event, 1);
    let (state, left) = (instance.recorded(), instance.outputs());
    let bytes = instance.serialized(state);
    let finish = |instance: &Instance<'_>| {
        instance.handle();
        go_on(instance)
    };
    let expected = finish(&instance);
    assert_eq!(instance.set_state(state), OK);
    assert_eq!(instance.outputs(), left);
    assert_eq!(finish(&instance), expected);
    let other = fmu.with_flags(true, true);
    assert_eq!(other.set_state(other.deserialized(&bytes)), OK);
    assert_eq!(other.outputs(), left);
    assert_eq!(finish(&other), expected);
}

#[test]
fn a_state_in_event_mode_is_in_event_mode() {
    let fmu = Fmu::v3(SCENE);
    let instance = fmu.with_flags(true, true);
    instance.start();
    assert_eq!(instance.stepped(0.0, 1.0).1.event, 1);
    instance.calls(&[fmi3EnterEventMode]);
    let bytes = instance.serialized(instance.recorded());
    instance.calls(&[fmi3EnterStepMode]);
    let expected = go_on(&instance);
    let other = fmu.with_flags(true, true);
    let state = other.deserialized(&bytes);
    assert_eq!(other.set_state(state), OK);
    assert_eq!(other.stepped(other.real("time"), 0.1).0, ERROR, "in Event Mode");
    assert_eq!(other.set_state(state), OK);
    assert_eq!(other.update(), (OK, [0; 5], 0.0));
    other.calls(&[fmi3EnterStepMode]);
    assert_eq!(go_on(&other), expected);
}

#[test]
fn without_event_mode_a_state_goes_on_in_step_mode() {
    let fmu = Fmu::v3(SCENE);
    let instance = fmu.with_flags(true, true);
    instance.start();
    assert_eq!(instance.stepped(0.0, 1.0).1.event, 1);
    let waiting = instance.serialized(instance.recorded());
    instance.calls(&[fmi3EnterEventMode]);
    let (handled, right) = (instance.serialized(instance.recorded()), instance.outputs());
    for bytes in [waiting, handled] {
        let plain = fmu.instance();
        assert_eq!(plain.set_state(plain.deserialized(&bytes)), OK);
        assert_eq!(plain.outputs(), right);
        let (status, stepped) = plain.stepped(plain.real("time"), 0.5);
        assert_eq!((status, stepped.event, stepped.early), (OK, 0, 0));
    }
}

#[test]
fn held_values_belong_to_the_state() {
    let fmu = Fmu::v3(SCENE);
    let instance = fmu.with_flags(true, false);
    instance.start();
    assert_eq!(instance.stepped(0.0, 0.5).1.event, 1);
    let (bytes, held) = (instance.serialized(instance.recorded()), instance.outputs());
    instance.calls(&[fmi3EnterEventMode]);
    let right = instance.outputs();
    assert_ne!(held, right);
    let other = fmu.with_flags(true, false);
    assert_eq!(other.set_state(other.deserialized(&bytes)), OK);
    assert_eq!(other.outputs(), held);
    other.calls(&[fmi3EnterEventMode]);
    assert_eq!(other.outputs(), right);
}

/// Discrete outputs that one instance holds until Event Mode are no longer held in one that returns at events.
#[test]
fn held_values_do_not_stay_in_an_instance_with_early_return() {
    let fmu = Fmu::v3(SCENE);
    let instance = fmu.with_flags(true, false);
    instance.start();
    assert_eq!(instance.stepped(0.0, 0.5).1.event, 1);
    let bytes = instance.serialized(instance.recorded());
    instance.handle();
    assert_eq!(instance.stepped(0.5, 1e-4).1.event, 0);
    let other = fmu.with_flags(true, true);
    assert_eq!(other.set_state(other.deserialized(&bytes)), OK);
    assert_eq!(other.stepped(0.5, 1e-4).1.event, 0);
    assert_eq!(other.outputs(), instance.outputs());
}

#[test]
fn messages_call_a_state_as_the_standard_does() {
    let fmu = Fmu::v3(SCENE);
    let instance = fmu.with_flags(true, true);
    let stale = std::ptr::without_provenance_mut(4711);
    for (state, expected) in [(std::ptr::null_mut(), "FMUState is null"), (stale, "FMUState = 0x1267: expected one")] {
        assert_eq!(instance.set_state(state), ERROR);
        assert!(instance.only_error().starts_with(&format!("fmi3SetFMUState: {expected}")));
    }
}

#[test]
fn an_input_that_is_set_at_an_event_is_in_the_state() {
    let fmu = Fmu::v3(SCENE);
    for event_mode_used in [false, true] {
        let [one, other] = [(); 2].map(|()| fmu.with_flags(event_mode_used, true));
        if event_mode_used {
            one.start()
        } else {
            one.initialize()
        }
        assert_eq!(one.stepped(0.0, 1.0).1.early, 1);
        if event_mode_used {
            one.handle();
        }
        assert_eq!(one.set_real("ground.acceleration", 2.0), OK);
        assert_eq!(other.set_state(other.deserialized(&one.serialized(one.recorded()))), OK);
        assert_eq!(other.outputs(), one.outputs());
        assert_eq!(go_on(&other), go_on(&one));
    }
}

#[test]
fn an_event_still_waits_when_nothing_has_been_set() {
    let fmu = Fmu::v3(SCENE);
    let instance = fmu.with_flags(true, true);
    instance.start();
    assert_eq!(instance.stepped(0.0, 1.0).1.event, 1);
    let waiting = instance.outputs();
    // SAFETY: a live instance, no elements.
    unsafe {
        assert_eq!(fmi3SetFloat64(instance.component, std::ptr::null(), 0, std::ptr::null(), 0), OK);
        assert_eq!(fmi3SetString(instance.component, std::ptr::null(), 0, std::ptr::null(), 0), OK);
    }
    assert_eq!(instance.outputs(), waiting);
    assert_eq!(instance.set_real("ground.acceleration", 2.0), OK);
    assert_ne!(instance.outputs(), waiting);
}
