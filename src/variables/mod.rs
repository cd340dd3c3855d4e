//! The variables of the FMU: one table for description and dispatch.
//!
//! [`Table::new`] lists what exists for a scene; the value reference of a variable is the number of its row. The
//! description walks the rows, and every access goes through the row's [`Slot`] (`values.rs`), so the two cannot differ.
//!
//! A new variable is a variant of [`Output`], [`Parameter`] or [`Input`], its row in `rows.rs` and its arm in
//! `values.rs`; the compiler asks for the arms.

mod changes;
mod dependencies;
mod derivatives;
mod initial_dependencies;
mod rows;
mod unit;
mod values;

pub use changes::Changes;
pub use dependencies::{Dependence, at_communication_points};
pub use derivatives::{HIGHEST_OUTPUT_DERIVATIVE, by_parameter};
pub use initial_dependencies::at_start;
pub use unit::{Unit, UnitInfo};
pub use values::{Inputs, Instant, Settings, Value};

use crate::engine::{PeakOf, Side};
use crate::scene::{Building, Scene};

/// What a variable stands for. Floors, storeys and contacts are counted from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Slot {
    /// Set by the master at any time.
    Input(Input),
    /// Set by the master before the end of initialisation.
    Parameter(Parameter),
    /// Hz: natural frequency of a building alone, a calculated parameter.
    Frequency(Side, usize),
    /// Result.
    Output(Output),
}

/// What a master sets at any time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Input {
    /// m/s2
    GroundAcceleration,
    /// N, on a floor
    Force(Side, usize),
}

/// What a master sets before the end of initialisation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Parameter {
    /// Factor on the record.
    GroundScale,
    /// Path of another record.
    GroundRecord,
    /// kg
    Mass(Side, usize),
    /// N/m, of a storey
    Stiffness(Side, usize),
    /// Of every mode of a building
    DampingRatio(Side),
    /// m
    Gap(usize),
    /// N/m^exponent
    ContactStiffness(usize),
    /// Of the penetration
    Exponent(usize),
    /// Of a free impact
    Restitution(usize),
    /// Error of a contact episode
    RelativeTolerance,
}

/// What the FMU computes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Output {
    /// m/s2, of the record
    GroundAcceleration,
    /// m
    Displacement(Side, usize),
    /// m/s
    Velocity(Side, usize),
    /// m/s2
    Acceleration(Side, usize),
    /// N
    BaseShear(Side),
    /// The largest magnitude so far.
    Peak(PeakOf),
    /// One contact.
    Contact(usize, ContactOutput),
    /// Contact episodes so far.
    Impacts,
    /// One term of the energy account.
    Energy(EnergyOutput),
}

/// What the FMU computes for one contact.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ContactOutput {
    /// N
    Force,
    /// m
    Penetration,
    /// In contact now.
    Active,
    /// Episodes begun so far.
    Impacts,
    /// N
    PeakForce,
    /// N s
    Impulse,
    /// J
    DissipatedEnergy,
    /// m/s
    ApproachVelocity,
}

/// The terms of the energy account.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EnergyOutput {
    /// J
    Input,
    /// J
    Kinetic,
    /// J
    Strain,
    /// J
    Viscous,
    /// J
    Impact,
    /// J
    External,
    /// Dimensionless
    Residual,
}

/// FMI causality.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Causality {
    /// `parameter`
    Parameter,
    /// `calculatedParameter`
    CalculatedParameter,
    /// `input`
    Input,
    /// `output`
    Output,
}

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
    /// One line for a user.
    pub description: String,
}

/// All variables of a scene. The value reference of a variable is its place in `rows`.
#[derive(Clone, Debug)]
pub struct Table {
    /// In the order of the description.
    pub rows: Vec<Row>,
}

impl Slot {
    /// The causality that follows from what it stands for.
    pub const fn causality(self) -> Causality {
        match self {
            Slot::Input(_) => Causality::Input,
            Slot::Parameter(_) => Causality::Parameter,
            Slot::Frequency(..) => Causality::CalculatedParameter,
            Slot::Output(_) => Causality::Output,
        }
    }
}

impl From<Input> for Slot {
    fn from(input: Input) -> Slot {
        Slot::Input(input)
    }
}

impl From<Parameter> for Slot {
    fn from(parameter: Parameter) -> Slot {
        Slot::Parameter(parameter)
    }
}

impl From<Output> for Slot {
    fn from(output: Output) -> Slot {
        Slot::Output(output)
    }
}

impl Causality {
    /// As the description writes it.
    pub const fn name(self) -> &'static str {
        match self {
            Causality::Parameter => "parameter",
            Causality::CalculatedParameter => "calculatedParameter",
            Causality::Input => "input",
            Causality::Output => "output",
        }
    }
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
    /// Name of the element of the description.
    pub const fn name(self) -> &'static str {
        match self {
            Type::Real(_) => "Real",
            Type::Integer => "Integer",
            Type::Boolean => "Boolean",
            Type::String => "String",
        }
    }
}

impl Table {
    /// The row of a value reference.
    pub fn row(&self, value_reference: u32) -> Option<&Row> {
        self.rows.get(usize::try_from(value_reference).ok()?)
    }

    /// Each row with its value reference.
    pub fn iter(&self) -> impl Iterator<Item = (u32, &Row)> {
        (0u32..).zip(&self.rows)
    }
}

fn building(scene: &Scene, side: Side) -> &Building {
    match side {
        Side::Left => &scene.left,
        Side::Right => &scene.right,
    }
}
