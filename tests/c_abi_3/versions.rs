//! An instance of one version in the hands of functions of the other.

use crate::linked_3::*;
use crate::support::SCENE;
use std::ffi::{CString, c_char, c_int, c_void};
use std::ptr::{null, null_mut};

/// `fmi2CallbackLogger`, to which no variable arguments are passed.
unsafe extern "C" fn note_2(
    environment: *mut c_void,
    _name: *const c_char,
    status: c_int,
    category: *const c_char,
    text: *const c_char,
) {
    // SAFETY: what FMI 2.0 passes beyond FMI 3.0 is the name.
    unsafe { note(environment, status, category, text) }
}

/// An instance of FMI 2.0.
fn instance_2(fmu: &Fmu, log: &Log) -> Component {
    type Note = unsafe extern "C" fn(*mut c_void, *const c_char, c_int, *const c_char, *const c_char);
    type Variadic = unsafe extern "C" fn(*mut c_void, *const c_char, c_int, *const c_char, *const c_char, ...);
    // SAFETY: the logger is called without variable arguments.
    let logger = unsafe { std::mem::transmute::<Note, Variadic>(note_2) };
    let callbacks = CallbackFunctions {
        logger: Some(logger),
        allocate_memory: null(),
        free_memory: null(),
        step_finished: null(),
        component_environment: environment(log),
    };
    let text = |text: &str| CString::new(text).unwrap();
    let (guid, path) = (text(&fmu.package.guid(pounding::FmiVersion::V2)), text(fmu.resources().to_str().unwrap()));
    // SAFETY: strings that end with a zero, and callbacks that outlive the instance.
    let component =
        unsafe { fmi2Instantiate(c"two".as_ptr(), 1, guid.as_ptr(), path.as_ptr(), &raw const callbacks, 0, 1) };
    assert!(!component.is_null(), "{:?}", log.lines.take());
    component
}

#[test]
fn an_instance_of_the_other_version_is_refused_by_every_kind_of_function() {
    let fmu = Fmu::new(SCENE);
    let log = Log::default();
    let two = instance_2(&fmu, &log);
    let three = fmu.instance(true, true);
    let c = three.component;
    let (vr, mut value) = (fmu.vr("left.displacement[1]"), 5.0);
    // SAFETY: live instances, one reference and one value.
    let of_2 = unsafe {
        [
            ("fmi2EnterInitializationMode", fmi2EnterInitializationMode(c)),
            ("fmi2SetupExperiment", fmi2SetupExperiment(c, 0, 0.0, 0.0, 0, 0.0)),
            ("fmi2GetReal", fmi2GetReal(c, &raw const vr, 1, &raw mut value)),
            ("fmi2DoStep", fmi2DoStep(c, 0.0, 0.1, 1)),
            ("fmi2CancelStep", fmi2CancelStep(c)),
            ("fmi2Reset", fmi2Reset(c)),
        ]
    };
    let found = three.log();
    assert_eq!(found.len(), of_2.len());
    for ((name, status), line) in of_2.into_iter().zip(found) {
        assert_eq!((status, line.status), (ERROR, ERROR), "{name}");
        let expected = format!("{name}: the instance is one of FMI 3.0: expected one of FMI 2.0");
        assert_eq!(line.message, expected);
    }
    // SAFETY: live instances, one reference and one value.
    let of_3 = unsafe {
        [
            ("fmi3EnterInitializationMode", fmi3EnterInitializationMode(two, 0, 0.0, 0.0, 0, 0.0)),
            ("fmi3GetFloat64", fmi3GetFloat64(two, &raw const vr, 1, &raw mut value, 1)),
            ("fmi3EnterEventMode", fmi3EnterEventMode(two)),
            ("fmi3GetAdjointDerivative", {
                fmi3GetAdjointDerivative(two, null(), 0, null(), 0, null(), 0, null_mut(), 0)
            }),
            ("fmi3GetInt8", fmi3GetInt8(two, null(), 0, null_mut(), 0)),
            ("fmi3Reset", fmi3Reset(two)),
        ]
    };
    let found = log.lines.take();
    assert_eq!(found.len(), of_3.len());
    for ((name, status), line) in of_3.into_iter().zip(found) {
        assert_eq!((status, line.status), (ERROR, ERROR), "{name}");
        let expected = format!("{name}: the instance is one of FMI 2.0: expected one of FMI 3.0");
        assert_eq!(line.message, expected);
    }
    assert_eq!(value, 5.0, "nothing has been read");
    assert_eq!(three.call(fmi3Reset), OK);
    three.initialize();
    // SAFETY: alive, of FMI 2.0, and not used afterwards.
    unsafe {
        assert_eq!(fmi2Reset(two), OK);
        fmi2FreeInstance(two);
    }
}
