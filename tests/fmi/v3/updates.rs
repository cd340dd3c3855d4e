//! Intermediate updates: the turns that a step gives the master, what it may do in them, and masters that do what they may
//! not.

use crate::both::{TABLE_3, call};
use crate::support::*;
use pounding::FmiVersion;
use pounding::description::Package;
use pounding::slave::{Interface, Log, Slave};
use pounding::variables::{Type, Value};
use std::cell::RefCell;
use std::ptr::null_mut;
use std::rc::Rc;

/// An instance in Step Mode that wants turns for the sake of these variables.
fn started<'f>(fmu: &'f Fmu, names: &[&str], event_mode_used: bool, early_return_allowed: bool) -> Instance<'f> {
    let required: Vec<u32> = names.iter().map(|name| fmu.vr(name)).collect();
    let n_required = required.len();
    let [event_mode_used, early_return_allowed] = [event_mode_used, early_return_allowed].map(u8::from);
    let flags = Arguments { event_mode_used, early_return_allowed, ..Arguments::of(fmu) };
    let arguments = Arguments { required: Some(required), n_required, with_updates: true, ..flags };
    let instance = fmu.instance_with(&arguments);
    instance.initialize();
    if event_mode_used == 1 {
        instance.calls(&[fmi3EnterStepMode]);
    }
    instance
}

/// Does something with the instance in each of its turns; the instance stays where it is until it ends.
fn in_turns(instance: &Instance<'_>, mut turn: impl FnMut(&Instance<'_>, Turn) + 'static) {
    let at = std::ptr::from_ref(instance).cast::<Instance<'static>>();
    // SAFETY: turns are given within calls that borrow the instance.
    instance.in_turns(move |of| turn(unsafe { &*at }, of));
}

const SETS: Turn = Turn { time: 0.0, sets: 1, gets: 0, is_finished: 0, can_return: 0 };
const GETS: Turn = Turn { time: 0.0, sets: 0, gets: 1, is_finished: 1, can_return: 0 };
const GROUND: &str = "ground.acceleration";

/// An acceleration that changes all the time, m/s2.
fn ground(time: f64) -> f64 {
    3.0 * (12.0 * time).sin()
}

#[test]
fn inputs_are_asked_for_once_a_step_at_its_end() {
    let fmu = Fmu::v3(SCENE);
    for early in [false, true] {
        let instance = started(&fmu, &[GROUND], false, early);
        let turns = Rc::new(RefCell::new(Vec::new()));
        let seen = Rc::clone(&turns);
        in_turns(&instance, move |_, turn| seen.borrow_mut().push(turn));
        let (mut now, mut steps) = (0.0, 0);
        while now < 1.0 {
            let (status, stepped) = instance.stepped(now, 1.0 - now);
            assert_eq!(status, OK, "{:?}", instance.log());
            (now, steps) = (stepped.last, steps + 1);
        }
        assert_eq!(*turns.borrow(), vec![Turn { time: 1.0, ..SETS }; steps]);
        assert_eq!(steps > 1, early);
    }
}

#[test]
fn an_input_is_a_line_to_what_it_is_at_the_end() {
    let fmu = Fmu::v3(SCENE);
    let instance = started(&fmu, &[GROUND], false, false);
    in_turns(&instance, |instance, turn| assert_eq!(instance.set_real(GROUND, ground(turn.time)), OK));
    // The same lines by the way of FMI 2.0.
    let package = Package::from_resources(&fmu.resources()).unwrap();
    let mut lines = Slave::new(package, Interface::V2, Log::new(FmiVersion::V2, false));
    lines.enter_initialization();
    lines.exit_initialization().unwrap();
    let (mut now, step, mut value) = (0.0, 0.03125, 0.0);
    for _ in 0..64 {
        assert_eq!(instance.stepped(now, step).0, OK, "{:?}", instance.log());
        lines.set_input_derivatives(&[fmu.vr(GROUND)], &[1], &[(ground(now + step) - value) / step]).unwrap();
        lines.do_step(now, step).unwrap();
        now += step;
        value = instance.real(GROUND);
        assert!((value - ground(now)).abs() < 3e-15, "{value} at {now} s");
        for name in [GROUND, "left.displacement[2]", "right.velocity[3]", "contact[1].force"] {
            let mut line = f64::NAN;
            let take = |_, value: Value<'_>| value.real().map(|value| line = value);
            lines.get(&[fmu.vr(name)], "Real", take).unwrap();
            assert_eq!(instance.real(name).to_bits(), line.to_bits(), "{name} at {now} s");
        }
    }
    assert!(instance.integer("impacts") > 3);
}

#[test]
fn what_the_master_does_not_say_stays() {
    let fmu = Fmu::v3(SCENE);
    let instance = started(&fmu, &[GROUND], false, false);
    in_turns(&instance, |instance, turn| {
        if turn.time <= 0.5 {
            assert_eq!(instance.set_real(GROUND, ground(turn.time)), OK);
        }
    });
    for k in 0..8 {
        let end = 0.25 * f64::from(k + 1);
        assert_eq!(instance.stepped(0.25 * f64::from(k), 0.25).0, OK);
        assert!((instance.real(GROUND) - ground(end.min(0.5))).abs() < 3e-15, "at {end} s");
    }
}

#[test]
fn a_line_goes_on_to_the_same_bits_over_early_returns() {
    let fmu = Fmu::v3(SCENE);
    let whole = started(&fmu, &[GROUND], false, false);
    let parts = [(false, true), (true, true)].map(|(event, early)| started(&fmu, &[GROUND], event, early));
    for instance in parts.iter().chain([&whole]) {
        in_turns(instance, |instance, turn| assert_eq!(instance.set_real(GROUND, ground(turn.time)), OK));
    }
    let mut stops = 0;
    for k in 1..=20 {
        let end = 0.125 * f64::from(k);
        assert_eq!(whole.stepped(end - 0.125, 0.125).0, OK);
        for instance in &parts {
            let mut now = end - 0.125;
            while now < end {
                let (status, stepped) = instance.stepped(now, step_to(now, end));
                assert_eq!(status, OK, "{:?}", instance.log());
                if stepped.event == 1 {
                    instance.handle();
                }
                (now, stops) = (stepped.last, stops + u32::from(stepped.early));
            }
            assert_eq!(instance.outputs(), whole.outputs(), "at {end} s");
        }
    }
    assert!(stops > 10);
}

#[test]
fn each_event_gives_a_turn_to_read() {
    for (scene, text) in [SCENE, RICH, UNEVEN, YIELDING, LINKED, CORRECTED].into_iter().enumerate() {
        let fmu = Fmu::v3(text);
        let plain = fmu.instance();
        plain.initialize();
        let stopping = fmu.with_flags(false, true);
        stopping.initialize();
        let instance = started(&fmu, &["left.displacement[1]"], false, false);
        let turns = Rc::new(RefCell::new(Vec::new()));
        let seen = Rc::clone(&turns);
        in_turns(&instance, move |instance, turn| {
            assert_eq!(turn, Turn { time: instance.real("time"), ..GETS });
            seen.borrow_mut().push((turn.time.to_bits(), instance.outputs()));
        });
        let mut stops = Vec::new();
        for k in 1..=20 {
            let end = 0.125 * f64::from(k);
            assert_eq!((plain.stepped(end - 0.125, 0.125).0, instance.stepped(end - 0.125, 0.125).0), (OK, OK));
            assert_eq!(instance.outputs(), plain.outputs(), "scene {scene} at {end} s");
            let mut now = end - 0.125;
            while now < end {
                let (_, stepped) = stopping.stepped(now, step_to(now, end));
                now = stepped.last;
                if stepped.early == 1 {
                    stops.push((now.to_bits(), stopping.outputs()));
                }
            }
        }
        assert_eq!(*turns.borrow(), stops, "scene {scene}");
        assert!(stops.len() > 4, "scene {scene}: {}", stops.len());
    }
}

#[test]
fn a_step_that_ends_at_events_gives_no_turn_there() {
    let fmu = Fmu::v3(SCENE);
    let instance = started(&fmu, &["left.displacement[1]"], true, true);
    in_turns(&instance, |_, turn| panic!("{turn:?}"));
    let (status, stepped) = instance.stepped(0.0, 1.0);
    assert_eq!((status, stepped.event, stepped.early), (OK, 1, 1));
}

#[test]
fn discrete_outputs_do_not_change_in_turns() {
    let fmu = Fmu::v3(SCENE);
    for wanted in [&["left.displacement[1]"][..], &[GROUND, "left.displacement[1]"]] {
        let instance = started(&fmu, wanted, true, false);
        let shown = instance.discrete();
        in_turns(&instance, move |instance, _| assert_eq!(instance.discrete(), shown));
        let (status, stepped) = instance.stepped(0.0, 1.0);
        assert_eq!((status, stepped.event, stepped.early), (OK, 1, 0), "{wanted:?}");
        instance.handle();
        assert!(instance.integer("impacts") > 1);
    }
}

/// What may be called in a turn, of those in the table of all functions.
const ALLOWED: [&str; 6] =
    ["fmi3GetFloat64", "fmi3GetInt32", "fmi3GetBoolean", "fmi3GetString", "fmi3SetFloat64", "fmi3GetOutputDerivatives"];

#[test]
fn every_call_in_a_turn() {
    let fmu = Fmu::v3(SCENE);
    for variable in [GROUND, "left.displacement[1]"] {
        for &(function, ..) in TABLE_3 {
            let instance = started(&fmu, &[variable], false, false);
            let state = instance.recorded();
            let bytes = instance.serialized(state);
            let found = Rc::new(RefCell::new(None));
            let seen = Rc::clone(&found);
            in_turns(&instance, move |instance, _| {
                let status = call(instance, function, state, &bytes);
                seen.borrow_mut().get_or_insert(status);
            });
            let (status, _) = instance.stepped(0.0, 1.0);
            let is_allowed = ALLOWED.contains(&function);
            let expected = if is_allowed { OK } else { ERROR };
            assert_eq!((*found.borrow(), status), (Some(expected), expected), "{function}: {:?}", instance.log());
            if !is_allowed {
                let log = instance.log();
                let start = format!("{function}: called in phase Intermediate Update Mode: expected in ");
                assert!(log[0].message.starts_with(&start) || function == "fmi3GetFloat32", "{log:?}");
                assert_eq!(log[1].message, "fmi3DoStep: a call in Intermediate Update Mode has failed");
                goes_on_after_a_reset(&instance);
            }
        }
    }
}

fn goes_on_after_a_reset(instance: &Instance<'_>) {
    assert_eq!(instance.stepped(0.0, 1.0).0, ERROR);
    instance.in_turns(|_| ());
    instance.calls(&[fmi3Reset]);
    instance.initialize();
    assert_eq!(instance.stepped(0.0, 1.0).0, OK, "{:?}", instance.log());
}

#[test]
fn what_cannot_be_set_in_a_turn_is_refused() {
    let fmu = Fmu::v3(SCENE);
    for (wanted, set, value, expected) in [
        ("left.displacement[1]", GROUND, 1.0, "ground.acceleration: the step asks for no inputs now"),
        (GROUND, "left.mass[1]", 1.0, "left.mass[1]: a fixed parameter can only be set"),
        (GROUND, "left.displacement[1]", 1.0, "left.displacement[1]: computed by the FMU"),
        (GROUND, GROUND, f64::NAN, "ground.acceleration = NaN"),
    ] {
        let instance = started(&fmu, &[wanted], false, false);
        in_turns(&instance, move |instance, _| assert_eq!(instance.set_real(set, value), ERROR));
        assert_eq!(instance.stepped(0.0, 1.0).0, ERROR);
        let log = instance.log();
        assert!(log[0].message.contains(expected), "{log:?}");
        goes_on_after_a_reset(&instance);
    }
}

#[test]
fn an_instance_that_is_freed_in_a_turn_ends_with_its_step() {
    let fmu = Fmu::v3(SCENE);
    for variable in [GROUND, "left.displacement[1]"] {
        let mut instance = started(&fmu, &[variable], false, false);
        in_turns(&instance, |instance, _| {
            // SAFETY: freed once: the component is forgotten below.
            unsafe { fmi3FreeInstance(instance.component) };
        });
        let (status, stepped) = instance.stepped(0.0, 1.0);
        assert_eq!((status, stepped), (ERROR, UNTOUCHED));
        instance.component = null_mut();
    }
}

#[test]
fn an_instance_that_is_freed_in_a_message_before_a_turn_gets_none() {
    let fmu = Fmu::v3(SCENE);
    let mut instance = started(&fmu, &["left.displacement[1]"], false, false);
    let component = instance.component;
    let is_freed = Rc::new(RefCell::new(false));
    let seen = Rc::clone(&is_freed);
    in_turns(&instance, move |_, turn| assert!(!*seen.borrow(), "{turn:?}"));
    // The end of a contact is said before the turn that it gives.
    let freed = Rc::clone(&is_freed);
    instance.in_next_message(move || {
        freed.replace(true);
        // SAFETY: freed once: the component is forgotten below.
        unsafe { fmi3FreeInstance(component) }
    });
    let (status, stepped) = instance.stepped(0.0, 1.0);
    instance.component = null_mut();
    assert_eq!((status, stepped), (ERROR, UNTOUCHED));
    assert!(*is_freed.borrow());
}

/// After an error a state can be set, and after that another step be made: within the one that the turn belongs to.
#[test]
fn an_instance_that_is_freed_after_a_step_in_a_turn_ends_with_the_outer_step() {
    let fmu = Fmu::v3(SCENE);
    let mut instance = started(&fmu, &["left.displacement[1]"], false, false);
    let state = instance.recorded();
    in_turns(&instance, move |instance, _| {
        assert_eq!((instance.call(fmi3Terminate), instance.set_state(state)), (ERROR, OK));
        assert_eq!(instance.stepped(0.0, 0.3).0, OK);
        // SAFETY: freed once: the component is forgotten below.
        unsafe { fmi3FreeInstance(instance.component) }
    });
    let (status, stepped) = instance.stepped(0.0, 1.0);
    instance.component = null_mut();
    assert_eq!((status, stepped), (ERROR, UNTOUCHED));
}

#[test]
fn variables_that_there_are_not_are_refused_where_there_is_a_function() {
    let fmu = Fmu::v3(SCENE);
    let broken = [
        (Some(vec![fmu.vr(GROUND), 4711, u32::MAX]), 3, vec!["value reference 4711", "value reference 4294967295"]),
        (None, 3, vec!["requiredIntermediateVariables = 0x0: expected 3 elements"]),
        (Some(vec![0]), usize::MAX, vec!["elements of requiredIntermediateVariables: expected at most"]),
    ];
    for (required, n_required, expected) in broken {
        let arguments = Arguments { required, n_required, with_updates: true, ..Arguments::of(&fmu) };
        let (instance, log) = fmu.instantiate(&arguments);
        assert!(instance.is_none());
        assert_eq!(log.len(), expected.len(), "{log:?}");
        for (line, expected) in log.iter().zip(expected) {
            assert!(line.message.contains(expected), "{log:?}");
        }
    }
}

#[test]
fn parameters_and_time_ask_for_no_turn() {
    let fmu = Fmu::v3(SCENE);
    let instance = started(&fmu, &["left.mass[1]", "time"], false, false);
    in_turns(&instance, |_, turn| panic!("{turn:?}"));
    assert_eq!(instance.stepped(0.0, 1.0).0, OK);
}

#[test]
fn states_between_steps_know_nothing_of_turns() {
    let fmu = Fmu::v3(SCENE);
    let all = [GROUND, "left.displacement[1]"];
    let (one, other) = (started(&fmu, &all, false, false), started(&fmu, &all, false, false));
    for instance in [&one, &other] {
        in_turns(instance, |instance, turn| {
            if turn.sets == 1 {
                assert_eq!(instance.set_real(GROUND, ground(turn.time)), OK);
            }
            assert!(instance.reals(&instance.fmu.outputs(|ty| matches!(ty, Type::Real(_)))).is_ok());
        });
    }
    for k in 0..8 {
        assert_eq!(one.stepped(0.25 * f64::from(k), 0.25).0, OK);
        let state = other.deserialized(&one.serialized(one.recorded()));
        assert_eq!(other.set_state(state), OK);
        assert_eq!(other.outputs(), one.outputs());
    }
    assert_eq!((one.stepped(2.0, 0.5).0, other.stepped(2.0, 0.5).0), (OK, OK));
    assert_eq!(other.outputs(), one.outputs());
}
