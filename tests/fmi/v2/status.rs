//! The status functions, which FMI 2.0 has alone, and functions for variables of types that nothing can be set of.

use crate::support::*;
use std::ffi::c_int;
use std::ptr::null_mut;

fn started(fmu: &Fmu) -> Instance<'_> {
    let instance = fmu.instance();
    instance.start();
    instance
}

#[test]
fn status_information() {
    let fmu = Fmu::new(SCENE);
    let instance = started(&fmu);
    let c = instance.component;
    let real = |kind: c_int, place: *mut f64| {
        // SAFETY: a live instance, and a place or null.
        unsafe { fmi2GetRealStatus(c, kind, place) }
    };
    assert_eq!(instance.step(0.0, 0.25), OK);
    let (mut time, mut terminated) = (-1.0, -1);
    assert_eq!((real(2, &mut time), time), (OK, 0.25));
    // SAFETY: a live instance and places.
    unsafe {
        assert_eq!((fmi2GetBooleanStatus(c, 3, &mut terminated), terminated), (OK, 0));
        assert_eq!(fmi2GetStatus(c, 0, &mut 0), DISCARD);
    }
    assert_eq!(real(3, &mut time), DISCARD);
    assert_eq!(instance.step(0.25, 0.25), OK, "a discarded question does not stop the simulation");
    assert_eq!(real(2, null_mut()), ERROR);
}

/// FMI 2.0 has no other way to say that a run is over than to discard the step, and a status that says so.
#[test]
fn a_collapse_discards_the_step() {
    let fmu = Fmu::new(COLLAPSE);
    let instance = started(&fmu);
    for _ in 0..2 {
        assert_eq!(instance.step(0.0, 10.0), DISCARD, "{:?}", instance.log());
        let log = instance.log();
        let last = log.last().unwrap();
        assert_eq!((last.status, last.category.as_str()), (DISCARD, "logStatusDiscard"));
        let time = instance.time();
        assert!(time > 0.0 && time < 1.0, "{time} s");
        let (outputs, mut terminated) = (instance.outputs(), -1);
        // SAFETY: a live instance, and a place.
        assert_eq!((unsafe { fmi2GetBooleanStatus(instance.component, 3, &mut terminated) }, terminated), (OK, 1));
        assert_eq!(instance.step(time, 0.1), DISCARD);
        assert_eq!((instance.time(), instance.outputs()), (time, outputs));
        assert_eq!(instance.reset(), OK);
        instance.start();
    }
}

#[test]
fn what_is_set_by_the_function_of_another_type_is_not_set() {
    let fmu = Fmu::new(SCENE);
    let (mass, ground, impacts) = (fmu.vr("left.mass[1]"), fmu.vr("ground.acceleration"), fmu.vr("impacts"));
    let calls: [(&str, &dyn Fn(Component) -> c_int); 4] = [
        // SAFETY: of each: a live instance, one reference and one value.
        ("left.mass[1]", &|c| unsafe { fmi2SetInteger(c, &raw const mass, 1, &0) }),
        // SAFETY: as above.
        ("ground.acceleration", &|c| unsafe { fmi2SetBoolean(c, &raw const ground, 1, &0) }),
        // SAFETY: as above.
        ("left.mass[1]", &|c| unsafe { fmi2SetString(c, &raw const mass, 1, &c"".as_ptr()) }),
        // SAFETY: as above.
        ("impacts", &|c| unsafe { fmi2SetReal(c, &raw const impacts, 1, &0.0) }),
    ];
    for (name, set) in calls {
        let instance = fmu.instance();
        instance.enter();
        assert_eq!(set(instance.component), ERROR, "{name}");
        let message = instance.only_error();
        assert!(message.contains(name) && message.contains(", not "), "{message}");
        assert_eq!(instance.real("left.mass[1]"), 3.65);
    }
}
