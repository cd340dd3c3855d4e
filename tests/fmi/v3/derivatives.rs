//! Derivatives: adjoint and directional ones are of the same matrix; those with respect to time.

use crate::support::*;
use std::ffi::c_int;

type Partial =
    unsafe extern "C" fn(Component, *const u32, usize, *const u32, usize, *const f64, usize, *mut f64, usize) -> c_int;

fn partial(
    instance: &Instance<'_>,
    function: Partial,
    unknowns: &[u32],
    knowns: &[u32],
    seed: &[f64],
    n: usize,
) -> (c_int, Vec<f64>) {
    let mut found = vec![f64::NAN; n];
    let (u, k, s) = (unknowns.as_ptr(), knowns.as_ptr(), seed.as_ptr());
    // SAFETY: arrays of as many elements as announced.
    let status = unsafe {
        function(instance.component, u, unknowns.len(), k, knowns.len(), s, seed.len(), found.as_mut_ptr(), n)
    };
    (status, found)
}

/// By known, the derivative of each unknown.
fn columns(instance: &Instance<'_>, unknowns: &[u32], knowns: &[u32]) -> Vec<Vec<f64>> {
    let column = |k: usize| {
        let seed = (0..knowns.len()).map(|i| f64::from(u8::from(i == k))).collect::<Vec<_>>();
        let (status, found) = partial(instance, fmi3GetDirectionalDerivative, unknowns, knowns, &seed, unknowns.len());
        assert_eq!(status, OK, "{:?}", instance.log());
        found
    };
    (0..knowns.len()).map(column).collect()
}

fn check(instance: &Instance<'_>, unknowns: &[u32], knowns: &[u32]) {
    let columns = columns(instance, unknowns, knowns);
    let counts = columns.iter().filter(|column| column.iter().any(|value| *value != 0.0)).count();
    assert!(counts >= 2, "what is compared is not zero: {columns:?}");
    let seed = (0..unknowns.len()).map(|i| 1.0 / f64::from(u32::try_from(i).unwrap() + 3)).collect::<Vec<_>>();
    let (status, found) = partial(instance, fmi3GetAdjointDerivative, unknowns, knowns, &seed, knowns.len());
    assert_eq!(status, OK, "{:?}", instance.log());
    for (k, column) in columns.iter().enumerate() {
        let sum = column.iter().zip(&seed).map(|(value, seed)| value * seed).sum::<f64>();
        let size = column.iter().zip(&seed).map(|(value, seed)| (value * seed).abs()).sum::<f64>();
        assert!((found[k] - sum).abs() <= 1e-14 * size, "known {k}: {} and {sum}", found[k]);
    }
    // A seed for one unknown alone gives its row.
    for (u, _) in unknowns.iter().enumerate() {
        let seed = (0..unknowns.len()).map(|i| f64::from(u8::from(i == u))).collect::<Vec<_>>();
        let (_, row) = partial(instance, fmi3GetAdjointDerivative, unknowns, knowns, &seed, knowns.len());
        assert_eq!(row, columns.iter().map(|column| column[u]).collect::<Vec<_>>(), "unknown {u}");
    }
}

const UNKNOWNS: [&str; 5] = [
    "left.acceleration[1]",
    "left.acceleration[2]",
    "right.acceleration[1]",
    "right.acceleration[3]",
    "left.displacement[1]",
];
const KNOWNS: [&str; 3] = ["ground.acceleration", "left.force[1]", "right.force[3]"];

#[test]
fn the_adjoint_is_the_seed_times_the_columns() {
    let fmu = Fmu::v3(SCENE);
    let (unknowns, knowns) = (UNKNOWNS.map(|name| fmu.vr(name)), KNOWNS.map(|name| fmu.vr(name)));
    let instance = fmu.with_flags(true, true);
    assert_eq!(instance.enter_from(0.0, None), OK);
    let of_parameters = ["left.mass[1]", "left.stiffness[2]"].map(|name| fmu.vr(name));
    check(&instance, &["left.frequency[1]", "left.frequency[2]"].map(|name| fmu.vr(name)), &of_parameters);
    check(&instance, &unknowns, &knowns);
    instance.calls(&[fmi3ExitInitializationMode]);
    check(&instance, &unknowns, &knowns);
    instance.calls(&[fmi3EnterStepMode]);
    assert_eq!(instance.stepped(0.0, 1.0).1.event, 1);
    check(&instance, &unknowns, &knowns);
    instance.calls(&[fmi3EnterEventMode]);
    check(&instance, &unknowns, &knowns);
    instance.calls(&[fmi3Terminate]);
    check(&instance, &unknowns, &knowns);
}

#[test]
fn what_has_no_derivative_is_discarded_and_nothing_is_written() {
    let fmu = Fmu::v3(SCENE);
    let instance = fmu.instance();
    instance.initialize();
    let (acceleration, ground) = (fmu.vr("left.acceleration[1]"), fmu.vr("ground.acceleration"));
    for (unknown, known, seed) in [
        (fmu.vr("impacts"), ground, 1.0),
        (fmu.vr("time"), ground, 1.0),
        (u32::MAX, ground, 1.0),
        (acceleration, acceleration, 1.0),
        (acceleration, fmu.vr("left.mass[1]"), 1.0),
        (acceleration, fmu.vr("time"), 1.0),
        (acceleration, ground, f64::NAN),
    ] {
        for function in [fmi3GetDirectionalDerivative as Partial, fmi3GetAdjointDerivative] {
            let (status, found) = partial(&instance, function, &[unknown], &[known], &[seed], 1);
            assert_eq!((status, found[0].is_nan()), (DISCARD, true), "{unknown} {known} {seed}");
            let log = instance.log();
            assert!(!log.is_empty() && log.iter().all(|line| line.status == DISCARD), "{log:?}");
        }
    }
    assert_eq!(instance.stepped(0.0, 0.1).0, OK, "the run goes on");
}

#[test]
fn derivatives_with_respect_to_time() {
    let fmu = Fmu::v3(SCENE);
    let instance = fmu.with_flags(true, true);
    instance.start();
    assert_eq!(instance.stepped(0.0, 1.0).1.event, 1, "at an event that waits");
    let vr = ["left.displacement[1]", "left.displacement[1]", "left.velocity[1]"].map(|name| fmu.vr(name));
    let rates = |orders: [i32; 3]| {
        let mut values = [f64::NAN; 3];
        // SAFETY: three references, orders and values.
        let status = unsafe {
            fmi3GetOutputDerivatives(instance.component, vr.as_ptr(), 3, orders.as_ptr(), values.as_mut_ptr(), 3)
        };
        (status, values)
    };
    let (velocity, acceleration) = (instance.real("left.velocity[1]"), instance.real("left.acceleration[1]"));
    let (status, values) = rates([1, 2, 1]);
    assert_eq!((status, values[0]), (OK, velocity));
    for value in &values[1..] {
        assert!((value - acceleration).abs() < 1e-9 * acceleration.abs().max(1.0), "{values:?} {acceleration}");
    }
    for order in [0, 3, -1, i32::MAX] {
        assert_eq!(rates([order; 3]).0, DISCARD);
    }
}

#[test]
fn the_time_is_named_as_what_has_no_derivative() {
    const NONE: &str = "there are no derivatives of or with respect to the independent variable";
    let fmu = Fmu::v3(SCENE);
    let instance = fmu.instance();
    instance.initialize();
    let (acceleration, ground, time) = (fmu.vr("left.acceleration[1]"), fmu.vr("ground.acceleration"), fmu.vr("time"));
    let told = || instance.log().into_iter().map(|line| line.message).collect::<Vec<_>>();
    for (name, function) in [
        ("fmi3GetDirectionalDerivative", fmi3GetDirectionalDerivative as Partial),
        ("fmi3GetAdjointDerivative", fmi3GetAdjointDerivative),
    ] {
        partial(&instance, function, &[time], &[ground], &[1.0], 1);
        assert_eq!(told(), [format!("{name}: unknown time: {NONE}; expected an output of type Float64")]);
        partial(&instance, function, &[acceleration], &[time], &[1.0], 1);
        assert_eq!(told(), [format!("{name}: known time: {NONE}; expected an input of type Float64")]);
    }
    let mut value = f64::NAN;
    // SAFETY: one reference, order and value.
    let status = unsafe { fmi3GetOutputDerivatives(instance.component, &time, 1, &1, &mut value, 1) };
    assert_eq!((status, value.is_nan()), (DISCARD, true));
    let expected = "fmi3GetOutputDerivatives: time: the independent variable has no derivatives; expected an output";
    assert_eq!(told(), [expected]);
}
