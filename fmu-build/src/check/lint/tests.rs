#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

#[path = "../../../../tests/support/scenes.rs"]
mod scenes;

use fmi::model_description::fmi2::ModelDescription;
use scenes::{NO_CONTACT, RECORD_SCENE, SCENE, package};
use std::fs;
use std::path::Path;

/// Everything that is wrong with a description.
fn findings(text: &str) -> Vec<String> {
    super::description(text, &ModelDescription::from_string(text).unwrap())
}

#[test]
fn nothing_is_wrong_with_the_descriptions_of_the_example_scenes() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../modelDescription");
    let files = fs::read_dir(folder).unwrap().map(|file| file.unwrap().path()).collect::<Vec<_>>();
    assert!(!files.is_empty());
    for file in files {
        assert_eq!(findings(&fs::read_to_string(&file).unwrap()), [""; 0], "{}", file.display());
    }
}

#[test]
fn nothing_is_wrong_with_any_kind_of_variable() {
    for scene in [SCENE, RECORD_SCENE, NO_CONTACT] {
        assert_eq!(findings(&package(scene).model_description()), [""; 0], "{scene}");
    }
}

/// A lint that finds nothing anywhere finds nothing in our descriptions either.
#[test]
fn every_kind_of_damage_is_found() {
    let text = package(SCENE).model_description();
    for (from, to, finding) in [
        ("start=\"0.65\"", "start=\"1.65\"", "contact[1].restitution: start 1.65; expected 0 to 1"),
        ("min=\"1\" max=\"3\"", "min=\"3\" max=\"1\"", "contact[2].exponent: min 3 is greater than max 1"),
        ("min=\"1\" max=\"3\"", "min=\"one\"", "contact[2].exponent: min \"one\"; expected a number"),
        ("nominal=\"0.01\"", "nominal=\"0\"", "left.displacement[1]: nominal 0"),
        ("name=\"logStatusError\"", "name=\"logEvents\"", "log category \"logEvents\": more than once"),
        ("stopTime=\"4\"", "stopTime=\"0\"", "DefaultExperiment stopTime 0"),
        ("stopTime=\"4\"", "stopTime=\"inf\"", "DefaultExperiment stopTime \"inf\": expected a finite number"),
        ("stepSize=\"0.01\"", "stepSize=\"4\"", "DefaultExperiment stepSize 4: expected less than the duration 4"),
        ("stepSize=\"0.01\"", "stepSize=\"0\"", "DefaultExperiment stepSize 0: expected > 0"),
        ("valueReference=\"3\"", "valueReference=\"4\"", "both have the value reference 4"),
        ("<Unit name=\"Hz\">", "<Unit name=\"kHz\">", "left.frequency[1]: unit \"Hz\" is not in <UnitDefinitions>"),
        ("<Unit name=\"Hz\">", "<Unit name=\"kHz\">", "unit \"kHz\" is not used"),
        ("<Unit name=\"Hz\">", "<Unit name=\"kg\">", "unit \"kg\": more than once"),
        ("unit=\"kg\"", "", "left.mass[1]: no unit"),
        ("<DisplayUnit name=\"kN\"", "<DisplayUnit name=\"MN\"", "left.force[1]: display unit \"kN\" is not defined"),
        (
            "index=\"5\" dependencies=\"2\"",
            "index=\"5\" dependencies=\"3\"",
            "Outputs 5: depends on left.displacement[1]",
        ),
        (
            "index=\"5\" dependencies=\"2\"",
            "index=\"5\" dependencies=\"2 1\"",
            "Outputs 5, dependencies: index 1 after 2",
        ),
        ("<Unknown index=\"3\"", "<Unknown index=\"5\"", "Outputs: index 4 after 5; expected ascending"),
        ("description=\"mass of floor 1\" ", "", "left.mass[1]: no description"),
        ("start=\"3.65\"", "", "left.mass[1]: no start value"),
        ("<Boolean/>", "<Boolean start=\"false\"/>", "contact[1].active: a start value"),
        ("initial=\"calculated\"", "initial=\"exact\"", "left.displacement[1]: initial"),
        ("causality=\"output\"", "causality=\"independent\"", "left.displacement[1]: an independent variable"),
        ("</ModelStructure>", "<Derivatives/></ModelStructure>", "<Derivatives>: empty"),
        ("<LogCategories>", "<TypeDefinitions/><LogCategories>", "<TypeDefinitions>: empty"),
        ("<LogCategories>", "<Categories/><LogCategories>", "<Categories>: not an element of FMI 2.0"),
        ("<ModelVariables>", "<DefaultExperiment/><ModelVariables>", "<DefaultExperiment>: more than once"),
        ("<DefaultExperiment ", "<VendorAnnotations ", "<DefaultExperiment>: missing"),
        ("<CoSimulation ", "<VendorAnnotations><Tool name=\"a\"/></VendorAnnotations><CoSimulation ", "out of order"),
        ("modelName=", "generationDateAndTime=\"2020-01-01T00:00:00Z\" modelName=", "generationDateAndTime"),
    ] {
        assert!(text.contains(from), "{from}");
        let found = findings(&text.replacen(from, to, 1));
        assert!(found.iter().any(|f| f.contains(finding)), "{from} -> {to}: {found:?}");
    }
}
