//! `fmi2Instantiate` and `fmi3InstantiateCoSimulation`: which calls give an instance, and what the others say.

use crate::support::*;
use std::fs;

/// The name of the call, and how it calls the GUID.
fn words(fmu: &Fmu) -> (&'static str, &'static str) {
    fmu.either(("fmi2Instantiate", "fmuGUID"), ("fmi3InstantiateCoSimulation", "instantiationToken"))
}

/// Arguments that are wrong by themselves, and what is said of them.
fn wrong(fmu: &Fmu) -> Vec<(Arguments, String)> {
    let usual = || Arguments::of(fmu);
    let (_, guid) = words(fmu);
    let mut wrong = vec![
        (Arguments { name: None, ..usual() }, "instanceName is null".to_owned()),
        (Arguments { name: c(""), ..usual() }, "instanceName is empty".to_owned()),
        (Arguments { guid: None, ..usual() }, format!("{guid} is null")),
        (Arguments { guid: c(""), ..usual() }, format!("{guid} \"\"")),
        (Arguments { guid: c("{00000000-0000-0000-0000-000000000000}"), ..usual() }, fmu.guid.clone()),
        (Arguments { logging_on: 2, ..usual() }, format!("loggingOn = 2: expected {}", booleans(fmu))),
    ];
    let more = fmu.either(wrong_in_2(fmu), wrong_in_3(fmu));
    wrong.extend(more.into_iter().map(|(arguments, expected)| (arguments, expected.to_owned())));
    wrong
}

fn booleans(fmu: &Fmu) -> &'static str {
    fmu.either("fmi2False (0) or fmi2True (1)", "fmi3False (0) or fmi3True (1)")
}

fn wrong_in_2(fmu: &Fmu) -> Vec<(Arguments, &'static str)> {
    let usual = || Arguments::of(fmu);
    vec![
        (Arguments { kind: 0, ..usual() }, "fmuType = 0"),
        (Arguments { kind: 77, ..usual() }, "fmuType = 77"),
        (Arguments { location: None, ..usual() }, "fmuResourceLocation is null"),
        (Arguments { location: c("file:///nowhere/at/all"), ..usual() }, "scene.toml"),
        (Arguments { location: c("file://elsewhere/resources"), ..usual() }, "a directory of this machine"),
    ]
}

fn wrong_in_3(fmu: &Fmu) -> Vec<(Arguments, &'static str)> {
    let usual = || Arguments::of(fmu);
    vec![
        (Arguments { location: None, ..usual() }, "resourcePath is null"),
        (Arguments { location: c(""), ..usual() }, "resourcePath is empty"),
        (Arguments { location: c("resources"), ..usual() }, "resourcePath \"resources\""),
        (Arguments { location: c("/nowhere/at/all/"), ..usual() }, "scene.toml"),
        (Arguments { event_mode_used: 255, ..usual() }, "eventModeUsed = 255: expected fmi3False (0) or fmi3True (1)"),
        (
            Arguments { early_return_allowed: 2, ..usual() },
            "earlyReturnAllowed = 2: expected fmi3False (0) or fmi3True (1)",
        ),
    ]
}

#[test]
fn what_is_missing_or_wrong_is_logged_and_there_is_no_instance() {
    for fmu in Fmu::both(SCENE) {
        let (call, _) = words(&fmu);
        for (arguments, expected) in wrong(&fmu) {
            let (instance, log) = fmu.instantiate(&arguments);
            assert!(instance.is_none(), "{expected}");
            assert!(log.len() == 1 && log[0].message.contains(&expected), "{expected}: {log:?}");
            assert!(log[0].message.starts_with(&format!("{call}: ")), "{log:?}");
            assert_eq!((log[0].status, log[0].category.as_str()), (ERROR, "logStatusError"));
        }
    }
}

#[test]
fn all_wrong_arguments_are_named_at_once() {
    for fmu in Fmu::both(SCENE) {
        let nothing = Arguments { name: None, guid: None, location: None, logging_on: 2, ..Arguments::of(&fmu) };
        let all = Arguments { kind: 5, event_mode_used: 2, early_return_allowed: 2, ..nothing };
        let (_, log) = fmu.instantiate(&all);
        assert_eq!(log.len(), fmu.either(5, 6), "{log:?}");
    }
}

#[test]
fn no_logger_is_needed() {
    for fmu in Fmu::both(SCENE) {
        let silent = || Arguments { with_logger: false, ..Arguments::of(&fmu) };
        let instance = fmu.instance_with(&silent());
        assert_eq!(instance.step(0.0, 0.1), ERROR, "it is not started");
        assert_eq!(instance.reset(), OK);
        instance.start();
        assert_eq!(instance.step(7.0, 0.1), ERROR);
        assert!(fmu.instantiate(&Arguments { guid: None, ..silent() }).0.is_none());
        assert!(fmu.instantiate(&Arguments { guid: c("wrong"), ..silent() }).0.is_none());
    }
}

/// A place that has to be escaped in a URI, with a copy of the resources.
fn odd_place(fmu: &Fmu) -> String {
    let odd = fmu.directory.path().join("a b %41 #ü 100%").join("resources");
    fs::create_dir_all(&odd).unwrap();
    for file in ["scene.toml", "record.csv"] {
        fs::copy(fmu.resources().join(file), odd.join(file)).unwrap();
    }
    odd.to_str().unwrap().to_owned()
}

/// In FMI 2.0 a URI, escaped or not, or a path; in FMI 3.0 a path, in which nothing is escaped.
fn spellings(fmu: &Fmu, plain: &str) -> Vec<String> {
    let of_3 = vec![plain.to_owned(), format!("{plain}/")];
    let plain = plain.replace('\\', "/");
    let path = plain.trim_start_matches('/');
    let escaped = path.replace('%', "%25").replace(' ', "%20").replace('#', "%23").replace('ü', "%C3%BC");
    let of_2 = vec![
        format!("file:/{escaped}"),
        format!("file:///{escaped}"),
        format!("file:///{escaped}/"),
        format!("file://localhost/{escaped}"),
        format!("file:////{escaped}"),
        format!("file:///{path}"),
        plain.clone(),
    ];
    fmu.either(of_2, of_3)
}

#[test]
fn every_spelling_of_the_resource_location() {
    for fmu in Fmu::both(RECORD_SCENE) {
        for location in spellings(&fmu, &odd_place(&fmu)) {
            let (instance, log) = fmu.instantiate(&Arguments { location: c(&location), ..Arguments::of(&fmu) });
            assert!(instance.is_some(), "{location}: {log:?}");
        }
    }
}

#[test]
fn altered_resources_do_not_pass() {
    for (file, text) in [("scene.toml", "\n# a comment\n"), ("record.csv", "99.0,0.0\n")] {
        let both = Fmu::both(RECORD_SCENE);
        append(&both[0], file, text);
        for fmu in both {
            let (instance, log) = fmu.instantiate(&Arguments::of(&fmu));
            assert!(instance.is_none());
            let (_, guid) = words(&fmu);
            assert!(log[0].message.contains(&fmu.guid) && log[0].message.contains(guid), "{log:?}");
        }
    }
}

fn append(fmu: &Fmu, file: &str, text: &str) {
    let path = fmu.resources().join(file);
    let mut bytes = fs::read(&path).unwrap();
    bytes.extend_from_slice(text.as_bytes());
    fs::write(path, bytes).unwrap();
}

#[test]
fn all_problems_of_a_damaged_scene_are_logged() {
    let damaged = SCENE.replace("restitution = 0.65", "restitution = 1.4").replace("gap = 0.002", "gap = nan");
    for fmu in Fmu::both(SCENE) {
        fs::write(fmu.resources().join("scene.toml"), &damaged).unwrap();
        let (instance, log) = fmu.instantiate(&Arguments::of(&fmu));
        assert!(instance.is_none());
        let messages = log.iter().map(|line| line.message.as_str()).collect::<Vec<_>>();
        assert_eq!(messages.len(), 3, "{messages:?}");
        assert!(messages.iter().any(|m| m.contains("contact[1].restitution = 1.4")), "{messages:?}");
    }
}

#[test]
fn a_missing_record_is_named() {
    let both = Fmu::both(RECORD_SCENE);
    fs::remove_file(both[0].resources().join("record.csv")).unwrap();
    for fmu in both {
        let (instance, log) = fmu.instantiate(&Arguments::of(&fmu));
        assert!(instance.is_none());
        assert!(log[0].message.contains("ground.record") && log[0].message.contains("record.csv"), "{log:?}");
    }
}

#[test]
fn a_path_may_be_the_name_of_an_instance() {
    for fmu in Fmu::both(SCENE) {
        let name = uri(&fmu.directory.path().join("x.fmu"));
        let instance = fmu.instance_with(&Arguments { name: c(&name), ..Arguments::of(&fmu) });
        assert_eq!(instance.terminate(), ERROR);
        assert_eq!(instance.log()[0].instance, fmu.either(Some(name), None));
    }
}
