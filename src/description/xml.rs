//! The document `modelDescription.xml`, element by element in the order of the schemas of FMI 2.0 and 3.0, and what is
//! the same in both.

use super::log_category::Category;
use super::variable::{borrowed, known};
use super::writer::{Xml, branch, leaf, number, text};
use super::{model_structure, xml2, xml3};
use crate::FmiVersion;
use crate::engine::Inputs;
use crate::scene::Package;
use crate::variables::{Settings, Slot, Table, Type, Unit, Value, highest_output_derivative};
use quick_xml::Writer;
use std::io;

/// s: communication step of the default experiment. The results do not depend on it.
const STEP_SIZE: f64 = 0.01;

/// This program and its version, as descriptions name it.
pub const TOOL: &str = concat!(env!("CARGO_PKG_NAME"), " ", env!("CARGO_PKG_VERSION"));

/// The whole text, with the scene's variables and this GUID.
#[expect(clippy::expect_used, reason = "writing to memory cannot fail, and the writer makes UTF-8 of UTF-8")]
pub(super) fn document(package: &Package, table: &Table, version: FmiVersion, guid: &str) -> String {
    let mut xml = Writer::new_with_indent(Vec::new(), b' ', 2);
    write_document(&mut xml, package, table, version, guid).expect("writing to memory");
    xml.get_mut().push(b'\n');
    String::from_utf8(xml.into_inner()).expect("UTF-8")
}

fn write_document(xml: &mut Xml, package: &Package, table: &Table, version: FmiVersion, guid: &str) -> io::Result<()> {
    let scene = &package.scene;
    let highest_derivative = highest_output_derivative(scene).to_string();
    let (name_of_guid, co_simulation) = match version {
        FmiVersion::V2 => ("guid", xml2::co_simulation(&highest_derivative)),
        FmiVersion::V3 => ("instantiationToken", xml3::co_simulation(&highest_derivative)),
    };
    xml.write_event(quick_xml::events::Event::Decl(quick_xml::events::BytesDecl::new("1.0", Some("UTF-8"), None)))?;
    let attributes = [
        ("fmiVersion", version.name()),
        ("modelName", &scene.name),
        (name_of_guid, guid),
        ("description", &text(&scene.description)),
        ("generationTool", TOOL),
        ("variableNamingConvention", "structured"),
    ];
    branch(xml, "fmiModelDescription", attributes, |xml| {
        let units = used_units(table, version);
        let identifier = [("modelIdentifier", scene.name.as_str())];
        leaf(xml, "CoSimulation", identifier.into_iter().chain(co_simulation))?;
        branch(xml, "UnitDefinitions", [], |xml| units.iter().try_for_each(|unit| write_unit(xml, *unit)))?;
        if version == FmiVersion::V3 {
            xml3::write_types(xml, &units)?;
        }
        write_log_categories(xml)?;
        write_default_experiment(xml, package)?;
        write_variables(xml, package, table, version)?;
        model_structure::write(xml, scene, table, version)
    })
}

/// The units of the numbers, in FMI 3.0 that of the time, too.
fn used_units(table: &Table, version: FmiVersion) -> Vec<Unit> {
    let is_of_time = |unit: Unit| version == FmiVersion::V3 && unit == xml3::TIME;
    let is_of_row = |unit| table.rows.iter().any(|row| row.ty == Type::Real(unit));
    Unit::ALL.into_iter().filter(|unit| is_of_time(*unit) || is_of_row(*unit)).collect()
}

fn write_unit(xml: &mut Xml, unit: Unit) -> io::Result<()> {
    let info = unit.info();
    let name = [("name", info.name)];
    let Some(base) = info.base else { return leaf(xml, "Unit", name) };
    branch(xml, "Unit", name, |xml| {
        let powers = base.iter().map(|(unit, power)| (*unit, power.to_string())).collect();
        leaf(xml, "BaseUnit", borrowed(&powers))?;
        let Some((name, factor)) = info.display else { return Ok(()) };
        leaf(xml, "DisplayUnit", [("name", name), ("factor", &number(factor))])
    })
}

fn write_log_categories(xml: &mut Xml) -> io::Result<()> {
    let all = Category::ALL.map(|category| (category.name(), category.description()));
    branch(xml, "LogCategories", [], |xml| {
        let mut all = all.into_iter().chain([Category::ALL_MESSAGES]);
        all.try_for_each(|(name, about)| leaf(xml, "Category", [("name", name), ("description", about)]))
    })
}

fn write_default_experiment(xml: &mut Xml, package: &Package) -> io::Result<()> {
    let stop = package.stop_time();
    let step = stop.is_none_or(|stop| stop > STEP_SIZE).then_some(STEP_SIZE);
    let tolerance = Some(package.scene.solver.relative_tolerance);
    let numbers = [("startTime", Some(0.0)), ("stopTime", stop), ("tolerance", tolerance), ("stepSize", step)];
    leaf(xml, "DefaultExperiment", borrowed(&known(numbers)))
}

/// The start values are read from fresh settings and inputs, as a new instance has them.
fn write_variables(xml: &mut Xml, package: &Package, table: &Table, version: FmiVersion) -> io::Result<()> {
    let record = package.record.as_ref().map(|record| record.record.clone());
    let (settings, inputs) = (Settings::new(package.scene.clone(), record), Inputs::new(&package.scene));
    branch(xml, "ModelVariables", [], |xml| {
        if version == FmiVersion::V3 {
            xml3::write_time(xml, table.time_reference())?;
        }
        table.iter().try_for_each(|(reference, row)| {
            let start = match row.slot {
                Slot::Input(input) => Some(Value::Real(inputs.get(input).at(0.0))),
                Slot::Parameter(parameter) => Some(settings.read(parameter)),
                Slot::Calculated(_) | Slot::Output(_) => None,
            };
            match version {
                FmiVersion::V2 => xml2::write_variable(xml, reference, row, start),
                FmiVersion::V3 => xml3::write_variable(xml, reference, row, start),
            }
        })
    })
}
