//! The `ModelStructure` of the description: what is computed, and from what.
//!
//! Variables are named here by their position from 1, not by their value reference.

use super::xml::Xml;
use crate::scene::Scene;
use crate::variables::{Row, Slot, Table, at_communication_points, at_start};
use std::io;

/// Writes the element. A co-simulation FMU need not declare states, so there is no `Derivatives` element.
pub(super) fn write(xml: &mut Xml, scene: &Scene, table: &Table) -> io::Result<()> {
    xml.create_element("ModelStructure").write_inner_content(|xml| {
        xml.create_element("Outputs").write_inner_content(|xml| {
            let is_output = |row: &Row| matches!(row.slot, Slot::Output(_));
            write_unknowns(xml, table, is_output, |unknown, known| match (unknown, known) {
                (Slot::Output(output), Slot::Input(input)) => at_communication_points(scene, output, input),
                _ => false,
            })
        })?;
        xml.create_element("InitialUnknowns").write_inner_content(|xml| {
            let is_computed = |row: &Row| matches!(row.slot, Slot::Output(_) | Slot::Frequency(..));
            write_unknowns(xml, table, is_computed, |unknown, known| at_start(scene, unknown, known))
        })?;
        Ok(())
    })?;
    Ok(())
}

fn write_unknowns(
    xml: &mut Xml,
    table: &Table,
    is_unknown: impl Fn(&Row) -> bool,
    depends: impl Fn(Slot, Slot) -> bool,
) -> io::Result<()> {
    let positioned = || (1_usize..).zip(&table.rows);
    let is_known = |row: &Row| matches!(row.slot, Slot::Input(_) | Slot::Parameter(_));
    let knowns = positioned().filter(|(_, row)| is_known(row)).map(|(index, row)| (index.to_string(), row.slot));
    let knowns: Vec<(String, Slot)> = knowns.collect();
    for (index, unknown) in positioned().filter(|(_, row)| is_unknown(row)) {
        let known = knowns.iter().filter(|(_, slot)| depends(unknown.slot, *slot));
        let known = known.map(|(index, _)| index.as_str()).collect::<Vec<_>>().join(" ");
        xml.create_element("Unknown")
            .with_attribute(("index", index.to_string().as_str()))
            .with_attribute(("dependencies", known.as_str()))
            .write_empty()?;
    }
    Ok(())
}
