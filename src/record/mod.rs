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
mod known;

pub use known::KnownRecords;

use crate::figures::plain;
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

/// A record file that cannot be read: everything that is wrong with it; displayed with one problem a line.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{}", problems.join("\n"))]
pub struct RecordError {
    /// What is wrong, with line and value, in the order of the file: the first [`MOST_PROBLEMS`], then how many more
    /// there are.
    pub problems: Vec<String>,
}

/// A file of the wrong kind has a problem in every line: nobody reads more than these.
pub const MOST_PROBLEMS: usize = 10;

/// m/s2 in one g.
pub const STANDARD_GRAVITY: f64 = 9.80665;

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
    /// Everything that is wrong, each with its line (counted from 1), the value found and what was expected: a header
    /// that does not fit (nothing behind it is looked at then), something that is not a finite number, times that do
    /// not increase, fewer than two samples, a number of samples other than the one announced.
    pub fn parse(name: &str, bytes: &[u8]) -> Result<Record, RecordError> {
        match Format::of(name) {
            Format::Csv => csv::parse(bytes),
            Format::PeerAt2 => at2::parse(bytes),
        }
    }

    /// A record that has come another way than by [`Record::parse`], if it could have been read from a file.
    ///
    /// # Errors
    /// As [`Record::parse`], without lines.
    pub fn checked(self) -> Result<Record, RecordError> {
        let (times, accelerations) = (self.times.len(), self.accelerations.len());
        if times != accelerations {
            return Err(RecordError::new(format!("{times} times and {accelerations} accelerations: expected as many")));
        }
        let mut reading = Reading::with_capacity(times);
        for (time, acceleration) in self.times.into_iter().zip(self.accelerations) {
            reading.add(time, acceleration, |problem| problem);
        }
        reading.complete()
    }

    /// m/s2, largest magnitude.
    pub fn peak(&self) -> f64 {
        self.accelerations.iter().fold(0.0, |peak, a| peak.max(a.abs()))
    }
}

/// A record while it is being read, and what is wrong with it so far.
struct Reading {
    record: Record,
    problems: Vec<String>,
    /// Problems beyond the first ones.
    more: usize,
    /// In the file, good or bad.
    samples: usize,
}

impl Reading {
    fn with_capacity(samples: usize) -> Reading {
        let record = Record { times: Vec::with_capacity(samples), accelerations: Vec::with_capacity(samples) };
        Reading { record, problems: Vec::new(), more: 0, samples: 0 }
    }

    /// Adds a sample, or what is wrong with it; `place` says where.
    fn add(&mut self, time: f64, acceleration: f64, place: impl Fn(String) -> String) {
        self.samples += 1;
        if !time.is_finite() {
            self.refuse(|| place(format!("time {} s: expected a finite time", plain(time))));
        }
        if !acceleration.is_finite() {
            self.refuse(|| place(format!("acceleration {} m/s2: expected a finite acceleration", plain(acceleration))));
        }
        if let Some(&last) = self.record.times.last()
            && time <= last
        {
            self.refuse(|| {
                place(format!("time {} s: expected more than the time before it, {} s", plain(time), plain(last)))
            });
        }
        // What comes next is compared with this one, in or out of order: one wrong time is one problem, or two.
        if time.is_finite() {
            self.record.times.push(time);
            self.record.accelerations.push(acceleration);
        }
    }

    /// Notes a sample that is none.
    fn skip(&mut self, problem: impl FnOnce() -> String) {
        self.samples += 1;
        self.refuse(problem);
    }

    fn refuse(&mut self, problem: impl FnOnce() -> String) {
        if self.problems.len() < MOST_PROBLEMS {
            self.problems.push(problem());
        } else {
            self.more += 1;
        }
    }

    /// The record once its file has been read to the end.
    fn complete(mut self) -> Result<Record, RecordError> {
        match self.samples {
            0 => self.refuse(|| "0 samples: expected at least 2".to_owned()),
            1 => self.refuse(|| "1 sample: expected at least 2".to_owned()),
            _ => {}
        }
        if self.problems.is_empty() { Ok(self.record) } else { Err(self.stop()) }
    }

    /// What has been found, where nothing behind it can be read.
    fn stop(self) -> RecordError {
        let Reading { mut problems, more, .. } = self;
        match more {
            0 => {}
            1 => problems.push("there is 1 more problem".to_owned()),
            _ => problems.push(format!("there are {more} more problems")),
        }
        RecordError { problems }
    }
}

impl RecordError {
    fn new(problem: impl Into<String>) -> RecordError {
        RecordError { problems: vec![problem.into()] }
    }
}

/// A problem on a line, counted from 1.
fn on_line(number: usize, problem: impl std::fmt::Display) -> String {
    format!("line {number}: {problem}")
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
