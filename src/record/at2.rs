//! Records as PEER ground motion database files, `.AT2`.

use super::accelerogram::Accelerogram;
use super::error::RecordError;
use super::format::Format;
use super::numbers::{fortran_number, numbers_apart};
use super::reading::{Reading, Said, excerpt, on_line};
use super::said::{self, SaidUnit};
use super::unit::Unit;

const HEADER_LINES: usize = 4;
/// Letters of the name of a direction.
const LONGEST_COMPONENT: usize = 8;
/// The way out where the accelerations are in another unit.
const OTHERWISE: &str = ", or skip_lines, step and unit, which read the numbers below";
/// A title that goes on makes more of them.
const MOST_HEADER_LINES: usize = 10;

/// Whether a text has such a header.
pub(super) fn is_it(text: &str) -> bool {
    let head = text.lines().take(HEADER_LINES).any(|line| line.to_ascii_uppercase().contains("IN UNITS OF"));
    head || sampling(text).is_some()
}

pub(super) fn parse(text: &str) -> Result<Accelerogram, RecordError> {
    let mut reading = Reading::with_capacity(0);
    let mut lines = text.split('\n').enumerate().map(|(i, line)| (i + 1, line));
    let sampling = sampling(text);
    let header = lines.by_ref().take(sampling.as_ref().map_or(HEADER_LINES, |found| found.line)).collect::<Vec<_>>();
    check_unit(&header, &mut reading);
    let Some(Sampling { line, samples, step }) = sampling else {
        let Some(&(number, last)) = header.get(HEADER_LINES - 1) else {
            reading.refuse(|| format!("{} lines: expected 4 header lines and the samples", header.len()));
            return Err(reading.stop());
        };
        reading.refuse(|| {
            on_line(number, format!("{}: expected NPTS=..., DT=... or \"... ... NPTS, DT\"", excerpt(last)))
        });
        return Err(reading.stop());
    };
    reading.record.times.reserve(samples.min(text.len() / 2));
    reading.record.accelerations.reserve(samples.min(text.len() / 2));
    for (number, line) in lines {
        if !reading.is_end(line, samples) {
            reading.add_all(number, numbers_apart(line), |k, value| (k * step, Unit::Gravity.in_si(value)), "a number");
        }
    }
    reading.check_count(line, "NPTS", samples);
    let about = header.get(1).map_or_else(String::new, |(_, line)| excerpt(line));
    // `Loma Prieta, 10/18/1989, Gilroy, 067`, or UP and the like.
    let second = header.get(1).and_then(|(_, line)| line.rsplit_once(',')).map_or("", |(_, last)| last.trim());
    let component = if second.len() <= LONGEST_COMPONENT { second } else { "" };
    reading.accelerogram(Said::one(Format::PeerAt2, Unit::Gravity, about, component))
}

/// The line of the header that says it: the fourth, or a later one where a title goes on.
fn sampling(text: &str) -> Option<Sampling> {
    let head = text.split('\n').enumerate().take(MOST_HEADER_LINES).skip(HEADER_LINES - 1);
    head.filter(|(_, line)| !line.starts_with('#')).find_map(|(i, line)| Sampling::find(i + 1, line))
}

/// What the last line of the header says.
struct Sampling {
    line: usize,
    samples: usize,
    /// s
    step: f64,
}

impl Sampling {
    /// Reads `NPTS=  4000, DT=  .0100 SEC` and the older `4000  0.0100  NPTS, DT`.
    fn find(number: usize, line: &str) -> Option<Sampling> {
        let text = line.to_ascii_uppercase();
        let separators = |c: char| c.is_whitespace() || matches!(c, ',' | '=' | ':');
        let words: Vec<&str> = text.split(separators).filter(|word| !word.is_empty()).collect();
        let place = |name: &str| words.iter().position(|&word| word == name);
        let (npts, dt) = (place("NPTS")?, place("DT")?);
        let after = Self::read(number, words.get(npts + 1), words.get(dt + 1));
        after.or_else(|| Self::read(number, words.first(), words.get(1)))
    }

    fn read(line: usize, samples: Option<&&str>, step: Option<&&str>) -> Option<Sampling> {
        let step = step?.trim_end_matches("SEC");
        let step = fortran_number(step).filter(|step| step.is_finite() && *step > 0.0)?;
        Some(Sampling { line, samples: samples?.parse().ok()?, step })
    }
}

/// Velocity and displacement files of the same database (`.VT2`, `.DT2`) have the same form and another unit, as have files that
/// others have written in this form.
fn check_unit(header: &[(usize, &str)], reading: &mut Reading) {
    for (number, line) in header {
        let text = line.to_ascii_uppercase();
        let words_after = text.split_once("UNITS OF").map(|(_, after)| after.split([' ', '\t', '\r', ',', '.']));
        let is_other =
            words_after.and_then(|mut words| words.find(|word| !word.is_empty())).is_some_and(|unit| unit != "G");
        let is_other_motion =
            ["VELOCITY", "DISPLACEMENT"].iter().any(|word| text.contains(word)) && !text.contains("ACCEL");
        let is_gravity = |unit: &SaidUnit| *unit == SaidUnit::Known(Unit::Gravity);
        let units = said::units(line);
        if is_other || is_other_motion || !units.iter().all(is_gravity) {
            let otherwise = if is_other_motion || units.is_empty() { "" } else { OTHERWISE };
            reading.refuse(|| on_line(*number, format!("{}: expected UNITS OF G{otherwise}", excerpt(line))));
        }
    }
}
