//! Records of ESM and ITACA in ASCII [Luzi2016]: lines `KEY: VALUE`, then the samples.

use super::accelerogram::Accelerogram;
use super::error::RecordError;
use super::format::Format;
use super::numbers::{numbers_apart, numbers_of};
use super::reading::{Reading, Said, excerpt, numbered, on_line};
use super::unit::Unit;

/// The header has 64 lines, older ones fewer; values may go on in a line of their own.
const MOST_HEADER_LINES: usize = 200;
const INTERVAL: &str = "SAMPLING_INTERVAL_S";
const SAMPLES: &str = "NDATA";
const UNITS: &str = "UNITS";
const TYPE: &str = "DATA_TYPE";

/// Whether a text begins with such a header.
pub(super) fn is_it(text: &str) -> bool {
    let mut keys = numbered(text).take(MOST_HEADER_LINES).filter_map(|(_, line)| entry(line)).map(|(key, _)| key);
    let first = numbered(text).find(|(_, line)| !line.trim().is_empty());
    first.is_some_and(|(_, line)| entry(line).is_some())
        && keys.any(|key| [INTERVAL, SAMPLES, "EVENT_NAME", "EVENT_ID"].contains(&key))
}

/// Key and value of a header line.
fn entry(line: &str) -> Option<(&str, &str)> {
    let (key, value) = line.trim_start().split_once(':')?;
    let is_key = key.starts_with(|c: char| c.is_ascii_uppercase())
        && key.chars().all(|c| c.is_ascii_uppercase() || c.is_ascii_digit() || "_/^()-".contains(c));
    is_key.then(|| (key, value.trim()))
}

pub(super) fn parse(text: &str) -> Result<Accelerogram, RecordError> {
    let header = Header::read(text);
    let mut reading = Reading::with_capacity(0);
    let unit = header.unit(&mut reading);
    let expected = |text: &str| text.parse::<f64>().ok().filter(|step| *step > 0.0 && step.is_finite());
    let step = header.value(INTERVAL, "a number of seconds > 0", expected, &mut reading);
    let samples = header.value(SAMPLES, "a number of samples", |text| text.parse::<usize>().ok(), &mut reading);
    let (Some(unit), Some((_, step)), Some((line, samples))) = (unit, step, samples) else {
        return Err(reading.stop());
    };
    for (number, line) in numbered(text).skip(header.lines) {
        reading.add_all(number, numbers_apart(line), |k, value| (k * step, unit.in_si(value)), "a number");
    }
    reading.check_count(line, SAMPLES, samples);
    if let Some((number, peak)) = header.peak() {
        reading.check_peak(number, peak, Unit::Centimetres);
    }
    let component = header.find("STREAM").map_or("", |(_, stream)| stream);
    reading.accelerogram(Said::one(Format::Esm, unit, header.about(), component))
}

struct Header<'t> {
    /// Line, key and value.
    entries: Vec<(usize, &'t str, &'t str)>,
    lines: usize,
}

impl<'t> Header<'t> {
    fn read(text: &'t str) -> Header<'t> {
        let head = || numbered(text).take(MOST_HEADER_LINES);
        let entries = head().filter_map(|(number, line)| entry(line).map(|(key, value)| (number, key, value)));
        let entries: Vec<_> = entries.collect();
        let last = entries.last().map_or(0, |(number, ..)| *number);
        let is_number = |line: &str| line.split_whitespace().next().is_some_and(|f| numbers_of(f).is_some());
        let continued = head().skip(last).take_while(|(_, line)| !line.trim().is_empty() && !is_number(line)).count();
        // What no number follows is no header that goes on, but samples that cannot be read.
        let is_header = head().nth(last + continued).is_some_and(|(_, line)| is_number(line));
        Header { entries, lines: last + if is_header { continued } else { 0 } }
    }

    fn find(&self, key: &str) -> Option<(usize, &'t str)> {
        self.entries.iter().find(|(_, found, _)| *found == key).map(|(number, _, value)| (*number, *value))
    }

    /// A value, with its line; what is wrong with it is noted.
    fn value<T>(
        &self,
        key: &str,
        expected: &str,
        read: impl Fn(&str) -> Option<T>,
        reading: &mut Reading,
    ) -> Option<(usize, T)> {
        let missing = || format!("ESM, ITACA: no line {key}: expected it in the header, with {expected}");
        reading.value(self.find(key), (&format!("{key}:"), missing), expected, read)
    }

    fn unit(&self, reading: &mut Reading) -> Option<Unit> {
        if let Some((number, kind)) = self.find(TYPE)
            && !kind.is_empty()
            && (!kind.to_ascii_uppercase().contains("ACCELERATION") || kind.to_ascii_uppercase().contains("SPECTR"))
        {
            reading.refuse(|| on_line(number, format!("{TYPE}: {}: expected ACCELERATION", excerpt(kind))));
        }
        let unit = self.value(UNITS, "a unit of acceleration, cm/s^2", Unit::read, reading);
        unit.filter(|_| reading.is_sound()).map(|(_, unit)| unit)
    }

    /// cm/s2, with its line.
    fn peak(&self) -> Option<(usize, f64)> {
        let (number, value) = self.find("PGA_CM/S^2")?;
        Some((number, value.parse().ok()?))
    }

    fn about(&self) -> String {
        let keys = ["EVENT_NAME", "EVENT_DATE_YYYYMMDD", "NETWORK", "STATION_CODE", "STREAM"];
        let known = keys.iter().filter_map(|key| self.find(key)).filter(|(_, value)| !value.is_empty());
        known.map(|(_, value)| excerpt(value)).collect::<Vec<_>>().join(", ")
    }
}
