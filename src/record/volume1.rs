//! Records of the volume 1, uncorrected, with a header in words and one of 100 whole and 50 real numbers: pairs of time and
//! acceleration of digitised film, as USC [TrifunacLee1973], CSMIP [ShakalHuang1985] and RENADIC [Renadic2010] hand them out,
//! and equally spaced samples of BHRC, Iran [Bhrc2012]; both in tenths of g. Blocks of CSMIP with a line that says format and
//! step are read in `volume2.rs`.

use super::accelerogram::Accelerogram;
use super::components::{self, Component};
use super::error::RecordError;
use super::format::Format;
use super::header::{self, Header, positive};
use super::numbers::{Columns, fortran_number, numbers_apart};
use super::options::Column;
use super::reading::{Reading, Said, excerpt, numbered};
use super::unit::Unit;

/// Lines of words at the beginning of a channel, and of numbers behind them.
const MOST_WORDS: usize = 20;
const NUMBERS: usize = 14;
/// Lines of the whole numbers among these, and which of the real numbers behind them is the sampling rate of BHRC, in Hz.
const WHOLE: usize = 7;
const RATE: usize = 9;
const PAIRS: Columns = Columns { count: 10, width: 7 };
const SAMPLES: &str = "NO. OF POINTS";
const BHRC: &str = "* VOL1DS";

/// Whether a text begins so.
pub(super) fn is_it(text: &str) -> bool {
    text.lines().find(|line| !line.trim().is_empty()).is_some_and(is_title)
}

/// `UNCORRECTED ACCELEROGRAM DATA`, `FILE     0 OF UNCORRECTED ACCELEROGRAM DATA OF VOLUME I:`, `* VOL1DS FILE:  5526/01`
fn is_title(line: &str) -> bool {
    let upper = |line: &str| line.to_ascii_uppercase();
    line.starts_with(BHRC)
        || line.get(..24).is_some_and(|start| upper(start) == "UNCORRECTED ACCELEROGRAM")
        || line.starts_with("FILE") && line.contains("OF UNCORRECTED ACCELEROGRAM")
}

pub(super) fn parse(text: &str, wanted: Option<&Column>) -> Result<Accelerogram, RecordError> {
    let blocks = header::blocks("volume 1", text, is_title, MOST_WORDS + NUMBERS);
    let components: Vec<Component> = blocks.iter().enumerate().map(|(place, head)| component(place, head)).collect();
    let chosen = components::choose(&components, wanted)?;
    let head = &blocks[chosen];
    let mut reading = Reading::with_capacity(0);
    let count = head.count(SAMPLES, &mut reading);
    let unit = unit(head, &mut reading);
    let (Some((line, count)), Some(unit)) = (count, unit) else { return Err(reading.stop()) };
    samples(text, head, unit, count, &mut reading);
    reading.check_count(line, SAMPLES, count);
    for key in ["RECORD LENGTH", "DURATION"] {
        if let Some((line, duration, _)) = head.quantity(key) {
            reading.check_duration(line, duration);
        }
    }
    if let Some((line, peak, unit)) = head.quantity("  MAX  =")
        && let Some(unit) = Unit::read(unit)
    {
        reading.check_peak(line, peak, unit);
    }
    let about = format!("{}, {}", station(head), components[chosen].name);
    reading.accelerogram(Said { format: Format::Volume1, unit, about, components, chosen })
}

/// `CHAN  1: EW`, `COMP S05W`, and `COMP V2` for the vertical component V, which is the second.
fn component(place: usize, head: &Header<'_>) -> Component {
    if let Some(label) = head.lines.iter().find_map(|(_, line)| header::channel(line)) {
        return Component::new(header::channel_number(&label).unwrap_or(place + 1), label);
    }
    let name = head.lines.iter().find_map(|(_, line)| header::direction(line)).unwrap_or_default();
    let is_numbered = is_bhrc(head) && name.ends_with(&(place + 1).to_string());
    let name = if is_numbered { name.trim_end_matches(|c: char| c.is_ascii_digit()) } else { &name };
    Component::new(place + 1, name)
}

/// What stands before the position of the station, or in the line below it.
fn station(head: &Header<'_>) -> String {
    let mut lines = head.lines.iter().map(|(_, line)| *line);
    let name = lines.find_map(|line| line.get(..line.to_ascii_uppercase().find("STATION ")?));
    let name = name.filter(|name| !name.trim().is_empty()).or_else(|| lines.next()).unwrap_or_default();
    excerpt(name.trim().split("  ").next().unwrap_or_default())
}

fn is_bhrc(head: &Header<'_>) -> bool {
    head.lines.first().is_some_and(|(_, line)| line.starts_with(BHRC))
}

/// `UNITS ARE SEC AND G/10`, `UNITS OF UNCOR ACCEL ARE SEC AND G/10.     MAX  =  -.200 G`
fn unit(head: &Header<'_>, reading: &mut Reading) -> Option<Unit> {
    let read = |text: &str| Unit::read(header::after(text, "AND")?.split_whitespace().next()?);
    let missing = || "volume 1: no UNITS: expected it in the header, with SEC AND G/10".to_owned();
    let found =
        reading.value(head.after("UNITS"), ("UNITS", missing), "SEC AND G/10 or another unit of acceleration", read);
    found.map(|(_, unit)| unit)
}

/// Reads the samples behind both headers.
fn samples(text: &str, head: &Header<'_>, unit: Unit, count: usize, reading: &mut Reading) {
    let is_numbers =
        |line: &str| line.trim().contains(' ') && line.chars().all(|c| c.is_ascii_digit() || " -".contains(c));
    let Some(words) = head.lines.iter().position(|(_, line)| is_numbers(line)) else {
        reading.refuse(|| {
            "volume 1: cut off within its headers: expected 100 whole and 50 real numbers below the words".to_owned()
        });
        return;
    };
    let above = head.lines[words].0 - 1 + NUMBERS;
    let is_behind = |line: &str| line.starts_with("/&") || is_title(line);
    let lines = numbered(text).skip(above).take_while(|(_, line)| !is_behind(line));
    let lines = lines.filter(|(_, line)| !line.trim().is_empty());
    let rate = match is_bhrc(head) {
        true => Some(rate(head, words, reading)),
        false => None,
    };
    for (number, line) in lines {
        match rate {
            _ if reading.is_end(line, count) => {}
            None => {
                let sample = |_, time, value| (time, unit.in_si(value));
                reading.add_pairs(number, PAIRS.values(line, fortran_number), sample);
            }
            Some(rate) => {
                let sample = |k: f64, value: f64| (k / rate, unit.in_si(value));
                reading.add_all(number, numbers_apart(line), sample, "a number");
            }
        }
    }
}

/// Hz
fn rate(head: &Header<'_>, words: usize, reading: &mut Reading) -> f64 {
    let said = head.lines.get(words + WHOLE + RATE / 8);
    let said = said.map(|(number, line)| (*number, line.split_whitespace().next().unwrap_or_default()));
    let missing = || format!("volume 1: no real numbers: expected the sampling rate as number {RATE}, in Hz");
    let key = format!("real number {RATE}, the sampling rate,");
    reading.value(said, (&key, missing), "a number > 0", positive).map_or(1.0, |(_, rate)| rate)
}
