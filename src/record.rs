//! Accelerograms: CSV and PEER AT2 files.

/// A ground acceleration, linear between its samples and 0 before the first and after the last.
#[derive(Clone, Debug, PartialEq)]
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

impl Record {
    /// Reads the bytes of a record file; the name tells the format (`.at2` in any case: PEER, else CSV).
    pub fn parse(_name: &str, _bytes: &[u8]) -> Result<Record, RecordError> {
        todo!()
    }

    /// m/s2, largest magnitude.
    pub fn peak(&self) -> f64 {
        self.accelerations.iter().fold(0.0, |peak, a| peak.max(a.abs()))
    }
}
