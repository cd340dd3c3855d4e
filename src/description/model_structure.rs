//! The `ModelStructure` of the description: what is computed, and from what.
//!
//! Variables are named here by their position from 1, not by their value reference.

use super::writer::Xml;
use crate::scene::Scene;
use crate::variables::{Dependence, Row, Slot, Table, at_communication_points, at_start};
use std::io;

/// Writes the element. A co-simulation FMU need not declare states, so there is no `Derivatives` element.
pub(super) fn write(xml: &mut Xml, scene: &Scene, table: &Table) -> io::Result<()> {
    xml.create_element("ModelStructure").write_inner_content(|xml| {
        xml.create_element("Outputs").write_inner_content(|xml| {
            let is_output = |row: &Row| matches!(row.slot, Slot::Output(_));
            write_unknowns(xml, table, is_output, |unknown, known| match (unknown, known) {
                (Slot::Output(output), Slot::Input(input)) => at_communication_points(scene, output, input),
                _ => None,
            })
        })?;
        xml.create_element("InitialUnknowns").write_inner_content(|xml| {
            let is_computed = |row: &Row| matches!(row.slot, Slot::Output(_) | Slot::Calculated(_));
            // Of the kinds only `dependent`, which goes without saying, and `constant` are allowed here.
            let depends = |unknown, known| at_start(scene, unknown, known).then_some(Dependence::Dependent);
            write_unknowns(xml, table, is_computed, depends)
        })?;
        Ok(())
    })?;
    Ok(())
}

fn write_unknowns(
    xml: &mut Xml,
    table: &Table,
    is_unknown: impl Fn(&Row) -> bool,
    depends: impl Fn(Slot, Slot) -> Option<Dependence>,
) -> io::Result<()> {
    let positioned = || (1_usize..).zip(&table.rows);
    let is_known = |row: &Row| matches!(row.slot, Slot::Input(_) | Slot::Parameter(_));
    let knowns = positioned().filter(|(_, row)| is_known(row)).map(|(index, row)| (index.to_string(), row.slot));
    let knowns: Vec<(String, Slot)> = knowns.collect();
    for (index, unknown) in positioned().filter(|(_, row)| is_unknown(row)) {
        let known = knowns.iter().filter_map(|(index, slot)| Some((index.as_str(), depends(unknown.slot, *slot)?)));
        let (known, kinds): (Vec<&str>, Vec<Dependence>) = known.unzip();
        let mut element = xml
            .create_element("Unknown")
            .with_attribute(("index", index.to_string().as_str()))
            .with_attribute(("dependencies", known.join(" ").as_str()));
        if kinds.contains(&Dependence::Fixed) {
            let kinds = kinds.into_iter().map(kind).collect::<Vec<_>>().join(" ");
            element = element.with_attribute(("dependenciesKind", kinds.as_str()));
        }
        element.write_empty()?;
    }
    Ok(())
}

const fn kind(dependence: Dependence) -> &'static str {
    match dependence {
        Dependence::Fixed => "fixed",
        Dependence::Dependent => "dependent",
    }
}
