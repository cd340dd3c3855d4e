//! Events with both flags: where steps stop, what is read before and after, and masters that do not follow.

use crate::linked_3::*;
use crate::support::SCENE;

/// Steps to the next event, which must come before a time.
fn to_event(instance: &Instance<'_>, from: f64, end: f64) -> f64 {
    let (status, stepped) = instance.step(from, end - from);
    assert_eq!((status, stepped.event, stepped.early, stepped.terminate), (OK, 1, 1, 0), "{:?}", instance.log());
    assert!(from <= stepped.last && stepped.last < end);
    assert_eq!(instance.real("time"), stepped.last);
    stepped.last
}

/// An instance in Step Mode.
fn started(fmu: &Fmu) -> Instance<'_> {
    let instance = fmu.instance(true, true);
    instance.start_with_events();
    instance
}

#[test]
fn discrete_outputs_change_in_event_mode_only() {
    let fmu = Fmu::new(SCENE);
    let instance = started(&fmu);
    let (mut time, mut events, mut shown) = (0.0, 0, instance.discrete());
    while time < 2.0 {
        let (status, stepped) = instance.step(time, 2.0 - time);
        assert_eq!(status, OK);
        time = stepped.last;
        let left = instance.outputs();
        assert_eq!(instance.discrete(), shown, "at {time} s, before the event");
        if stepped.event == 0 {
            assert_eq!((stepped.early, time), (0, 2.0));
            break;
        }
        events += 1;
        instance.calls(&[fmi3EnterEventMode]);
        assert_ne!(instance.discrete(), shown, "at {time} s, after the event");
        let right = instance.outputs();
        assert_ne!(left, right);
        assert_eq!(instance.update(), (OK, [0; 5], 0.0));
        assert_eq!(instance.outputs(), right, "an update has nothing left to do");
        instance.calls(&[fmi3EnterStepMode]);
        assert_eq!(instance.outputs(), right);
        assert_eq!(instance.real("time"), time);
        shown = instance.discrete();
    }
    let open = i32::from(instance.boolean("contact[1].active")) + i32::from(instance.boolean("contact[2].active"));
    assert_eq!(events, 2 * instance.integer("impacts") - open, "each onset and each release");
    assert!(events > 10);
}

#[test]
fn motion_does_not_jump_where_a_soft_contact_begins() {
    let fmu = Fmu::new(SCENE);
    let instance = started(&fmu);
    let time = to_event(&instance, 0.0, 1.0);
    let continuous = |instance: &Instance<'_>| {
        ["left.displacement[1]", "left.velocity[1]", "right.displacement[2]", "right.velocity[2]"]
            .map(|name| instance.real(name))
    };
    let before = continuous(&instance);
    assert_eq!((instance.boolean("contact[1].active"), instance.boolean("contact[2].active")), (0, 0));
    instance.calls(&[fmi3EnterEventMode]);
    for (after, before) in continuous(&instance).into_iter().zip(before) {
        assert!((after - before).abs() <= 1e-14 * before.abs(), "{before} and {after}");
    }
    assert_eq!(instance.boolean("contact[1].active") + instance.boolean("contact[2].active"), 1);
    assert_eq!(instance.integer("impacts"), 1);
    assert_eq!(instance.real("time"), time);
}

#[test]
fn both_flags_lead_to_the_bits_of_none() {
    let fmu = Fmu::new(SCENE);
    let (plain, events) = (fmu.instance(false, false), started(&fmu));
    plain.initialize();
    for k in 0..40 {
        let (time, end) = (f64::from(k) / 16.0, f64::from(k + 1) / 16.0);
        for instance in [&plain, &events] {
            // The ground is held for ten steps: most of them set what is set already.
            assert_eq!(instance.set_real("ground.acceleration", f64::from(k / 10)), OK);
        }
        assert_eq!(plain.step(time, step_to(time, end)).0, OK);
        let mut now = time;
        loop {
            let (status, stepped) = events.step(now, step_to(now, end));
            assert_eq!(status, OK);
            now = stepped.last;
            if stepped.event == 1 {
                events.handle();
            }
            if stepped.early == 0 {
                break;
            }
            assert_eq!(events.set_real("ground.acceleration", f64::from(k / 10)), OK);
        }
        assert_eq!(events.outputs(), plain.outputs(), "at {end} s");
    }
}

#[test]
fn without_early_return_discrete_outputs_wait_for_event_mode() {
    let fmu = Fmu::new(SCENE);
    let (plain, held) = (fmu.instance(false, false), fmu.instance(true, false));
    plain.initialize();
    held.start_with_events();
    let mut needed = 0;
    for k in 0..40 {
        let time = f64::from(k) * 0.05;
        let shown = held.discrete();
        assert_eq!(plain.step(time, 0.05).0, OK);
        let (status, stepped) = held.step(time, 0.05);
        assert_eq!((status, stepped.early, stepped.last), (OK, 0, plain.real("time")));
        assert_eq!(held.discrete(), shown, "after step {k}");
        assert_eq!(stepped.event == 1, plain.discrete() != shown, "after step {k}");
        needed += i32::from(stepped.event);
        if stepped.event == 1 {
            held.handle();
        }
        assert_eq!(held.outputs(), plain.outputs(), "after step {k}");
    }
    assert!(needed > 5);
}

#[test]
fn a_step_in_event_mode_is_refused() {
    let fmu = Fmu::new(SCENE);
    let instance = started(&fmu);
    let time = to_event(&instance, 0.0, 1.0);
    instance.calls(&[fmi3EnterEventMode]);
    assert_eq!(instance.step(time, 0.1), (ERROR, UNTOUCHED));
    assert_eq!(instance.only_error(), "fmi3DoStep: called in phase Event Mode: expected in Step Mode");
}

#[test]
fn an_event_that_is_ignored_is_handled_by_the_next_step() {
    let fmu = Fmu::new(SCENE);
    let (follows, ignores) = (started(&fmu), started(&fmu));
    let time = to_event(&follows, 0.0, 1.0);
    assert_eq!(to_event(&ignores, 0.0, 1.0), time);
    follows.handle();
    let next = to_event(&follows, time, 1.0);
    assert!(next > time);
    assert_eq!(to_event(&ignores, time, 1.0), next);
    assert_eq!(ignores.outputs(), follows.outputs());
}

#[test]
fn an_input_that_is_set_while_an_event_waits_counts_from_after_it() {
    let fmu = Fmu::new(SCENE);
    let (follows, hurries) = (started(&fmu), started(&fmu));
    let time = to_event(&follows, 0.0, 1.0);
    to_event(&hurries, 0.0, 1.0);
    follows.calls(&[fmi3EnterEventMode]);
    assert_eq!(follows.set_real("ground.acceleration", 2.0), OK);
    assert_eq!(follows.update().0, OK);
    follows.calls(&[fmi3EnterStepMode]);
    assert_eq!(hurries.set_real("ground.acceleration", 2.0), OK);
    assert_eq!(hurries.outputs(), follows.outputs());
    let next = to_event(&follows, time, 1.0);
    assert_eq!(to_event(&hurries, time, 1.0), next);
    assert_eq!(hurries.outputs(), follows.outputs());
}

#[test]
fn event_mode_without_an_event_is_for_inputs() {
    let fmu = Fmu::new(SCENE);
    let (through, plain) = (started(&fmu), started(&fmu));
    for instance in [&through, &plain] {
        assert_eq!(instance.step(0.0, 0.001).0, OK);
    }
    let before = through.outputs();
    through.calls(&[fmi3EnterEventMode]);
    assert_eq!(through.update(), (OK, [0; 5], 0.0));
    assert_eq!(through.outputs(), before);
    for instance in [&through, &plain] {
        assert_eq!(instance.set_real("ground.acceleration", 2.0), OK);
    }
    through.calls(&[fmi3EnterStepMode]);
    assert_eq!(to_event(&through, 0.001, 1.0), to_event(&plain, 0.001, 1.0));
    assert_eq!(through.outputs(), plain.outputs());
}

#[test]
fn the_first_event_mode_shows_the_start() {
    let fmu = Fmu::new(SCENE);
    let (first, plain) = (fmu.instance(true, true), fmu.instance(false, false));
    first.initialize();
    plain.initialize();
    assert_eq!(first.outputs(), plain.outputs());
    assert_eq!(first.update(), (OK, [0; 5], 0.0));
    assert_eq!(first.outputs(), plain.outputs());
}

#[test]
fn reset_and_terminate_at_an_event() {
    let fmu = Fmu::new(SCENE);
    let instance = started(&fmu);
    let time = to_event(&instance, 0.0, 1.0);
    let left = instance.outputs();
    instance.calls(&[fmi3Terminate]);
    assert_eq!(instance.outputs(), left, "the end handles nothing");
    instance.calls(&[fmi3Reset]);
    instance.start_with_events();
    assert_eq!(to_event(&instance, 0.0, 1.0), time);
    instance.calls(&[fmi3Reset]);
    instance.start_with_events();
    assert_eq!(to_event(&instance, 0.0, 1.0), time);
    instance.calls(&[fmi3EnterEventMode, fmi3Terminate, fmi3Reset]);
    instance.start_with_events();
    assert_eq!(to_event(&instance, 0.0, 1.0), time);
    assert_eq!(instance.outputs(), left);
}
