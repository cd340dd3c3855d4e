//! Derivatives of inputs and outputs.

use super::edge::{edge, misaligned};
use super::rows::{Row, row};
use super::target::Target;
use std::ffi::c_int;
use std::ptr::{null, null_mut};

/// Columns: instantiated, initialization, step complete, terminated, error, no instance.
const SET: &str = "oooeee";
const GET: &str = "eeoooe";
const DIRECTIONAL: &str = "eooooe";
const NEVER: &str = "eeeeee";
/// Questions that have no answer, where the question may be asked.
const NO_ANSWER: &str = "eeddde";
const NO_DIRECTIONAL: &str = "edddde";

const NO_SIZES: [usize; 3] = [usize::MAX, usize::MAX / 2, usize::MAX / 16 + 1];
const INPUT: &str = "left.force[1]";
const OUTPUT: &str = "left.displacement[1]";

pub fn rows() -> Vec<Row> {
    let pairs = [
        ("fmi2SetRealInputDerivatives", [SET, NEVER], INPUT),
        ("fmi2GetRealOutputDerivatives", [GET, NO_ANSWER], OUTPUT),
    ];
    let both = pairs.into_iter().flat_map(|(function, expected, good)| in_time(function, expected, good));
    both.chain(of_inputs()).chain(of_outputs()).chain(directional()).chain(directional_arrays()).collect()
}

fn in_time(function: &'static str, [allowed, refused]: [&'static str; 2], good: &'static str) -> Vec<Row> {
    let name = |what: &str| format!("{function}: {what}");
    let order = |order: c_int| {
        row(&name(&format!("order {order}")), refused, move |t| one(t, function, t.vr(good), order, 0.0))
    };
    let mut rows = vec![
        row(&name("nothing, null arrays"), allowed, |t| t.derivatives(function, null(), 0, null(), null_mut())),
        row(&name("null references"), NEVER, |t| t.derivatives(function, null(), 1, edge(&[1]), edge(&[0.0]))),
        row(&name("null orders"), NEVER, |t| t.derivatives(function, edge(&[t.vr(good)]), 1, null(), edge(&[0.0]))),
        row(&name("null values"), NEVER, |t| t.derivatives(function, edge(&[t.vr(good)]), 1, edge(&[1]), null_mut())),
        row(&name("misaligned values"), NEVER, |t| {
            t.derivatives(function, edge(&[t.vr(good)]), 1, edge(&[1]), misaligned())
        }),
        row(&name("a good reference"), allowed, |t| one(t, function, t.vr(good), 1, 0.0)),
        row(&name("the same reference many times"), allowed, |t| {
            let n = 1000;
            t.derivatives(function, edge(&vec![t.vr(good); n]), n, edge(&vec![1; n]), edge(&vec![0.0; n]))
        }),
        row(&name("an unknown reference"), refused, |t| one(t, function, u32::MAX, 1, 0.0)),
        row(&name("an Integer"), refused, |t| one(t, function, t.vr("impacts"), 1, 0.0)),
        row(&name("a Boolean"), refused, |t| one(t, function, t.vr("contact[1].active"), 1, 0.0)),
        row(&name("a parameter"), refused, |t| one(t, function, t.vr("right.mass[1]"), 1, 0.0)),
        order(0),
        order(-1),
        order(3),
        order(c_int::MAX),
        order(c_int::MIN),
    ];
    rows.extend(NO_SIZES.map(|n| {
        row(&name(&format!("{n} values")), NEVER, move |t| {
            t.derivatives(function, edge(&[t.vr(good)]), n, edge(&[1]), edge(&[0.0]))
        })
    }));
    rows
}

fn one(t: &Target<'_>, function: &str, vr: u32, order: c_int, value: f64) -> c_int {
    t.derivatives(function, edge(&[vr]), 1, edge(&[order]), edge(&[value]))
}

fn of_inputs() -> Vec<Row> {
    let function = "fmi2SetRealInputDerivatives";
    let rate = |rate: f64, expected| {
        row(&format!("{function}: rate {rate:e}"), expected, move |t| one(t, function, t.vr(INPUT), 1, rate))
    };
    vec![
        rate(f64::NAN, NEVER),
        rate(f64::INFINITY, NEVER),
        rate(f64::NEG_INFINITY, NEVER),
        rate(f64::MAX, SET),
        row(&format!("{function}: order 2, which no input has"), NEVER, |t| one(t, function, t.vr(INPUT), 2, 0.0)),
        row(&format!("{function}: an output"), NEVER, |t| one(t, function, t.vr(OUTPUT), 1, 0.0)),
        row(&format!("{function}: the largest rate, then a step"), "xxxeee", |t| {
            one(t, function, t.vr(INPUT), 1, f64::MAX).max(t.step(0.0, 0.1))
        }),
    ]
}

fn of_outputs() -> Vec<Row> {
    let function = "fmi2GetRealOutputDerivatives";
    vec![
        row(&format!("{function}: order 2"), GET, |t| one(t, function, t.vr(OUTPUT), 2, 0.0)),
        row(&format!("{function}: an input"), NO_ANSWER, |t| one(t, function, t.vr(INPUT), 1, 0.0)),
        row(&format!("{function}: a calculated parameter"), NO_ANSWER, |t| {
            one(t, function, t.vr("left.frequency[1]"), 1, 0.0)
        }),
    ]
}

fn directional() -> Vec<Row> {
    let name = |what: &str| format!("fmi2GetDirectionalDerivative: {what}");
    let of = |what: &str, expected, unknown: &'static str, known: &'static str, seed: f64| {
        row(&name(what), expected, move |t| {
            t.directional((edge(&[t.vr(unknown)]), 1), (edge(&[t.vr(known)]), 1), edge(&[seed]), edge(&[0.0]))
        })
    };
    vec![
        of("an acceleration by a force", DIRECTIONAL, "left.acceleration[1]", INPUT, 1.0),
        of("a seed of 0", DIRECTIONAL, "left.acceleration[1]", INPUT, 0.0),
        of("a seed of NaN", NO_DIRECTIONAL, "left.acceleration[1]", INPUT, f64::NAN),
        of("an infinite seed", NO_DIRECTIONAL, "left.acceleration[1]", INPUT, f64::INFINITY),
        of("the largest seed", "exxxxe", "left.acceleration[1]", INPUT, f64::MAX),
        of("an output as known", NO_DIRECTIONAL, OUTPUT, OUTPUT, 1.0),
        of("an input as unknown", NO_DIRECTIONAL, INPUT, INPUT, 1.0),
        of("an Integer as unknown", NO_DIRECTIONAL, "impacts", INPUT, 1.0),
        of("a Boolean as known", NO_DIRECTIONAL, OUTPUT, "contact[1].active", 1.0),
        of("a String as known", NO_DIRECTIONAL, OUTPUT, "ground.record", 1.0),
        of("a parameter as known, only in initialization", "eoddde", "left.frequency[1]", "right.mass[1]", 1.0),
    ]
}

fn directional_arrays() -> Vec<Row> {
    let name = |what: &str| format!("fmi2GetDirectionalDerivative: {what}");
    let unknowns = |t: &Target<'_>, n: usize| (edge(&vec![t.vr("left.acceleration[1]"); n]).cast_const(), n);
    let knowns = |t: &Target<'_>, n: usize| (edge(&vec![t.vr(INPUT); n]).cast_const(), n);
    let mut rows = vec![
        row(&name("nothing, null arrays"), DIRECTIONAL, |t| {
            t.directional((null(), 0), (null(), 0), null(), null_mut())
        }),
        row(&name("no knowns, null"), DIRECTIONAL, move |t| {
            t.directional(unknowns(t, 1), (null(), 0), null(), edge(&[0.0]))
        }),
        row(&name("no unknowns, null"), DIRECTIONAL, move |t| {
            t.directional((null(), 0), knowns(t, 1), edge(&[1.0]), null_mut())
        }),
        row(&name("no unknowns, null knowns"), NEVER, |t| {
            t.directional((null(), 0), (null(), 1), edge(&[1.0]), null_mut())
        }),
        row(&name("no unknowns, a null seed"), NEVER, move |t| {
            t.directional((null(), 0), knowns(t, 1), null(), null_mut())
        }),
        row(&name("null unknowns"), NEVER, move |t| {
            t.directional((null(), 1), knowns(t, 1), edge(&[1.0]), edge(&[0.0]))
        }),
        row(&name("null knowns"), NEVER, move |t| {
            t.directional(unknowns(t, 1), (null(), 1), edge(&[1.0]), edge(&[0.0]))
        }),
        row(&name("a null seed"), NEVER, move |t| t.directional(unknowns(t, 1), knowns(t, 1), null(), edge(&[0.0]))),
        row(&name("a null sensitivity"), NEVER, move |t| {
            t.directional(unknowns(t, 1), knowns(t, 1), edge(&[1.0]), null_mut())
        }),
        row(&name("unknown references"), NO_DIRECTIONAL, |t| {
            t.directional((edge(&[u32::MAX]), 1), (edge(&[9999]), 1), edge(&[1.0]), edge(&[0.0]))
        }),
        row(&name("the same references many times"), DIRECTIONAL, move |t| {
            t.directional(unknowns(t, 500), knowns(t, 500), edge(&[1.0; 500]), edge(&[0.0; 500]))
        }),
    ];
    rows.extend(NO_SIZES.map(|n| {
        row(&name(&format!("{n} unknowns")), NEVER, move |t| {
            t.directional((unknowns(t, 1).0, n), knowns(t, 1), edge(&[1.0]), edge(&[0.0]))
        })
    }));
    rows.extend(NO_SIZES.map(|n| {
        row(&name(&format!("{n} knowns")), NEVER, move |t| {
            t.directional(unknowns(t, 1), (knowns(t, 1).0, n), edge(&[1.0]), edge(&[0.0]))
        })
    }));
    rows
}
