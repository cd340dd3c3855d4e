//! Derivatives of outputs with respect to time.

use crate::support::*;
use std::ffi::c_int;

#[test]
fn derivatives_that_are_other_outputs() {
    for fmu in Fmu::both(SCENE) {
        let instance = fmu.instance();
        instance.start();
        for (name, value) in [("ground.acceleration", 1.3), ("right.force[2]", -2.0)] {
            assert_eq!(instance.set_real(name, value), OK);
        }
        let mut closed = false;
        for k in 0..200 {
            assert_eq!(instance.step(f64::from(k) * 0.003, 0.003), OK);
            for (side, floors) in [("left", 2), ("right", 3)] {
                for i in 1..=floors {
                    let of = |quantity: &str| format!("{side}.{quantity}[{i}]");
                    assert_eq!(instance.rate(&of("displacement"), 1), Ok(instance.real(&of("velocity"))));
                    let relative = instance.real(&of("acceleration")) - 1.3;
                    for (quantity, order) in [("displacement", 2), ("velocity", 1)] {
                        let found = instance.rate(&of(quantity), order).unwrap();
                        assert!((found - relative).abs() < 1e-11 * relative.abs().max(10.0), "{found} and {relative}");
                    }
                }
            }
            for p in 1..=2 {
                let of = |quantity: &str| format!("contact[{p}].{quantity}");
                let force = instance.real(&of("force"));
                assert_eq!(instance.rate(&of("impulse"), 1), Ok(force));
                assert_eq!(instance.rate(&of("impulse"), 2), instance.rate(&of("force"), 1));
                let closing = instance.rate(&of("penetration"), 1).unwrap();
                let facing =
                    instance.real(&format!("left.velocity[{p}]")) - instance.real(&format!("right.velocity[{p}]"));
                assert!((closing - facing).abs() < 1e-12, "{closing} and {facing}");
                assert_eq!(instance.rate(&of("dissipated_energy"), 1), Ok(force * closing));
                assert_eq!(instance.rate(&of("approach_velocity"), 1), Ok(0.0));
                closed |= force != 0.0;
            }
        }
        assert!(closed);
    }
}

#[test]
fn output_derivatives_that_there_are_not() {
    for fmu in Fmu::both(SCENE) {
        for (name, order, expected) in [
            ("left.displacement[1]", 0, "derivative of order 0: expected order 1 to 2"),
            ("left.displacement[1]", 3, "derivative of order 3: expected order 1 to 2"),
            ("left.displacement[1]", c_int::MIN, "expected order 1 to 2"),
            ("left.displacement[1]", c_int::MAX, "expected order 1 to 2"),
            ("left.displacement[1]", -1, "expected order 1 to 2"),
            ("impacts", 1, "impacts (value reference"),
            ("contact[1].active", 1, fmu.either("is Boolean, not Real", "is Boolean, not Float64")),
            ("left.mass[1]", 1, "left.mass[1]: expected an output"),
            ("left.force[1]", 1, "left.force[1]: expected an output"),
        ] {
            let instance = fmu.instance();
            instance.start();
            assert_eq!(instance.rate(name, order), Err(DISCARD), "{name}");
            let log = instance.log();
            assert!(log.len() == 1 && log[0].message.contains(expected), "{name}: {log:?}");
            assert_eq!((log[0].category.as_str(), instance.step(0.0, 0.1)), ("logStatusDiscard", OK));
        }
    }
}
