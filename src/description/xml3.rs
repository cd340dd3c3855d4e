//! The elements that only FMI 3.0 has. Scalars without clocks, arrays and aliases, which importers have trouble
//! with; units by the declared type, as some do not know them on a variable.

use super::variable::{borrowed, identity, limits, start};
use super::writer::{Xml, branch, leaf};
use crate::FmiVersion;
use crate::variables::{Row, Slot, Type, Unit, Value, Variability};
use std::io;

/// The unit of the time.
pub(super) const TIME: Unit = Unit::Second;

/// What an FMU can do.
pub(super) fn co_simulation(highest_derivative: &str) -> Vec<(&str, &str)> {
    vec![
        ("canGetAndSetFMUState", "true"),
        ("canSerializeFMUState", "true"),
        ("providesDirectionalDerivatives", "true"),
        ("providesAdjointDerivatives", "true"),
        ("canHandleVariableCommunicationStepSize", "true"),
        ("maxOutputDerivativeOrder", highest_derivative),
        ("providesIntermediateUpdate", "true"),
        ("mightReturnEarlyFromDoStep", "true"),
        ("hasEventMode", "true"),
    ]
}

/// A type for each unit, called after what is measured in it.
pub(super) fn write_types(xml: &mut Xml, units: &[Unit]) -> io::Result<()> {
    branch(xml, "TypeDefinitions", [], |xml| {
        units.iter().map(|unit| unit.info()).try_for_each(|info| {
            let attributes = [("name", info.quantity), ("quantity", info.quantity), ("unit", info.name)];
            let display = info.display.map(|(display, _)| ("displayUnit", display));
            leaf(xml, "Float64Type", attributes.into_iter().chain(display))
        })
    })
}

/// The time, which is a variable that masters may read.
pub(super) fn write_time(xml: &mut Xml, reference: u32) -> io::Result<()> {
    let attributes = [
        ("name", "time"),
        ("valueReference", &reference.to_string()),
        ("description", "time"),
        ("causality", "independent"),
        ("variability", "continuous"),
        ("declaredType", TIME.info().quantity),
    ];
    leaf(xml, "Float64", attributes)
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
    let (name, value) = (row.ty.name(FmiVersion::V3), value.map(start));
    if let (Type::String, Some(value)) = (row.ty, &value) {
        return branch(xml, name, borrowed(&attributes), |xml| leaf(xml, "Start", [("value", value.as_str())]));
    }
    attributes.extend(value.map(|value| ("start", value)));
    leaf(xml, name, borrowed(&attributes))
}
