//! The document `modelDescription.xml`, element by element in the order of the FMI 2.0 schema.

use super::log_category::Category;
use super::model_structure;
use super::writer::{Xml, number, text};
use crate::FmiVersion;
use crate::engine::Inputs;
use crate::scene::Package;
use crate::variables::{Causality, HIGHEST_OUTPUT_DERIVATIVE, Row, Settings, Slot, Table, Type, Unit, Value};
use quick_xml::Writer;
use std::io;

/// s: communication step of the default experiment. The results do not depend on it.
const STEP_SIZE: f64 = 0.01;

/// The whole text, with the scene's variables and this GUID.
#[expect(clippy::expect_used, reason = "writing to memory cannot fail, and the writer makes UTF-8 of UTF-8")]
pub(super) fn document(package: &Package, table: &Table, _version: FmiVersion, guid: &str) -> String {
    let mut xml = Writer::new_with_indent(Vec::new(), b' ', 2);
    write_document(&mut xml, package, table, guid).expect("writing to memory");
    xml.get_mut().push(b'\n');
    String::from_utf8(xml.into_inner()).expect("UTF-8")
}

fn write_document(xml: &mut Xml, package: &Package, table: &Table, guid: &str) -> io::Result<()> {
    let scene = &package.scene;
    xml.write_event(quick_xml::events::Event::Decl(quick_xml::events::BytesDecl::new("1.0", Some("UTF-8"), None)))?;
    xml.create_element("fmiModelDescription")
        .with_attributes([
            ("fmiVersion", "2.0"),
            ("modelName", &scene.name),
            ("guid", guid),
            ("description", &text(&scene.description)),
            ("generationTool", concat!(env!("CARGO_PKG_NAME"), " ", env!("CARGO_PKG_VERSION"))),
            ("variableNamingConvention", "structured"),
        ])
        .write_inner_content(|xml| {
            write_co_simulation(xml, package)?;
            write_units(xml, table)?;
            write_log_categories(xml)?;
            write_default_experiment(xml, package)?;
            write_variables(xml, package, table)?;
            model_structure::write(xml, scene, table)
        })?;
    Ok(())
}

fn write_co_simulation(xml: &mut Xml, package: &Package) -> io::Result<()> {
    xml.create_element("CoSimulation")
        .with_attributes([
            ("modelIdentifier", package.scene.name.as_str()),
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

fn write_units(xml: &mut Xml, table: &Table) -> io::Result<()> {
    let used = |unit: &Unit| table.rows.iter().any(|row| row.ty == Type::Real(*unit));
    xml.create_element("UnitDefinitions").write_inner_content(|xml| {
        Unit::ALL.iter().filter(|unit| used(unit)).try_for_each(|unit| write_unit(xml, *unit))
    })?;
    Ok(())
}

fn write_unit(xml: &mut Xml, unit: Unit) -> io::Result<()> {
    let info = unit.info();
    let element = xml.create_element("Unit").with_attribute(("name", info.name));
    let Some(base) = info.base else {
        element.write_empty()?;
        return Ok(());
    };
    element.write_inner_content(|xml| {
        let powers = base.iter().map(|(unit, power)| (*unit, power.to_string()));
        let powers = powers.collect::<Vec<_>>();
        let attributes = powers.iter().map(|(unit, power)| (*unit, power.as_str()));
        xml.create_element("BaseUnit").with_attributes(attributes).write_empty()?;
        if let Some((name, factor)) = info.display {
            let factor = number(factor);
            let attributes = [("name", name), ("factor", &factor)];
            xml.create_element("DisplayUnit").with_attributes(attributes).write_empty()?;
        }
        Ok(())
    })?;
    Ok(())
}

fn write_log_categories(xml: &mut Xml) -> io::Result<()> {
    xml.create_element("LogCategories").write_inner_content(|xml| {
        let all = Category::ALL.map(|category| (category.name(), category.description()));
        for (name, description) in all.into_iter().chain([Category::ALL_MESSAGES]) {
            let attributes = [("name", name), ("description", description)];
            xml.create_element("Category").with_attributes(attributes).write_empty()?;
        }
        Ok(())
    })?;
    Ok(())
}

fn write_default_experiment(xml: &mut Xml, package: &Package) -> io::Result<()> {
    let stop = package.stop_time();
    let mut element = xml.create_element("DefaultExperiment").with_attribute(("startTime", "0"));
    if let Some(stop) = stop {
        element = element.with_attribute(("stopTime", number(stop).as_str()));
    }
    let tolerance = number(package.scene.solver.relative_tolerance);
    element = element.with_attribute(("tolerance", tolerance.as_str()));
    if stop.is_none_or(|stop| stop > STEP_SIZE) {
        element = element.with_attribute(("stepSize", number(STEP_SIZE).as_str()));
    }
    element.write_empty()?;
    Ok(())
}

/// The start values are read from fresh settings and inputs, as a new instance has them.
fn write_variables(xml: &mut Xml, package: &Package, table: &Table) -> io::Result<()> {
    let record = package.record.as_ref().map(|record| record.record.clone());
    let (settings, inputs) = (Settings::new(package.scene.clone(), record), Inputs::new(&package.scene));
    xml.create_element("ModelVariables").write_inner_content(|xml| {
        for (value_reference, row) in table.iter() {
            let start = match row.slot {
                Slot::Input(input) => Some(Value::Real(inputs.get(input).at(0.0))),
                Slot::Parameter(parameter) => Some(settings.read(parameter)),
                Slot::Calculated(_) | Slot::Output(_) => None,
            };
            write_variable(xml, value_reference, row, start)?;
        }
        Ok(())
    })?;
    Ok(())
}

fn write_variable(xml: &mut Xml, value_reference: u32, row: &Row, start: Option<Value<'_>>) -> io::Result<()> {
    let mut element = xml.create_element("ScalarVariable").with_attributes([
        ("name", row.name.as_str()),
        ("valueReference", &value_reference.to_string()),
        ("description", &row.description),
        ("causality", row.slot.causality().name()),
        ("variability", row.variability.name()),
    ]);
    match row.slot.causality() {
        Causality::Parameter => element = element.with_attribute(("initial", "exact")),
        Causality::CalculatedParameter | Causality::Output => {
            element = element.with_attribute(("initial", "calculated"));
        }
        Causality::Input => {} // the standard forbids it
    }
    element.write_inner_content(|xml| write_type(xml, row, start))?;
    Ok(())
}

fn write_type(xml: &mut Xml, row: &Row, start: Option<Value<'_>>) -> io::Result<()> {
    let mut element = xml.create_element(row.ty.name(FmiVersion::V2));
    if let Type::Real(unit) = row.ty {
        element = element.with_attribute(("unit", unit.info().name));
        if let Some((display, _)) = unit.info().display {
            element = element.with_attribute(("displayUnit", display));
        }
    }
    for (name, value) in [("min", row.min), ("max", row.max), ("nominal", row.nominal)] {
        if let Some(value) = value {
            element = element.with_attribute((name, number(value).as_str()));
        }
    }
    if let Some(start) = start {
        let start = match start {
            Value::Real(value) => number(value),
            Value::Integer(value) => value.to_string(),
            Value::Boolean(value) => value.to_string(),
            Value::String(value) => text(value).into_owned(),
        };
        element = element.with_attribute(("start", start.as_str()));
    }
    element.write_empty()?;
    Ok(())
}
