//! What is read of a run, by value reference.

use pounding::engine::{BuildingId, Input, Instant, Output};
use pounding::variables::{Calculated, Settings, Slot, Table, Type};

/// A numeric variable.
#[derive(Clone, Copy)]
pub enum Reading {
    /// Changes in the course of a run.
    Computed(Output, Kind),
    /// Hz, of the model.
    Frequency(BuildingId, usize),
    /// Hz, of the model with its links.
    SystemFrequency(usize),
    /// What is set from outside.
    Input(Input),
    /// Does not change: a parameter.
    Constant(f64),
}

/// How the values of a variable are kept.
#[derive(Clone, Copy)]
pub enum Kind {
    /// As a double.
    Real,
    /// As a whole number.
    Integer,
    /// As true or false.
    Boolean,
}

impl Reading {
    /// That of a value reference; none where it is of no variable, or of a text.
    pub fn new(table: &Table, settings: &Settings, reference: u32) -> Option<Reading> {
        let row = table.row(reference)?;
        Some(match row.slot {
            Slot::Output(output) => Reading::Computed(output, Kind::of(row.ty)?),
            Slot::Calculated(Calculated::Frequency(id, mode)) => Reading::Frequency(id, mode),
            Slot::Calculated(Calculated::SystemFrequency(mode)) => Reading::SystemFrequency(mode),
            Slot::Calculated(calculated) => Reading::Constant(settings.calculate(calculated)),
            Slot::Input(input) => Reading::Input(input),
            Slot::Parameter(parameter) => Reading::Constant(settings.read(parameter).real()?),
        })
    }

    /// How its values are kept.
    pub fn kind(self) -> Kind {
        if let Reading::Computed(_, kind) = self { kind } else { Kind::Real }
    }

    /// Its value at a time.
    pub fn at(self, now: &Instant<'_>) -> f64 {
        match self {
            Reading::Computed(output, _) => now.read(output),
            Reading::Frequency(id, mode) => now.model().natural_frequencies(id)[mode],
            Reading::SystemFrequency(mode) => now.model().system_frequencies()[mode],
            Reading::Input(input) => now.input(input),
            Reading::Constant(value) => value,
        }
    }
}

impl Kind {
    fn of(ty: Type) -> Option<Kind> {
        match ty {
            Type::Real(_) => Some(Kind::Real),
            Type::Integer => Some(Kind::Integer),
            Type::Boolean => Some(Kind::Boolean),
            Type::String => None,
        }
    }
}
