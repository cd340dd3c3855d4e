//! Records as CSV: `time_s,accel_m_s2`.

use super::accelerogram::{Record, RecordError};
use super::reading::{Reading, excerpt, on_line};
use ::csv::{ByteRecord, ReaderBuilder, Trim};

const COLUMNS: [&str; 2] = ["time_s", "accel_m_s2"];

pub(super) fn parse(bytes: &[u8]) -> Result<Record, RecordError> {
    // Without quoting a stray quotation mark is an error on its own line instead of swallowing the lines that follow.
    let mut reader = ReaderBuilder::new()
        .has_headers(false)
        .flexible(true)
        .quoting(false)
        .comment(Some(b'#'))
        .trim(Trim::All)
        .from_reader(bytes);
    let mut row = ByteRecord::new();
    let mut header_read = false;
    let mut reading = Reading::with_capacity(bytes.len() / 16);
    loop {
        let more = reader.read_byte_record(&mut row).map_err(|e| RecordError::new(e.to_string()))?;
        if !more {
            break;
        }
        let end = usize::try_from(reader.position().byte()).unwrap_or(usize::MAX);
        let here = |problem: String| on_line(line_that_ends_at(bytes, end), problem);
        if is_blank_or_comment(&row) {
            continue;
        }
        if !header_read {
            check_header(&row).map_err(|problem| RecordError::new(here(problem)))?;
            header_read = true;
            continue;
        }
        match sample(&row) {
            Ok((time, acceleration)) => reading.add(time, acceleration, here),
            Err(problem) => reading.skip(|| here(problem)),
        }
    }
    if !header_read {
        return Err(RecordError::new(format!("no header line: expected {}", COLUMNS.join(","))));
    }
    reading.complete()
}

/// The `csv` crate skips empty lines and lines that start with `#`; these are the ones with blanks before.
fn is_blank_or_comment(row: &ByteRecord) -> bool {
    row.get(0).is_some_and(|first| first.starts_with(b"#") || (first.is_empty() && row.len() == 1))
}

fn check_header(row: &ByteRecord) -> Result<(), String> {
    let unquoted = row.iter().map(|name| name.strip_prefix(b"\"").and_then(|n| n.strip_suffix(b"\"")).unwrap_or(name));
    if unquoted.eq(COLUMNS.map(str::as_bytes)) {
        return Ok(());
    }
    Err(format!("header {}: expected {}", joined(row), COLUMNS.join(",")))
}

fn sample(row: &ByteRecord) -> Result<(f64, f64), String> {
    let (Some(time), Some(acceleration), 2) = (row.get(0), row.get(1), row.len()) else {
        return Err(format!("{}: expected 2 values, {}, not {}", joined(row), COLUMNS.join(" and "), row.len()));
    };
    Ok((number(COLUMNS[0], time)?, number(COLUMNS[1], acceleration)?))
}

fn number(column: &str, field: &[u8]) -> Result<f64, String> {
    let parsed = std::str::from_utf8(field).ok().and_then(|text| text.parse().ok());
    parsed.ok_or_else(|| format!("{column} = {}: expected a number", excerpt(field)))
}

fn joined(row: &ByteRecord) -> String {
    excerpt(&row.iter().collect::<Vec<_>>().join(&b','))
}

/// The line, counted from 1, of the row after which the reader stands at byte `end`. (The reader's own line is that of
/// the row before, comments and blank lines not counted.) Called for errors only.
fn line_that_ends_at(bytes: &[u8], end: usize) -> usize {
    let row = bytes.get(..end.saturating_sub(1)).unwrap_or(bytes);
    row.iter().filter(|&&byte| byte == b'\n').count() + 1
}
