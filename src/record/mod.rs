//! Accelerograms: what a ground motion is, and how its files are read.
//!
//! Two formats, told apart by the file name: PEER `.AT2` (any case), everything else CSV.
//!
//! * CSV: lines that start with `#` are comments, the header is `time_s,accel_m_s2`, then one sample per line, s and
//!   m/s2, at any strictly increasing times.
//! * AT2: four header lines, the last with the number of samples and the time step, then the samples in g, separated
//!   by blanks. The first sample is at t = 0.
//!
//! Byte order mark, `\r\n`, blank lines and blanks around values are accepted in both.

mod at2;
mod csv;

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

/// A record file that cannot be read, with its line where there is one.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{message}")]
pub struct RecordError {
    /// What is wrong, with line and value.
    pub message: String,
}

/// The formats of record files.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// `time_s,accel_m_s2`.
    Csv,
    /// PEER, in g.
    PeerAt2,
}

impl Format {
    /// The format of a file of that name: `.at2` in any case is PEER, anything else CSV.
    pub fn of(name: &str) -> Format {
        let is_at2 = name.rsplit_once('.').is_some_and(|(_, extension)| extension.eq_ignore_ascii_case("at2"));
        if is_at2 { Format::PeerAt2 } else { Format::Csv }
    }
}

impl Record {
    /// Reads the bytes of a record file; the name tells the format (`.at2` in any case: PEER, else CSV).
    ///
    /// ```
    /// use pounding::record::Record;
    ///
    /// let record = Record::parse("pulse.csv", b"time_s,accel_m_s2\n0.0,0.0\n0.1,3.0\n0.3,-4.0\n")?;
    /// assert_eq!(record.times, [0.0, 0.1, 0.3]);
    /// assert_eq!(record.peak(), 4.0);
    /// # Ok::<(), pounding::record::RecordError>(())
    /// ```
    ///
    /// # Errors
    /// The first thing that is wrong, with its line (counted from 1), the value found and what was expected: a header
    /// that does not fit, something that is not a finite number, times that do not increase, fewer than two samples, a
    /// number of samples other than the one announced.
    pub fn parse(name: &str, bytes: &[u8]) -> Result<Record, RecordError> {
        match Format::of(name) {
            Format::Csv => csv::parse(bytes),
            Format::PeerAt2 => at2::parse(bytes),
        }
    }

    /// A record that has come another way than by [`Record::parse`], if it could have been read from a file.
    pub(crate) fn checked(self) -> Result<Record, RecordError> {
        let (times, accelerations) = (self.times.len(), self.accelerations.len());
        if times != accelerations {
            return Err(RecordError::new(format!("{times} times and {accelerations} accelerations: expected as many")));
        }
        let mut record = Record::with_capacity(times);
        for (time, acceleration) in self.times.into_iter().zip(self.accelerations) {
            record.push(time, acceleration).map_err(RecordError::new)?;
        }
        record.complete()
    }

    /// m/s2, largest magnitude.
    pub fn peak(&self) -> f64 {
        self.accelerations.iter().fold(0.0, |peak, a| peak.max(a.abs()))
    }

    fn with_capacity(samples: usize) -> Record {
        Record { times: Vec::with_capacity(samples), accelerations: Vec::with_capacity(samples) }
    }

    /// Adds a sample, or says what is wrong with it.
    fn push(&mut self, time: f64, acceleration: f64) -> Result<(), String> {
        if !time.is_finite() {
            return Err(format!("time {time} s: expected a finite time"));
        }
        if !acceleration.is_finite() {
            return Err(format!("acceleration {acceleration} m/s2: expected a finite acceleration"));
        }
        if let Some(&last) = self.times.last()
            && time <= last
        {
            return Err(format!("time {time} s: expected more than the time before it, {last} s"));
        }
        self.times.push(time);
        self.accelerations.push(acceleration);
        Ok(())
    }

    /// The record once its file has been read to the end.
    fn complete(self) -> Result<Record, RecordError> {
        match self.times.len() {
            0 => Err(RecordError::new("0 samples: expected at least 2")),
            1 => Err(RecordError::new("1 sample: expected at least 2")),
            _ => Ok(self),
        }
    }
}

impl RecordError {
    fn new(message: impl Into<String>) -> RecordError {
        RecordError { message: message.into() }
    }

    /// An error on a line, counted from 1.
    fn at(line: usize, message: impl std::fmt::Display) -> RecordError {
        RecordError { message: format!("line {line}: {message}") }
    }
}

/// Bytes of a file as text for a message: one line, at most 40 characters.
fn excerpt(bytes: &[u8]) -> String {
    let text = String::from_utf8_lossy(bytes.get(..200).unwrap_or(bytes));
    let printable = |c: char| if c.is_control() { char::REPLACEMENT_CHARACTER } else { c };
    let mut short: String = text.trim().chars().take(40).map(printable).collect();
    if text.trim().chars().nth(40).is_some() {
        short.push_str("...");
    }
    short
}
