//! `fmi2Instantiate`: which calls give an instance, and what the others say.

use crate::support::{Arguments, Fmu, OK, RECORD_SCENE, SCENE, uri};
use std::ffi::CString;
use std::fs;

fn c(text: &str) -> Option<CString> {
    Some(CString::new(text).unwrap())
}

#[test]
fn what_is_missing_or_wrong_is_logged_and_there_is_no_instance() {
    let fmu = Fmu::new(SCENE);
    let usual = || Arguments::of(&fmu);
    for (arguments, expected) in [
        (Arguments { name: None, ..usual() }, "instanceName is null"),
        (Arguments { name: c(""), ..usual() }, "instanceName is empty"),
        (Arguments { kind: 0, ..usual() }, "fmuType = 0"),
        (Arguments { kind: 77, ..usual() }, "fmuType = 77"),
        (Arguments { guid: None, ..usual() }, "fmuGUID is null"),
        (Arguments { guid: c("{00000000-0000-0000-0000-000000000000}"), ..usual() }, &*fmu.guid),
        (Arguments { location: None, ..usual() }, "fmuResourceLocation is null"),
        (Arguments { location: c("file:///nowhere/at/all"), ..usual() }, "scene.toml"),
        (Arguments { location: c("file://elsewhere/resources"), ..usual() }, "a directory of this machine"),
    ] {
        let (instance, log) = fmu.instantiate(&arguments);
        assert!(instance.is_none(), "{expected}");
        assert!(log.len() == 1 && log[0].message.contains(expected), "{expected}: {log:?}");
        assert_eq!((log[0].status, log[0].category.as_str()), (3, "logStatusError"));
    }
}

#[test]
fn all_wrong_arguments_are_named_at_once() {
    let fmu = Fmu::new(SCENE);
    let arguments = Arguments { name: None, kind: 5, guid: None, location: None, ..Arguments::of(&fmu) };
    let (_, log) = fmu.instantiate(&arguments);
    assert_eq!(log.len(), 4, "{log:?}");
}

#[test]
fn callbacks_are_needed_and_a_logger_is_not() {
    let fmu = Fmu::new(SCENE);
    assert!(fmu.instantiate(&Arguments { with_callbacks: false, ..Arguments::of(&fmu) }).0.is_none());
    let silent = Arguments { with_logger: false, ..Arguments::of(&fmu) };
    let (instance, _) = fmu.instantiate(&silent);
    let instance = instance.unwrap();
    instance.start();
    assert_ne!(instance.step(7.0, 0.1), OK);
    assert!(fmu.instantiate(&Arguments { guid: c("wrong"), ..silent }).0.is_none());
}

#[test]
fn every_spelling_of_the_resource_location() {
    let fmu = Fmu::new(RECORD_SCENE);
    let odd = fmu.directory.path().join("a b %41 #ü").join("resources");
    fs::create_dir_all(&odd).unwrap();
    for file in ["scene.toml", "record.csv"] {
        fs::copy(fmu.resources().join(file), odd.join(file)).unwrap();
    }
    let plain = odd.to_str().unwrap().replace('\\', "/");
    let path = plain.trim_start_matches('/');
    let escaped = path.replace('%', "%25").replace(' ', "%20").replace('#', "%23").replace('ü', "%C3%BC");
    for location in [
        format!("file:/{escaped}"),
        format!("file:///{escaped}"),
        format!("file:///{escaped}/"),
        format!("file://localhost/{escaped}"),
        format!("file:////{escaped}"),
        format!("file:///{path}"),
        plain,
    ] {
        let (instance, log) = fmu.instantiate(&Arguments { location: c(&location), ..Arguments::of(&fmu) });
        assert!(instance.is_some(), "{location}: {log:?}");
    }
}

#[test]
fn altered_resources_do_not_pass() {
    for alter in
        [|fmu: &Fmu| append(fmu, "scene.toml", "\n# a comment\n"), |fmu: &Fmu| append(fmu, "record.csv", "99.0,0.0\n")]
    {
        let fmu = Fmu::new(RECORD_SCENE);
        alter(&fmu);
        let (instance, log) = fmu.instantiate(&Arguments::of(&fmu));
        assert!(instance.is_none());
        assert!(log[0].message.contains(&fmu.guid) && log[0].message.contains("fmuGUID"), "{log:?}");
    }
}

#[test]
fn all_problems_of_a_damaged_scene_are_logged() {
    let fmu = Fmu::new(SCENE);
    let damaged = SCENE.replace("restitution = 0.65", "restitution = 1.4").replace("gap = 0.002", "gap = nan");
    fs::write(fmu.resources().join("scene.toml"), damaged).unwrap();
    let (instance, log) = fmu.instantiate(&Arguments::of(&fmu));
    assert!(instance.is_none());
    let messages = log.iter().map(|line| line.message.as_str()).collect::<Vec<_>>();
    assert_eq!(messages.len(), 3, "{messages:?}");
    assert!(messages.iter().any(|m| m.contains("contact[1].restitution = 1.4")), "{messages:?}");
}

#[test]
fn a_missing_record_is_named() {
    let fmu = Fmu::new(RECORD_SCENE);
    fs::remove_file(fmu.resources().join("record.csv")).unwrap();
    let (instance, log) = fmu.instantiate(&Arguments::of(&fmu));
    assert!(instance.is_none());
    assert!(log[0].message.contains("ground.record") && log[0].message.contains("record.csv"), "{log:?}");
}

#[test]
fn a_path_may_be_the_name_of_an_instance() {
    let fmu = Fmu::new(SCENE);
    let name = uri(&fmu.directory.path().join("x.fmu"));
    let (instance, _) = fmu.instantiate(&Arguments { name: c(&name), ..Arguments::of(&fmu) });
    let instance = instance.unwrap();
    instance.call("fmi2Terminate");
    assert_eq!(instance.log()[0].instance, name);
}

fn append(fmu: &Fmu, file: &str, text: &str) {
    let path = fmu.resources().join(file);
    let mut bytes = fs::read(&path).unwrap();
    bytes.extend_from_slice(text.as_bytes());
    fs::write(path, bytes).unwrap();
}
