//! Events with both flags: where steps stop, what is read before and after, and masters that do not follow.

use crate::support::*;
use pounding::variables::Slot;

/// Steps to the next event, which must come before a time.
fn to_event(instance: &Instance<'_>, from: f64, end: f64) -> f64 {
    let (status, stepped) = instance.stepped(from, end - from);
    assert_eq!((status, stepped.event, stepped.early, stepped.terminate), (OK, 1, 1, 0), "{:?}", instance.log());
    assert!(from <= stepped.last && stepped.last < end);
    assert_eq!(instance.real("time"), stepped.last);
    stepped.last
}

/// An instance in Step Mode.
fn started(fmu: &Fmu) -> Instance<'_> {
    let instance = fmu.with_flags(true, true);
    instance.start();
    instance
}

#[test]
fn discrete_outputs_change_in_event_mode_only() {
    let fmu = Fmu::v3(SCENE);
    let instance = started(&fmu);
    let (mut time, mut events, mut shown) = (0.0, 0, instance.discrete());
    while time < 2.0 {
        let (status, stepped) = instance.stepped(time, 2.0 - time);
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
    let fmu = Fmu::v3(SCENE);
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
fn a_parameter_that_is_set_to_what_it_is_leaves_the_event_to_the_master() {
    let fmu = Fmu::v3(SCENE);
    let (again, once) = (started(&fmu), started(&fmu));
    for instance in [&again, &once] {
        to_event(instance, 0.0, 1.0);
    }
    let before = again.outputs();
    assert_eq!(again.set_real("contact[1].gap", 0.002), OK, "{:?}", again.log());
    assert_eq!(again.outputs(), before);
    for instance in [&again, &once] {
        instance.calls(&[fmi3EnterEventMode]);
    }
    assert_eq!(again.outputs(), once.outputs());
    assert_ne!(again.outputs(), before);
}

/// A step ends where a link begins to slip and where it sticks: its force does not jump there, and a slip is seen from the
/// event on.
#[test]
fn slips_of_links_are_events() {
    let fmu = Fmu::v3(LINKED);
    let instance = started(&fmu);
    let senses = || [1, 4].map(|link| instance.integer(&format!("link[{link}].slipping")));
    let (mut time, mut slips, mut sticks) = (0.0, 0, 0);
    while time < 1.0 {
        let (status, stepped) = instance.stepped(time, 1.0 - time);
        assert_eq!(status, OK);
        let (from, before) = (time, senses());
        time = stepped.last;
        if stepped.event == 0 {
            break;
        }
        let forces = || [1, 4].map(|link| instance.real(&format!("link[{link}].force")));
        let force = forces();
        instance.handle();
        for (after, before) in forces().into_iter().zip(force) {
            assert!((after - before).abs() < 1e-11, "{before} N and {after} N at {time} s");
        }
        let after = senses();
        assert!(from < time || before != after);
        slips += before.iter().zip(after).filter(|(before, after)| **before == 0 && *after != 0).count();
        sticks += before.iter().zip(after).filter(|(before, after)| **before != 0 && *after == 0).count();
    }
    assert!(slips > 5 && sticks > 5, "{slips} slips and {sticks} sticks are stopped at");
    // Of the whole run, as a master sees it that looks ten thousand times: none but the shortest is missed.
    let watched = fmu.instance();
    watched.initialize();
    let (mut last, mut seen) = ([0; 2], 0);
    for k in 0..10_000 {
        assert_eq!(watched.stepped(1e-4 * f64::from(k), 1e-4).0, OK);
        let now = [1, 4].map(|link| watched.integer(&format!("link[{link}].slipping")));
        seen += last.iter().zip(now).filter(|(last, now)| **last == 0 && *now != 0).count();
        last = now;
    }
    assert!(seen <= slips + 2 && slips <= seen + 2, "{slips} slips are stopped at, {seen} seen");
}

/// Steps to a communication point as a master does that follows what it is told, and sets its inputs at every stop.
/// Number of early returns and events.
fn follow(instance: &Instance<'_>, inputs: &[(u32, f64)], from: f64, end: f64) -> usize {
    let (vr, values): (Vec<u32>, Vec<f64>) = inputs.iter().copied().unzip();
    let (mut now, mut count) = (from, 0);
    loop {
        // SAFETY: as many references as values.
        let set = unsafe { fmi3SetFloat64(instance.component, vr.as_ptr(), vr.len(), values.as_ptr(), values.len()) };
        assert_eq!(set, OK, "{:?}", instance.log());
        let (status, stepped) = instance.stepped(now, step_to(now, end));
        assert_eq!((status, stepped.terminate), (OK, 0), "{:?}", instance.log());
        now = stepped.last;
        if stepped.event == 1 {
            instance.handle();
        }
        count += usize::from(stepped.event.max(stepped.early));
        if stepped.early == 0 {
            assert_eq!(now, end);
            return count;
        }
    }
}

#[test]
fn whatever_the_flags_the_bits_are_the_same() {
    for (scene, text) in [SCENE, RECORD_SCENE, RICH, UNEVEN, YIELDING, LINKED, CORRECTED].into_iter().enumerate() {
        let fmu = Fmu::v3(text);
        let inputs = fmu.table.iter().filter(|(_, row)| matches!(row.slot, Slot::Input(_)));
        let inputs = inputs.map(|(reference, _)| reference).collect::<Vec<_>>();
        let plain = fmu.instance();
        plain.initialize();
        let others = [(false, true), (true, false), (true, true)].map(|(event_mode_used, early_return_allowed)| {
            let instance = fmu.with_flags(event_mode_used, early_return_allowed);
            instance.initialize();
            if event_mode_used {
                instance.calls(&[fmi3EnterStepMode]);
            }
            instance
        });
        let mut counts = [0; 3];
        let mut time = 0.0;
        for k in 0..60 {
            // Steps of changing length; inputs that are held for seven of them.
            let end = time + [1.0 / 64.0, 1.0 / 32.0, 1.0 / 128.0][k % 3];
            let value = |i: usize| f64::from(u8::try_from((k / 7 * 5 + i * 3) % 11).unwrap()) * 0.2 - 1.0;
            let inputs = inputs.iter().enumerate().map(|(i, &input)| (input, value(i))).collect::<Vec<_>>();
            assert_eq!(follow(&plain, &inputs, time, end), 0);
            for (count, instance) in counts.iter_mut().zip(&others) {
                *count += follow(instance, &inputs, time, end);
                assert_eq!(instance.outputs(), plain.outputs(), "scene {scene} at {end} s");
            }
            time = end;
        }
        assert!(counts.iter().all(|&count| count > 4), "scene {scene}: {counts:?}");
    }
}

#[test]
fn without_early_return_discrete_outputs_wait_for_event_mode() {
    let fmu = Fmu::v3(SCENE);
    let (plain, held) = (fmu.instance(), fmu.with_flags(true, false));
    plain.initialize();
    held.start();
    let mut needed = 0;
    for k in 0..40 {
        let time = f64::from(k) * 0.05;
        let shown = held.discrete();
        assert_eq!(plain.stepped(time, 0.05).0, OK);
        let (status, stepped) = held.stepped(time, 0.05);
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
    let fmu = Fmu::v3(SCENE);
    let instance = started(&fmu);
    let time = to_event(&instance, 0.0, 1.0);
    instance.calls(&[fmi3EnterEventMode]);
    assert_eq!(instance.stepped(time, 0.1), (ERROR, UNTOUCHED));
    assert_eq!(instance.only_error(), "fmi3DoStep: called in phase Event Mode: expected in Step Mode");
}

#[test]
fn an_event_that_is_ignored_is_handled_by_the_next_step() {
    let fmu = Fmu::v3(SCENE);
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
    let fmu = Fmu::v3(SCENE);
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
    let fmu = Fmu::v3(SCENE);
    let (through, plain) = (started(&fmu), started(&fmu));
    for instance in [&through, &plain] {
        assert_eq!(instance.stepped(0.0, 0.001).0, OK);
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
    let fmu = Fmu::v3(SCENE);
    let (first, plain) = (fmu.with_flags(true, true), fmu.instance());
    first.initialize();
    plain.initialize();
    assert_eq!(first.outputs(), plain.outputs());
    assert_eq!(first.update(), (OK, [0; 5], 0.0));
    assert_eq!(first.outputs(), plain.outputs());
}

#[test]
fn reset_and_terminate_at_an_event() {
    let fmu = Fmu::v3(SCENE);
    let instance = started(&fmu);
    let time = to_event(&instance, 0.0, 1.0);
    let left = instance.outputs();
    instance.calls(&[fmi3Terminate]);
    assert_eq!(instance.outputs(), left, "the end handles nothing");
    instance.calls(&[fmi3Reset]);
    instance.start();
    assert_eq!(to_event(&instance, 0.0, 1.0), time);
    instance.calls(&[fmi3Reset]);
    instance.start();
    assert_eq!(to_event(&instance, 0.0, 1.0), time);
    instance.calls(&[fmi3EnterEventMode, fmi3Terminate, fmi3Reset]);
    instance.start();
    assert_eq!(to_event(&instance, 0.0, 1.0), time);
    assert_eq!(instance.outputs(), left);
}
