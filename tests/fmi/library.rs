//! A shared library as it is in an FMU: which functions it exports, and that a run through it is that of the linked ones.

#[path = "../../fmu-build/src/functions.rs"]
mod functions;
#[path = "../support/library.rs"]
mod path;

use crate::support::*;
use functions::functions;
use libloading::Library;
use object::Object;
use path::library_path;
use pounding::FmiVersion;
use std::collections::BTreeSet;
use std::ffi::{CStr, c_char, c_int, c_void};
use std::ptr::null;

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

fn load() -> Library {
    // SAFETY: the library has no initialisers of its own.
    unsafe { Library::new(library_path()) }.unwrap()
}

/// A function by its name.
///
/// # Safety
///
/// The type is that which the standard gives the function.
unsafe fn symbol<T: Copy>(library: &Library, name: &str) -> T {
    // SAFETY: the caller's contract.
    unsafe { *library.get::<T>(name).unwrap_or_else(|error| panic!("{name}: {error}")) }
}

#[test]
fn every_function_is_found_by_name() {
    let library = load();
    for name in both() {
        // SAFETY: it is not called.
        let _ = unsafe { symbol::<unsafe extern "C" fn()>(&library, name) };
    }
}

#[test]
fn version_and_platform() {
    let library = load();
    for (name, expected) in
        [("fmi2GetVersion", c"2.0"), ("fmi2GetTypesPlatform", c"default"), ("fmi3GetVersion", c"3.0")]
    {
        // SAFETY: they take nothing and return a constant string.
        let found = unsafe { CStr::from_ptr(symbol::<unsafe extern "C" fn() -> *const c_char>(&library, name)()) };
        assert_eq!(found, expected);
    }
}

type Text = *const c_char;
type Instantiate = unsafe extern "C" fn(Text, c_int, Text, Text, *const CallbackFunctions, c_int, c_int) -> Component;
type Get = unsafe extern "C" fn(Component, *const u32, usize, *mut f64) -> c_int;
type Step = unsafe extern "C" fn(Component, f64, f64, c_int) -> c_int;

/// The bits of a few outputs along a run with impacts, by functions that are found by name.
fn loaded(fmu: &Fmu, vr: &[u32]) -> Vec<Vec<u64>> {
    let (library, arguments) = (load(), Arguments::of(fmu));
    let text = |text: &Option<std::ffi::CString>| text.as_ref().unwrap().as_ptr();
    let [allocate_memory, free_memory, step_finished] = [null::<c_void>(); 3];
    let component_environment = std::ptr::null_mut();
    let none = CallbackFunctions { logger: None, allocate_memory, free_memory, step_finished, component_environment };
    // SAFETY: the types of the standard, strings that end with a zero, room for all values.
    unsafe {
        let instantiate: Instantiate = symbol(&library, "fmi2Instantiate");
        let (guid, location) = (text(&arguments.guid), text(&arguments.location));
        let c = instantiate(c"loaded".as_ptr(), 1, guid, location, &raw const none, 0, 0);
        assert!(!c.is_null());
        for name in ["fmi2EnterInitializationMode", "fmi2ExitInitializationMode"] {
            assert_eq!(symbol::<Plain>(&library, name)(c), OK, "{name}");
        }
        let (step, get): (Step, Get) = (symbol(&library, "fmi2DoStep"), symbol(&library, "fmi2GetReal"));
        let rows = (0..20).map(|k| {
            let mut values = vec![f64::NAN; vr.len()];
            assert_eq!(step(c, f64::from(k) * 0.05, 0.05, 1), OK);
            assert_eq!(get(c, vr.as_ptr(), vr.len(), values.as_mut_ptr()), OK);
            values.into_iter().map(f64::to_bits).collect()
        });
        let rows = rows.collect();
        symbol::<unsafe extern "C" fn(Component)>(&library, "fmi2FreeInstance")(c);
        rows
    }
}

#[test]
fn a_run_through_the_loaded_library_has_the_bits_of_the_linked_functions() {
    let fmu = Fmu::new(SCENE);
    let vr = fmu.vrs(["left.displacement[2]", "right.acceleration[3]", "contact[1].impulse"]);
    let instance = fmu.instance();
    instance.start();
    let linked = (0..20).map(|k| {
        assert_eq!(instance.step(f64::from(k) * 0.05, 0.05), OK);
        instance.reals(&vr).unwrap().into_iter().map(f64::to_bits).collect::<Vec<_>>()
    });
    let linked: Vec<_> = linked.collect();
    assert!(instance.integer("impacts") > 0);
    assert_eq!(loaded(&fmu, &vr), linked);
}
