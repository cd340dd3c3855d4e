//! Rows of hostile arguments with what the standard asks for, and the cases that they make: one for each state.

use crate::support::{DISCARD, ERROR, Fmu, Instance, OK};
use super::target::{Phase, Target, scene};
use super::{derivatives, instantiate, life, state, step, values};
use std::ffi::c_int;

/// A function with some arguments.
pub struct Row {
    /// The function, a colon, and what is hostile about the arguments.
    pub name: String,
    /// A letter for each of [`Phase::ALL`]: `o` for `fmi2OK`, `d` for `fmi2Discard`, `e` for `fmi2Error`, `n` for
    /// either of the last two, `x` for any of the three, where the standard leaves it to the FMU how far its numbers
    /// reach.
    pub expected: &'static str,
    pub call: Box<dyn Fn(&Target<'_>) -> c_int>,
}

/// A row; `name` as for [`Row::name`].
pub fn row(name: &str, expected: &'static str, call: impl Fn(&Target<'_>) -> c_int + 'static) -> Row {
    Row { name: name.to_owned(), expected, call: Box::new(call) }
}

/// A row in a state, to be run in a process of its own.
pub struct Case {
    pub name: String,
    check: Box<dyn Fn()>,
}

impl Case {
    pub fn new(name: String, check: impl Fn() + 'static) -> Case {
        Case { name, check: Box::new(check) }
    }

    /// Panics where the outcome is not the expected one.
    pub fn check(&self) {
        (self.check)();
    }
}

/// Every case, always in the same order.
pub fn cases() -> Vec<Case> {
    let rows = [life::rows(), values::rows(), derivatives::rows(), state::rows(), step::rows()].into_iter().flatten();
    rows.flat_map(in_each_phase).chain(instantiate::cases()).collect()
}

fn in_each_phase(row: Row) -> impl Iterator<Item = Case> {
    let Row { name, expected, call } = row;
    assert_eq!(expected.len(), Phase::ALL.len(), "{name}");
    let call = std::rc::Rc::new(call);
    Phase::ALL.into_iter().zip(expected.chars()).map(move |(phase, expected)| {
        let call = std::rc::Rc::clone(&call);
        Case::new(format!("{name}, in {phase:?}"), move || check(phase, expected, &**call))
    })
}

fn check(phase: Phase, expected: char, call: &dyn Fn(&Target<'_>) -> c_int) {
    let fmu = Fmu::new(&scene());
    let reference = run(&fmu.instance());
    let target = Target::new(&fmu, phase);
    let status = call(&target);
    let is_expected = match expected {
        'o' => status == OK,
        'd' => status == DISCARD,
        'e' => status == ERROR,
        'n' => status == DISCARD || status == ERROR,
        'x' => [OK, DISCARD, ERROR].contains(&status),
        other => panic!("{other:?} is no status"),
    };
    let log = target.instance.log();
    assert!(is_expected, "status {status}, expected {expected:?}: {log:?}");
    if status == ERROR && phase != Phase::NoInstance {
        assert!(!log.is_empty(), "an error without a message");
        assert_eq!(target.step(0.0, 0.1), ERROR, "no step after an error");
    }
    if status == DISCARD {
        assert!(!log.is_empty(), "refused without a message");
        let goes_on = if phase == Phase::StepComplete { OK } else { ERROR };
        assert_eq!(target.step(0.0, 0.1), goes_on, "the step after a call that was discarded");
    }
    assert_eq!(target.instance.reset(), OK);
    assert!(run(&target.instance) == reference, "after a reset: not the bits of a fresh instance");
}

/// The bits of a short run with impacts.
fn run(instance: &Instance<'_>) -> Vec<Vec<u64>> {
    instance.start();
    instance.run(0.0, 0.1, 8)
}
