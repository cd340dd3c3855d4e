//! Records of the Turkish network of AFAD [Afad2017] in text: a header of lines `KEY : VALUE`, then a row of three
//! components a sample.

use super::accelerogram::Accelerogram;
use super::components::Component;
use super::error::RecordError;
use super::format::Format;
use super::header::{Header, after};
use super::numbers::fortran_number;
use super::options::Column;
use super::reading::{Reading, numbered};
use super::table::Told;
use super::unit::Unit;

const MOST_HEADER_LINES: usize = 60;
const SAMPLES: &str = "NUMBER OF DATA";
const INTERVAL: &str = "SAMPLING INTERVAL (sec)";
const PEAKS: &str = "PGA VALUES (";

/// Whether a text has such a header.
pub(super) fn is_it(text: &str) -> bool {
    let head = head(text);
    head.after(SAMPLES).is_some() && head.after(INTERVAL).is_some()
}

fn head(text: &str) -> Header<'_> {
    let words = |line: &str| line.chars().any(|c| c.is_ascii_alphabetic()) || line.trim().is_empty();
    Header::new("AFAD", numbered(text).take(MOST_HEADER_LINES).take_while(|(_, line)| words(line)))
}

pub(super) fn parse(text: &str, wanted: Option<&Column>) -> Result<Accelerogram, RecordError> {
    let head = head(text);
    let mut reading = Reading::with_capacity(0);
    let count = head.count(SAMPLES, &mut reading);
    let step = head.positive(INTERVAL, &mut reading);
    let unit = head.after(PEAKS).map(|(line, rest)| (line, rest.split(')').next().unwrap_or_default()));
    let missing = || format!("AFAD: no {PEAKS}: expected the unit of the samples behind it");
    let unit = reading.value(unit, (PEAKS, missing), "a unit of acceleration, gal", Unit::read);
    let (Some((line, count)), Some((_, step)), Some((_, unit))) = (count, step, unit) else {
        return Err(reading.stop());
    };
    // The last line of the header names the columns.
    let names = head.lines.iter().rev().find(|(_, line)| !line.trim().is_empty()).map_or("", |(_, line)| line);
    let names = names.split_whitespace().enumerate();
    let components: Vec<Component> = names.map(|(place, name)| Component::new(place + 1, name)).collect();
    let peaks = components.iter().map_while(|component| peak(&head, &component.name)).collect();
    let about = head.about(&["STATION ID", "PLACE", "EARTHQUAKE DATE"]);
    let first = head.lines.len() + 1;
    let count = (line, SAMPLES, count);
    let told = Told {
        format: Format::Afad,
        about,
        unit,
        first,
        components,
        has_times: false,
        step,
        count,
        peaks,
        repeats_last: false,
        duration: None,
    };
    told.read(text, wanted, reading)
}

/// That of a component: `(N-S) 12.3 (E-W) 4.5`.
fn peak(head: &Header<'_>, name: &str) -> Option<(usize, f64)> {
    let (line, rest) = head.after(PEAKS)?;
    Some((line, fortran_number(after(rest, &format!("({name})"))?.split_whitespace().next()?)?))
}
