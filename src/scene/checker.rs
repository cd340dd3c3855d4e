//! The problems of a scene as the rules find them.

use super::problem::{Problem, count, excerpt, numbers};
use super::rule::Rule;
use std::fmt::Display;

/// What has been found so far.
#[derive(Default)]
pub(super) struct Checker {
    pub problems: Vec<Problem>,
}

impl Checker {
    pub fn refuse(&mut self, path: impl Display, found: impl Into<String>, expected: impl Into<String>) {
        self.problems.push(Problem::new(path.to_string(), found, expected));
    }

    pub fn number(&mut self, path: impl Display, value: f64, rule: Rule) {
        self.problems.extend(rule.problem(path, value));
    }

    pub fn numbers(&mut self, path: impl Display, values: &[f64], rule: Rule) {
        for (i, &value) in values.iter().enumerate() {
            self.number(format_args!("{path}[{}]", i + 1), value, rule);
        }
    }

    /// One number per floor, storey or mode, as `each` says.
    pub fn list(&mut self, path: impl Display, values: &[f64], rule: Rule, floors: usize, each: &str) {
        if floors > 0 && values.len() != floors {
            let expected = format!("{}, one per {each}, not {}", count(floors, "number"), values.len());
            self.refuse(&path, excerpt(&numbers(values)), expected);
        }
        self.numbers(path, values, rule);
    }
}
