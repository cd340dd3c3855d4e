//! Getting and setting values.

use super::edge::{edge, misaligned, text};
use super::rows::{Row, row};
use super::target::{Phase, Target, Text};
use crate::support::{fmi2EnterInitializationMode, fmi2ExitInitializationMode};
use std::ffi::{c_int, c_void};
use std::ptr::{null, null_mut};

/// Columns: instantiated, initialization, step complete, terminated, error, no instance.
const GET: &str = "eooooe";
const SET: &str = "oooeee";
const SET_PARAMETER: &str = "ooeeee";
const NEVER: &str = "eeeeee";

/// Sizes in elements that no array of references, of 4-byte or of 8-byte values can have.
const NO_SIZES: [usize; 4] = [usize::MAX, usize::MAX / 2, usize::MAX / 8 + 1, usize::MAX / 16 + 1];

pub fn rows() -> Vec<Row> {
    let mut rows = Vec::new();
    for (ty, good, wrong) in [
        ("Real", "left.displacement[1]", "impacts"),
        ("Integer", "impacts", "left.displacement[1]"),
        ("Boolean", "contact[1].active", "impacts"),
        ("String", "ground.record", "contact[1].active"),
    ] {
        rows.extend(getting(ty, good, wrong));
        rows.extend(setting(ty, wrong));
    }
    rows.extend(reals());
    rows.extend(strings());
    rows
}

fn getting(ty: &str, good: &'static str, wrong: &'static str) -> Vec<Row> {
    let function: &'static str = format!("fmi2Get{ty}").leak();
    let name = |what: &str| format!("{function}: {what}");
    // A pointer is as large as the largest of the types.
    let values = |n: usize| edge(&vec![0_u64; n]).cast::<c_void>();
    let get = move |t: &Target<'_>, vr: &[u32]| t.get(function, edge(vr), vr.len(), values(vr.len()));
    let mut rows = vec![
        row(&name("nothing, null arrays"), GET, move |t| t.get::<c_void>(function, null(), 0, null_mut())),
        row(&name("nothing, arrays that are there"), GET, move |t| t.get(function, edge(&[u32::MAX]), 0, values(1))),
        row(&name("null references"), NEVER, move |t| t.get(function, null(), 1, values(1))),
        row(&name("null values"), NEVER, move |t| t.get::<c_void>(function, edge(&[t.vr(good)]), 1, null_mut())),
        row(&name("misaligned references"), NEVER, move |t| t.get(function, misaligned(), 1, values(1))),
        row(&name("a good reference"), GET, move |t| get(t, &[t.vr(good)])),
        row(&name("the same reference many times"), GET, move |t| get(t, &[t.vr(good); 10_000])),
        row(&name("the reference after the last"), NEVER, move |t| {
            get(t, &[u32::try_from(t.fmu.description.modelVariables.len()).unwrap()])
        }),
        row(&name("the largest reference"), NEVER, move |t| get(t, &[u32::MAX])),
        row(&name("an unknown reference among good ones"), NEVER, move |t| get(t, &[t.vr(good), 9999, t.vr(good)])),
        row(&name("many unknown references"), NEVER, move |t| get(t, &[9999; 10_000])),
        row(&name("a variable of another type"), NEVER, move |t| get(t, &[t.vr(wrong)])),
        row(&name("every variable there is"), NEVER, move |t| get(t, &(0..40).collect::<Vec<_>>())),
    ];
    rows.extend(NO_SIZES.map(|n| {
        row(&name(&format!("{n} values")), NEVER, move |t| t.get(function, edge(&[t.vr(good)]), n, values(1)))
    }));
    rows
}

fn setting(ty: &str, wrong: &'static str) -> Vec<Row> {
    let function: &'static str = format!("fmi2Set{ty}").leak();
    let name = |what: &str| format!("{function}: {what}");
    // Good strings where strings are read, and then a number of any type too.
    let values = |n: usize| edge(&vec![text(b""); n]).cast::<c_void>();
    let set = move |t: &Target<'_>, vr: &[u32]| t.set(function, edge(vr), vr.len(), values(vr.len()));
    let mut rows = vec![
        row(&name("nothing, null arrays"), SET, move |t| t.set::<c_void>(function, null(), 0, null())),
        row(&name("nothing, arrays that are there"), SET, move |t| t.set(function, edge(&[u32::MAX]), 0, values(1))),
        row(&name("null references"), NEVER, move |t| t.set(function, null(), 1, values(1))),
        row(&name("null values"), NEVER, move |t| t.set::<c_void>(function, edge(&[0]), 1, null())),
        row(&name("misaligned references"), NEVER, move |t| t.set(function, misaligned(), 1, values(1))),
        row(&name("the largest reference"), NEVER, move |t| set(t, &[u32::MAX])),
        row(&name("many unknown references"), NEVER, move |t| set(t, &[9999; 10_000])),
        row(&name("a variable of another type"), NEVER, move |t| set(t, &[t.vr(wrong)])),
        row(&name("an output"), NEVER, move |t| set(t, &[t.vr("impacts")])),
        row(&name("a Boolean output"), NEVER, move |t| set(t, &[t.vr("contact[1].active")])),
        row(&name("a calculated parameter"), NEVER, move |t| set(t, &[t.vr("left.frequency[1]")])),
    ];
    rows.extend(
        NO_SIZES.map(|n| row(&name(&format!("{n} values")), NEVER, move |t| t.set(function, edge(&[0]), n, values(1)))),
    );
    if ty != "String" {
        rows.push(row(&name("misaligned values"), NEVER, move |t| t.set(function, edge(&[0]), 1, misaligned::<u64>())));
    }
    rows
}

fn reals() -> Vec<Row> {
    let one = |variable: &'static str, value: f64, expected| {
        row(&format!("fmi2SetReal: {variable} = {value:e}"), expected, move |t| {
            t.set("fmi2SetReal", edge(&[t.vr(variable)]), 1, edge(&[value]))
        })
    };
    let mut rows = vec![
        row("fmi2SetReal: an input twice", SET, |t| {
            let vr = t.vr("left.force[1]");
            t.set("fmi2SetReal", edge(&[vr, vr]), 2, edge(&[1.0, 2.0]))
        }),
        row("fmi2SetReal: a NaN behind a good value", NEVER, |t| {
            t.set("fmi2SetReal", edge(&[t.vr("left.force[1]"), t.vr("left.force[2]")]), 2, edge(&[1.0, f64::NAN]))
        }),
        row("fmi2GetReal: misaligned values", NEVER, |t| {
            t.get("fmi2GetReal", edge(&[t.vr("left.velocity[1]")]), 1, misaligned::<f64>())
        }),
        row("fmi2SetReal and fmi2DoStep: the largest force", "eeoeee", |t| {
            let set = t.set("fmi2SetReal", edge(&[t.vr("left.force[1]")]), 1, edge(&[3.65e6]));
            set.max(t.step(0.0, 0.1))
        }),
        row("fmi2SetReal: numbers at the ends of what there is, then a run", "xxeeee", |t| {
            let vr = [t.vr("right.mass[1]"), t.vr("contact[1].stiffness")];
            let set = t.set("fmi2SetReal", edge(&vr), 2, edge(&[5e-324, f64::MAX]));
            t.alone(fmi2EnterInitializationMode);
            t.alone(fmi2ExitInitializationMode);
            t.step(0.0, 1e-3);
            set
        }),
        one("left.force[1]", 3.65e6, SET),
        one("left.force[1]", 3.66e6, NEVER),
        one("left.force[1]", f64::MAX, NEVER),
        one("ground.scale", 1e300, NEVER),
        one("left.force[1]", -0.0, SET),
        one("left.force[1]", 5e-324, SET),
        one("right.mass[1]", 4.0, SET_PARAMETER),
        one("right.mass[1]", 3.65, SET), // as it is
    ];
    for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        rows.push(one("left.force[1]", value, NEVER));
        rows.push(one("right.mass[1]", value, NEVER));
        rows.push(one("contact[1].gap", value, NEVER));
        rows.push(one("ground.scale", value, NEVER));
    }
    for (variable, value) in [
        ("right.mass[1]", 0.0),
        ("right.mass[1]", -1.0),
        ("right.stiffness[1]", -2910.0),
        ("contact[1].stiffness", -1.0),
        ("contact[1].restitution", 1.5),
        ("contact[1].restitution", -0.5),
        ("solver.relative_tolerance", -1.0),
        ("ground.acceleration", 0.0), // an output here
    ] {
        rows.push(one(variable, value, NEVER));
    }
    rows
}

fn strings() -> Vec<Row> {
    let one = |what: &str, expected, value: &'static [u8]| {
        row(&format!("fmi2SetString: ground.record is {what}"), expected, move |t| {
            t.set("fmi2SetString", edge(&[t.vr("ground.record")]), 1, edge(&[text(value)]))
        })
    };
    let long: &'static [u8] = vec![b'r'; 1 << 20].leak();
    let deep: &'static [u8] = "../".repeat(100_000).into_bytes().leak();
    vec![
        one("empty: that of the FMU, as it is", SET, b""),
        one("a file that there is not", NEVER, b"no/such/file.csv"),
        one("a directory", NEVER, b"/"),
        one("a device without end", NEVER, b"/dev/zero"),
        one("no record", NEVER, b"/proc/self/exe"),
        one("no UTF-8", NEVER, b"\xff\xfe.csv").says(Phase::Instantiated, "value[0]"),
        one("a cut character", NEVER, b"record\xe2\x82"),
        one("a megabyte", NEVER, long),
        one("a very deep path", NEVER, deep),
        one("conversions of printf", NEVER, b"%s%s%s%n%99999999d#r1#"),
        one("a URI", NEVER, b"file:///record.csv"),
        row("fmi2SetString: a null string", NEVER, |t| {
            t.set("fmi2SetString", edge(&[t.vr("ground.record")]), 1, edge(&[null::<i8>()]))
        })
        .says(Phase::Instantiated, "value[0]"),
        row("fmi2SetString: a null string among good ones", NEVER, |t| {
            let values: [Text; 3] = [text(b""), null(), text(b"")];
            t.set("fmi2SetString", edge(&[t.vr("ground.record"); 3]), 3, edge(&values))
        }),
        row("fmi2SetString: misaligned strings", NEVER, |t| {
            t.set("fmi2SetString", edge(&[t.vr("ground.record")]), 1, misaligned::<usize>())
        }),
        row("fmi2SetBoolean: a Boolean that is none, for an output", NEVER, |t| {
            t.set::<c_int>("fmi2SetBoolean", edge(&[t.vr("contact[1].active")]), 1, edge(&[7]))
        }),
    ]
}
