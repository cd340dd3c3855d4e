//! What reaches the master's logger.

use crate::linked_3::{Arguments, ERROR, Fmu, Instance, OK, fmi3EnterStepMode, fmi3Reset, fmi3SetDebugLogging};
use crate::support::{RECORD_SCENE, SCENE};
use std::ffi::{CString, c_int};

fn choose(instance: &Instance<'_>, on: u8, categories: &[&str]) -> c_int {
    let texts = categories.iter().map(|text| CString::new(*text).unwrap()).collect::<Vec<_>>();
    let pointers = texts.iter().map(|text| text.as_ptr()).collect::<Vec<_>>();
    // SAFETY: as many strings as announced.
    unsafe { fmi3SetDebugLogging(instance.component, on, pointers.len(), pointers.as_ptr()) }
}

#[test]
fn a_message_is_plain_text_with_double_hashes() {
    let fmu = Fmu::new(RECORD_SCENE);
    let instance = fmu.instance(false, false);
    assert_eq!(instance.set_string("ground.record", "100%s #1#.csv"), ERROR);
    let message = instance.only_error();
    assert!(message.starts_with("fmi3SetString: ") && message.contains("100%s ##1##.csv"), "{message}");
    assert!(!message.ends_with('\n'));
}

/// The categories of what is logged in a run with events, a warning and an error.
fn categories(fmu: &Fmu, logging_on: u8, prepare: impl Fn(&Instance<'_>)) -> Vec<String> {
    let (instance, _) = fmu.instantiate(&Arguments { flags: [logging_on, 0, 0], ..Arguments::of(fmu) });
    let instance = instance.unwrap();
    prepare(&instance);
    instance.initialize();
    for k in 0..40 {
        // 1500 m/s2: a slip that is warned of.
        instance.set_real("ground.acceleration", if k == 20 { 1500.0 } else { 0.0 });
        assert_eq!(instance.step(f64::from(k) * 0.05, 0.05).0, OK);
    }
    assert_eq!(instance.step(0.0, 0.05).0, ERROR);
    let mut categories = instance.log().into_iter().map(|line| line.category).collect::<Vec<_>>();
    categories.sort();
    categories.dedup();
    categories
}

#[test]
fn without_logging_errors_only() {
    let fmu = Fmu::new(SCENE);
    assert_eq!(categories(&fmu, 0, |_| ()), ["logStatusError"]);
    assert_eq!(categories(&fmu, 1, |_| ()), ["logEvents", "logStatusError", "logStatusWarning"]);
}

#[test]
fn categories_are_chosen_by_name() {
    let fmu = Fmu::new(SCENE);
    let chosen = |on, names: &'static [&'static str]| {
        categories(&fmu, 0, move |instance| assert_eq!(choose(instance, on, names), OK))
    };
    assert_eq!(chosen(1, &[]), ["logEvents", "logStatusError", "logStatusWarning"]);
    assert_eq!(chosen(1, &["logAll"]), ["logEvents", "logStatusError", "logStatusWarning"]);
    assert_eq!(chosen(1, &["logEvents"]), ["logEvents"]);
    assert!(chosen(0, &[]).is_empty());
    let instance = fmu.instance(false, false);
    assert_eq!(choose(&instance, 1, &["logEvents", "logNonsense"]), ERROR);
    assert!(instance.only_error().contains("logNonsense"));
}

#[test]
fn a_master_may_call_back_from_its_logger() {
    let fmu = Fmu::new(SCENE);
    let instance = fmu.instance(false, false);
    let component = instance.component;
    instance.in_next_message(move || {
        // SAFETY: the instance is live, and the call that logs has finished with it.
        assert_eq!(unsafe { fmi3Reset(component) }, OK);
    });
    assert_eq!(instance.call(fmi3EnterStepMode), ERROR);
    instance.initialize();
}

#[test]
fn no_logger_is_needed() {
    let fmu = Fmu::new(SCENE);
    let silent = || Arguments { with_logger: false, ..Arguments::of(&fmu) };
    let (instance, _) = fmu.instantiate(&silent());
    assert_eq!(instance.unwrap().step(0.0, 0.1).0, ERROR);
    assert!(fmu.instantiate(&Arguments { token: None, ..silent() }).0.is_none());
}
