//! Headers in words: what stands behind a key.

use super::numbers::fortran_number;
use super::reading::{Reading, excerpt, numbered};

/// Lines of a header that are searched.
pub(super) struct Header<'t> {
    /// As messages call it.
    pub format: &'static str,
    pub lines: Vec<(usize, &'t str)>,
}

impl<'t> Header<'t> {
    pub(super) fn new(format: &'static str, lines: impl Iterator<Item = (usize, &'t str)>) -> Header<'t> {
        Header { format, lines: lines.collect() }
    }

    /// What stands behind the first place of a key in any case, without blanks, `:` and `=`; its line.
    pub(super) fn after(&self, key: &str) -> Option<(usize, &'t str)> {
        self.lines.iter().find_map(|(number, line)| Some((*number, after(line, key)?)))
    }

    /// The first word of that, which a comma ends as well.
    pub(super) fn word(&self, key: &str) -> Option<(usize, &'t str)> {
        self.after(key).map(|(number, rest)| (number, first_word(rest)))
    }

    /// What `read` makes of it; what is wrong with it is noted.
    pub(super) fn value<T>(
        &self,
        key: &str,
        expected: &str,
        read: impl Fn(&str) -> Option<T>,
        reading: &mut Reading,
    ) -> Option<(usize, T)> {
        let missing = || format!("{}: no {key}: expected it in the header, with {expected}", self.format);
        reading.value(self.word(key), (key, missing), expected, read)
    }

    /// A number of seconds or Hz, > 0.
    pub(super) fn positive(&self, key: &str, reading: &mut Reading) -> Option<(usize, f64)> {
        self.value(key, "a number > 0", positive, reading)
    }

    /// A number of samples.
    pub(super) fn count(&self, key: &str, reading: &mut Reading) -> Option<(usize, usize)> {
        self.value(key, "a number of samples", |text| text.parse().ok(), reading)
    }

    /// A number, and the word behind it, where both are there.
    pub(super) fn quantity(&self, key: &str) -> Option<(usize, f64, &'t str)> {
        let (number, rest) = self.after(key)?;
        let value = first_word(rest);
        Some((number, fortran_number(value)?, first_word(rest.get(value.len()..)?.trim_start())))
    }

    /// What the file says about itself, by these keys.
    pub(super) fn about(&self, keys: &[&str]) -> String {
        let said = keys.iter().filter_map(|key| self.after(key)).map(|(_, text)| excerpt(text));
        said.filter(|text| !text.is_empty()).collect::<Vec<_>>().join(", ")
    }
}

/// The headers of all parts of a text that begin with such a line, each with so many lines.
pub(super) fn blocks<'t>(
    format: &'static str,
    text: &'t str,
    begins: fn(&str) -> bool,
    lines: usize,
) -> Vec<Header<'t>> {
    let mut found: Vec<Header<'t>> = Vec::new();
    for (number, line) in numbered(text) {
        if begins(line) {
            found.push(Header { format, lines: Vec::new() });
        }
        if let Some(last) = found.last_mut().filter(|last| last.lines.len() < lines) {
            last.lines.push((number, line));
        }
    }
    found
}

/// What stands in a line behind a key in any case, without blanks, `:` and `=`.
pub(super) fn after<'t>(line: &'t str, key: &str) -> Option<&'t str> {
    let place = line.to_ascii_lowercase().find(&key.to_ascii_lowercase())?;
    let rest = line.get(place + key.len()..)?;
    Some(rest.trim_start_matches(|c: char| c.is_whitespace() || ":=".contains(c)).trim_end())
}

fn first_word(text: &str) -> &str {
    text.split(|c: char| c.is_whitespace() || c == ',').next().unwrap_or_default()
}

/// A number > 0.
pub(super) fn positive(text: &str) -> Option<f64> {
    fortran_number(text).filter(|value| *value > 0.0 && value.is_finite())
}

/// `Chan  1: 180 Deg`, of a line with more.
pub(super) fn channel(line: &str) -> Option<String> {
    let start = line.to_ascii_lowercase().find("chan")?;
    let label = line.get(start..)?;
    let (name, rest) = label.split_once(':')?;
    let is_number = name.contains(|c: char| c.is_ascii_digit() || c == '?') && name.len() < 16;
    let rest = rest.trim().split("  ").next().unwrap_or_default().split('(').next().unwrap_or_default();
    is_number.then(|| excerpt(&format!("{name}: {}", rest.trim())))
}

/// The direction behind `COMP`, where a file has one component.
pub(super) fn direction(line: &str) -> Option<String> {
    after(line, "COMP ").map(first_word).filter(|word| !word.is_empty()).map(excerpt)
}

/// The number in such a label.
pub(super) fn channel_number(label: &str) -> Option<usize> {
    let digits = label.chars().skip_while(|c| !c.is_ascii_digit()).take_while(char::is_ascii_digit);
    digits.collect::<String>().parse().ok()
}
