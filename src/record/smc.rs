//! Records of the USGS in SMC format [Seekins1992]: a header of text, one of 48 whole and one of 50 real numbers, comments, then
//! the samples in cm/s2, or pairs of time and acceleration.

use super::accelerogram::Accelerogram;
use super::error::RecordError;
use super::format::Format;
use super::header::{self, Header};
use super::numbers::{Columns, fortran_number, numbers_apart};
use super::reading::{Reading, Said, excerpt, numbered, on_line};
use super::unit::Unit;

/// Lines of text, of whole numbers and of real numbers, from the top.
const TEXT: usize = 11;
const WHOLE: Numbers = Numbers { lines: 6, columns: Columns { count: 8, width: 10 } };
const REAL: Numbers = Numbers { lines: 10, columns: Columns { count: 5, width: 15 } };
/// Which of the whole numbers, counted from 1: degrees from the upward vertical, degrees from north, and how many numbers follow
/// the comments.
const FROM_UP: usize = 13;
const FROM_NORTH: usize = 14;
const VALUES: usize = 17;
/// Which of the real numbers: samples per second, none where they are not equally spaced, and both peaks.
const RATE: usize = 2;
const PEAKS: [usize; 2] = [30, 32];
/// Hz; a number that stands for none is far beyond.
const MOST_RATE: f64 = 1e6;

/// Whether a text begins so: a digit and the kind of motion, then an asterisk.
pub(super) fn is_it(text: &str) -> bool {
    let mut lines = text.lines();
    let (Some(title), Some(mark)) = (lines.next(), lines.next()) else { return false };
    kind(title).is_some() && mark.trim_start().starts_with('*')
}

/// `2 CORRECTED ACCELEROGRAM`
fn kind(title: &str) -> Option<&str> {
    let (digit, kind) = title.trim().split_once(' ')?;
    let kinds = ["UNCORRECTED", "CORRECTED", "VELOCITY", "DISPLACEMENT", "RESPONSE", "FOURIER", "UNKNOWN"];
    let is_one = digit.parse::<u8>().is_ok() && kinds.iter().any(|known| kind.trim_start().starts_with(known));
    is_one.then_some(kind.trim())
}

pub(super) fn parse(text: &str) -> Result<Accelerogram, RecordError> {
    let mut reading = Reading::with_capacity(0);
    let title = text.lines().next().and_then(kind).unwrap_or_default();
    if !title.ends_with("ACCELEROGRAM") {
        reading.refuse(|| on_line(1, format!("{}: expected an accelerogram", excerpt(title))));
    }
    let whole = WHOLE.read(text, TEXT, &mut reading);
    let real = REAL.read(text, TEXT + WHOLE.lines, &mut reading);
    if !reading.is_sound() {
        return Err(reading.stop());
    }
    let values = whole[VALUES - 1] as usize;
    let lines = numbered(text).skip(TEXT + WHOLE.lines + REAL.lines).filter(|(_, line)| !line.trim().is_empty());
    let lines = lines.skip_while(|(_, line)| line.starts_with('|'));
    let line = WHOLE.line_of(VALUES, TEXT);
    match Some(real[RATE - 1]).filter(|rate| *rate > 0.0 && *rate < MOST_RATE) {
        Some(rate) => {
            let sample = |k: f64, value: f64| (k / rate, Unit::Centimetres.in_si(value));
            lines.for_each(|(number, line)| reading.add_all(number, numbers_apart(line), sample, "a number"));
            reading.check_count(line, "values", values);
        }
        None => {
            pairs(lines, values, &mut reading);
            reading.check_count(line, "pairs of values", values / 2);
        }
    }
    let peaks = PEAKS.map(|number| (real[number - 1], REAL.line_of(number, TEXT + WHOLE.lines)));
    let known = peaks.into_iter().filter(|(peak, _)| *peak != real[0]);
    if let Some((peak, line)) = known.max_by(|(a, _), (b, _)| a.abs().total_cmp(&b.abs())) {
        reading.check_peak(line, peak, Unit::Centimetres);
    }
    let head = Header::new("SMC", numbered(text).take(TEXT));
    let component = component(&head, &whole);
    let station = head.after("station").map_or("", |(_, text)| text.split("component").next().unwrap_or_default());
    let about = format!("{}, {component}", excerpt(station.trim().trim_end_matches(',')));
    reading.accelerogram(Said::one(Format::Smc, Unit::Centimetres, about, component))
}

/// Direction, in degrees or as `up`.
fn component(head: &Header<'_>, whole: &[f64]) -> String {
    let said = head.lines.iter().find_map(|(_, line)| header::after(line, "component"));
    match (said.filter(|text| !text.is_empty()), whole[FROM_UP - 1]) {
        (Some(text), _) => excerpt(text),
        (None, 0.0) => "up".to_owned(),
        (None, 180.0) => "down".to_owned(),
        (None, _) => whole[FROM_NORTH - 1].to_string(),
    }
}

/// Pairs of time and acceleration, as many numbers as announced. Behind them files of the network have one line more, which
/// belongs to no sample: its times do not go on where the others end.
fn pairs<'t>(lines: impl Iterator<Item = (usize, &'t str)>, announced: usize, reading: &mut Reading) {
    let mut is_over = false;
    for (number, line) in lines {
        if reading.samples == announced / 2 && !std::mem::replace(&mut is_over, true) {
            continue;
        }
        let sample = |before, time, value| (told_apart(before, time), Unit::Centimetres.in_si(value));
        reading.add_pairs(number, numbers_apart(line), sample);
    }
}

/// Times have five digits, which are too few for the samples beyond 10 s: one that is the same as that before it is moved on, half
/// the way to the next digit.
fn told_apart(before: Option<f64>, time: f64) -> f64 {
    let digit = 10f64.powi((time.log10().floor() as i32).saturating_sub(4));
    match before {
        Some(before) if time > 0.0 && before >= time && before < time + digit => (before + time + digit) / 2.0,
        _ => time,
    }
}

/// One of both headers of numbers.
struct Numbers {
    lines: usize,
    columns: Columns,
}

impl Numbers {
    /// The line of a number, both counted from 1, below so many lines.
    fn line_of(&self, number: usize, above: usize) -> usize {
        above + 1 + (number - 1) / self.columns.count
    }

    /// Its numbers, below so many lines; what is wrong with them is noted.
    fn read(&self, text: &str, above: usize, reading: &mut Reading) -> Vec<f64> {
        let lines = numbered(text).skip(above).take(self.lines);
        let values: Vec<f64> =
            lines.flat_map(|(_, line)| self.columns.values(line, fortran_number)).map_while(Result::ok).collect();
        let expected = self.lines * self.columns.count;
        if values.len() != expected {
            let (first, last) = (above + 1, above + self.lines);
            reading.refuse(|| format!("SMC: {} numbers in lines {first} to {last}: expected {expected}", values.len()));
        }
        values
    }
}
