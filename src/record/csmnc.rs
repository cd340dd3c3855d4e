//! Records of the China Strong Motion Network Centre [Csmnc2012]: a header in words, then the samples in cm/s2.

use super::accelerogram::Accelerogram;
use super::error::RecordError;
use super::format::Format;
use super::header::{Header, after};
use super::numbers::numbers_apart;
use super::reading::{Reading, Said, numbered};
use super::unit::Unit;

const MOST_HEADER_LINES: usize = 40;
const SAMPLES: &str = "NO. OF POINTS";
const INTERVAL: &str = "EQUALLY SPACED INTERVALS OF";
const PEAK: &str = "PEAK VALUE";
const DURATION: &str = "DURATION";

/// Whether a text has such a header.
pub(super) fn is_it(text: &str) -> bool {
    let head = head(text);
    head.after(SAMPLES).is_some() && head.after(INTERVAL).is_some() && head.after("UNIT:").is_some()
}

/// Up to the samples.
fn head(text: &str) -> Header<'_> {
    let is_sample = |line: &str| {
        let values = numbers_apart(line);
        2 * values.iter().filter(|value| value.is_ok()).count() > values.len()
    };
    let lines: Vec<(usize, &str)> = numbered(text).take(MOST_HEADER_LINES).collect();
    let words = lines.iter().position(|(_, line)| after(line, SAMPLES).is_some()).unwrap_or(lines.len());
    let more = lines[words..].iter().take_while(|(_, line)| !is_sample(line)).count();
    Header::new("CSMNC", lines.into_iter().take(words + more))
}

pub(super) fn parse(text: &str) -> Result<Accelerogram, RecordError> {
    let head = head(text);
    let mut reading = Reading::with_capacity(0);
    let count = head.count(SAMPLES, &mut reading);
    let step = head.positive(INTERVAL, &mut reading);
    let unit = head.value("UNIT:", "a unit of acceleration, CM/SEC/SEC", Unit::read, &mut reading);
    let (Some((line, count)), Some((_, step)), Some((_, unit))) = (count, step, unit) else {
        return Err(reading.stop());
    };
    for (number, line) in numbered(text).skip(head.lines.len()) {
        reading.add_all(number, numbers_apart(line), |k, value| (k * step, unit.in_si(value)), "a number");
    }
    reading.check_count(line, SAMPLES, count);
    if let Some((line, peak, _)) = head.quantity(PEAK) {
        reading.check_peak(line, peak, unit);
    }
    if let Some((line, duration, _)) = head.quantity(DURATION) {
        reading.check_duration(line, duration);
    }
    let component = head.word("COMP.").map_or("", |(_, name)| name);
    let about = head.about(&["STATION", "EPICENTER", "COMP."]);
    reading.accelerogram(Said::one(Format::Csmnc, unit, about, component))
}
