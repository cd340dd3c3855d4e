//! Arguments that `fmi2Instantiate` does not have, and how little `fmi3InstantiateCoSimulation` needs.

use crate::support::*;
use std::ffi::CString;
use std::ptr::{null, null_mut};

#[test]
fn what_is_not_offered_is_not_looked_at() {
    let fmu = Fmu::v3(SCENE);
    for (required, n_required) in [(None, 0), (None, 3), (Some(vec![0, 4711, u32::MAX]), 3), (None, usize::MAX)] {
        let arguments = Arguments { required, n_required, visible: 255, ..Arguments::of(&fmu) };
        let (instance, log) = fmu.instantiate(&arguments);
        assert!(instance.is_some(), "{n_required}: {log:?}");
    }
}

#[test]
fn nothing_but_strings_is_needed() {
    let fmu = Fmu::v3(SCENE);
    let Arguments { name, guid, location, .. } = Arguments::of(&fmu);
    let text = |text: &Option<CString>| text.as_ref().unwrap().as_ptr();
    // SAFETY: strings that end with a zero; all else may be null.
    unsafe {
        let component = fmi3InstantiateCoSimulation(
            text(&name),
            text(&guid),
            text(&location),
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
        fmi3FreeInstance(component);
        fmi3FreeInstance(null_mut());
    }
}

#[cfg(unix)]
#[test]
fn a_relative_path_starts_at_the_directory_of_the_process() {
    let fmu = Fmu::v3(SCENE);
    let depth = std::env::current_dir().unwrap().components().count() - 1;
    let path = format!("{}{}", "../".repeat(depth), fmu.resources().to_str().unwrap().trim_start_matches('/'));
    let (instance, log) = fmu.instantiate(&Arguments { location: c(&path), ..Arguments::of(&fmu) });
    assert!(instance.is_some(), "{path}: {log:?}");
}
