//! Record files as a scene names them: a path, and behind `#` the channel.

use super::accelerogram::{Accelerogram, RecordError};
use std::path::{Path, PathBuf};
use std::{fs, io};

/// A record file that has been read, but not understood yet.
#[derive(Clone, Debug, PartialEq)]
pub struct RecordFile {
    /// Its name, without a channel.
    pub name: String,
    /// The channel that was asked for, counted from 1.
    pub channel: Option<usize>,
    /// All that is in it.
    pub bytes: Vec<u8>,
}

impl RecordFile {
    /// Reads a file. `records/CHAN.v2#2` is the second channel of `records/CHAN.v2`, unless there is a file of that very name.
    ///
    /// # Errors
    /// A file that cannot be read, or what is no file: a device or a pipe may have no end.
    pub fn read(path: &Path) -> io::Result<RecordFile> {
        let (place, channel) = RecordFile::place(path);
        Ok(RecordFile { bytes: read(&place)?, name: place.to_string_lossy().into_owned(), channel })
    }

    /// Where the file lies that `read` reads, and the channel that is asked for.
    pub fn place(path: &Path) -> (PathBuf, Option<usize>) {
        match without_channel(&path.to_string_lossy()) {
            (shorter, Some(number)) if fs::symlink_metadata(path).is_err() => (shorter.into(), Some(number)),
            _ => (path.to_path_buf(), None),
        }
    }

    /// The file that a name asks for among files in memory, told by `bytes_of`, as `read` finds it in a folder.
    pub fn find(name: &str, bytes_of: impl Fn(&str) -> Option<Vec<u8>>) -> Option<RecordFile> {
        if let Some(bytes) = bytes_of(name) {
            return Some(RecordFile { name: name.to_owned(), channel: None, bytes });
        }
        let (shorter, channel) = without_channel(name);
        Some(RecordFile::named(name, channel.and_then(|_| bytes_of(shorter))?))
    }

    /// A file that has been read already; its name may end with a channel.
    pub fn named(name: &str, bytes: Vec<u8>) -> RecordFile {
        let (name, channel) = without_channel(name);
        RecordFile { name: name.to_owned(), channel, bytes }
    }

    /// The channel at the end of a name.
    pub fn channel_of(name: &str) -> Option<usize> {
        without_channel(name).1
    }

    /// What is in it.
    ///
    /// # Errors
    /// As [`super::Record::parse`].
    pub fn parse(&self) -> Result<Accelerogram, RecordError> {
        Accelerogram::parse(&self.name, self.channel, &self.bytes)
    }
}

fn read(path: &Path) -> io::Result<Vec<u8>> {
    if fs::metadata(path).is_ok_and(|metadata| !metadata.is_file()) {
        return Err(io::Error::other("it is no file"));
    }
    fs::read(path)
}

/// `file.v2#2` is `file.v2` and 2.
fn without_channel(name: &str) -> (&str, Option<usize>) {
    let channel = name.rsplit_once('#').and_then(|(file, number)| {
        let is_number = (1..=6).contains(&number.len()) && number.bytes().all(|byte| byte.is_ascii_digit());
        (is_number && !file.is_empty()).then(|| Some((file, number.parse().ok()?)))?
    });
    channel.map_or((name, None), |(file, number)| (file, Some(number)))
}
