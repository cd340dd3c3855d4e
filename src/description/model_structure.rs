//! The `ModelStructure` of the description: what is computed, and from what.
//!
//! Variables are named here by their position from 1 in FMI 2.0, by their value reference in FMI 3.0.

use super::variable::borrowed;
use super::writer::{Xml, branch, leaf};
use crate::FmiVersion;
use crate::scene::Scene;
use crate::variables::{Dependence, Dependencies, InitialDependencies, Slot, Table};
use std::collections::HashMap;
use std::fmt::{Display, Write};
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
        let dependencies = Dependencies::of(scene);
        let is_output = |slot: Slot| matches!(slot, Slot::Output(_));
        self.write(xml, is_output, |unknown| match unknown {
            Slot::Output(output) => {
                let inputs = dependencies.at_communication_points(output).into_iter();
                inputs.map(|(input, dependence)| (Slot::Input(input), dependence)).collect()
            }
            _ => Vec::new(),
        })
    }

    fn initial_unknowns(&self, xml: &mut Xml, scene: &Scene) -> io::Result<()> {
        let dependencies = InitialDependencies::of(scene);
        let is_computed = |slot: Slot| matches!(slot, Slot::Output(_) | Slot::Calculated(_));
        // Of the kinds only `dependent`, which goes without saying, and `constant` are allowed here.
        self.write(xml, is_computed, |unknown| {
            dependencies.at_start(unknown).into_iter().map(|known| (known, Dependence::Dependent)).collect()
        })
    }

    /// Writes an element for each unknown, with the knowns on which it depends: those that the table has, each once and in its
    /// order.
    fn write(
        &self,
        xml: &mut Xml,
        is_unknown: impl Fn(Slot) -> bool,
        depends_on: impl Fn(Slot) -> Vec<(Slot, Dependence)>,
    ) -> io::Result<()> {
        let numbered = || (self.first..).zip(&self.table.rows).map(|(number, row)| (number, row.slot));
        let is_known = |slot: Slot| matches!(slot, Slot::Input(_) | Slot::Parameter(_));
        let numbers: HashMap<Slot, u32> =
            numbered().filter(|(_, slot)| is_known(*slot)).map(|(number, slot)| (slot, number)).collect();
        for (number, unknown) in numbered().filter(|(_, slot)| is_unknown(*slot)) {
            let known = depends_on(unknown).into_iter();
            let mut known: Vec<(u32, Dependence)> =
                known.filter_map(|(slot, dependence)| Some((*numbers.get(&slot)?, dependence))).collect();
            known.sort_unstable_by_key(|(number, _)| *number);
            known.dedup_by_key(|(number, _)| *number);
            let mut attributes = vec![
                (self.reference, number.to_string()),
                ("dependencies", joined(known.iter().map(|(number, _)| number))),
            ];
            if known.iter().any(|(_, dependence)| *dependence == Dependence::Fixed) {
                attributes.push(("dependenciesKind", joined(known.iter().map(|(_, dependence)| kind(*dependence)))));
            }
            leaf(xml, self.element, borrowed(&attributes))?;
        }
        Ok(())
    }
}

/// A list of an attribute.
fn joined(items: impl Iterator<Item = impl Display>) -> String {
    let mut list = String::new();
    for item in items {
        let blank = if list.is_empty() { "" } else { " " };
        // Writing to memory cannot fail.
        let _ = write!(list, "{blank}{item}");
    }
    list
}

const fn kind(dependence: Dependence) -> &'static str {
    match dependence {
        Dependence::Fixed => "fixed",
        Dependence::Dependent => "dependent",
    }
}
