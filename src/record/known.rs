//! Records that have been read lately. Who runs a record many times, for other gaps or scales, names its file each time;
//! what is in the file is compared, so that one that has changed is read anew.

use super::accelerogram::{Record, RecordError};
use super::format::Format;
use std::collections::VecDeque;
use std::sync::{Arc, Mutex, PoisonError};

/// The latest records, as many as it was made for.
#[derive(Debug)]
pub struct KnownRecords {
    most: usize,
    known: Mutex<VecDeque<Known>>,
}

#[derive(Debug)]
struct Known {
    format: Format,
    bytes: Vec<u8>,
    record: Arc<Record>,
}

impl KnownRecords {
    /// Room for so many records, at least one.
    pub const fn new(most: usize) -> KnownRecords {
        KnownRecords { most, known: Mutex::new(VecDeque::new()) }
    }

    /// The record in the bytes of a file; the name tells the format, as in [`Record::parse`].
    ///
    /// # Errors
    /// As [`Record::parse`].
    pub fn read(&self, name: &str, bytes: Vec<u8>) -> Result<Arc<Record>, RecordError> {
        let format = Format::of(name);
        let latest = || self.known.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(known) = latest().iter().find(|known| known.format == format && known.bytes == bytes) {
            return Ok(Arc::clone(&known.record));
        }
        let record = Arc::new(Record::parse(name, &bytes)?);
        let mut latest = latest();
        latest.truncate(self.most - 1);
        latest.push_front(Known { format, bytes, record: Arc::clone(&record) });
        Ok(record)
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    const PULSE: &[u8] = b"time_s,accel_m_s2\n0,0\n0.1,3\n0.3,0\n";
    const OTHER: &[u8] = b"time_s,accel_m_s2\n0,0\n0.1,4\n0.3,0\n";

    #[test]
    fn the_same_content_is_read_once_and_another_anew() {
        let known = KnownRecords::new(1);
        let first = known.read("one.csv", PULSE.to_vec()).unwrap();
        assert!(Arc::ptr_eq(&first, &known.read("one.csv", PULSE.to_vec()).unwrap()));
        assert!(Arc::ptr_eq(&first, &known.read("copy.csv", PULSE.to_vec()).unwrap()));
        // Under that name it is no record, and what is known stays.
        assert!(known.read("other.AT2", PULSE.to_vec()).is_err());
        assert!(Arc::ptr_eq(&first, &known.read("one.csv", PULSE.to_vec()).unwrap()));
        // The same file with something else in it.
        assert_eq!((first.peak(), known.read("one.csv", OTHER.to_vec()).unwrap().peak()), (3.0, 4.0));
        assert!(!Arc::ptr_eq(&first, &known.read("one.csv", PULSE.to_vec()).unwrap()), "there is room for one");
    }

    #[test]
    fn the_latest_ones_stay() {
        let known = KnownRecords::new(2);
        let first = known.read("one.csv", PULSE.to_vec()).unwrap();
        let second = known.read("one.csv", OTHER.to_vec()).unwrap();
        assert!(Arc::ptr_eq(&first, &known.read("one.csv", PULSE.to_vec()).unwrap()));
        known.read("one.csv", [PULSE, b"0.4,1\n"].concat()).unwrap();
        assert!(Arc::ptr_eq(&second, &known.read("one.csv", OTHER.to_vec()).unwrap()));
        assert!(!Arc::ptr_eq(&first, &known.read("one.csv", PULSE.to_vec()).unwrap()));
    }
}
