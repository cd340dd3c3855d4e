//! Rows of hostile arguments with what the standards ask for, and the cases that they make: one for each state.

use super::target::{Phase, Target, scene};
use super::{derivatives, instantiate, life, state, step, v3, values};
use crate::support::{DISCARD, ERROR, Fmu, Instance, OK};
use pounding::FmiVersion;
use std::ffi::c_int;

/// A function with some arguments.
pub struct Row {
    version: FmiVersion,
    /// The function, a colon, and what is hostile about the arguments.
    name: String,
    /// A letter for each of [`Phase::all`]: `o` for `fmi2OK`, `d` for `fmi2Discard`, `e` for `fmi2Error`, `n` for
    /// either of the last two, `x` for any of the three, where the standard leaves it to the FMU how far its numbers
    /// reach.
    expected: &'static str,
    /// Words of the only message in one of the states, in which all that can be read stays as it was.
    says: Option<(Phase, String)>,
    call: Box<Call>,
}

type Call = dyn Fn(&Target<'_>) -> c_int;

/// A row of FMI 2.0; `name` as for [`Row::name`].
pub fn row(name: &str, expected: &'static str, call: impl Fn(&Target<'_>) -> c_int + 'static) -> Row {
    let version = FmiVersion::V2;
    Row { version, name: name.to_owned(), expected, says: None, call: Box::new(call) }
}

/// The same of FMI 3.0.
pub fn row_3(name: &str, expected: &'static str, call: impl Fn(&Target<'_>) -> c_int + 'static) -> Row {
    Row { version: FmiVersion::V3, ..row(name, expected, call) }
}

impl Row {
    pub fn says(self, phase: Phase, words: &str) -> Row {
        Row { says: Some((phase, words.to_owned())), ..self }
    }
}

/// What the cases of a process share: the unpacked FMU in both versions, and the bits of a fresh instance of each.
pub struct Shared {
    fmus: [Fmu; 2],
    references: [Vec<Vec<u64>>; 2],
}

impl Shared {
    pub fn new() -> Shared {
        let fmus = Fmu::both(&scene());
        let references = fmus.each_ref().map(|fmu| run(&fmu.with_flags(true, false)));
        Shared { fmus, references }
    }

    pub fn fmu(&self, version: FmiVersion) -> &Fmu {
        &self.fmus[version as usize]
    }
}

/// A row in a state, to be run in a process that may crash.
pub struct Case {
    pub name: String,
    check: Box<dyn Fn(&Shared)>,
}

impl Case {
    pub fn new(name: String, check: impl Fn(&Shared) + 'static) -> Case {
        Case { name, check: Box::new(check) }
    }

    /// Panics where the outcome is not the expected one.
    pub fn check(&self, shared: &Shared) {
        (self.check)(shared);
    }
}

/// Every case, always in the same order.
pub fn cases() -> Vec<Case> {
    let of_2 = [life::rows(), values::rows(), derivatives::rows(), state::rows(), step::rows()].into_iter().flatten();
    of_2.chain(v3::rows()).flat_map(in_each_phase).chain(instantiate::cases()).collect()
}

fn in_each_phase(row: Row) -> impl Iterator<Item = Case> {
    let phases = Phase::all(row.version);
    assert_eq!(row.expected.len(), phases.len(), "{}", row.name);
    let row = std::rc::Rc::new(row);
    phases.iter().zip(row.expected.chars().collect::<Vec<_>>()).map(move |(&phase, expected)| {
        let row = std::rc::Rc::clone(&row);
        Case::new(format!("{}, in {phase:?}", row.name), move |shared| check(shared, &row, phase, expected))
    })
}

fn check(shared: &Shared, row: &Row, phase: Phase, expected: char) {
    let target = Target::new(shared.fmu(row.version), phase);
    let words = row.says.as_ref().filter(|(told, _)| *told == phase).map(|(_, words)| words);
    let before = words.and_then(|_| shown(&target, phase));
    let status = (row.call)(&target);
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
    if let Some(words) = words {
        let [line] = &log[..] else { panic!("one message: {log:?}") };
        let is_of = |function: &str| line.message.starts_with(&format!("{function}: "));
        assert!(row.name.split([':', ',']).next().is_some_and(is_of), "{line:?}");
        assert!(line.message.contains(words), "expected {words:?}: {line:?}");
        assert_eq!((line.status, line.category.as_str()), (ERROR, "logStatusError"));
        assert_eq!(shown(&target, phase), before, "something has changed");
    }
    if status == ERROR && phase != Phase::NoInstance {
        assert!(!log.is_empty(), "an error without a message");
        assert_eq!(target.instance.step(0.0, 0.1), ERROR, "no step after an error");
    }
    if status == DISCARD {
        assert!(!log.is_empty(), "refused without a message");
        let goes_on = if phase == Phase::StepComplete { OK } else { ERROR };
        assert_eq!(target.instance.step(0.0, 0.1), goes_on, "the step after a call that was discarded");
    }
    assert_eq!(target.instance.reset(), OK);
    let reference = &shared.references[row.version as usize];
    assert!(run(&target.instance) == *reference, "after a reset: not the bits of a fresh instance");
}

/// All outputs, where they can be read: FMI 2.0 has none before initialisation.
fn shown(target: &Target<'_>, phase: Phase) -> Option<Vec<u64>> {
    let is_early = phase == Phase::Instantiated && target.fmu.version == FmiVersion::V2;
    (!is_early).then(|| target.instance.outputs())
}

/// The bits of a short run with impacts.
fn run(instance: &Instance<'_>) -> Vec<Vec<u64>> {
    instance.start();
    instance.run(0.0, 0.1, 8)
}
