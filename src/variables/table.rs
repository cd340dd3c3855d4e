//! The table of variables: a row each.

use super::slot::Slot;
use super::unit::Unit;
use crate::FmiVersion;
use crate::engine::Inputs;
use crate::scene::rule::Rule;

/// FMI variability.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Variability {
    /// `fixed`: constant after initialisation
    Fixed,
    /// `discrete`: constant but for events
    Discrete,
    /// `continuous`
    Continuous,
}

/// FMI type of a variable.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Type {
    /// `Real` in a unit, shown to people in its display unit.
    Real(Unit),
    /// `Integer`
    Integer,
    /// `Boolean`
    Boolean,
    /// `String`
    String,
}

/// One variable.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Row {
    /// Structured name, such as `contact[2].gap`.
    pub name: String,
    /// What it stands for.
    pub slot: Slot,
    /// When it changes.
    pub variability: Variability,
    /// Type and unit.
    pub ty: Type,
    /// Smallest value.
    pub min: Option<f64>,
    /// Largest value.
    pub max: Option<f64>,
    /// Typical magnitude, > 0.
    pub nominal: Option<f64>,
    /// Of the numbers that a parameter can have.
    pub rule: Option<Rule>,
    /// The rule that a parameter shares with others.
    pub shared: Option<SharedRule>,
    /// One line for a user.
    pub description: String,
}

/// What has to hold of several parameters together, and is asked again when one of them is set. Rules about gravity are
/// not: a master may set a weight first and then the stiffness that carries it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum SharedRule {
    /// The record can be scaled so.
    Scaling,
    /// Rigid floors of a contact do not overlap at the start.
    Overlap(usize),
    /// Links and soil are springs beside those of the storeys.
    Springs,
}

/// All variables of a scene. The value reference of a variable is its place in `rows`.
#[derive(Clone, Debug)]
pub struct Table {
    /// In the order of the description.
    pub rows: Vec<Row>,
}

impl Variability {
    /// As the description writes it.
    pub const fn name(self) -> &'static str {
        match self {
            Variability::Fixed => "fixed",
            Variability::Discrete => "discrete",
            Variability::Continuous => "continuous",
        }
    }
}

impl Type {
    /// Name of the type, and of its element in the description.
    pub const fn name(self, version: FmiVersion) -> &'static str {
        match (self, version) {
            (Type::Real(_), FmiVersion::V2) => "Real",
            (Type::Real(_), FmiVersion::V3) => "Float64",
            (Type::Integer, FmiVersion::V2) => "Integer",
            (Type::Integer, FmiVersion::V3) => "Int32",
            (Type::Boolean, _) => "Boolean",
            (Type::String, _) => "String",
        }
    }
}

impl Table {
    /// The row of a value reference.
    pub fn row(&self, value_reference: u32) -> Option<&Row> {
        self.rows.get(usize::try_from(value_reference).ok()?)
    }

    /// The value reference of the time, which only FMI 3.0 has among its variables: that after the last row.
    pub fn time_reference(&self) -> u32 {
        u32::try_from(self.rows.len()).unwrap_or(u32::MAX)
    }

    /// What is wrong with inputs at a time, s: a problem for each that is out of its range.
    pub fn problems(&self, inputs: &Inputs, time: f64) -> Vec<String> {
        let problem = |row: &Row| match row.slot {
            Slot::Input(input) => row.problem(inputs.get(input).at(time)),
            Slot::Parameter(_) | Slot::Calculated(_) | Slot::Output(_) => None,
        };
        self.rows.iter().filter_map(problem).collect()
    }

    /// Each row with its value reference.
    pub fn iter(&self) -> impl Iterator<Item = (u32, &Row)> {
        (0u32..).zip(&self.rows)
    }
}
