//! Records of K-NET and KiK-net in ASCII [Nied2006]: counts, the scale factor of the header makes them gal.

use super::accelerogram::Accelerogram;
use super::error::RecordError;
use super::format::Format;
use super::numbers::Columns;
use super::reading::{Reading, Said, excerpt, numbered};
use super::unit::Unit;

/// How the first line of every file begins.
const FIRST_KEY: &str = "Origin Time";
const LAST_KEY: &str = "Memo";
const SCALE: &str = "Scale Factor";
/// Header lines of a sound file; a memo may go on for a few more.
const HEADER_LINES: usize = 17;
const MOST_HEADER_LINES: usize = 60;
const COLUMNS: Columns = Columns { count: 8, width: 9 };

/// Whether a text begins so.
pub(super) fn is_it(text: &str) -> bool {
    text.trim_start().starts_with(FIRST_KEY)
}

pub(super) fn parse(text: &str) -> Result<Accelerogram, RecordError> {
    let mut reading = Reading::with_capacity(0);
    let header = Header::read(text, &mut reading);
    let (Some(header), true) = (header, reading.is_sound()) else { return Err(reading.stop()) };
    let Scale { gal, counts } = header.scale;
    for (number, line) in numbered(text).skip(header.lines) {
        // Both products are whole numbers, so that the quotient is all that is rounded.
        let sample = |k: f64, value: f64| (k / header.frequency, value * gal / (100.0 * counts));
        reading.add_all(number, COLUMNS.values(line, count), sample, "whole counts");
    }
    let samples = (header.duration * header.frequency).round();
    reading.check_count(header.duration_line, "Duration Time times Sampling Freq", samples as usize);
    if let Some((line, peak)) = header.peak.filter(|_| reading.is_sound() && reading.samples > 0) {
        // The network takes the offset away first.
        let level = reading.record.mean();
        reading.check_peak_about(line, peak, Unit::Centimetres, level);
    }
    reading.accelerogram(Said::one(Format::Knet, Unit::Centimetres, header.about, header.direction))
}

/// Whether most of a line is counts, in columns or apart.
fn is_data(line: &str) -> bool {
    let values = COLUMNS.values(line, count);
    2 * values.iter().filter(|value| value.is_ok()).count() > values.len()
}

fn count(text: &str) -> Option<f64> {
    let is_short = text.len() <= COLUMNS.width;
    text.parse::<i64>().ok().filter(|_| is_short).map(|value| value as f64)
}

struct Header {
    /// Hz
    frequency: f64,
    /// s
    duration: f64,
    duration_line: usize,
    scale: Scale,
    /// gal, about the mean, with its line.
    peak: Option<(usize, f64)>,
    about: String,
    direction: String,
    lines: usize,
}

/// `3920(gal)/6182761`: so many gal are so many counts.
struct Scale {
    gal: f64,
    counts: f64,
}

impl Header {
    fn read(text: &str, reading: &mut Reading) -> Option<Header> {
        let head: Vec<(usize, &str)> = numbered(text).take(MOST_HEADER_LINES).collect();
        let Some(last) = head.iter().position(|(_, line)| line.starts_with(LAST_KEY)) else {
            let lines = HEADER_LINES;
            reading
                .refuse(|| format!("K-NET: no line {LAST_KEY}: expected a header of {lines} lines that ends with it"));
            return None;
        };
        // A memo that goes on.
        let memo = head[last + 1..].iter().take_while(|(_, line)| !is_data(line)).count();
        let value = |key: &str| {
            let found = head[..last].iter().find_map(|(number, line)| Some((*number, line.strip_prefix(key)?)));
            found.map(|(number, rest)| (number, rest.split_once(')').map_or(rest, |(_, after)| after).trim()))
        };
        let about = |key: &str| value(key).map_or_else(String::new, |(_, text)| excerpt(text));
        let frequency = positive(value("Sampling Freq"), "Sampling Freq(Hz)", reading);
        let duration = positive(value("Duration Time"), "Duration Time(s)", reading);
        let scale = head[..last].iter().find_map(|(number, line)| Some((*number, line.strip_prefix(SCALE)?.trim())));
        let scale = value_of(scale, SCALE, "gal and counts, such as 3920(gal)/6182761", Scale::of, reading);
        Some(Header {
            frequency: frequency?.1,
            duration: duration?.1,
            duration_line: duration?.0,
            scale: scale?.1,
            peak: value("Max. Acc.").and_then(|(number, text)| Some((number, text.parse().ok()?))),
            direction: direction(&about("Dir.")),
            about: format!("{}, {}, {}", about("Station Code"), about("Dir."), about(FIRST_KEY)),
            lines: last + 1 + memo,
        })
    }
}

/// KiK-net numbers its components: 1 to 3 are of the sensor in the borehole, 3 and 6 vertical.
fn direction(said: &str) -> String {
    let name = match said {
        "1" | "4" => "N-S",
        "2" | "5" => "E-W",
        "3" | "6" => "U-D",
        other => other,
    };
    name.to_owned()
}

/// A value of the header, with its line; what is wrong with it is noted.
fn value_of<T>(
    found: Option<(usize, &str)>,
    key: &str,
    expected: &str,
    read: impl Fn(&str) -> Option<T>,
    reading: &mut Reading,
) -> Option<(usize, T)> {
    reading.value(found, (key, || format!("K-NET: no line {key}: expected it in the header")), expected, read)
}

/// The number > 0 of a header line, and its line.
fn positive(found: Option<(usize, &str)>, key: &str, reading: &mut Reading) -> Option<(usize, f64)> {
    let read = |text: &str| {
        let value = text.trim_end_matches(['H', 'h', 'z', 's']).trim().parse::<f64>();
        value.ok().filter(|value| *value > 0.0 && *value < 1e9)
    };
    value_of(found, key, "a number > 0", read, reading)
}

impl Scale {
    fn of(text: &str) -> Option<Scale> {
        let (gal, counts) = text.split_once('/')?;
        let (gal, unit) = gal.split_once('(')?;
        let is_gal = unit.trim().trim_end_matches(')').eq_ignore_ascii_case("gal");
        let number = |text: &str| text.trim().parse::<f64>().ok().filter(|v| *v > 0.0 && v.is_finite());
        let scale = Scale { gal: number(gal)?, counts: number(counts)? };
        is_gal.then_some(scale)
    }
}
