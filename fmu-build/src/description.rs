//! A description as an importer that is not ours has read it, with one form for both versions.

use anyhow::{Context, Result};
use fmi::model_description::fmi3::{Causality, Initial};
use fmi::model_description::{DefaultExperiment, fmi2, fmi3};
use pounding::FmiVersion;

/// What the importer has made of a description.
pub struct Description {
    pub version: FmiVersion,
    pub name: String,
    /// Of co-simulation.
    pub identifier: String,
    /// The GUID, or `instantiationToken`.
    pub token: String,
    pub experiment: Option<DefaultExperiment>,
    pub variables: Vec<Variable>,
    pub outputs: Vec<Unknown>,
    pub initial_unknowns: Vec<Unknown>,
    /// Where this is FMI 2.0, whether it needs memory functions of the importer.
    pub needs_memory: bool,
    /// What the importer finds wrong.
    pub problems: Vec<String>,
}

/// A variable, its numbers as texts.
#[derive(Clone)]
pub struct Variable {
    pub name: String,
    pub reference: u32,
    pub description: Option<String>,
    pub causality: Causality,
    pub initial: Option<Initial>,
    pub kind: Kind,
    pub min: Option<String>,
    pub max: Option<String>,
    pub nominal: Option<String>,
    pub start: Option<String>,
    /// Of FMI 3.0: it is exchanged within steps.
    pub has_updates: bool,
    /// It changes between events.
    pub is_continuous: bool,
}

/// The type of a variable: those that FMUs of ours have.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    Real,
    Integer,
    Boolean,
    String,
    Other(&'static str),
}

/// What is computed, and from what, by the numbers that the version gives to variables there.
pub struct Unknown {
    pub number: u32,
    pub dependencies: Vec<u32>,
}

impl Description {
    /// Reads it as one of the version that it says it is of.
    pub fn read(text: &str, version: FmiVersion) -> Result<Description> {
        match version {
            FmiVersion::V2 => of_fmi2(fmi2::ModelDescription::from_string(text)?),
            FmiVersion::V3 => of_fmi3(fmi3::ModelDescription::from_string(text)?),
        }
    }

    /// The variable of a number in the model structure.
    pub fn variable(&self, number: u32) -> Option<&Variable> {
        match self.version {
            FmiVersion::V2 => self.variables.get(usize::try_from(number).ok()?.checked_sub(1)?),
            FmiVersion::V3 => self.variables.iter().find(|variable| variable.reference == number),
        }
    }
}

const NO_INTERFACE: &str = "the FMU has no co-simulation interface";

fn of_fmi2(read: fmi2::ModelDescription) -> Result<Description> {
    let problems = read.validate().into_iter().map(|problem| problem.message).collect();
    let interface = read.coSimulation.context(NO_INTERFACE)?;
    let unknowns = |list: Vec<fmi2::Unknown>| list.into_iter().map(|u| unknown(u.index, u.dependencies)).collect();
    Ok(Description {
        version: FmiVersion::V2,
        name: read.modelName,
        identifier: interface.modelIdentifier,
        token: read.guid,
        experiment: read.defaultExperiment,
        variables: read.modelVariables.into_iter().map(variable_of_fmi2).collect(),
        outputs: unknowns(read.outputs),
        initial_unknowns: unknowns(read.initialUnknowns),
        needs_memory: !interface.canNotUseMemoryManagementFunctions,
        problems,
    })
}

fn of_fmi3(read: fmi3::ModelDescription) -> Result<Description> {
    let problems = read.validate().into_iter().map(|problem| problem.message).collect();
    let interface = read.coSimulation.context(NO_INTERFACE)?;
    let unknowns =
        |list: Vec<fmi3::Unknown>| list.into_iter().map(|u| unknown(u.valueReference, u.dependencies)).collect();
    Ok(Description {
        version: FmiVersion::V3,
        name: read.modelName,
        identifier: interface.modelIdentifier,
        token: read.instantiationToken,
        experiment: read.defaultExperiment,
        variables: read.modelVariables.into_iter().map(variable_of_fmi3).collect(),
        outputs: unknowns(read.outputs),
        initial_unknowns: unknowns(read.initialUnknowns),
        needs_memory: false,
        problems,
    })
}

fn unknown(number: u32, dependencies: Option<Vec<u32>>) -> Unknown {
    Unknown { number, dependencies: dependencies.unwrap_or_default() }
}

fn variable_of_fmi2(read: fmi2::ScalarVariable) -> Variable {
    use fmi2::VariableType;
    let start = read.variableType.start().clone();
    let (kind, min, max, nominal) = match read.variableType {
        VariableType::Real { min, max, nominal, .. } => (Kind::Real, min, max, nominal),
        VariableType::Integer { min, max, .. } => (Kind::Integer, min, max, None),
        VariableType::Enumeration { min, max, .. } => (Kind::Other("Enumeration"), min, max, None),
        VariableType::Boolean { .. } => (Kind::Boolean, None, None, None),
        VariableType::String { .. } => (Kind::String, None, None, None),
    };
    Variable {
        is_continuous: read.variability == fmi2::Variability::Continuous,
        name: read.name,
        reference: read.valueReference,
        description: read.description,
        causality: match read.causality {
            fmi2::Causality::Parameter => Causality::Parameter,
            fmi2::Causality::CalculatedParameter => Causality::CalculatedParameter,
            fmi2::Causality::Input => Causality::Input,
            fmi2::Causality::Output => Causality::Output,
            fmi2::Causality::Local => Causality::Local,
            fmi2::Causality::Independent => Causality::Independent,
        },
        initial: read.initial.map(|initial| match initial {
            fmi2::Initial::Exact => Initial::Exact,
            fmi2::Initial::Approx => Initial::Approx,
            fmi2::Initial::Calculated => Initial::Calculated,
        }),
        kind,
        min,
        max,
        nominal,
        start,
        has_updates: false,
    }
}

fn variable_of_fmi3(read: fmi3::ModelVariable) -> Variable {
    use fmi3::VariableType;
    // A scalar has one.
    let start = read.variableType.start().filter(|_| read.variableType.has_start()).map(|texts| texts.join(" "));
    let text = |number: Option<f64>| number.map(|number| number.to_string());
    let whole = |number: Option<i32>| number.map(|number| number.to_string());
    let (kind, min, max, nominal) = match &read.variableType {
        VariableType::Float64 { min, max, nominal, .. } => (Kind::Real, text(*min), text(*max), text(*nominal)),
        VariableType::Int32 { min, max, .. } => (Kind::Integer, whole(*min), whole(*max), None),
        VariableType::Boolean { .. } => (Kind::Boolean, None, None, None),
        VariableType::String { .. } => (Kind::String, None, None, None),
        other => (Kind::Other(other.name()), None, None, None),
    };
    let has_updates = matches!(read.variableType, VariableType::Float64 { intermediateUpdate: true, .. });
    Variable {
        is_continuous: read.variability == fmi3::Variability::Continuous,
        name: read.name,
        reference: read.valueReference,
        description: read.description,
        causality: read.causality,
        initial: read.initial,
        kind,
        min,
        max,
        nominal,
        start,
        has_updates,
    }
}
