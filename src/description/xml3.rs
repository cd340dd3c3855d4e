//! The elements that only FMI 3.0 has. Scalars without clocks, arrays and aliases, which importers have trouble
//! with; units by the declared type, as some do not know them on a variable.

use super::variable::{borrowed, identity, limits, start};
use super::writer::Xml;
use crate::FmiVersion;
use crate::variables::{HIGHEST_OUTPUT_DERIVATIVE, Row, Slot, Type, Unit, Value, Variability};
use std::io;

/// The unit of the time.
pub(super) const TIME: Unit = Unit::Second;

pub(super) fn write_co_simulation(xml: &mut Xml, identifier: &str) -> io::Result<()> {
    xml.create_element("CoSimulation")
        .with_attributes([
            ("modelIdentifier", identifier),
            ("canGetAndSetFMUState", "true"),
            ("canSerializeFMUState", "true"),
            ("providesDirectionalDerivatives", "true"),
            ("providesAdjointDerivatives", "true"),
            ("canHandleVariableCommunicationStepSize", "true"),
            ("maxOutputDerivativeOrder", &HIGHEST_OUTPUT_DERIVATIVE.to_string()),
            ("providesIntermediateUpdate", "true"),
            ("mightReturnEarlyFromDoStep", "true"),
            ("hasEventMode", "true"),
        ])
        .write_empty()?;
    Ok(())
}

/// A type for each unit, called after what is measured in it.
pub(super) fn write_types(xml: &mut Xml, units: &[Unit]) -> io::Result<()> {
    xml.create_element("TypeDefinitions").write_inner_content(|xml| {
        for info in units.iter().map(|unit| unit.info()) {
            let attributes = [("name", info.quantity), ("quantity", info.quantity), ("unit", info.name)];
            let display = info.display.map(|(display, _)| ("displayUnit", display));
            xml.create_element("Float64Type").with_attributes(attributes).with_attributes(display).write_empty()?;
        }
        Ok(())
    })?;
    Ok(())
}

/// The time, which is a variable that masters may read.
pub(super) fn write_time(xml: &mut Xml, reference: u32) -> io::Result<()> {
    xml.create_element("Float64")
        .with_attributes([
            ("name", "time"),
            ("valueReference", &reference.to_string()),
            ("description", "time"),
            ("causality", "independent"),
            ("variability", "continuous"),
            ("declaredType", TIME.info().quantity),
        ])
        .write_empty()?;
    Ok(())
}

pub(super) fn write_variable(xml: &mut Xml, reference: u32, row: &Row, value: Option<Value<'_>>) -> io::Result<()> {
    let mut attributes = identity(reference, row, FmiVersion::V3);
    if let Type::Real(unit) = row.ty {
        attributes.push(("declaredType", unit.info().quantity.to_owned()));
    }
    attributes.extend(limits(row));
    let is_exchanged = matches!(row.slot, Slot::Input(_) | Slot::Output(_));
    if is_exchanged && row.variability == Variability::Continuous {
        attributes.push(("intermediateUpdate", "true".to_owned()));
    }
    let value = value.map(start);
    let element = xml.create_element(row.ty.name(FmiVersion::V3));
    match (row.ty, value) {
        (Type::String, Some(value)) => {
            let element = element.with_attributes(borrowed(&attributes));
            element.write_inner_content(|xml| {
                xml.create_element("Start").with_attribute(("value", value.as_str())).write_empty()?;
                Ok(())
            })?;
        }
        (_, value) => {
            attributes.extend(value.map(|value| ("start", value)));
            element.with_attributes(borrowed(&attributes)).write_empty()?;
        }
    }
    Ok(())
}
