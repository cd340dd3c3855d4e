//! What reaches the master's logger.

use crate::support::*;
use pounding::FmiVersion;

/// In FMI 2.0 a message is a format of `printf`; in both versions a hash begins a reference to a variable.
#[test]
fn a_message_has_neither_conversions_nor_references() {
    for fmu in Fmu::both(RECORD_SCENE) {
        let instance = fmu.instance();
        assert_eq!(instance.set_string("ground.record", "100%s #1#.csv"), ERROR);
        let message = instance.only_error();
        assert!(message.starts_with(fmu.either("fmi2SetString: ", "fmi3SetString: ")), "{message}");
        assert!(message.contains(fmu.either("100%%s ##1##.csv", "100%s ##1##.csv")), "{message}");
        let conversions = message.replace("%%", "").matches('%').count();
        assert!(fmu.version == FmiVersion::V3 || conversions == 0, "{message}");
        assert!(!message.ends_with('\n'));
    }
}

#[test]
fn name_status_and_category_come_with_the_message() {
    for fmu in Fmu::both(SCENE) {
        let instance = fmu.instance();
        assert_eq!(instance.step(0.0, 0.1), ERROR);
        let [line] = &instance.log()[..] else { panic!("one message") };
        assert_eq!(line.instance.as_deref(), fmu.either(Some("buildings"), None));
        assert_eq!((line.status, line.category.as_str()), (ERROR, "logStatusError"));
    }
}

#[test]
fn each_episode_is_an_event() {
    for fmu in Fmu::both(SCENE) {
        let instance = fmu.instance();
        instance.start();
        instance.run(0.0, 0.05, 40);
        let events = instance.log();
        assert!(events.iter().all(|line| (line.status, line.category.as_str()) == (OK, "logEvents")), "{events:?}");
        let open = instance.boolean("contact[1].active") + instance.boolean("contact[2].active");
        assert_eq!(i32::try_from(events.len()).unwrap(), instance.integer("impacts") - i32::from(open));
        let first = &events[0].message;
        assert!(first.starts_with("contact[1] from 0.0") || first.starts_with("contact[2] from 0.0"), "{first}");
    }
}

/// The categories of what is logged in a run with events, a warning and an error, in the order of their first lines.
fn categories(fmu: &Fmu, logging_on: i32, prepare: impl Fn(&Instance<'_>)) -> Vec<String> {
    let instance = fmu.instance_with(&Arguments { logging_on, ..Arguments::of(fmu) });
    prepare(&instance);
    instance.start();
    for k in 0..40 {
        // 1500 m/s2: a slip that is warned of.
        assert_eq!(instance.set_real("ground.acceleration", if k == 20 { 1500.0 } else { 0.0 }), OK);
        assert_eq!(instance.step(f64::from(k) * 0.05, 0.05), OK);
    }
    assert_eq!(instance.step(0.0, 0.05), ERROR);
    let mut categories: Vec<String> = Vec::new();
    for line in instance.log() {
        if !categories.contains(&line.category) {
            categories.push(line.category);
        }
    }
    categories
}

#[test]
fn only_what_is_asked_for_is_logged() {
    const ALL: [&str; 3] = ["logEvents", "logStatusWarning", "logStatusError"];
    for fmu in Fmu::both(SCENE) {
        let choose = |on, names: &[&str]| {
            categories(&fmu, 0, |instance| assert_eq!(instance.set_debug_logging(on, names), OK, "{names:?}"))
        };
        assert_eq!(categories(&fmu, 1, |_| ()), ALL);
        // Whoever does not ask hears of errors; in FMI 2.0, whose masters rarely ask, of slips too.
        assert_eq!(categories(&fmu, 0, |_| ()), ALL[fmu.either(1, 2)..]);
        assert_eq!(choose(true, &[]), ALL);
        assert_eq!(choose(true, &["logAll"]), ALL);
        assert_eq!(choose(true, &["logEvents"]), ["logEvents"]);
        assert_eq!(choose(true, &["logStatusError", "logStatusFatal"]), ["logStatusError"]);
        assert!(choose(false, &[]).is_empty());
    }
}

#[test]
fn the_declared_categories_are_those_that_can_be_chosen() {
    for fmu in Fmu::both(SCENE) {
        let text = fmu.package.model_description(fmu.version);
        let document = roxmltree::Document::parse(&text).unwrap();
        let declared = document.descendants().filter(|node| node.has_tag_name("Category"));
        let declared: Vec<&str> = declared.filter_map(|node| node.attribute("name")).collect();
        assert!(declared.len() > 3, "{declared:?}");
        for category in declared {
            assert_eq!(fmu.instance().set_debug_logging(true, &[category]), OK, "{category}");
        }
        let instance = fmu.instance();
        assert_eq!(instance.set_debug_logging(true, &["logEvents", "logNonsense"]), ERROR);
        assert!(instance.only_error().contains("logNonsense"));
    }
}

#[test]
fn a_master_may_call_back_from_its_logger() {
    for fmu in Fmu::both(SCENE) {
        let instance = fmu.instance();
        instance.start();
        let (reset, component) = (instance.functions().reset, instance.component);
        instance.in_next_message(move || {
            // SAFETY: the instance is live, and the call that logs has finished with it.
            assert_eq!(unsafe { reset(component) }, OK);
        });
        assert_eq!(instance.step(9.0, 0.1), ERROR);
        assert_eq!(instance.enter_from(0.0, None), OK, "the reset has taken place");
    }
}
