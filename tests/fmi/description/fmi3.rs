//! The description in FMI 3.0 says the same as that in FMI 2.0, in the words of the newer standard.

use crate::support::scenes::{CORRECTED, LINKED, NO_CONTACT, RECORD_SCENE, SCENE, UNEVEN, YIELDING, package};
use fmi::model_description::fmi2;
use fmi::model_description::fmi3::{
    Causality, DependencyKind, Initial, ModelDescription, ModelVariable, TypeDefinition, Unknown, Variability,
    VariableType,
};
use pounding::FmiVersion;
use std::collections::HashSet;

const SCENES: [&str; 7] = [SCENE, RECORD_SCENE, NO_CONTACT, UNEVEN, YIELDING, LINKED, CORRECTED];

pub fn describe(text: &str) -> ModelDescription {
    ModelDescription::from_string(text).unwrap()
}

fn both(scene: &str) -> (fmi2::ModelDescription, ModelDescription) {
    let text = |version| package(scene).model_description(version);
    (fmi2::ModelDescription::from_string(&text(FmiVersion::V2)).unwrap(), describe(&text(FmiVersion::V3)))
}

/// What a variable says, but for its type, in words that both versions have.
fn in_words(name: &str, reference: u32, description: &Option<String>, rest: [String; 5]) -> String {
    format!("{name} {reference} {description:?} {}", rest.join(" "))
}

fn in_words_of_2(variable: &fmi2::ScalarVariable) -> String {
    let (ty, numbers) = match &variable.variableType {
        fmi2::VariableType::Real { unit, displayUnit, min, max, nominal, .. } => {
            let number = |text: &Option<String>| text.as_ref().map(|text| text.parse::<f64>().unwrap());
            ("Float64", format!("{unit:?} {displayUnit:?} {:?}", [number(min), number(max), number(nominal)]))
        }
        fmi2::VariableType::Integer { .. } => ("Int32", String::new()),
        other => (other.name(), String::new()),
    };
    let start = variable.variableType.start().iter().map(|text| text.to_string()).collect::<Vec<_>>();
    let rest = [
        format!("{:?}", variable.causality),
        format!("{:?}", variable.variability),
        ty.to_owned(),
        numbers,
        format!("{start:?}"),
    ];
    in_words(&variable.name, variable.valueReference, &variable.description, rest)
}

fn in_words_of_3(variable: &ModelVariable, description: &ModelDescription) -> String {
    let numbers = match &variable.variableType {
        VariableType::Float64 {
            declaredType,
            unit: None,
            displayUnit: None,
            quantity: None,
            min,
            max,
            nominal,
            ..
        } => {
            let declared = description.get_type_definition(declaredType.as_deref().unwrap());
            let Some(TypeDefinition::Float64 { unit, displayUnit, .. }) = declared else { panic!("{variable:?}") };
            format!("{unit:?} {displayUnit:?} {:?}", [*min, *max, *nominal])
        }
        VariableType::Float64 { .. } => panic!("a unit beside the declared type: {variable:?}"),
        _ => String::new(),
    };
    let rest = [
        format!("{:?}", variable.causality),
        format!("{:?}", variable.variability),
        variable.variableType.name().to_owned(),
        numbers,
        format!("{:?}", variable.variableType.start().unwrap_or_default()),
    ];
    in_words(&variable.name, variable.valueReference, &variable.description, rest)
}

#[test]
fn the_variables_are_those_of_fmi_2_and_the_time() {
    for scene in SCENES {
        let (old, new) = both(scene);
        let (time, others): (Vec<_>, Vec<_>) =
            new.modelVariables.iter().partition(|variable| variable.causality == Causality::Independent);
        let expected = old.modelVariables.iter().map(in_words_of_2).collect::<Vec<_>>();
        assert_eq!(others.iter().map(|variable| in_words_of_3(variable, &new)).collect::<Vec<_>>(), expected);
        let [time] = time[..] else { panic!("{time:?}") };
        assert_eq!((time.name.as_str(), time.valueReference as usize), ("time", expected.len()));
        assert_eq!((new.get_unit(time), time.variability), (Some("s"), Variability::Continuous));
        assert!(time.initial.is_none() && !time.variableType.has_start());
    }
}

#[test]
fn what_can_be_set_is_exact_and_the_rest_calculated() {
    for variable in both(SCENE).1.modelVariables {
        let expected = match variable.causality {
            Causality::Input | Causality::Parameter => Some(Initial::Exact),
            Causality::Output | Causality::CalculatedParameter => Some(Initial::Calculated),
            _ => None,
        };
        assert_eq!(variable.initial, expected, "{}", variable.name);
        assert!(variable.clocks.is_empty() && variable.dimensions.is_empty(), "{}", variable.name);
    }
}

#[test]
fn dependencies_are_those_of_fmi_2() {
    for scene in SCENES {
        let (old, new) = both(scene);
        let reference = |index: &u32| old.variable_by_index(*index).unwrap().valueReference;
        for (old, new) in [(&old.outputs, &new.outputs), (&old.initialUnknowns, &new.initialUnknowns)] {
            assert_eq!(old.len(), new.len());
            for (old, Unknown { valueReference, dependencies, dependenciesKind, .. }) in old.iter().zip(new) {
                assert_eq!(*valueReference, reference(&old.index));
                let known = old.dependencies.as_ref().unwrap().iter().map(reference).collect::<Vec<_>>();
                assert_eq!(dependencies.as_ref(), Some(&known));
                let kinds = dependenciesKind.as_ref().map(|kinds| kinds.iter().map(DependencyKind::is_fixed).collect());
                let expected = old.dependenciesKind.as_ref().map(|kinds| {
                    kinds.iter().map(|kind| matches!(kind, fmi2::DependencyKind::Fixed)).collect::<Vec<_>>()
                });
                assert_eq!(kinds, expected);
            }
        }
        let unknown = |list: &[Unknown]| list.iter().map(|unknown| unknown.valueReference).collect::<HashSet<_>>();
        assert!(!unknown(&new.outputs).contains(&(old.modelVariables.len() as u32)), "the time is no output");
        assert!(new.derivatives.is_empty() && new.clockedStates.is_empty() && new.eventIndicators.is_empty());
    }
}

trait IsFixed {
    fn is_fixed(&self) -> bool;
}

impl IsFixed for DependencyKind {
    fn is_fixed(&self) -> bool {
        *self == DependencyKind::Fixed
    }
}

#[test]
fn each_unit_has_one_type_that_is_used() {
    for scene in SCENES {
        let new = both(scene).1;
        let used = new.modelVariables.iter().filter_map(|variable| match &variable.variableType {
            VariableType::Float64 { declaredType, .. } => declaredType.clone(),
            _ => None,
        });
        let used = used.collect::<HashSet<_>>();
        let defined = new.typeDefinitions.iter().map(|definition| definition.name().to_owned());
        assert_eq!(defined.collect::<HashSet<_>>(), used);
        let units = new.typeDefinitions.iter().map(|definition| match definition {
            TypeDefinition::Float64 { name, quantity, unit, .. } => {
                assert_eq!(quantity.as_ref(), Some(name));
                unit.clone().unwrap()
            }
            other => panic!("{other:?}"),
        });
        let defined = new.unitDefinitions.iter().map(|unit| unit.name.clone()).collect::<Vec<_>>();
        assert_eq!(units.collect::<Vec<_>>(), defined, "one for each, in their order");
    }
    let new = both(SCENE).1;
    for (quantity, unit) in [("Length", "m"), ("Acceleration", "m/s2"), ("Impulse", "N.s"), ("Dimensionless", "1")] {
        let declared = new.get_type_definition(quantity);
        assert!(matches!(declared, Some(TypeDefinition::Float64 { unit: Some(its), .. }) if its == unit), "{quantity}");
    }
}

#[test]
fn what_the_fmu_can_do_is_declared() {
    for scene in SCENES {
        let new = both(scene).1;
        let can = new.coSimulation.unwrap();
        assert!(can.canGetAndSetFMUState && can.canSerializeFMUState);
        assert!(can.providesDirectionalDerivatives && can.providesAdjointDerivatives);
        assert!(can.canHandleVariableCommunicationStepSize && can.maxOutputDerivativeOrder == 2);
        assert!(can.mightReturnEarlyFromDoStep && can.hasEventMode);
        assert!(can.providesIntermediateUpdate && !can.canReturnEarlyAfterIntermediateUpdate);
        assert!(!can.providesEvaluateDiscreteStates && !can.providesPerElementDependencies);
        assert_eq!(new.fmiVersion, "3.0");
        assert!(new.modelExchange.is_none() && new.scheduledExecution.is_none());
    }
}

#[test]
fn the_token_is_no_guid_of_fmi_2() {
    let package = package(RECORD_SCENE);
    let [guid, token] = FmiVersion::ALL.map(|version| package.guid(version));
    assert_ne!(guid, token);
    let described = describe(&package.model_description(FmiVersion::V3));
    assert_eq!((described.instantiationToken, token.len()), (token, 38));
}
