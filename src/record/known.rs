//! Records that have been read lately. Who runs a record many times, for other gaps or scales, names its file each time;
//! what is in the file is compared, so that one that has changed is read anew.

use super::accelerogram::Record;
use super::error::RecordError;
use super::file::RecordFile;
use super::options::RecordOptions;
use std::collections::VecDeque;
use std::sync::{Arc, Mutex, PoisonError};

/// The latest records, as many as it was made for.
#[derive(Debug)]
pub struct KnownRecords {
    most: usize,
    known: Mutex<VecDeque<KnownRecord>>,
}

#[derive(Debug)]
struct KnownRecord {
    options: RecordOptions,
    bytes: Vec<u8>,
    record: Arc<Record>,
}

impl KnownRecords {
    /// Room for so many records, at least one.
    pub const fn new(most: usize) -> KnownRecords {
        KnownRecords { most, known: Mutex::new(VecDeque::new()) }
    }

    /// The record in a file.
    ///
    /// # Errors
    /// As [`Record::parse`].
    pub fn read(&self, file: RecordFile) -> Result<Arc<Record>, RecordError> {
        let options = file.wanted()?;
        let latest = || self.known.lock().unwrap_or_else(PoisonError::into_inner);
        let is_same = |known: &&KnownRecord| known.options == options && known.bytes == file.bytes;
        if let Some(known) = latest().iter().find(is_same) {
            return Ok(Arc::clone(&known.record));
        }
        let record = Arc::new(file.parse()?.record);
        let mut latest = latest();
        latest.truncate(self.most - 1);
        latest.push_front(KnownRecord { options, bytes: file.bytes, record: Arc::clone(&record) });
        Ok(record)
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use crate::record::Column;

    const PULSE: &[u8] = b"time_s,accel_m_s2\n0,0\n0.1,3\n0.3,0\n";
    const OTHER: &[u8] = b"time_s,accel_m_s2\n0,0\n0.1,4\n0.3,0\n";

    fn file(name: &str, bytes: &[u8]) -> RecordFile {
        RecordFile::named(name, bytes.to_vec())
    }

    #[test]
    fn the_same_content_is_read_once_and_another_anew() {
        let known = KnownRecords::new(1);
        let first = known.read(file("one.csv", PULSE)).unwrap();
        assert!(Arc::ptr_eq(&first, &known.read(file("one.csv", PULSE)).unwrap()));
        assert!(Arc::ptr_eq(&first, &known.read(file("copy.csv", PULSE)).unwrap()));
        // Another channel is another record: there is none here, and what is known stays.
        assert!(known.read(RecordFile::named("one.csv#3", PULSE.to_vec())).is_err());
        assert!(Arc::ptr_eq(&first, &known.read(file("one.csv", PULSE)).unwrap()));
        // The same file with something else in it.
        assert_eq!((first.peak(), known.read(file("one.csv", OTHER)).unwrap().peak()), (3.0, 4.0));
        assert!(!Arc::ptr_eq(&first, &known.read(file("one.csv", PULSE)).unwrap()), "there is room for one");
    }

    #[test]
    fn a_contradiction_is_refused_though_the_file_is_known() {
        let known = KnownRecords::new(1);
        known.read(file("one.csv#1", PULSE)).unwrap();
        let second = RecordOptions { column: Some(Column::Number(2)), ..RecordOptions::default() };
        assert!(known.read(file("one.csv#1", PULSE).with(&second)).is_err());
    }

    #[test]
    fn the_latest_ones_stay() {
        let known = KnownRecords::new(2);
        let first = known.read(file("one.csv", PULSE)).unwrap();
        let second = known.read(file("one.csv", OTHER)).unwrap();
        assert!(Arc::ptr_eq(&first, &known.read(file("one.csv", PULSE)).unwrap()));
        known.read(file("one.csv", &[PULSE, b"0.4,1\n"].concat())).unwrap();
        assert!(Arc::ptr_eq(&second, &known.read(file("one.csv", OTHER)).unwrap()));
        assert!(!Arc::ptr_eq(&first, &known.read(file("one.csv", PULSE)).unwrap()));
    }
}
