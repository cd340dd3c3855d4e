//! Records as PEER ground motion database files, `.AT2`.

use super::accelerogram::{Record, RecordError, STANDARD_GRAVITY};
use super::reading::{Reading, excerpt, on_line, text_of};

const HEADER_LINES: usize = 4;

pub(super) fn parse(bytes: &[u8]) -> Result<Record, RecordError> {
    let text = text_of(bytes);
    let mut lines = text.split('\n').enumerate().map(|(i, line)| (i + 1, line));
    let header: Vec<_> = lines.by_ref().take(HEADER_LINES).collect();
    let mut reading = Reading::with_capacity(0);
    check_unit(&header, &mut reading);
    let Some(&(number, last)) = header.get(HEADER_LINES - 1) else {
        reading.refuse(|| format!("{} lines: expected 4 header lines and the samples", header.len()));
        return Err(reading.stop());
    };
    let Some(Sampling { samples, step }) = Sampling::find(last) else {
        reading.refuse(|| {
            on_line(number, format!("{}: expected NPTS=..., DT=... or \"... ... NPTS, DT\"", excerpt(last)))
        });
        return Err(reading.stop());
    };
    reading.record.times.reserve(samples.min(bytes.len() / 2));
    reading.record.accelerations.reserve(samples.min(bytes.len() / 2));
    for (number, line) in lines {
        for field in line.split_ascii_whitespace() {
            let time = reading.samples as f64 * step;
            match fortran_number(field) {
                Some(value) => reading.add(time, value * STANDARD_GRAVITY, |problem| on_line(number, problem)),
                None => reading.skip(|| on_line(number, format!("{}: expected a number", excerpt(field)))),
            }
        }
    }
    let found = reading.samples;
    if found != samples {
        let expected = format!("NPTS = {samples}: expected {found}, the number of samples in the file");
        reading.refuse(|| on_line(number, expected));
    }
    reading.complete()
}

/// What the fourth line says.
struct Sampling {
    samples: usize,
    /// s
    step: f64,
}

impl Sampling {
    /// Reads `NPTS=  4000, DT=  .0100 SEC` and the older `4000  0.0100  NPTS, DT`.
    fn find(line: &str) -> Option<Sampling> {
        let text = line.to_ascii_uppercase();
        let separators = |c: char| c.is_whitespace() || matches!(c, ',' | '=' | ':');
        let words: Vec<&str> = text.split(separators).filter(|word| !word.is_empty()).collect();
        let place = |name: &str| words.iter().position(|&word| word == name);
        let (npts, dt) = (place("NPTS")?, place("DT")?);
        let after = Self::read(words.get(npts + 1), words.get(dt + 1));
        after.or_else(|| Self::read(words.first(), words.get(1)))
    }

    fn read(samples: Option<&&str>, step: Option<&&str>) -> Option<Sampling> {
        let step = step?.trim_end_matches("SEC");
        let step = fortran_number(step).filter(|step| step.is_finite() && *step > 0.0)?;
        Some(Sampling { samples: samples?.parse().ok()?, step })
    }
}

/// Velocity and displacement files of the same database (`.VT2`, `.DT2`) have the same form and another unit.
fn check_unit(header: &[(usize, &str)], reading: &mut Reading) {
    for (number, line) in header {
        let text = line.to_ascii_uppercase();
        let words_after = text.split_once("UNITS OF").map(|(_, after)| after.split([' ', '\t', '\r', ',', '.']));
        if words_after.and_then(|mut words| words.find(|word| !word.is_empty())).is_some_and(|unit| unit != "G") {
            reading.refuse(|| on_line(*number, format!("{}: expected UNITS OF G", excerpt(line))));
        }
    }
}

/// A number as Fortran writes it: `.1234E-02`, `-0.5D-03`, and `.1234-102` where the exponent has three digits.
fn fortran_number(text: &str) -> Option<f64> {
    if let Ok(value) = text.parse() {
        return Some(value);
    }
    let with_e = text.replace(['d', 'D'], "E");
    with_e.parse().ok().or_else(|| {
        let sign = with_e.rfind(['+', '-']).filter(|&place| place > 0)?;
        let (mantissa, exponent) = with_e.split_at_checked(sign)?;
        format!("{mantissa}E{exponent}").parse().ok()
    })
}
