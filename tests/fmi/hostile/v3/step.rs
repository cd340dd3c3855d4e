//! Steps, events and the experiment: places for what is written, flags, numbers.

use super::super::edge::edge;
use super::super::rows::{Row, row_3};
use super::super::target::Phase;
use super::{refused, refused_in};
use crate::support::*;
use std::ptr::null_mut;

pub fn rows() -> Vec<Row> {
    let mut rows = places_of_a_step();
    rows.extend(places_of_an_update());
    rows.extend([2, 255].map(flag_of_a_step));
    rows.extend(experiments());
    rows
}

/// What is in a place before a call that must not write there.
const BEFORE: u8 = 77;

fn places_of_a_step() -> Vec<Row> {
    let names = ["eventHandlingNeeded", "terminateSimulation", "earlyReturn", "lastSuccessfulTime"];
    let row = |(missing, name): (usize, &str)| {
        refused("fmi3DoStep", &format!("{name} = 0x0: expected 1 elements"), move |_, c| {
            let (flags, last) = ([(); 3].map(|()| edge(&[BEFORE])), edge(&[-77.0]));
            let mut given = flags;
            if let Some(place) = given.get_mut(missing) {
                *place = null_mut();
            }
            let [event, terminate, early] = given;
            let time = if missing == 3 { null_mut() } else { last };
            // SAFETY: places, or null.
            unsafe {
                let status = fmi3DoStep(c, 0.0, 0.1, 1, event, terminate, early, time);
                assert_eq!((flags.map(|flag| *flag), *last), ([BEFORE; 3], -77.0), "something is written");
                status
            }
        })
    };
    names.into_iter().enumerate().map(row).collect()
}

fn places_of_an_update() -> Vec<Row> {
    let names = [
        "discreteStatesNeedUpdate",
        "terminateSimulation",
        "nominalsOfContinuousStatesChanged",
        "valuesOfContinuousStatesChanged",
        "nextEventTimeDefined",
        "nextEventTime",
    ];
    let row = |(missing, name): (usize, &str)| {
        refused_in(Phase::Event, "fmi3UpdateDiscreteStates", &format!("{name} = 0x0"), move |_, c| {
            let (flags, next) = ([(); 5].map(|()| edge(&[BEFORE])), edge(&[-77.0]));
            let mut given = flags;
            if let Some(place) = given.get_mut(missing) {
                *place = null_mut();
            }
            let [need, terminate, nominals, values, defined] = given;
            let time = if missing == 5 { null_mut() } else { next };
            // SAFETY: places, or null.
            unsafe {
                let status = fmi3UpdateDiscreteStates(c, need, terminate, nominals, values, defined, time);
                assert_eq!((flags.map(|flag| *flag), *next), ([BEFORE; 5], -77.0), "something is written");
                status
            }
        })
    };
    names.into_iter().enumerate().map(row).collect()
}

fn flag_of_a_step(value: u8) -> Row {
    let words = format!("noSetFMUStatePriorToCurrentPoint = {value}: expected fmi3False (0) or fmi3True (1)");
    refused("fmi3DoStep", &words, move |_, c| {
        let [event, terminate, early] = [(); 3].map(|()| edge(&[BEFORE]));
        // SAFETY: places.
        unsafe { fmi3DoStep(c, 0.0, 0.1, value, event, terminate, early, edge(&[0.0])) }
    })
}

fn experiments() -> Vec<Row> {
    let name = "fmi3EnterInitializationMode";
    let refused = |words: &str, tolerance: (u8, f64), start: f64, stop: (u8, f64)| {
        refused_in(Phase::Instantiated, name, words, move |_, c| {
            // SAFETY: null or a live instance.
            unsafe { fmi3EnterInitializationMode(c, tolerance.0, tolerance.1, start, stop.0, stop.1) }
        })
    };
    let off = (0, f64::NAN); // not defined: the number is nobody's
    let mut rows = vec![
        refused("startTime = ", off, f64::NAN, off),
        refused("startTime = inf", off, f64::INFINITY, off),
        refused("stopTime = ", off, 0.0, (1, -1.0)),
        refused("stopTime = NaN", off, 0.0, (1, f64::NAN)),
        refused("tolerance = ", (1, -1.0), 0.0, off),
        refused("tolerance = NaN", (1, f64::NAN), 0.0, off),
        // SAFETY: null or a live instance.
        row_3("fmi3EnterInitializationMode: nothing defined", "oeeeeee", move |t| unsafe {
            fmi3EnterInitializationMode(t.component, 0, f64::NAN, 0.0, 0, f64::NAN)
        }),
    ];
    for value in [2, 255] {
        let words = |flag: &str| format!("{flag} = {value}: expected fmi3False (0) or fmi3True (1)");
        rows.push(refused(&words("toleranceDefined"), (value, 0.0), 0.0, off));
        rows.push(refused(&words("stopTimeDefined"), off, 0.0, (value, 1.0)));
    }
    rows
}
