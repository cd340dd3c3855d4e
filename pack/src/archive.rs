//! The zip that an FMU is, written reproducibly.

use flate2::write::DeflateEncoder;
use flate2::{Compression, Crc};
use std::io::{self, Write};

/// A file inside an FMU.
#[derive(Clone, PartialEq, Eq)]
pub struct Entry {
    /// With forward slashes, relative to the FMU's root.
    pub path: String,
    /// The contents.
    pub bytes: Vec<u8>,
    permissions: u32,
}

impl Entry {
    /// A file to read.
    pub fn file(path: &str, bytes: Vec<u8>) -> Entry {
        Entry { path: path.into(), bytes, permissions: 0o644 }
    }

    /// A shared library.
    pub fn library(path: &str, bytes: Vec<u8>) -> Entry {
        Entry { path: path.into(), bytes, permissions: 0o755 }
    }
}

const FILE: &[u8] = b"PK\x03\x04";
const IN_DIRECTORY: &[u8] = b"PK\x01\x02";
const END: &[u8] = b"PK\x05\x06";
/// Of the format, which a reader needs.
const VERSION: u16 = 20;
const IS_UTF8: u16 = 1 << 11;
const DEFLATED: u16 = 8;
/// 1980-01-01 00:00, the first that there is: time and date.
const TIME: [u16; 2] = [0, 33];
/// The version of the writer, and that permissions are those of Unix.
const MADE_BY: [u8; 2] = [20, 3];
const REGULAR_FILE: u32 = 0o100_000;

/// The bytes of a zip of these entries in this order. They depend on nothing else: no clock, no owner, no umask.
///
/// # Errors
/// More bytes or entries than the format has numbers for.
pub fn pack(entries: &[Entry]) -> io::Result<Vec<u8>> {
    let (mut archive, mut directory) = (Vec::new(), Vec::new());
    for entry in entries {
        let start = length(&archive)?;
        let name = entry.path.as_bytes();
        let deflated = deflated(&entry.bytes)?;
        let header = header(entry, &deflated)?;
        archive.extend([FILE, &header, name, &deflated].concat());
        // No comment, the first disk, no internal attributes.
        let rest = [0_u8; 6];
        let attributes = [(REGULAR_FILE | entry.permissions) << 16, start].map(u32::to_le_bytes).concat();
        directory.extend([IN_DIRECTORY, &MADE_BY, &header, &rest, &attributes, name].concat());
    }
    let count = u16::try_from(entries.len()).map_err(|_| too_much())?.to_le_bytes();
    let sizes = [length(&directory)?, length(&archive)?].map(u32::to_le_bytes).concat();
    archive.extend(directory);
    archive.extend([END, &[0; 4], &count, &count, &sizes, &[0; 2]].concat());
    Ok(archive)
}

/// What stands both before a file and in the directory, up to the length of the further fields.
fn header(entry: &Entry, deflated: &[u8]) -> io::Result<Vec<u8>> {
    let mut crc = Crc::new();
    crc.update(&entry.bytes);
    let flags = if entry.path.is_ascii() { 0 } else { IS_UTF8 };
    let [time, date] = TIME;
    let name = u16::try_from(entry.path.len()).map_err(|_| too_much())?;
    let numbers = [crc.sum(), length(deflated)?, length(&entry.bytes)?].map(u32::to_le_bytes).concat();
    let shorts = [VERSION, flags, DEFLATED, time, date].map(u16::to_le_bytes).concat();
    Ok([shorts, numbers, [name, 0].map(u16::to_le_bytes).concat()].concat())
}

fn deflated(bytes: &[u8]) -> io::Result<Vec<u8>> {
    let mut encoder = DeflateEncoder::new(Vec::new(), Compression::new(6));
    encoder.write_all(bytes)?;
    encoder.finish()
}

fn length(bytes: &[u8]) -> io::Result<u32> {
    u32::try_from(bytes.len()).map_err(|_| too_much())
}

fn too_much() -> io::Error {
    io::Error::other("more than an archive of 4 GiB can hold")
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    /// An archive of one empty file, byte by byte as section 4.3 of the description of the format (APPNOTE.TXT) has it.
    #[test]
    fn an_archive_is_as_the_format_says() {
        let bytes = pack(&[Entry::library("a", Vec::new())]).unwrap();
        let common = [20, 0, 0, 0, 8, 0, 0, 0, 33, 0, 0, 0, 0, 0, 2, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0];
        let file = [b"PK\x03\x04", &common[..], b"a", &[3, 0]].concat();
        let attributes = [0, 0, 0xed, 0x81];
        let entry = [b"PK\x01\x02\x14\x03", &common[..], &[0; 6], &attributes, &[0; 4], b"a"].concat();
        let end = [b"PK\x05\x06", &[0; 4][..], &[1, 0, 1, 0], &[47, 0, 0, 0, 33, 0, 0, 0, 0, 0]].concat();
        assert_eq!(bytes, [file, entry, end].concat());
    }
}
