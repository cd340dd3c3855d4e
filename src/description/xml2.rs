//! The elements that only FMI 2.0 has.

use super::variable::{borrowed, identity, limits, start};
use super::writer::{Xml, branch, leaf};
use crate::FmiVersion;
use crate::variables::{Row, Type, Value};
use std::io;

/// What an FMU can do.
pub(super) fn co_simulation(highest_derivative: &str) -> Vec<(&str, &str)> {
    vec![
        ("canHandleVariableCommunicationStepSize", "true"),
        ("canInterpolateInputs", "true"),
        ("maxOutputDerivativeOrder", highest_derivative),
        ("canNotUseMemoryManagementFunctions", "true"),
        ("canGetAndSetFMUstate", "true"),
        ("canSerializeFMUstate", "true"),
        ("providesDirectionalDerivative", "true"),
    ]
}

pub(super) fn write_variable(xml: &mut Xml, reference: u32, row: &Row, value: Option<Value<'_>>) -> io::Result<()> {
    let mut attributes = Vec::new();
    if let Type::Real(unit) = row.ty {
        attributes.push(("unit", unit.info().name.to_owned()));
        attributes.extend(unit.info().display.map(|(display, _)| ("displayUnit", display.to_owned())));
    }
    attributes.extend(limits(row));
    attributes.extend(value.map(|value| ("start", start(value))));
    branch(xml, "ScalarVariable", borrowed(&identity(reference, row, FmiVersion::V2)), |xml| {
        leaf(xml, row.ty.name(FmiVersion::V2), borrowed(&attributes))
    })
}
