//! What a user says about a record file beside its name.

use super::unit::Unit;
use std::fmt;

/// What is wanted of a record file, and what the file does not say. What it says itself is compared with this: a contradiction
/// is refused.
///
/// ```
/// use pounding::record::{Accelerogram, RecordOptions, Unit};
///
/// let said = RecordOptions { step: Some(0.02), unit: Some(Unit::Gravity), ..RecordOptions::default() };
/// let read = Accelerogram::parse("motion.txt", &said, b"0.0\n0.1\n-0.2\n")?;
/// assert_eq!(read.record.times, [0.0, 0.02, 0.04]); // s
/// assert_eq!(read.record.accelerations[1], 0.1 * 9.80665); // m/s2
/// # Ok::<(), pounding::record::RecordError>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RecordOptions {
    /// s from sample to sample, of a file without times; its first sample is at 0.
    pub step: Option<f64>,
    /// Of the accelerations.
    pub unit: Option<Unit>,
    /// Which of several.
    pub column: Option<Column>,
    /// Lines above the numbers. Where they are given nothing in them counts.
    pub skip_lines: Option<usize>,
    /// Whether the mean of the samples is taken away.
    pub remove_mean: bool,
}

/// One of several components of a motion in a file: a column of a table, a channel.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Column {
    /// Counted from 1: columns from the left, that of the times among them; channels as the file numbers them, else in its order.
    Number(usize),
    /// As the file calls it, in any case; the beginning is enough where no other begins so.
    Name(String),
}

impl fmt::Display for Column {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Column::Number(number) => write!(f, "{number}"),
            Column::Name(name) => f.write_str(name),
        }
    }
}
