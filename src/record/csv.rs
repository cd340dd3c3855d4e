//! Records as CSV: `time_s,accel_m_s2`.

use super::accelerogram::Accelerogram;
use super::error::RecordError;
use super::format::Format;
use super::reading::{Reading, Said, excerpt, on_line};
use super::unit::Unit;

const COLUMNS: [&str; 2] = ["time_s", "accel_m_s2"];
/// Number of the one with the accelerations.
pub(super) const COLUMN: usize = 2;

/// Bytes of a short line: two numbers, a comma and the end of the line.
const SHORT_LINE: usize = 12;

/// Whether a text has the header; one without any row has none, and is told so.
pub(super) fn is_it(text: &str) -> bool {
    Rows { line: 1, rest: text }.next().is_none_or(|(_, row)| check_header(row).is_ok())
}

pub(super) fn parse(text: &str) -> Result<Accelerogram, RecordError> {
    let mut rows = Rows { line: 1, rest: text };
    let Some((line, header)) = rows.next() else {
        return Err(RecordError::new(format!("no header line: expected {}", COLUMNS.join(","))));
    };
    check_header(header).map_err(|problem| RecordError::new(on_line(line, problem)))?;
    let mut reading = Reading::with_capacity(text.len() / SHORT_LINE);
    for (line, row) in rows {
        match sample(row) {
            Some((time, acceleration)) => reading.add(time, acceleration, |problem| on_line(line, problem)),
            None => reading.skip(|| on_line(line, problem(row))),
        }
    }
    let comment = text.trim_start().strip_prefix('#').and_then(|rest| rest.split('\n').next());
    let about = comment.map_or_else(String::new, excerpt);
    reading.accelerogram(Said::one(Format::Csv, Unit::Metres, about, ""))
}

/// The rows of a text, each with its line, counted from 1: all but blank ones and comments. `\r` alone ends a row too, but
/// not a line and no comment.
struct Rows<'t> {
    line: usize,
    rest: &'t str,
}

impl<'t> Iterator for Rows<'t> {
    type Item = (usize, &'t str);

    fn next(&mut self) -> Option<(usize, &'t str)> {
        while !self.rest.is_empty() {
            let (line, rest, is_comment) = (self.line, self.rest, self.rest.starts_with('#'));
            // All but few bytes are greater than both: one comparison for each.
            let ends = |byte| byte <= b'\r' && (byte == b'\n' || (byte == b'\r' && !is_comment));
            let end = rest.bytes().position(ends);
            let end = end.unwrap_or(rest.len());
            self.line += usize::from(rest.as_bytes().get(end) == Some(&b'\n'));
            self.rest = rest.get(end + 1..).unwrap_or_default();
            let row = rest.get(..end).unwrap_or_default().trim_ascii();
            if !row.is_empty() && !row.starts_with('#') {
                return Some((line, row));
            }
        }
        None
    }
}

fn check_header(row: &str) -> Result<(), String> {
    let values = values(row);
    let unquoted = values.iter().map(|name| name.strip_prefix('"').and_then(|n| n.strip_suffix('"')).unwrap_or(name));
    if unquoted.eq(COLUMNS) {
        return Ok(());
    }
    Err(format!("header {}: expected {}", excerpt(&values.join(",")), COLUMNS.join(",")))
}

/// Time and acceleration; `None` where the row does not hold them, see [`problem`].
fn sample(row: &str) -> Option<(f64, f64)> {
    let comma = row.bytes().position(|byte| byte == b',')?;
    let (time, acceleration) = (row.get(..comma)?, row.get(comma + 1..)?);
    Some((time.trim_ascii().parse().ok()?, acceleration.trim_ascii().parse().ok()?))
}

/// What is wrong with a row that holds no sample.
fn problem(row: &str) -> String {
    let values = values(row);
    if values.len() != COLUMNS.len() {
        let (row, columns) = (excerpt(&values.join(",")), COLUMNS.join(" and "));
        return format!("{row}: expected 2 values, {columns}, not {}", values.len());
    }
    let is_wrong = |(_, value): &(_, &str)| value.parse::<f64>().is_err();
    let (column, value) = COLUMNS.into_iter().zip(values).find(is_wrong).unwrap_or_default();
    format!("{column} = {}: expected a number", excerpt(value))
}

fn values(row: &str) -> Vec<&str> {
    row.split(',').map(str::trim_ascii).collect()
}
