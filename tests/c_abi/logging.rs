//! What reaches the master's logger.

use crate::support::{Arguments, ERROR, Fmu, Instance, OK, RECORD_SCENE, SCENE};
use std::ffi::{CString, c_char, c_int, c_void};

/// Log categories by name; none is all.
pub fn set_debug_logging(instance: &Instance<'_>, on: bool, categories: &[&str]) -> c_int {
    type Logging = unsafe extern "C" fn(*mut c_void, c_int, usize, *const *const c_char) -> c_int;
    let texts = categories.iter().map(|text| CString::new(*text).unwrap()).collect::<Vec<_>>();
    let pointers = texts.iter().map(|text| text.as_ptr()).collect::<Vec<_>>();
    let set = instance.fmu.symbol::<Logging>("fmi2SetDebugLogging");
    // SAFETY: as many strings as announced.
    unsafe { set(instance.component, c_int::from(on), pointers.len(), pointers.as_ptr()) }
}

#[test]
fn a_message_is_a_format_without_conversions_or_references() {
    let fmu = Fmu::new(RECORD_SCENE);
    let instance = fmu.instance();
    assert_eq!(instance.set_string("ground.record", "100%s #1#.csv"), ERROR);
    let log = instance.log();
    assert!(log[0].message.contains("100%%s ##1##.csv"), "{log:?}");
    assert_eq!(log[0].message.replace("%%", "").matches('%').count(), 0);
}

#[test]
fn name_status_and_category_come_with_the_message() {
    let fmu = Fmu::new(SCENE);
    let instance = fmu.instance();
    assert_eq!(instance.step(0.0, 0.1), ERROR);
    let log = instance.log();
    assert_eq!(log.len(), 1);
    assert_eq!((log[0].instance.as_str(), log[0].status, log[0].category.as_str()), ("buildings", 3, "logStatusError"));
}

#[test]
fn each_episode_is_an_event() {
    let fmu = Fmu::new(SCENE);
    let instance = fmu.instance();
    instance.start();
    instance.run(0.0, 0.05, 40);
    let events = instance.log();
    assert!(events.iter().all(|line| (line.status, line.category.as_str()) == (0, "logEvents")), "{events:?}");
    let active = ["contact[1].active", "contact[2].active"].map(|name| fmu.vr(name));
    let open = instance.get::<i32>("fmi2GetBoolean", &active).unwrap().iter().sum::<i32>();
    assert_eq!(i32::try_from(events.len()).unwrap(), instance.integer("impacts") - open);
    assert!(
        events[0].message.starts_with("contact[1] from 0.0") || events[0].message.starts_with("contact[2] from 0.0")
    );
}

#[test]
fn only_what_is_asked_for_is_logged() {
    let fmu = Fmu::new(SCENE);
    let run = |prepare: &dyn Fn(&Instance<'_>)| {
        let arguments = Arguments { logging_on: 0, ..Arguments::of(&fmu) };
        let instance = fmu.instantiate(&arguments).0.unwrap();
        prepare(&instance);
        instance.start();
        instance.run(0.0, 0.05, 40);
        assert_eq!(instance.step(0.0, 0.05), ERROR);
        let mut categories = instance.log().into_iter().map(|line| line.category).collect::<Vec<_>>();
        categories.dedup();
        categories
    };
    let choose = |on, categories: &'static [&'static str]| {
        run(&move |instance| assert_eq!(set_debug_logging(instance, on, categories), OK))
    };
    assert_eq!(run(&|_| ()), ["logStatusError"], "errors need no asking");
    assert_eq!(choose(true, &[]), ["logEvents", "logStatusError"]);
    assert_eq!(choose(true, &["logAll"]), ["logEvents", "logStatusError"]);
    assert_eq!(choose(true, &["logEvents"]), ["logEvents"]);
    assert_eq!(choose(true, &["logStatusError", "logStatusFatal"]), ["logStatusError"]);
    assert!(choose(false, &[]).is_empty());
}

#[test]
fn the_declared_categories_are_those_that_can_be_chosen() {
    let fmu = Fmu::new(SCENE);
    for category in &fmu.description.logCategories {
        assert_eq!(set_debug_logging(&fmu.instance(), true, &[&category.name]), OK, "{}", category.name);
    }
    let instance = fmu.instance();
    assert_eq!(set_debug_logging(&instance, true, &["logEvents", "logNonsense"]), ERROR);
    assert!(instance.log()[0].message.contains("logNonsense"));
}

#[test]
fn a_master_may_call_back_from_its_logger() {
    let fmu = Fmu::new(SCENE);
    let instance = fmu.instance();
    instance.start();
    let reset = fmu.symbol::<unsafe extern "C" fn(*mut c_void) -> c_int>("fmi2Reset");
    let component = instance.component;
    instance.in_next_message(move || {
        // SAFETY: the component is live, and the call that logs has finished with it.
        assert_eq!(unsafe { reset(component) }, OK);
    });
    assert_eq!(instance.step(9.0, 0.1), ERROR);
    assert_eq!(instance.setup(0.0, None), OK, "the reset has taken place");
}
