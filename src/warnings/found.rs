//! What the rules have found.

use crate::scene::{Units, excerpt, matrix_text, number, numbers};
use std::fmt;

/// One thing that looks like a slip.
///
/// Displayed as `path = value: text`.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Warning {
    /// Path in the scene, such as `contact[2].gap`.
    pub path: String,
    /// The value found.
    pub value: String,
    /// What is odd, what it would mean, what may have been meant.
    pub text: String,
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} = {}: {}", self.path, self.value, self.text)
    }
}

/// What begins the list of others of which the same is to be said.
pub(super) const LIKEWISE: &str = " (likewise ";

/// What is odd about one number of a contact or a link: the number and a text.
pub(super) type Odd = Option<(f64, String)>;

/// What has been found so far.
#[derive(Default)]
pub(super) struct Found {
    pub warnings: Vec<Warning>,
    /// Those of the scene, in which masses and forces are shown.
    units: Units,
}

impl Found {
    pub(super) fn new(units: Units) -> Found {
        Found { warnings: Vec::new(), units }
    }

    /// The SI number of one with a mass or a force in its unit.
    pub(super) fn quantity(&mut self, path: impl Into<String>, value: f64, text: impl Into<String>) {
        self.number(path, self.units.written(value), text);
    }

    pub(super) fn quantities(&mut self, path: impl Into<String>, values: &[f64], text: impl Into<String>) {
        self.numbers(path, &values.iter().map(|&value| self.units.written(value)).collect::<Vec<_>>(), text);
    }

    /// Odd entries of a list that several may be odd in: one line where all of them are, with the text about the first.
    pub(super) fn entries(
        &mut self,
        path: &str,
        values: &[f64],
        odd: &[usize],
        all: usize,
        text: impl Fn(usize) -> String,
    ) {
        match odd {
            [first, _, ..] if odd.len() == all => self.quantities(path, values, text(*first)),
            _ => odd.iter().for_each(|&i| self.quantity(format!("{path}[{}]", i + 1), values[i], text(i))),
        }
    }

    pub(super) fn matrix(&mut self, path: impl Into<String>, rows: &[Vec<f64>], text: impl Into<String>) {
        self.add(path, matrix_text(rows, self.units), text);
    }

    pub(super) fn number(&mut self, path: impl Into<String>, value: f64, text: impl Into<String>) {
        // 2.75e9, not 2750000000.0.
        self.add(path, if value.abs() >= 1e6 { format!("{value:e}") } else { number(value) }, text);
    }

    pub(super) fn numbers(&mut self, path: impl Into<String>, values: &[f64], text: impl Into<String>) {
        self.add(path, excerpt(&numbers(values)), text);
    }

    pub(super) fn add(&mut self, path: impl Into<String>, value: String, text: impl Into<String>) {
        self.warnings.push(Warning { path: path.into(), value, text: text.into() });
    }

    /// One warning for all tables of that name that have the same to be said about a key; none about a table and key of
    /// which something has been said.
    pub(super) fn group<T>(&mut self, (name, tables): (&str, &[T]), key: &str, odd: impl Fn(&T) -> Odd) {
        let path = |index: usize| format!("{name}[{}].{key}", index + 1);
        let new = tables.iter().enumerate().filter(|(index, _)| !self.has(&path(*index)));
        let mut all = new.filter_map(|(i, table)| Some((i, odd(table)?)));
        let Some((first, (value, text))) = all.next() else { return };
        let more: Vec<String> = all.map(|(index, _)| format!("{name}[{}]", index + 1)).collect();
        let also = match more.as_slice() {
            [] => String::new(),
            [one] => format!("{LIKEWISE}{one})"),
            [one, .., last] => format!("{LIKEWISE}{} more, {one} to {last})", more.len()),
        };
        let text = format!("{text}{also}");
        match key {
            "stiffness" | "dashpot" | "slip_force" => self.quantity(path(first), value, text),
            _ => self.number(path(first), value, text),
        }
    }

    /// Whether anything has been found at a path or below it.
    pub(super) fn has(&self, path: &str) -> bool {
        let below = |rest: &str| rest.is_empty() || rest.starts_with(['.', '[']);
        self.warnings.iter().any(|warning| warning.path.strip_prefix(path).is_some_and(below))
    }
}
