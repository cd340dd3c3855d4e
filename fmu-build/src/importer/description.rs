//! A description as an importer that is not ours reads it, in the form that both versions share.

use crate::description::{Causality, Description, Experiment, Initial, Kind, NO_INTERFACE, Unknown, Variable};
use anyhow::{Context, Result};
use fmi::model_description::{DefaultExperiment, fmi2, fmi3};
use pounding::FmiVersion;

/// Reads it as one of the version that it says it is of.
pub fn read(text: &str, version: FmiVersion) -> Result<Description> {
    match version {
        FmiVersion::V2 => of_fmi2(fmi2::ModelDescription::from_string(text)?),
        FmiVersion::V3 => of_fmi3(fmi3::ModelDescription::from_string(text)?),
    }
}

fn of_fmi2(read: fmi2::ModelDescription) -> Result<Description> {
    let problems = read.validate().into_iter().map(|problem| problem.message).collect();
    let interface = read.coSimulation.context(NO_INTERFACE)?;
    let unknowns = |list: Vec<fmi2::Unknown>| list.into_iter().map(|u| unknown(u.index, u.dependencies)).collect();
    Ok(Description {
        version: FmiVersion::V2,
        name: read.modelName,
        identifier: interface.modelIdentifier,
        token: read.guid,
        experiment: experiment(read.defaultExperiment),
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
        experiment: experiment(read.defaultExperiment),
        variables: read.modelVariables.into_iter().map(variable_of_fmi3).collect(),
        outputs: unknowns(read.outputs),
        initial_unknowns: unknowns(read.initialUnknowns),
        needs_memory: false,
        problems,
    })
}

fn experiment(read: Option<DefaultExperiment>) -> Experiment {
    read.map_or_else(Experiment::default, |read| Experiment {
        start: read.startTime,
        stop: read.stopTime,
        step: read.stepSize,
        tolerance: read.tolerance,
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
        causality: match read.causality {
            fmi3::Causality::Parameter => Causality::Parameter,
            fmi3::Causality::CalculatedParameter => Causality::CalculatedParameter,
            fmi3::Causality::StructuralParameter => Causality::StructuralParameter,
            fmi3::Causality::Input => Causality::Input,
            fmi3::Causality::Output => Causality::Output,
            fmi3::Causality::Local => Causality::Local,
            fmi3::Causality::Independent => Causality::Independent,
        },
        initial: read.initial.map(|initial| match initial {
            fmi3::Initial::Exact => Initial::Exact,
            fmi3::Initial::Approx => Initial::Approx,
            fmi3::Initial::Calculated => Initial::Calculated,
        }),
        kind,
        min,
        max,
        nominal,
        start,
        has_updates,
    }
}
