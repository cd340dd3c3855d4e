//! Records of the Central Weather Administration of Taiwan [Lee2001]: a header of comments, then rows of time and three components.

use super::accelerogram::Accelerogram;
use super::components::Component;
use super::error::RecordError;
use super::format::Format;
use super::header::Header;
use super::numbers::fortran_number;
use super::options::Column;
use super::reading::{Reading, numbered};
use super::table::Told;
use super::unit::Unit;

const MOST_HEADER_LINES: usize = 60;
const RATE: &str = "SampleRate(Hz)";
const LENGTH: &str = "RecordLength(sec)";
const UNIT: &str = "AmplitudeUnit";
const SEQUENCE: &str = "DataSequence";

/// Whether a text begins so.
pub(super) fn is_it(text: &str) -> bool {
    let head = head(text);
    head.after(SEQUENCE).is_some() && head.after(RATE).is_some()
}

fn head(text: &str) -> Header<'_> {
    let lines = numbered(text).take(MOST_HEADER_LINES);
    Header::new("CWA", lines.take_while(|(_, line)| line.starts_with('#') || line.trim().is_empty()))
}

pub(super) fn parse(text: &str, wanted: Option<&Column>) -> Result<Accelerogram, RecordError> {
    let head = head(text);
    let mut reading = Reading::with_capacity(0);
    let rate = head.positive(RATE, &mut reading);
    let length = head.positive(LENGTH, &mut reading);
    let unit =
        head.value(UNIT, "a unit of acceleration, gal", |text| Unit::read(text.trim_end_matches('.')), &mut reading);
    // `Time U(+); N(+); E(+)`
    let named = |text: &str| {
        let names = text.strip_prefix("Time")?.split(';').enumerate();
        let name = |text: &str| text.split('(').next().unwrap_or_default().trim().to_owned();
        Some(names.map(|(place, text)| Component::new(place + 2, name(text))).collect::<Vec<_>>())
    };
    let missing = || format!("CWA: no {SEQUENCE}: expected it in the header");
    let components =
        reading.value(head.after(SEQUENCE), (SEQUENCE, missing), "Time and the components behind it", named);
    let (Some((_, rate)), Some((line, length)), Some((_, unit)), Some((_, components))) =
        (rate, length, unit, components)
    else {
        return Err(reading.stop());
    };
    let peaks = components.iter().map_while(|component| peak(&head, &component.name)).collect();
    let count = (line, "RecordLength times SampleRate", (length * rate).round() as usize);
    let about = head.about(&["StationCode", "StationName", "StartTime"]);
    let first = head.lines.len() + 1;
    let told = Told {
        format: Format::Cwa,
        about,
        unit,
        first,
        components,
        has_times: true,
        step: 1.0 / rate,
        count,
        peaks,
        repeats_last: false,
        duration: None,
    };
    told.read(text, wanted, reading)
}

/// The larger of both extremes of a component: `AmplitudeMAX. N: 1.5~ -2.25`.
fn peak(head: &Header<'_>, name: &str) -> Option<(usize, f64)> {
    let (line, rest) = head.after(&format!("AmplitudeMAX. {name}:"))?;
    let (most, least) = rest.split_once('~')?;
    let (most, least) = (fortran_number(most.trim())?, fortran_number(least.trim())?);
    Some((line, if most.abs() > least.abs() { most } else { least }))
}
