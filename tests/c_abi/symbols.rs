//! What the library exports.

#[path = "../../fmu-build/src/functions.rs"]
mod functions;

use crate::support::{Fmu, SCENE, library_path};
use functions::functions;
use object::Object;
use pounding::FmiVersion;
use std::collections::BTreeSet;
use std::ffi::{CStr, c_char};

fn both() -> Vec<&'static str> {
    FmiVersion::ALL.map(functions).concat()
}

#[test]
fn exactly_the_functions_of_both_versions_are_exported() {
    let bytes = std::fs::read(library_path()).unwrap();
    let file = object::File::parse(&*bytes).unwrap();
    // On macOS C symbols begin with an underscore.
    let name = |name: Option<&[u8]>| String::from_utf8_lossy(name.unwrap()).trim_start_matches('_').to_owned();
    let exported = file.exports().unwrap().map(|export| name(export.unwrap().name().name())).collect::<BTreeSet<_>>();
    assert_eq!(exported, both().into_iter().map(str::to_owned).collect());
}

#[test]
fn every_function_is_found_by_name() {
    let fmu = Fmu::new(SCENE);
    for name in both() {
        let _ = fmu.symbol::<unsafe extern "C" fn()>(name);
    }
}

#[test]
fn version_and_platform() {
    let fmu = Fmu::new(SCENE);
    for (function, expected) in
        [("fmi2GetVersion", c"2.0"), ("fmi2GetTypesPlatform", c"default"), ("fmi3GetVersion", c"3.0")]
    {
        let function = fmu.symbol::<unsafe extern "C" fn() -> *const c_char>(function);
        // SAFETY: they take nothing and return a constant string.
        assert_eq!(unsafe { CStr::from_ptr(function()) }, expected);
    }
}
