//! What a ground motion is.

use super::components;
use super::format::Format;
use super::unit::Unit;
use serde::{Deserialize, Serialize};

/// A ground acceleration, linear between its samples and 0 before the first and after the last.
///
/// A record that [`Record::parse`] returns has at least two samples, all numbers finite, and strictly increasing times.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Record {
    /// s, strictly increasing.
    pub times: Vec<f64>,
    /// m/s2, positive to the right.
    pub accelerations: Vec<f64>,
    /// Direction, channel or column, as the file calls it; empty where it says nothing.
    pub component: String,
}

/// A record with what its file says about it.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Accelerogram {
    /// That of the file.
    pub format: Format,
    /// Of the accelerations in the file; those of `record` are in m/s2.
    pub unit: Unit,
    /// Station, event, component or title, on one line; empty where the file says nothing.
    pub about: String,
    /// The components of a file that has several, as it calls them, in its order; else empty.
    pub channels: Vec<String>,
    /// Of the component that was asked for.
    pub record: Record,
}

impl Record {
    /// Samples of a component without a name.
    pub fn new(times: Vec<f64>, accelerations: Vec<f64>) -> Record {
        Record { times, accelerations, component: String::new() }
    }

    /// Whether the name of its component is one of a vertical motion: `Up`, `U-D`, `Z`, `vertical`.
    pub fn is_vertical(&self) -> bool {
        components::is_vertical(&self.component)
    }

    /// m/s2, largest magnitude.
    pub fn peak(&self) -> f64 {
        self.accelerations.iter().fold(0.0, |peak, a| peak.max(a.abs()))
    }
}
