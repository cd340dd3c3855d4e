//! Names of columns, and what they say is in them.

use super::layout::Separators;
use crate::record::components::is_vertical;
use crate::record::numbers::fortran_number;
use crate::record::unit::Unit;

/// The names that a line gives to so many columns; `None` where it cannot be told which is whose.
pub(super) fn split(line: &str, separators: Separators, columns: usize) -> Option<Vec<String>> {
    let line = without_tags(line.trim().trim_start_matches(['#', '%', '!']).trim());
    let clean =
        |names: Vec<&str>| names.into_iter().map(|name| name.trim().trim_matches('"').to_owned()).collect::<Vec<_>>();
    let by_gaps = || line.split("  ").map(str::trim).filter(|name| !name.is_empty()).collect();
    let by_words = Some(words(&line)).filter(|names| are_of_columns(names)).unwrap_or_default();
    let ways: [Vec<String>; 5] = [
        if separators.column == ' ' { Vec::new() } else { clean(separators.fields(&line)) },
        clean(line.split('\t').collect()),
        clean(line.split([',', ';']).collect()),
        clean(by_gaps()),
        by_words,
    ];
    ways.into_iter().find(|names| names.len() == columns && names.iter().all(|name| is_name(name)))
}

fn is_name(name: &str) -> bool {
    !name.is_empty() && fortran_number(name).is_none()
}

/// Whether words speak of columns rather than make a title: one is a kind of column, a direction, a number or a unit in brackets.
fn are_of_columns(names: &[String]) -> bool {
    const DIRECTIONS: &str = "ns ew n s e w north south east west x y z l t long tran trans radial transverse fn fp";
    names.iter().any(|name| {
        let word: String = name.chars().filter(|c| c.is_alphabetic()).flat_map(char::to_lowercase).collect();
        let is_known = !matches!(kind(name), Kind::Unknown) && name.len() > 1;
        is_known
            || is_vertical(name)
            || DIRECTIONS.split(' ').any(|direction| direction == word)
            || name.contains(|c: char| c.is_ascii_digit() || "[(_".contains(c))
    })
}

/// Words, with the brackets behind them: `Time (s)`, `a [m s-2]`.
fn words(line: &str) -> Vec<String> {
    let mut names: Vec<String> = Vec::new();
    let mut depth = 0;
    for word in line.split_whitespace() {
        let opens = word.starts_with(['(', '[', '{']);
        match names.last_mut() {
            Some(last) if depth > 0 || opens => {
                last.push(' ');
                last.push_str(word);
            }
            _ => names.push(word.to_owned()),
        }
        let count = |marks: [char; 3]| word.chars().filter(|c| marks.contains(c)).count() as i32;
        depth = 0.max(depth + count(['(', '[', '{']) - count([')', ']', '}']));
    }
    names
}

/// A line of a page without its marks: `S<sub>a</sub>`.
fn without_tags(line: &str) -> String {
    let mut parts = line.split('<');
    let first = parts.next().unwrap_or_default().to_owned();
    parts.fold(first, |text, part| match part.split_once('>') {
        Some((_, rest)) => text + rest,
        None => text + "<" + part,
    })
}

/// What a column is, by its name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Time,
    /// The times in something other than s.
    OtherTime,
    Counter,
    /// Periods or frequencies.
    Period,
    Acceleration,
    /// Velocity or displacement.
    OtherMotion,
    /// An ordinate of a response or Fourier spectrum.
    Spectral,
    Unknown,
}

impl Kind {
    /// Whether it is what samples are over.
    pub(super) fn is_along(self) -> bool {
        matches!(self, Kind::Time | Kind::OtherTime | Kind::Counter | Kind::Period)
    }

    /// Whether it is something of a motion other than its acceleration.
    pub(super) fn is_of_other(self) -> bool {
        matches!(self, Kind::OtherMotion | Kind::Spectral)
    }
}

/// Whether a line holds units only, as one below names may: `(s) (gal)`, `[s];[m/s2]`.
pub(super) fn are_units(line: &str) -> bool {
    let words = line.split([' ', '\t', ';', ',']).map(str::trim).filter(|word| !word.is_empty());
    let is_unit = |word: &str| {
        word.starts_with(['(', '[']) && word.ends_with([')', ']']) || Unit::read(word).is_some() || word == "s"
    };
    let mut words = words.peekable();
    words.peek().is_some() && words.all(is_unit)
}

/// What the name of a column says.
pub(super) fn kind(name: &str) -> Kind {
    let lower = name.to_lowercase();
    let words: Vec<&str> =
        lower.split(|c: char| !c.is_alphanumeric() && !"/%#-".contains(c)).filter(|word| !word.is_empty()).collect();
    let Some(first) = words.first().copied() else { return Kind::Unknown };
    let begins = |names: &[&str]| names.iter().any(|name| words.iter().any(|word| word.starts_with(name)));
    let is = |names: &[&str]| names.contains(&first);
    let has = |names: &[&str]| words.iter().any(|word| names.contains(word));
    let counts = ["no", "nr", "n", "i", "idx", "#", "pt", "row", "count", "step", "steps", "scan"];
    if words.len() == 1 && is(&counts)
        || ["point", "sample", "index", "number"].iter().any(|name| first.starts_with(name))
    {
        Kind::Counter
    } else if begins(&["period", "freq"]) || is(&["hz"]) || has(&["hz"]) {
        Kind::Period
    } else if begins(&["time", "zeit", "temps", "tiempo", "tempo"])
        || is(&["t", "sec", "secs", "second", "seconds", "s"])
    {
        let in_other =
            words[1..].iter().any(|word| ["ms", "msec", "min", "us", "milliseconds", "minutes"].contains(word));
        if in_other || lower.ends_with("_ms") || lower.ends_with("/ms") { Kind::OtherTime } else { Kind::Time }
    } else if begins(&["spectr", "fourier", "pseudo"])
        || is(&["sa", "sae", "psa", "sd", "sde", "sv", "psv", "fas", "rs"])
    {
        Kind::Spectral
    } else if begins(&["veloc", "displ"]) || is(&["vel", "disp", "dis"]) || has_unit_of_other(&lower) {
        Kind::OtherMotion
    } else if begins(&["acc"]) || is(&["a", "ag"]) {
        Kind::Acceleration
    } else {
        Kind::Unknown
    }
}

/// A unit of velocity or displacement in brackets or at the end: `[cm/s]`, `(m)`.
fn has_unit_of_other(name: &str) -> bool {
    let inside = name.split(['(', '[']).nth(1).and_then(|rest| rest.split([')', ']']).next()).unwrap_or_default();
    let unit: String = inside.replace("sec", "s").chars().filter(|c| !c.is_whitespace()).collect();
    ["m/s", "cm/s", "mm/s", "in/s", "ft/s", "m", "cm", "mm", "in", "ft", "ms-1", "cms-1"].contains(&unit.as_str())
}

/// Whether the second name, beside a first `T`, `Amplitude` or the like, is one of a spectrum.
pub(super) fn is_amplitude(name: &str) -> bool {
    name.trim().to_lowercase().starts_with("ampl")
}
