//! Rows of FMI 3.0: what its functions are asked that those of FMI 2.0 are not, and the same with its lengths and flags.

mod derivatives;
mod life;
mod states;
mod step;
mod values;

use super::rows::{Row, row_3};
use super::target::{Phase, Target};
use crate::support::Component;
use std::ffi::c_int;

/// Columns: instantiated, initialization, event, step complete, terminated, error, no instance.
const NEVER: &str = "eeeeeee";

pub fn rows() -> Vec<Row> {
    [values::rows(), step::rows(), life::rows(), states::rows(), derivatives::rows()].into_iter().flatten().collect()
}

/// A call that is refused in all states, and in one of them with these words.
fn refused_in(phase: Phase, name: &str, words: &str, call: impl Fn(&Target<'_>, Component) -> c_int + 'static) -> Row {
    row_3(&format!("{name}: {words}"), NEVER, move |t| call(t, t.component)).says(phase, words)
}

/// The same with the words in Step Mode.
fn refused(name: &str, words: &str, call: impl Fn(&Target<'_>, Component) -> c_int + 'static) -> Row {
    refused_in(Phase::StepComplete, name, words, call)
}
