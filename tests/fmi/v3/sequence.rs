//! Which mode follows initialisation, with Event Mode and without.

use crate::support::*;

#[test]
fn without_event_mode_there_is_none() {
    let fmu = Fmu::v3(RECORD_SCENE);
    for early_return_allowed in [false, true] {
        let instance = fmu.with_flags(false, early_return_allowed);
        instance.initialize();
        assert_eq!(instance.stepped(0.0, 0.1).0, OK, "initialisation leads to Step Mode");
        assert_eq!(instance.call(fmi3EnterEventMode), ERROR);
        assert!(instance.only_error().contains("eventModeUsed"), "the message names the flag");
        assert_eq!(instance.stepped(0.1, 0.1).0, ERROR);
    }
}

#[test]
fn initialisation_leads_to_event_mode_where_it_is_used() {
    let fmu = Fmu::v3(RECORD_SCENE);
    for early_return_allowed in [false, true] {
        let instance = fmu.with_flags(true, early_return_allowed);
        instance.initialize();
        assert_eq!(instance.stepped(0.0, 0.1), (ERROR, UNTOUCHED));
        assert_eq!(instance.only_error(), "fmi3DoStep: called in phase Event Mode: expected in Step Mode");
    }
    let instance = fmu.with_flags(true, true);
    instance.start();
    assert_eq!(instance.call(fmi3EnterStepMode), ERROR, "a second time");
}
