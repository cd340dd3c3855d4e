//! What the variables stand for.

use crate::engine::{BuildingId, Input, Output};
use crate::scene::FoundationKey;

/// What a variable stands for. Floors, storeys, contacts and links are counted from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Slot {
    /// Set by the master at any time.
    Input(Input),
    /// Set by the master before the end of initialisation.
    Parameter(Parameter),
    /// Worked out from the parameters.
    Calculated(Calculated),
    /// Result.
    Output(Output),
}

/// A calculated parameter.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Calculated {
    /// Hz: natural frequency of a building alone.
    Frequency(BuildingId, usize),
    /// Share of a storey's stiffness that gravity takes.
    StabilityCoefficient(BuildingId, usize),
    /// m: drift at which a storey that yields resists no push any more.
    CriticalDrift(BuildingId, usize),
    /// Hz: natural frequency of the buildings with their links and on their soil.
    SystemFrequency(usize),
    /// First period of a building on its soil over that on a fixed base.
    PeriodRatio(BuildingId),
}

/// A parameter: the master sets it before the end of initialisation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Parameter {
    /// Factor on the record.
    GroundScale,
    /// Path of another record.
    GroundRecord,
    /// kg
    Mass(BuildingId, usize),
    /// N/m, of a storey
    Stiffness(BuildingId, usize),
    /// Of every mode of a building
    DampingRatio(BuildingId),
    /// N s/m, of a storey
    Dashpot(BuildingId, usize),
    /// N, of a storey
    YieldForce(BuildingId, usize),
    /// Of a storey
    PostYieldRatio(BuildingId, usize),
    /// m
    Gap(usize),
    /// Where columns are hit, as a share of their storey's height
    Position(usize),
    /// N/m^exponent
    ContactStiffness(usize),
    /// Of the penetration
    Exponent(usize),
    /// Of a free impact
    Restitution(usize),
    /// N/m, of a link
    LinkStiffness(usize),
    /// N s/m, of a link
    LinkDashpot(usize),
    /// Of the foundation of a building
    Foundation(BuildingId, FoundationKey),
    /// N, of a link
    SlipForce(usize),
    /// Of a link
    LinkPostYieldRatio(usize),
    /// Error of a contact episode
    RelativeTolerance,
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

impl Slot {
    /// The causality that follows from what it stands for.
    pub const fn causality(self) -> Causality {
        match self {
            Slot::Input(_) => Causality::Input,
            Slot::Parameter(_) => Causality::Parameter,
            Slot::Calculated(_) => Causality::CalculatedParameter,
            Slot::Output(_) => Causality::Output,
        }
    }
}

macro_rules! slots {
    ($($Kind:ident),*) => {$(
        impl From<$Kind> for Slot {
            fn from(of: $Kind) -> Slot {
                Slot::$Kind(of)
            }
        }
    )*};
}
slots!(Input, Parameter, Calculated, Output);

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
