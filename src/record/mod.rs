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

mod accelerogram;
mod at2;
mod csv;
mod format;
mod known;
mod reading;

pub use accelerogram::{Record, RecordError, STANDARD_GRAVITY};
pub use format::Format;
pub use known::KnownRecords;
pub use reading::MOST_PROBLEMS;
