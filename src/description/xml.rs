//! The document `modelDescription.xml`, element by element in the order of the FMI 2.0 schema.

use super::log_category::Category;
use super::model_structure;
use super::writer::{Xml, text};
use crate::scene::Package;
use crate::variables::{Causality, HIGHEST_OUTPUT_DERIVATIVE, Inputs, Row, Settings, Slot, Table, Type, Unit, Value};

/// s: communication step of the default experiment. The results do not depend on it.
const STEP_SIZE: f64 = 0.01;

/// The whole text, with this GUID; `table` is that of the scene.
pub(super) fn document(package: &Package, table: &Table, guid: &str) -> String {
    let (mut xml, scene) = (Xml::new(), &package.scene);
    xml.element("fmiModelDescription")
        .attribute("fmiVersion", "2.0")
        .attribute("modelName", &scene.name)
        .attribute("guid", guid)
        .attribute("description", &text(&scene.description))
        .attribute("generationTool", concat!(env!("CARGO_PKG_NAME"), " ", env!("CARGO_PKG_VERSION")))
        .attribute("variableNamingConvention", "structured")
        .content(|xml| {
            write_co_simulation(xml, package);
            write_units(xml, table);
            write_log_categories(xml);
            write_default_experiment(xml, package);
            write_variables(xml, package, table);
            model_structure::write(xml, scene, table);
        });
    xml.finish()
}

fn write_co_simulation(xml: &mut Xml, package: &Package) {
    xml.element("CoSimulation")
        .attribute("modelIdentifier", &package.scene.name)
        .attribute("canHandleVariableCommunicationStepSize", "true")
        .attribute("canInterpolateInputs", "true")
        .attribute("maxOutputDerivativeOrder", &HIGHEST_OUTPUT_DERIVATIVE.to_string())
        .attribute("canNotUseMemoryManagementFunctions", "true")
        .attribute("canGetAndSetFMUstate", "true")
        .attribute("canSerializeFMUstate", "true")
        .attribute("providesDirectionalDerivative", "true")
        .empty();
}

fn write_units(xml: &mut Xml, table: &Table) {
    let used = |unit: &Unit| table.rows.iter().any(|row| row.ty == Type::Real(*unit));
    xml.element("UnitDefinitions").content(|xml| {
        Unit::ALL.iter().filter(|unit| used(unit)).for_each(|unit| write_unit(xml, *unit));
    });
}

fn write_unit(xml: &mut Xml, unit: Unit) {
    let info = unit.info();
    let element = xml.element("Unit").attribute("name", info.name);
    let Some(base) = info.base else {
        element.empty();
        return;
    };
    element.content(|xml| {
        let powers = base.iter();
        powers.fold(xml.element("BaseUnit"), |xml, (unit, power)| xml.attribute(unit, &power.to_string())).empty();
        if let Some((name, factor)) = info.display {
            xml.element("DisplayUnit").attribute("name", name).number("factor", factor).empty();
        }
    });
}

fn write_log_categories(xml: &mut Xml) {
    xml.element("LogCategories").content(|xml| {
        let all = Category::ALL.map(|category| (category.name(), category.description()));
        for (name, description) in all.into_iter().chain([Category::ALL_MESSAGES]) {
            xml.element("Category").attribute("name", name).attribute("description", description).empty();
        }
    });
}

fn write_default_experiment(xml: &mut Xml, package: &Package) {
    let stop = package.stop_time();
    let mut element = xml.element("DefaultExperiment").attribute("startTime", "0");
    if let Some(stop) = stop {
        element = element.number("stopTime", stop);
    }
    element = element.number("tolerance", package.scene.solver.relative_tolerance);
    if stop.is_none_or(|stop| stop > STEP_SIZE) {
        element = element.number("stepSize", STEP_SIZE);
    }
    element.empty();
}

/// The start values are read from fresh settings and inputs, as a new instance has them.
fn write_variables(xml: &mut Xml, package: &Package, table: &Table) {
    let record = package.record.as_ref().map(|record| record.record.clone());
    let (settings, inputs) = (Settings::new(package.scene.clone(), record), Inputs::new(&package.scene));
    xml.element("ModelVariables").content(|xml| {
        for (value_reference, row) in table.iter() {
            let start = match row.slot {
                Slot::Input(input) => Some(Value::Real(inputs.get(input).at(0.0))),
                Slot::Parameter(parameter) => Some(settings.read(parameter)),
                Slot::Frequency(..) | Slot::Output(_) => None,
            };
            write_variable(xml, value_reference, row, start);
        }
    });
}

fn write_variable(xml: &mut Xml, value_reference: u32, row: &Row, start: Option<Value<'_>>) {
    let mut element = xml
        .element("ScalarVariable")
        .attribute("name", &row.name)
        .count("valueReference", value_reference as usize)
        .attribute("description", &row.description)
        .attribute("causality", row.slot.causality().name())
        .attribute("variability", row.variability.name());
    match row.slot.causality() {
        Causality::Parameter => element = element.attribute("initial", "exact"),
        Causality::CalculatedParameter | Causality::Output => element = element.attribute("initial", "calculated"),
        Causality::Input => {} // the standard forbids it
    }
    element.content(|xml| write_type(xml, row, start));
}

fn write_type(xml: &mut Xml, row: &Row, start: Option<Value<'_>>) {
    let mut element = xml.element(row.ty.name());
    if let Type::Real(unit) = row.ty {
        element = element.attribute("unit", unit.info().name);
        if let Some((display, _)) = unit.info().display {
            element = element.attribute("displayUnit", display);
        }
    }
    for (name, value) in [("min", row.min), ("max", row.max), ("nominal", row.nominal)] {
        if let Some(value) = value {
            element = element.number(name, value);
        }
    }
    let element = match start {
        None => element,
        Some(Value::Real(value)) => element.number("start", value),
        Some(Value::Integer(value)) => element.attribute("start", &value.to_string()),
        Some(Value::Boolean(value)) => element.attribute("start", &value.to_string()),
        Some(Value::String(value)) => element.attribute("start", &text(value)),
    };
    element.empty();
}
