//! What is wrong with a scene, and how values are written in messages.

use super::units::Units;
use std::fmt;

/// One thing that is wrong with a scene.
///
/// Displayed as `path = found: expected ...`, for example `contact[2].restitution = 1.4: expected 0 < e <= 1`.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Problem {
    /// Path in the file, such as `contact[2].restitution`; entries of lists are counted from 1.
    pub path: String,
    /// The value found; empty where something is missing.
    pub found: String,
    /// What was expected.
    pub expected: String,
}

impl Problem {
    /// A problem; the three parts as in the fields.
    pub fn new(path: impl Into<String>, found: impl Into<String>, expected: impl Into<String>) -> Problem {
        Problem { path: path.into(), found: found.into(), expected: expected.into() }
    }

    /// Whether a path is this problem's own or leads to a part of the value that it is about.
    pub(super) fn covers(&self, path: &str) -> bool {
        path.strip_prefix(self.path.as_str()).is_some_and(|rest| rest.is_empty() || rest.starts_with(['.', '[']))
    }
}

impl fmt::Display for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.found.is_empty() {
            write!(f, "{}: expected {}", self.path, self.expected)
        } else {
            write!(f, "{} = {}: expected {}", self.path, self.found, self.expected)
        }
    }
}

/// Everything that is wrong with a scene, at once; displayed with one problem a line.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{}", problems.iter().map(Problem::to_string).collect::<Vec<_>>().join("\n"))]
#[non_exhaustive]
pub struct SceneError {
    /// In the order of the file.
    pub problems: Vec<Problem>,
}

impl From<Problem> for SceneError {
    fn from(problem: Problem) -> SceneError {
        SceneError { problems: vec![problem] }
    }
}

/// A number as a scene may write it.
pub(crate) fn number(value: f64) -> String {
    if value.is_nan() { "nan".to_owned() } else { format!("{value:?}") }
}

/// A list of numbers as a scene may write it.
pub(crate) fn numbers(values: &[f64]) -> String {
    format!("[{}]", values.iter().copied().map(number).collect::<Vec<_>>().join(", "))
}

/// The beginning of a matrix of stiffnesses or dashpots as a scene in these units may write it.
pub(crate) fn matrix_text(rows: &[Vec<f64>], units: Units) -> String {
    let row = |row: &Vec<f64>| numbers(&row.iter().map(|&entry| units.written(entry)).collect::<Vec<_>>());
    excerpt(&format!("[{}]", rows.iter().map(row).collect::<Vec<_>>().join(", ")))
}

/// A text as a scene may write it.
pub(crate) fn quoted(text: &str) -> String {
    excerpt(&format!("{text:?}"))
}

/// `1 number`, `2 numbers`.
pub(super) fn count(n: usize, noun: &str) -> String {
    format!("{n} {noun}{}", if n == 1 { "" } else { "s" })
}

/// Text on one line, at most 60 characters.
pub(crate) fn excerpt(text: &str) -> String {
    const LONGEST: usize = 60;
    let mut line = String::new();
    for word in text.split_whitespace() {
        if !line.is_empty() {
            line.push(' ');
        }
        line.push_str(word);
        if line.chars().count() > LONGEST {
            let short: String = line.chars().take(LONGEST - 3).collect();
            return short + "...";
        }
    }
    line
}
