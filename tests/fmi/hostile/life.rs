//! Logging, setup and the changes of state.

use super::edge::{edge, misaligned, text};
use super::rows::{Row, row};
use crate::support::*;
use std::ffi::c_int;
use std::ptr::null;

pub fn rows() -> Vec<Row> {
    [logging(), setup(), changes()].into_iter().flatten().collect()
}

fn logging() -> Vec<Row> {
    let name = |what: &str| format!("fmi2SetDebugLogging: {what}");
    let one = |what: &str, expected, category: &'static [u8]| {
        row(&name(what), expected, move |t| t.logging(1, 1, edge(&[text(category)])))
    };
    let flag = |on: c_int| row(&name(&format!("loggingOn = {on}")), "eeeeee", move |t| t.logging(on, 0, null()));
    let size =
        |n: usize| row(&name(&format!("{n} categories")), "eeeeee", move |t| t.logging(1, n, edge(&[text(b"logAll")])));
    vec![
        row(&name("no categories, null"), "oooooe", |t| t.logging(1, 0, null())),
        row(&name("off, no categories, null"), "oooooe", |t| t.logging(0, 0, null())),
        row(&name("one category, null"), "eeeeee", |t| t.logging(1, 1, null())),
        row(&name("a null category"), "eeeeee", |t| t.logging(1, 1, edge(&[null()]))),
        row(&name("a null category among good ones"), "eeeeee", |t| {
            t.logging(1, 3, edge(&[text(b"logAll"), null(), text(b"logEvents")]))
        }),
        row(&name("misaligned categories"), "eeeeee", |t| t.logging(1, 1, misaligned::<usize>().cast())),
        row(&name("a category many times"), "oooooe", |t| t.logging(1, 100_000, edge(&[text(b"logAll"); 100_000]))),
        row(&name("a category of a megabyte"), "eeeeee", |t| t.logging(1, 1, edge(&[text(&[b'x'; 1 << 20])]))),
        one("an unknown category", "eeeeee", b"logNonsense"),
        one("an empty category", "eeeeee", b""),
        one("a category in other letters", "eeeeee", b"LOGALL"),
        one("a category that is no UTF-8", "eeeeee", b"log\xff\xfe"),
        one("a category with conversions of printf", "eeeeee", b"%s%n%999999999d#r1#"),
        flag(2),
        flag(-1),
        flag(c_int::MIN),
        size(usize::MAX),
        size(usize::MAX / 2),
        size(usize::MAX / 16 + 1),
    ]
}

fn setup() -> Vec<Row> {
    let name = |what: &str| format!("fmi2SetupExperiment: {what}");
    let off = (0, f64::NAN); // not defined: the number is nobody's
    let start =
        |start: f64, expected| row(&name(&format!("start = {start:e}")), expected, move |t| t.setup(off, start, off));
    let stop =
        |stop: f64, expected| row(&name(&format!("stop = {stop:e}")), expected, move |t| t.setup(off, 0.0, (1, stop)));
    let tolerance = |tolerance: f64, expected| {
        row(&name(&format!("tolerance = {tolerance:e}")), expected, move |t| t.setup((1, tolerance), 0.0, off))
    };
    vec![
        start(0.0, "oeeeee"),
        start(-1e12, "oeeeee"),
        start(1e12, "oeeeee"),
        // Times that double precision cannot tell from each other closely enough for any motion.
        start(-1e300, "eeeeee"),
        start(f64::MAX, "eeeeee"),
        start(f64::NAN, "eeeeee"),
        start(f64::INFINITY, "eeeeee"),
        start(f64::NEG_INFINITY, "eeeeee"),
        stop(f64::MIN_POSITIVE, "oeeeee"),
        stop(f64::MAX, "oeeeee"),
        stop(-1.0, "eeeeee"),
        stop(f64::NAN, "eeeeee"),
        stop(f64::INFINITY, "eeeeee"),
        stop(f64::NEG_INFINITY, "eeeeee"),
        tolerance(1e-300, "oeeeee"),
        tolerance(-1e-6, "eeeeee"),
        tolerance(f64::NAN, "eeeeee"),
        tolerance(f64::INFINITY, "eeeeee"),
        row(&name("toleranceDefined = 2"), "eeeeee", move |t| t.setup((2, 1e-6), 0.0, off)),
        row(&name("stopTimeDefined = -1"), "eeeeee", move |t| t.setup(off, 0.0, (-1, 1.0))),
        row(&name("everything wrong at once"), "eeeeee", |t| t.setup((1, -1.0), f64::NAN, (1, f64::NAN))),
        row(&name("twice"), "oeeeee", move |t| t.setup(off, 1.0, off).max(t.setup(off, 0.0, off))),
    ]
}

fn changes() -> Vec<Row> {
    let alone = |name: &str, function: Plain, expected| row(name, expected, move |t| t.alone(function));
    vec![
        alone("fmi2EnterInitializationMode", fmi2EnterInitializationMode, "oeeeee"),
        alone("fmi2ExitInitializationMode", fmi2ExitInitializationMode, "eoeeee"),
        alone("fmi2Terminate", fmi2Terminate, "eeoeee"),
        alone("fmi2Reset", fmi2Reset, "oooooe"),
        alone("fmi2CancelStep", fmi2CancelStep, "eeeeee"),
        alone("fmi2EnterEventMode", fmi2EnterEventMode, "eeeeee"),
        alone("fmi2EnterContinuousTimeMode", fmi2EnterContinuousTimeMode, "eeeeee"),
        row("fmi2Reset: a thousand times", "oooooe", |t| {
            (0..1000).map(|_| t.alone(fmi2Reset)).max().unwrap_or_default()
        }),
    ]
}
