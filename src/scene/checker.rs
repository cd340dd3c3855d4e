//! The problems of a scene as the rules find them.

use super::problem::{Problem, count, excerpt, number, numbers};
use super::rule::Rule;
use super::units::Units;
use std::fmt::Display;

/// What has been found so far.
pub(super) struct Checker {
    /// Those of the file, in which messages show masses and forces.
    pub units: Units,
    pub problems: Vec<Problem>,
}

impl Checker {
    pub(super) fn new(units: Units) -> Checker {
        Checker { units, problems: Vec::new() }
    }

    pub(super) fn refuse(&mut self, path: impl Display, found: impl Into<String>, expected: impl Into<String>) {
        self.problems.push(Problem::new(path.to_string(), found, expected));
    }

    pub(super) fn number(&mut self, path: impl Display, value: f64, rule: Rule) {
        self.problems.extend(rule.problem_in(self.units, path, value));
    }

    pub(super) fn numbers(&mut self, path: impl Display, values: &[f64], rule: Rule) {
        for (i, &value) in values.iter().enumerate() {
            self.number(format_args!("{path}[{}]", i + 1), value, rule);
        }
    }

    /// One number per floor, storey or mode, as `each` says.
    pub(super) fn list(&mut self, path: impl Display, values: &[f64], rule: Rule, floors: usize, each: &str) {
        self.length(&path, values, rule, floors, each);
        self.numbers(path, values, rule);
    }

    /// As many numbers as there are floors, storeys or modes.
    pub(super) fn length(&mut self, path: impl Display, values: &[f64], rule: Rule, floors: usize, each: &str) {
        if floors > 0 && values.len() != floors {
            let expected = format!("{}, one per {each}, not {}", count(floors, "number"), values.len());
            self.refuse(path, self.written(values, rule), expected);
        }
    }

    /// An SI number with a mass or a force in its unit, for a person.
    pub(super) fn six_digits(&self, value: f64) -> String {
        six_digits(self.units.written(value))
    }

    /// A list of numbers under a rule as the file may have it.
    pub(super) fn written(&self, values: &[f64], rule: Rule) -> String {
        let units = rule.units(self.units);
        excerpt(&numbers(&values.iter().map(|&value| units.written(value)).collect::<Vec<_>>()))
    }
}

/// For a person.
pub(super) fn six_digits(value: f64) -> String {
    number(format!("{value:.5e}").parse().unwrap_or(value))
}
