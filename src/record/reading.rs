//! A record while its file is being read, and how problems in it are told.

use super::accelerogram::{Accelerogram, Record};
use super::components::Component;
use super::error::RecordError;
use super::format::Format;
use super::unit::Unit;
use crate::figures::{plain, six_decimals};
use std::borrow::Cow;

/// A file of the wrong kind has a problem in every line: nobody reads more than these.
pub const MOST_PROBLEMS: usize = 10;

/// s, of either sign: double precision tells times beyond from each other by a tenth of a millisecond and worse, which
/// no impact can be followed with.
pub const MOST_TIME: f64 = 1e12;

/// s, from sample to sample: in less the slope overflows between the largest accelerations that a scene may have.
const LEAST_INTERVAL: f64 = 1e-300;

/// A record while it is being read, and what is wrong with it so far.
pub(super) struct Reading {
    pub record: Record,
    problems: Vec<String>,
    /// Problems beyond the first ones.
    more: usize,
    /// In the file, good or bad.
    pub samples: usize,
}

impl Reading {
    pub(super) fn with_capacity(samples: usize) -> Reading {
        let record = Record::new(Vec::with_capacity(samples), Vec::with_capacity(samples));
        Reading { record, problems: Vec::new(), more: 0, samples: 0 }
    }

    /// Adds a sample, or what is wrong with it; `place` says where.
    pub(super) fn add(&mut self, time: f64, acceleration: f64, place: impl Fn(String) -> String) {
        self.samples += 1;
        if !time.is_finite() {
            self.refuse(|| place(format!("time {} s: expected a finite time", plain(time))));
        } else if time.abs() > MOST_TIME {
            let expected = format!("expected a time from -{MOST_TIME:e} to {MOST_TIME:e} s");
            self.refuse(|| place(format!("time {} s: {expected}", plain(time))));
        }
        if !acceleration.is_finite() {
            self.refuse(|| place(format!("acceleration {} m/s2: expected a finite acceleration", plain(acceleration))));
        }
        if let Some(&last) = self.record.times.last()
            && time - last < LEAST_INTERVAL
        {
            let more = if time > last { format!("at least {LEAST_INTERVAL:e} s more") } else { "more".to_owned() };
            self.refuse(|| {
                place(format!("time {} s: expected {more} than the time before it, {} s", plain(time), plain(last)))
            });
        }
        // What comes next is compared with this one, in or out of order: one wrong time is one problem, or two.
        if time.is_finite() {
            self.record.times.push(time);
            self.record.accelerations.push(acceleration);
        }
    }

    /// Whether a line is words behind the last of the samples that were announced, such as `*** End data ***`.
    pub(super) fn is_end(&self, line: &str, announced: usize) -> bool {
        self.samples == announced && !line.contains(|c: char| c.is_ascii_digit())
    }

    /// Adds what a line holds at the same interval after the sample before it; `expected` is what an error is none of.
    pub(super) fn add_all(
        &mut self,
        line: usize,
        values: Vec<Result<f64, String>>,
        sample: impl Fn(f64, f64) -> (f64, f64),
        expected: &str,
    ) {
        for value in values {
            match value {
                Ok(value) => {
                    let (time, acceleration) = sample(self.samples as f64, value);
                    self.add(time, acceleration, |problem| on_line(line, problem));
                }
                Err(field) => self.skip(|| on_line(line, format!("{}: expected {expected}", excerpt(&field)))),
            }
        }
    }

    /// Adds pairs of time and acceleration, as many as a line holds.
    pub(super) fn add_pairs(
        &mut self,
        line: usize,
        values: Vec<Result<f64, String>>,
        sample: impl Fn(Option<f64>, f64, f64) -> (f64, f64),
    ) {
        let place = |problem: String| on_line(line, problem);
        for pair in values.chunks(2) {
            match pair {
                [Ok(time), Ok(acceleration)] => {
                    let before = self.record.times.last().copied();
                    let (time, acceleration) = sample(before, *time, *acceleration);
                    self.add(time, acceleration, place);
                }
                [Err(field), ..] | [_, Err(field)] => {
                    self.skip(|| place(format!("{}: expected a number", excerpt(field))));
                }
                _ => self.skip(|| place("a time without an acceleration: expected pairs".to_owned())),
            }
        }
    }

    /// Notes a sample that is none.
    pub(super) fn skip(&mut self, problem: impl FnOnce() -> String) {
        self.samples += 1;
        self.refuse(problem);
    }

    pub(super) fn refuse(&mut self, problem: impl FnOnce() -> String) {
        if self.problems.len() < MOST_PROBLEMS {
            self.problems.push(problem());
        } else {
            self.more += 1;
        }
    }

    /// What `read` makes of a value that a header names, with its line; where there is none, or none that fits, that is
    /// refused. `key` is as messages write it, and `expected` what it has to be.
    pub(super) fn value<T>(
        &mut self,
        found: Option<(usize, &str)>,
        (key, missing): (&str, impl FnOnce() -> String),
        expected: &str,
        read: impl FnOnce(&str) -> Option<T>,
    ) -> Option<(usize, T)> {
        let Some((number, text)) = found else {
            self.refuse(missing);
            return None;
        };
        let value = read(text);
        if value.is_none() {
            self.refuse(|| on_line(number, format!("{key} {}: expected {expected}", excerpt(text))));
        }
        value.map(|value| (number, value))
    }

    /// Whether nothing has been wrong so far.
    pub(super) fn is_sound(&self) -> bool {
        self.problems.is_empty()
    }

    /// Takes away what stands behind so many samples, where it is the last of them again and again.
    pub(super) fn drop_repeated(&mut self, samples: usize) {
        let found = &self.record.accelerations;
        let is_repeated = |last: &f64| found[samples..].iter().all(|value| value == last);
        if self.is_sound() && samples < found.len() && samples.checked_sub(1).is_some_and(|k| is_repeated(&found[k])) {
            self.record.times.truncate(samples);
            self.record.accelerations.truncate(samples);
            self.samples = samples;
        }
    }

    /// Compares the samples that have been found with those that a line of the header announces.
    pub(super) fn check_count(&mut self, line: usize, announced: &str, samples: usize) {
        let found = self.samples;
        if found != samples {
            let expected = format!("{announced} = {samples}: expected {found}, the number of samples in the file");
            self.refuse(|| on_line(line, expected));
        }
    }

    /// Compares the duration that a line of the header announces with that of the samples: to the last one, or an interval more.
    /// Headers write it in whole seconds as well.
    pub(super) fn check_duration(&mut self, line: usize, said: f64) {
        const ROUNDING: f64 = 1.0;
        let times = &self.record.times;
        let (Some(first), Some(last), true) = (times.first(), times.last(), self.is_sound()) else { return };
        let found = six_decimals(last - first);
        if (found - said).abs() > ROUNDING + found / times.len() as f64 {
            let expected = format!("a duration of {} s: expected that of the samples, {} s", plain(said), plain(found));
            self.refuse(|| on_line(line, expected));
        }
    }

    /// Compares the largest sample with that which a line of the header announces, in the unit of the samples. A header
    /// rounds, and its peak may be of a curve through the samples: a fiftieth is allowed.
    pub(super) fn check_peak(&mut self, line: usize, said: f64, unit: Unit) {
        self.check_peak_about(line, said, unit, 0.0);
    }

    /// The same of the peak about a level, m/s2.
    pub(super) fn check_peak_about(&mut self, line: usize, said: f64, unit: Unit, level: f64) {
        const ALLOWED: f64 = 0.02;
        const ROUNDING: f64 = 1e-3;
        let peak = self.record.peak_about(level);
        let expected = unit.in_si(said.abs());
        if self.is_sound() && said != 0.0 && (peak - expected).abs() > ALLOWED * expected + ROUNDING * unit.in_si(1.0) {
            let found = peak / unit.in_si(1.0);
            let problem = format!(
                "a peak of {} {unit}: expected that of the samples, {} {unit}",
                plain(said),
                six_decimals(found)
            );
            self.refuse(|| on_line(line, problem));
        }
    }

    /// The record, with what the file says about it.
    pub(super) fn accelerogram(self, said: Said) -> Result<Accelerogram, RecordError> {
        let Said { format, unit, about, components, chosen } = said;
        let mut record = self.complete()?;
        record.component = components.get(chosen).map(|one| one.name.clone()).unwrap_or_default();
        let has_channels = components.len() > 1 || format.has_channels();
        let names = components.into_iter().map(|component| component.name);
        let channels = if has_channels { names.collect() } else { Vec::new() };
        Ok(Accelerogram { format, unit, about, channels, record })
    }

    /// The record once its file has been read to the end.
    pub(super) fn complete(mut self) -> Result<Record, RecordError> {
        if self.samples < 2 {
            let plural = if self.samples == 1 { "" } else { "s" };
            let found = format!("{} sample{plural}: expected at least 2", self.samples);
            self.refuse(|| found);
        }
        if self.problems.is_empty() { Ok(self.record) } else { Err(self.stop()) }
    }

    /// What has been found, where nothing behind it can be read.
    pub(super) fn stop(self) -> RecordError {
        let Reading { mut problems, more, .. } = self;
        debug_assert!(!problems.is_empty(), "a record is refused without a word");
        match more {
            0 => {}
            1 => problems.push("there is 1 more problem".to_owned()),
            _ => problems.push(format!("there are {more} more problems")),
        }
        RecordError { problems }
    }
}

/// What a file says beside its samples.
pub(super) struct Said {
    pub format: Format,
    /// That of the samples in the file.
    pub unit: Unit,
    /// As [`Accelerogram::about`].
    pub about: String,
    /// All components; none where there is one without a name.
    pub components: Vec<Component>,
    /// The place among them of the one that has been read.
    pub chosen: usize,
}

impl Said {
    /// Of a file with one component, whose name may be empty.
    pub(super) fn one(format: Format, unit: Unit, about: String, component: impl Into<String>) -> Said {
        Said { format, unit, about, components: vec![Component::new(1, component)], chosen: 0 }
    }
}

/// A problem on a line, counted from 1.
pub(super) fn on_line(number: usize, problem: impl std::fmt::Display) -> String {
    format!("line {number}: {problem}")
}

/// s, the first interval between times that is another than a step, by more than times that were rounded.
pub(super) fn other_interval(times: &[f64], step: f64) -> Option<f64> {
    const ROUNDED: f64 = 0.02;
    let mut between = times.windows(2).map(|pair| pair[1] - pair[0]);
    between.find(|between| (between - step).abs() > ROUNDED * step)
}

/// The lines of a text, counted from 1.
pub(super) fn numbered(text: &str) -> impl Iterator<Item = (usize, &str)> {
    text.lines().enumerate().map(|(i, line)| (i + 1, line))
}

/// The text of a file, without a byte order mark: UTF-8, UTF-16 where such a mark says so. What is none of them is read as
/// Latin-1, in which a unit may be `m/s²`; of other encodings names are wrong then, but no numbers.
pub(super) fn text_of(bytes: &[u8]) -> Cow<'_, str> {
    let wide = |rest: &[u8], read: fn([u8; 2]) -> u16| {
        let units: Vec<u16> = rest.chunks_exact(2).map(|pair| read([pair[0], pair[1]])).collect();
        Cow::Owned(String::from_utf16_lossy(&units))
    };
    match bytes {
        [0xff, 0xfe, rest @ ..] => return wide(rest, u16::from_le_bytes),
        [0xfe, 0xff, rest @ ..] => return wide(rest, u16::from_be_bytes),
        _ => {}
    }
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let latin = || bytes.iter().map(|&byte| char::from(byte)).collect();
    std::str::from_utf8(bytes).map_or_else(|_| Cow::Owned(latin()), Cow::Borrowed)
}

/// Text of a file for a message: one line, at most 40 characters.
pub(super) fn excerpt(text: &str) -> String {
    let text = text.trim();
    let printable = |c: char| if c.is_control() { char::REPLACEMENT_CHARACTER } else { c };
    let mut short: String = text.chars().take(40).map(printable).collect();
    if text.chars().nth(40).is_some() {
        short.push_str("...");
    }
    short
}
