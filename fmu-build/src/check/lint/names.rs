//! What names must be.

use crate::description::Description;
use std::collections::HashSet;

/// The library carries the identifier in its file name and, in C, in its function names.
pub fn identifier(description: &Description) -> Option<String> {
    let identifier = &description.identifier;
    let mut letters = identifier.chars();
    let starts = letters.next().is_some_and(|first| first.is_ascii_alphabetic() || first == '_');
    let goes_on = letters.all(|letter| letter.is_ascii_alphanumeric() || letter == '_');
    (!(starts && goes_on)).then(|| format!("modelIdentifier {identifier:?}: expected a C identifier"))
}

/// A finding for every name that has been there before.
pub fn repeated<'a>(what: &str, names: impl Iterator<Item = &'a str>) -> Vec<String> {
    let mut seen = HashSet::new();
    names.filter(|name| !seen.insert(*name)).map(|name| format!("{what} {name:?}: more than once")).collect()
}
