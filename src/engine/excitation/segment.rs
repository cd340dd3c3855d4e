//! An interval of time in which the ground acceleration is linear.

use crate::engine::excitation::inputs::LinearInput;
use crate::structure::LinearGround;
use serde::{Deserialize, Serialize};

/// An interval of time in which the ground acceleration is linear.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Segment {
    /// Start, s.
    pub start: f64,
    /// Length, s.
    pub length: f64,
    /// Ground acceleration at the start, m/s2.
    pub acceleration: f64,
    /// Rate of change of the ground acceleration, m/s3.
    pub slope: f64,
    pub place: RecordPlace,
}

/// The position of a segment in the record.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) enum RecordPlace {
    /// Before the first sample, or an interval under an input.
    Outside,
    /// From this sample to the next.
    Sample(usize),
    /// This many segments after the last sample.
    After(u64),
}

impl Segment {
    /// A segment in which the ground stands still.
    pub(crate) fn at_rest(start: f64, length: f64, place: RecordPlace) -> Segment {
        Segment { start, length, acceleration: 0.0, slope: 0.0, place }
    }

    /// A segment under an input.
    pub(crate) fn under_input(start: f64, length: f64, input: &LinearInput) -> Segment {
        Segment { start, length, acceleration: input.at(start), slope: input.slope(), place: RecordPlace::Outside }
    }

    /// Whether it can be a segment under an input: outside a record, with finite numbers and a length of 0 or more.
    pub(crate) fn is_under_input(&self) -> bool {
        let Segment { start, length, acceleration, slope, place } = *self;
        let numbers = [start, length, acceleration, slope];
        place == RecordPlace::Outside && length >= 0.0 && numbers.into_iter().all(f64::is_finite)
    }

    /// The ground's acceleration from a time since the start on, s.
    pub(crate) fn ground_from(&self, elapsed: f64) -> LinearGround {
        LinearGround { acceleration: self.acceleration_at(elapsed), slope: self.slope }
    }

    /// Ground acceleration, m/s2, at a time since the start, s.
    pub(crate) fn acceleration_at(&self, elapsed: f64) -> f64 {
        self.acceleration + self.slope * elapsed
    }
}
