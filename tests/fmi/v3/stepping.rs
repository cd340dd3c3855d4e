//! What communication steps write, also those that are refused or end the run.

use crate::support::*;

#[test]
fn a_step_writes_all_that_it_has_come_to() {
    let fmu = Fmu::v3(RECORD_SCENE);
    for (event_mode_used, early_return_allowed) in [(false, false), (false, true), (true, false), (true, true)] {
        let instance = fmu.with_flags(event_mode_used, early_return_allowed);
        instance.initialize();
        if event_mode_used {
            instance.calls(&[fmi3EnterStepMode]);
        }
        let (status, stepped) = instance.stepped(0.0, 1e-4);
        assert_eq!((status, stepped), (OK, Stepped { event: 0, terminate: 0, early: 0, last: 1e-4 }));
    }
}

/// Which steps are refused both versions are asked (`both/stepping.rs`); FMI 3.0 writes where the run is all the same.
#[test]
fn a_refused_step_writes_where_the_run_is() {
    let fmu = Fmu::v3(SCENE);
    for (current, step, expected) in [
        (0.0, 0.0, "communicationStepSize = 0"),
        (0.0, -0.1, "communicationStepSize = -0.1"),
        (0.0, f64::NAN, "communicationStepSize = NaN"),
        (f64::NAN, 0.1, "currentCommunicationPoint = NaN"),
        (0.5, 0.1, "currentCommunicationPoint = 0.5"),
        (0.0, 2.1, "expected at most stopTime = 2"),
    ] {
        let instance = fmu.instance();
        assert_eq!(instance.enter_from(0.0, Some(2.0)), OK);
        instance.calls(&[fmi3ExitInitializationMode]);
        let (status, stepped) = instance.stepped(current, step);
        assert_eq!(status, ERROR, "{current} + {step}");
        assert_eq!(stepped, Stepped { event: 0, terminate: 0, early: 0, last: 0.0 });
        let message = instance.only_error();
        assert!(message.starts_with("fmi3DoStep: ") && message.contains(expected), "{message}");
    }
}

#[test]
fn a_step_below_the_rounding_of_time_is_one() {
    let fmu = Fmu::v3(SCENE);
    for flags in [(false, false), (true, true)] {
        let instance = fmu.with_flags(flags.0, flags.1);
        instance.initialize();
        if flags.0 {
            instance.calls(&[fmi3EnterStepMode]);
        }
        for step in [1e-300, f64::MIN_POSITIVE / 2.0, 1e-3] {
            let (status, stepped) = instance.stepped(instance.real("time"), step);
            assert_eq!((status, stepped.early, stepped.event), (OK, 0, 0), "{step}");
            assert_eq!(stepped.last, instance.real("time"));
        }
        assert_eq!(instance.real("time"), 1e-3);
    }
}

#[test]
fn a_collapse_ends_the_run() {
    let fmu = Fmu::v3(COLLAPSE);
    for (event_mode_used, early_return_allowed) in [(false, false), (false, true), (true, false), (true, true)] {
        let instance = fmu.with_flags(event_mode_used, early_return_allowed);
        instance.initialize();
        if event_mode_used {
            instance.calls(&[fmi3EnterStepMode]);
        }
        let mut time = 0.0;
        let over = loop {
            let (status, stepped) = instance.stepped(time, 10.0);
            assert_eq!(status, OK, "{:?}", instance.log());
            time = stepped.last;
            let mut terminate = stepped.terminate;
            if stepped.event == 1 {
                instance.calls(&[fmi3EnterEventMode]);
                terminate |= instance.update().1[1];
                instance.calls(&[fmi3EnterStepMode]);
            }
            if terminate == 1 {
                break stepped;
            }
            assert!(time < 10.0, "{stepped:?}");
        };
        assert!(over.last > 0.0 && over.last < 1.0, "{over:?}");
        let outputs = instance.outputs();
        if over.terminate == 0 {
            // It has been told in Event Mode, and FMPy makes one more step: to hear it from there too is no mistake.
            assert_eq!(instance.stepped(time, 0.1), (OK, Stepped { event: 0, terminate: 1, early: 1, last: time }));
        }
        let (status, stepped) = instance.stepped(time, 0.1);
        assert_eq!((status, stepped), (DISCARD, Stepped { event: 0, terminate: 1, early: 0, last: time }));
        let log = instance.log();
        let last = log.last().unwrap();
        assert_eq!((last.status, last.category.as_str()), (DISCARD, "logStatusDiscard"));
        assert_eq!(instance.outputs(), outputs);
        instance.calls(&[fmi3Terminate, fmi3Reset]);
        instance.initialize();
    }
}

#[test]
fn early_returns_lead_to_the_same_bits() {
    let fmu = Fmu::v3(RECORD_SCENE);
    let (plain, stops) = (fmu.instance(), fmu.with_flags(false, true));
    plain.initialize();
    stops.initialize();
    let mut count = 0;
    for k in 0..100 {
        let (time, end) = (f64::from(k) / 64.0, f64::from(k + 1) / 64.0);
        assert_eq!(plain.stepped(time, step_to(time, end)).0, OK);
        let mut now = time;
        loop {
            let (status, stepped) = stops.stepped(now, step_to(now, end));
            assert_eq!((status, stepped.event), (OK, 0), "no Event Mode, no need of it");
            count += i32::from(stepped.early);
            now = stepped.last;
            if stepped.early == 0 {
                break;
            }
        }
        assert_eq!(now, end);
        assert_eq!(stops.outputs(), plain.outputs(), "at {end} s");
    }
    assert!(count > 0 && count <= 2 * plain.integer("impacts"), "{count} stops");
}
