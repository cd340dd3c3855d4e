//! `fmi3InstantiateCoSimulation`: which calls give an instance, and what the others say.

use crate::linked_3::{Arguments, Fmu, fmi3InstantiateCoSimulation};
use crate::support::{RECORD_SCENE, SCENE};
use std::ffi::CString;
use std::fs;
use std::ptr::{null, null_mut};

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
        (Arguments { token: None, ..usual() }, "instantiationToken is null"),
        (Arguments { token: c("{00000000-0000-0000-0000-000000000000}"), ..usual() }, &*fmu.token),
        (Arguments { token: c(""), ..usual() }, "instantiationToken \"\""),
        (Arguments { path: None, ..usual() }, "resourcePath is null"),
        (Arguments { path: c(""), ..usual() }, "resourcePath is empty"),
        (Arguments { path: c("resources"), ..usual() }, "resourcePath \"resources\""),
        (Arguments { path: c("/nowhere/at/all/"), ..usual() }, "scene.toml"),
        (Arguments { flags: [2, 1, 1], ..usual() }, "loggingOn = 2: expected fmi3False (0) or fmi3True (1)"),
        (Arguments { flags: [1, 255, 1], ..usual() }, "eventModeUsed = 255: expected fmi3False (0) or fmi3True (1)"),
        (Arguments { flags: [1, 1, 2], ..usual() }, "earlyReturnAllowed = 2: expected fmi3False (0) or fmi3True (1)"),
    ] {
        let (instance, log) = fmu.instantiate(&arguments);
        assert!(instance.is_none(), "{expected}");
        assert!(log.len() == 1 && log[0].message.contains(expected), "{expected}: {log:?}");
        assert!(log[0].message.starts_with("fmi3InstantiateCoSimulation: "), "{log:?}");
        assert_eq!((log[0].status, log[0].category.as_str()), (3, "logStatusError"));
    }
}

#[test]
fn all_wrong_arguments_are_named_at_once() {
    let fmu = Fmu::new(SCENE);
    let flags = [2, 2, 2];
    let (_, log) = fmu.instantiate(&Arguments { name: None, token: None, path: None, flags, ..Arguments::of(&fmu) });
    assert_eq!(log.len(), 6, "{log:?}");
}

#[test]
fn what_is_not_offered_is_not_looked_at() {
    let fmu = Fmu::new(SCENE);
    for (required, n_required) in [(None, 0), (None, 3), (Some(vec![0, 4711, u32::MAX]), 3), (None, usize::MAX)] {
        let arguments = Arguments { required, n_required, visible: 255, ..Arguments::of(&fmu) };
        let (instance, log) = fmu.instantiate(&arguments);
        assert!(instance.is_some(), "{n_required}: {log:?}");
    }
}

#[test]
fn nothing_but_strings_is_needed() {
    let fmu = Fmu::new(SCENE);
    let Arguments { name, token, path, .. } = Arguments::of(&fmu);
    let text = |text: &Option<CString>| text.as_ref().unwrap().as_ptr();
    // SAFETY: strings that end with a zero; all else may be null.
    unsafe {
        let component = fmi3InstantiateCoSimulation(
            text(&name),
            text(&token),
            text(&path),
            0,
            0,
            0,
            0,
            null(),
            0,
            null_mut(),
            None,
            None,
        );
        assert!(!component.is_null());
        crate::linked_3::fmi3FreeInstance(component);
        crate::linked_3::fmi3FreeInstance(null_mut());
    }
}

#[test]
fn paths_of_every_kind() {
    let fmu = Fmu::new(RECORD_SCENE);
    let odd = fmu.directory.path().join("a b %41 #ü 100%").join("resources");
    fs::create_dir_all(&odd).unwrap();
    for file in ["scene.toml", "record.csv"] {
        fs::copy(fmu.resources().join(file), odd.join(file)).unwrap();
    }
    let plain = odd.to_str().unwrap();
    for path in [plain.to_owned(), format!("{plain}/")] {
        let (instance, log) = fmu.instantiate(&Arguments { path: c(&path), ..Arguments::of(&fmu) });
        assert!(instance.is_some(), "{path}: {log:?}");
    }
}

#[cfg(unix)]
#[test]
fn a_relative_path_starts_at_the_directory_of_the_process() {
    let fmu = Fmu::new(SCENE);
    let depth = std::env::current_dir().unwrap().components().count() - 1;
    let path = format!("{}{}", "../".repeat(depth), fmu.resources().to_str().unwrap().trim_start_matches('/'));
    let (instance, log) = fmu.instantiate(&Arguments { path: c(&path), ..Arguments::of(&fmu) });
    assert!(instance.is_some(), "{path}: {log:?}");
}

#[test]
fn altered_resources_do_not_pass() {
    let fmu = Fmu::new(RECORD_SCENE);
    let path = fmu.resources().join("record.csv");
    fs::write(&path, format!("{}99.0,0.0\n", fs::read_to_string(&path).unwrap())).unwrap();
    let (instance, log) = fmu.instantiate(&Arguments::of(&fmu));
    assert!(instance.is_none());
    assert!(log[0].message.contains(&fmu.token) && log[0].message.contains("instantiationToken"), "{log:?}");
}
