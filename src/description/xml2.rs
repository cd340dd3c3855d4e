//! The elements that only FMI 2.0 has.

use super::variable::{borrowed, identity, limits, start};
use super::writer::Xml;
use crate::FmiVersion;
use crate::variables::{HIGHEST_OUTPUT_DERIVATIVE, Row, Type, Value};
use std::io;

pub(super) fn write_co_simulation(xml: &mut Xml, identifier: &str) -> io::Result<()> {
    xml.create_element("CoSimulation")
        .with_attributes([
            ("modelIdentifier", identifier),
            ("canHandleVariableCommunicationStepSize", "true"),
            ("canInterpolateInputs", "true"),
            ("maxOutputDerivativeOrder", &HIGHEST_OUTPUT_DERIVATIVE.to_string()),
            ("canNotUseMemoryManagementFunctions", "true"),
            ("canGetAndSetFMUstate", "true"),
            ("canSerializeFMUstate", "true"),
            ("providesDirectionalDerivative", "true"),
        ])
        .write_empty()?;
    Ok(())
}

pub(super) fn write_variable(xml: &mut Xml, reference: u32, row: &Row, value: Option<Value<'_>>) -> io::Result<()> {
    let mut attributes = Vec::new();
    if let Type::Real(unit) = row.ty {
        attributes.push(("unit", unit.info().name.to_owned()));
        attributes.extend(unit.info().display.map(|(display, _)| ("displayUnit", display.to_owned())));
    }
    attributes.extend(limits(row));
    attributes.extend(value.map(|value| ("start", start(value))));
    xml.create_element("ScalarVariable")
        .with_attributes(borrowed(&identity(reference, row, FmiVersion::V2)))
        .write_inner_content(|xml| {
            let element = xml.create_element(row.ty.name(FmiVersion::V2));
            element.with_attributes(borrowed(&attributes)).write_empty()?;
            Ok(())
        })?;
    Ok(())
}
