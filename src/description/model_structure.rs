//! The `ModelStructure` of the description: what is computed, and from what.
//!
//! Variables are named here by their position from 1 in FMI 2.0, by their value reference in FMI 3.0.

use super::variable::borrowed;
use super::writer::{Xml, branch, leaf};
use crate::FmiVersion;
use crate::scene::Scene;
use crate::variables::{Dependence, Row, Slot, Table, at_communication_points, at_start};
use std::io;

/// Writes the element. A co-simulation FMU need not declare states, so there are no derivatives.
pub(super) fn write(xml: &mut Xml, scene: &Scene, table: &Table, version: FmiVersion) -> io::Result<()> {
    branch(xml, "ModelStructure", [], |xml| match version {
        FmiVersion::V2 => {
            let list = Unknowns { table, element: "Unknown", reference: "index", first: 1 };
            branch(xml, "Outputs", [], |xml| list.outputs(xml, scene))?;
            branch(xml, "InitialUnknowns", [], |xml| list.initial_unknowns(xml, scene))
        }
        FmiVersion::V3 => {
            let list = |element| Unknowns { table, element, reference: "valueReference", first: 0 };
            list("Output").outputs(xml, scene)?;
            list("InitialUnknown").initial_unknowns(xml, scene)
        }
    })
}

/// How a version writes what is computed.
struct Unknowns<'a> {
    table: &'a Table,
    element: &'static str,
    /// The attribute that says which variable it is.
    reference: &'static str,
    /// The number of the first variable there.
    first: u32,
}

impl Unknowns<'_> {
    fn outputs(&self, xml: &mut Xml, scene: &Scene) -> io::Result<()> {
        let is_output = |row: &Row| matches!(row.slot, Slot::Output(_));
        self.write(xml, is_output, |unknown, known| match (unknown, known) {
            (Slot::Output(output), Slot::Input(input)) => at_communication_points(scene, output, input),
            _ => None,
        })
    }

    fn initial_unknowns(&self, xml: &mut Xml, scene: &Scene) -> io::Result<()> {
        let is_computed = |row: &Row| matches!(row.slot, Slot::Output(_) | Slot::Calculated(_));
        // Of the kinds only `dependent`, which goes without saying, and `constant` are allowed here.
        let depends = |unknown, known| at_start(scene, unknown, known).then_some(Dependence::Dependent);
        self.write(xml, is_computed, depends)
    }

    fn write(
        &self,
        xml: &mut Xml,
        is_unknown: impl Fn(&Row) -> bool,
        depends: impl Fn(Slot, Slot) -> Option<Dependence>,
    ) -> io::Result<()> {
        let numbered = || (self.first..).zip(&self.table.rows).map(|(number, row)| (number.to_string(), row));
        let is_known = |row: &Row| matches!(row.slot, Slot::Input(_) | Slot::Parameter(_));
        let knowns = numbered().filter(|(_, row)| is_known(row)).map(|(number, row)| (number, row.slot));
        let knowns: Vec<(String, Slot)> = knowns.collect();
        for (number, unknown) in numbered().filter(|(_, row)| is_unknown(row)) {
            let known =
                knowns.iter().filter_map(|(number, slot)| Some((number.as_str(), depends(unknown.slot, *slot)?)));
            let (known, kinds): (Vec<&str>, Vec<Dependence>) = known.unzip();
            let mut attributes = vec![(self.reference, number), ("dependencies", known.join(" "))];
            if kinds.contains(&Dependence::Fixed) {
                attributes.push(("dependenciesKind", kinds.into_iter().map(kind).collect::<Vec<_>>().join(" ")));
            }
            leaf(xml, self.element, borrowed(&attributes))?;
        }
        Ok(())
    }
}

const fn kind(dependence: Dependence) -> &'static str {
    match dependence {
        Dependence::Fixed => "fixed",
        Dependence::Dependent => "dependent",
    }
}
