//! What a ground motion is.

use super::format::Format;
use serde::{Deserialize, Serialize};

/// A ground acceleration, linear between its samples and 0 before the first and after the last.
///
/// A record that [`Record::parse`] returns has at least two samples, all numbers finite, and strictly increasing times.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Record {
    /// s, strictly increasing.
    pub times: Vec<f64>,
    /// m/s2, positive to the right.
    pub accelerations: Vec<f64>,
}

/// A record with what its file says about it.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Accelerogram {
    /// That of the file.
    pub format: Format,
    /// Station, event, component or title, on one line; empty where the file says nothing.
    pub about: String,
    /// The channels of a file of the volume 2, as it calls them, in its order; empty for other formats.
    pub channels: Vec<String>,
    /// Of the channel that was asked for, else of the first.
    pub record: Record,
}

/// A record file that cannot be read: everything that is wrong with it; displayed with one problem a line.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{}", problems.join("\n"))]
#[non_exhaustive]
pub struct RecordError {
    /// What is wrong, with line and value, in the order of the file: the first [`super::MOST_PROBLEMS`], then how many more
    /// there are.
    pub problems: Vec<String>,
}

/// m/s2 in one g.
pub const STANDARD_GRAVITY: f64 = 9.80665;

impl Record {
    /// m/s2, largest magnitude.
    pub fn peak(&self) -> f64 {
        self.accelerations.iter().fold(0.0, |peak, a| peak.max(a.abs()))
    }
}

impl RecordError {
    pub(super) fn new(problem: impl Into<String>) -> RecordError {
        RecordError { problems: vec![problem.into()] }
    }
}
