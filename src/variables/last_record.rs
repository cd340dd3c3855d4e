//! The record that an instance has read last: who resets an FMU to run it again, for another gap or another scale, names
//! the same record again. What is in the file is compared, so that a file that has changed is read anew.

use crate::record::{Format, Record};
use crate::scene::{SceneError, parse_record, read_record_file};
use std::path::Path;
use std::sync::{Arc, Mutex, PoisonError};

/// Shared by all settings of an instance.
#[derive(Debug, Default)]
pub(super) struct LastRecord(Mutex<Option<Known>>);

#[derive(Debug)]
struct Known {
    format: Format,
    bytes: Vec<u8>,
    record: Arc<Record>,
}

impl LastRecord {
    /// The record in the file at a path, which `ground.record` names.
    pub fn read(&self, path: &str) -> Result<Arc<Record>, SceneError> {
        let (format, bytes) = (Format::of(path), read_record_file(path, Path::new(path))?);
        let mut last = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(known) = last.as_ref().filter(|known| known.format == format && known.bytes == bytes) {
            return Ok(Arc::clone(&known.record));
        }
        let packaged = parse_record(path, bytes)?;
        let record = Arc::new(packaged.record);
        *last = Some(Known { format, bytes: packaged.bytes, record: Arc::clone(&record) });
        Ok(record)
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn the_same_content_is_read_once_and_another_anew() {
        let folder = tempfile::TempDir::new().unwrap();
        let path = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
        let (one, copy, other) = (path("one.csv"), path("copy.csv"), path("other.AT2"));
        let pulse = "time_s,accel_m_s2\n0,0\n0.1,3\n0.3,0\n";
        std::fs::write(&one, pulse).unwrap();
        std::fs::write(&copy, pulse).unwrap();
        std::fs::write(&other, pulse).unwrap();

        let last = LastRecord::default();
        let first = last.read(&one).unwrap();
        assert!(Arc::ptr_eq(&first, &last.read(&one).unwrap()));
        assert!(Arc::ptr_eq(&first, &last.read(&copy).unwrap()));
        // Under that name it is no record, and what is known stays.
        assert!(last.read(&other).is_err());
        assert!(Arc::ptr_eq(&first, &last.read(&one).unwrap()));
        // The same file with something else in it.
        std::fs::write(&one, pulse.replace("0.1,3", "0.1,4")).unwrap();
        assert_eq!((first.peak(), last.read(&one).unwrap().peak()), (3.0, 4.0));
        std::fs::remove_file(&one).unwrap();
        assert!(last.read(&one).is_err());
    }
}
