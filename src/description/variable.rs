//! What both versions say of a variable, as names and texts of attributes.

use super::writer::{number, text};
use crate::FmiVersion;
use crate::variables::{Causality, Row, Value};

/// Attributes of an element, in their order.
pub(super) type Attributes = Vec<(&'static str, String)>;

/// Which variable it is, and how its value comes about.
pub(super) fn identity(reference: u32, row: &Row, version: FmiVersion) -> Attributes {
    let causality = row.slot.causality();
    let initial = match (causality, version) {
        (Causality::Parameter, _) | (Causality::Input, FmiVersion::V3) => Some("exact"),
        (Causality::CalculatedParameter | Causality::Output, _) => Some("calculated"),
        (Causality::Input, FmiVersion::V2) => None, // the standard forbids it
    };
    let mut attributes = vec![
        ("name", row.name.clone()),
        ("valueReference", reference.to_string()),
        ("description", row.description.clone()),
        ("causality", causality.name().to_owned()),
        ("variability", row.variability.name().to_owned()),
    ];
    attributes.extend(initial.map(|initial| ("initial", initial.to_owned())));
    attributes
}

/// Its limits and its typical magnitude.
pub(super) fn limits(row: &Row) -> Attributes {
    known([("min", row.min), ("max", row.max), ("nominal", row.nominal)])
}

/// Those of some numbers that there are.
pub(super) fn known<const N: usize>(numbers: [(&'static str, Option<f64>); N]) -> Attributes {
    numbers.into_iter().filter_map(|(name, value)| Some((name, number(value?)))).collect()
}

/// A start value.
pub(super) fn start(value: Value<'_>) -> String {
    match value {
        Value::Real(value) => number(value),
        Value::Integer(value) => value.to_string(),
        Value::Boolean(value) => value.to_string(),
        Value::String(value) => text(value).into_owned(),
    }
}

/// As the writer takes them.
pub(super) fn borrowed(attributes: &Attributes) -> impl Iterator<Item = (&str, &str)> {
    attributes.iter().map(|(name, value)| (*name, value.as_str()))
}
