//! An instance of one version in the hands of functions of the other.

use crate::support::*;
use std::ptr::{null, null_mut};

#[test]
fn an_instance_of_the_other_version_is_refused_by_every_kind_of_function() {
    let [of_2, fmu] = Fmu::both(SCENE);
    let (instance_2, three) = (of_2.instance(), fmu.with_flags(true, true));
    let (two, c) = (instance_2.component, three.component);
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
    let found = instance_2.log();
    assert_eq!(found.len(), of_3.len());
    for ((name, status), line) in of_3.into_iter().zip(found) {
        assert_eq!((status, line.status), (ERROR, ERROR), "{name}");
        let expected = format!("{name}: the instance is one of FMI 2.0: expected one of FMI 3.0");
        assert_eq!(line.message, expected);
    }
    assert_eq!(value, 5.0, "nothing has been read");
    assert_eq!(three.call(fmi3Reset), OK);
    three.initialize();
    assert_eq!(instance_2.reset(), OK);
}
