//! The formats of record files, and records from what they hold.

use super::accelerogram::{Record, RecordError};
use super::reading::Reading;
use super::{at2, csv};

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
}
