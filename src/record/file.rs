//! Record files as a scene names them: a path, and behind `#` the channel or column.

use super::accelerogram::Accelerogram;
use super::error::RecordError;
use super::options::{Column, RecordOptions};
use std::path::{Path, PathBuf};
use std::{fs, io};

/// A record file that has been read, but not understood yet.
#[derive(Clone, Debug, PartialEq)]
pub struct RecordFile {
    /// Its name, without a column.
    pub name: String,
    /// The column that its name asked for.
    pub column: Option<Column>,
    /// What a user says about it otherwise.
    pub options: RecordOptions,
    /// All that is in it.
    pub bytes: Vec<u8>,
}

impl RecordFile {
    /// Reads a file. `records/CHAN.v2#2` is the second channel of `records/CHAN.v2`, and `motion.csv#EW` the column with that name,
    /// unless there is a file of that very name.
    ///
    /// # Errors
    /// A file that cannot be read, or what is no file: a device or a pipe may have no end.
    pub fn read(path: &Path) -> io::Result<RecordFile> {
        let (place, column) = RecordFile::place(path);
        let name = place.to_string_lossy().into_owned();
        Ok(RecordFile { bytes: read(&place)?, name, column, options: RecordOptions::default() })
    }

    /// Where the file lies that `read` reads, and the column that is asked for.
    pub fn place(path: &Path) -> (PathBuf, Option<Column>) {
        match without_column(&path.to_string_lossy()) {
            (shorter, Some(column)) if fs::symlink_metadata(path).is_err() => (shorter.into(), Some(column)),
            _ => (path.to_path_buf(), None),
        }
    }

    /// The file that a name asks for among files in memory, told by `bytes_of`, as `read` finds it in a folder.
    pub fn find(name: &str, bytes_of: impl Fn(&str) -> Option<Vec<u8>>) -> Option<RecordFile> {
        if let Some(bytes) = bytes_of(name) {
            return Some(RecordFile { name: name.to_owned(), column: None, options: RecordOptions::default(), bytes });
        }
        let (shorter, column) = without_column(name);
        Some(RecordFile::named(name, column.and_then(|_| bytes_of(shorter))?))
    }

    /// A file that has been read already; its name may end with a column.
    pub fn named(name: &str, bytes: Vec<u8>) -> RecordFile {
        let (name, column) = without_column(name);
        RecordFile { name: name.to_owned(), column, options: RecordOptions::default(), bytes }
    }

    /// The same file with what a user says about it.
    pub fn with(self, options: &RecordOptions) -> RecordFile {
        RecordFile { options: options.clone(), ..self }
    }

    /// The column at the end of a name.
    pub fn column_of(name: &str) -> Option<Column> {
        without_column(name).1
    }

    /// What is in it.
    ///
    /// # Errors
    /// As [`super::Record::parse`].
    pub fn parse(&self) -> Result<Accelerogram, RecordError> {
        Accelerogram::parse(&self.name, &self.wanted()?, &self.bytes)
    }

    /// What is wanted of it, by its name and otherwise.
    ///
    /// # Errors
    /// Two columns.
    pub(super) fn wanted(&self) -> Result<RecordOptions, RecordError> {
        if let (Some(first), Some(second)) = (&self.column, &self.options.column)
            && first != second
        {
            return Err(RecordError::new(format!("#{first} in its name and column = {second}: expected one of them")));
        }
        let options = self.options.clone();
        Ok(RecordOptions { column: self.column.clone().or(options.column), ..options })
    }
}

fn read(path: &Path) -> io::Result<Vec<u8>> {
    if fs::metadata(path).is_ok_and(|metadata| !metadata.is_file()) {
        return Err(io::Error::other("it is no file"));
    }
    fs::read(path)
}

/// `file.v2#2` is `file.v2` and 2.
fn without_column(name: &str) -> (&str, Option<Column>) {
    const LONGEST: usize = 40;
    let Some((file, column)) = name.rsplit_once('#') else { return (name, None) };
    let is_column = (1..=LONGEST).contains(&column.len()) && !column.contains(['/', '\\', '.']) && !file.is_empty();
    let is_number = column.bytes().all(|byte| byte.is_ascii_digit());
    match column.parse() {
        Ok(number) if is_column && is_number && column.len() <= 6 => (file, Some(Column::Number(number))),
        _ if is_column && !is_number => (file, Some(Column::Name(column.to_owned()))),
        _ => (name, None),
    }
}
