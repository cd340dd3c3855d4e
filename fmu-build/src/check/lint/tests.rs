#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

#[path = "../../../../tests/support/scenes.rs"]
mod scenes;

use crate::description::Description;
use crate::importer;
use crate::sight::{origin, version};
use pounding::FmiVersion;
use scenes::{NO_CONTACT, RECORD_SCENE, SCENE, package};
use std::fs;
use std::path::Path;
use std::sync::Mutex;

/// Everything that is wrong with a description, in our eyes and in those of the importer.
fn findings(text: &str) -> Vec<String> {
    let mut findings = super::document(text);
    match read(text) {
        Ok(description) => {
            findings.extend(super::description(&description));
            findings.extend(description.problems);
        }
        Err(error) => findings.push(error.to_string()),
    }
    findings
}

/// The importer's parser of names is one for all threads.
fn read(text: &str) -> anyhow::Result<Description> {
    static TURN: Mutex<()> = Mutex::new(());
    let _turn = TURN.lock().unwrap_or_else(|poisoned| poisoned.into_inner());
    importer::read(text, version(text))
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
        for version in FmiVersion::ALL {
            assert_eq!(findings(&package(scene).model_description(version)), [""; 0], "{scene}");
        }
    }
}

/// A lint that finds nothing anywhere finds nothing in our descriptions either.
#[test]
fn every_kind_of_damage_is_found() {
    let text = package(SCENE).model_description(FmiVersion::V2);
    for (from, to, finding) in [
        ("start=\"0.65\"", "start=\"1.65\"", "contact[1].restitution: start 1.65; expected 0 to 1"),
        ("min=\"1\" max=\"3\"", "min=\"3\" max=\"1\"", "contact[2].exponent: min 3 is greater than max 1"),
        ("min=\"1\" max=\"3\"", "min=\"one\"", "contact[2].exponent: min \"one\"; expected a number"),
        ("nominal=\"0.01\"", "nominal=\"0\"", "left.displacement[1]: nominal 0"),
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
        ("min=\"0\" max=\"1\"", "min=\"0\" max=\"0.5\"", "contact[1].restitution: start 0.65; expected 0 to 0.5"),
        ("nominal=\"0.01\"", "nominal=\"NaN\"", "left.displacement[1]: nominal NaN"),
        ("nominal=\"0.01\"", "nominal=\"-1\"", "left.displacement[1]: nominal -1"),
        ("tolerance=\"1e-12\"", "tolerance=\"-1\"", "DefaultExperiment tolerance -1: expected > 0"),
        ("tolerance=\"1e-12\"", "tolerance=\"tight\"", "DefaultExperiment tolerance \"tight\""),
        ("unit=\"m/s2\" displayUnit", "displayUnit", "ground.acceleration: no unit, but display unit \"g\""),
        ("index=\"5\" dependencies=\"2\"", "index=\"5\" dependencies=\"999\"", "999"),
        (
            "index=\"5\" dependencies=\"2\" dependenciesKind=\"fixed\"",
            "index=\"5\" dependencies=\"2\" dependenciesKind=\"fixed fixed\"",
            "dependenciesKind",
        ),
        ("<Unknown index=\"3\" dependencies=\"\"/>", "", "output"),
        ("<Unknown index=\"3\"", "<Unknown index=\"999\"", "999"),
        ("name=\"left.displacement[1]\"", "name=\"left.velocity[1]\"", "Duplicate variable name"),
        ("name=\"left.displacement[1]\"", "name=\"left.displacement[1\"", "left.displacement[1"),
        ("variability=\"fixed\"", "variability=\"continuous\"", "left.mass[1]"),
    ] {
        assert!(text.contains(from), "{from}");
        let found = findings(&text.replacen(from, to, 1));
        assert!(found.iter().any(|f| f.contains(finding)), "{from} -> {to}: {found:?}");
    }
}

/// The same for FMI 3.0.
#[test]
fn every_kind_of_damage_in_fmi3_is_found() {
    let text = package(RECORD_SCENE).model_description(FmiVersion::V3);
    for (from, to, finding) in [
        ("declaredType=\"Mass\"", "", "left.mass[1]: no declaredType, and so no unit"),
        ("declaredType=\"Mass\"", "declaredType=\"Weight\"", "left.mass[1]: declaredType \"Weight\" is not in"),
        ("Type name=\"Mass\"", "Type name=\"Weight\"", "type \"Weight\" is not used"),
        ("Type name=\"Mass\"", "Type name=\"Force\"", "type \"Force\": more than once"),
        ("unit=\"kg\" displayUnit=\"t\"", "", "left.mass[1]: no unit"),
        ("displayUnit=\"t\"", "displayUnit=\"lb\"", "left.mass[1]: display unit \"lb\" is not defined"),
        ("<Unit name=\"kg\"", "<Unit name=\"slug\"", "left.mass[1]: unit \"kg\" is not in <UnitDefinitions>"),
        ("causality=\"independent\"", "causality=\"local\"", "independent variables: []; expected \"time\" alone"),
        ("name=\"time\"", "name=\"t\"", "independent variables: [\"t\"]"),
        ("name=\"time\"", "intermediateUpdate=\"true\" name=\"time\"", "time: intermediateUpdate true; expected false"),
        (" intermediateUpdate=\"true\"", "", "intermediateUpdate false; expected true"),
        ("<Int32 ", "<Int64 ", "of type Int64; expected a type that FMUs of ours have"),
        ("<Output valueReference=\"", "<Output valueReference=\"99", "expected set"),
        ("initial=\"calculated\"", "initial=\"exact\"", "no start value"),
        ("<Start value=\"\"/>", "", "ground.record"),
    ] {
        assert!(text.contains(from), "{from}");
        let found = findings(&text.replacen(from, to, 1));
        assert!(found.iter().any(|f| f.contains(finding)), "{from} -> {to}: {found:#?}");
    }
}

#[test]
fn missing_initial_unknowns_are_found() {
    let text = package(SCENE).model_description(FmiVersion::V2);
    let (start, end) = (text.find("<InitialUnknowns>").unwrap(), text.find("</ModelStructure>").unwrap());
    let found = findings(&(text[..start].to_owned() + &text[end..]));
    assert!(found.iter().any(|f| f.contains("initial unknowns")), "{found:?}");
}

#[test]
fn every_finding_comes_at_once() {
    let text = package(SCENE).model_description(FmiVersion::V2);
    let changes = [
        ("start=\"0.65\"", "start=\"1.65\"", "contact[1].restitution: start 1.65"),
        ("stopTime=\"4\"", "stopTime=\"0\"", "DefaultExperiment stopTime 0"),
        ("unit=\"kg\"", "", "left.mass[1]: no unit"),
        ("<Unknown index=\"3\"", "<Unknown index=\"5\"", "expected ascending"),
    ];
    let found = findings(&changes.iter().fold(text, |text, (from, to, _)| text.replacen(from, to, 1)));
    for (.., expected) in changes {
        assert!(found.iter().any(|f| f.contains(expected)), "no {expected}: {found:#?}");
    }
}

#[test]
fn files_that_are_not_ours_and_libraries_under_other_names_are_found() {
    let text = package(SCENE).model_description(FmiVersion::V2);
    let description = read(&text).unwrap();
    let findings = |name: &str| super::files(&[name.to_owned()], &description);
    for good in [
        "modelDescription.xml",
        "model.png",
        "resources/scene.toml",
        "resources/record.at2",
        "resources/record.txt",
        "resources/record_channel_12.txt",
        "documentation/licenses/license.txt",
        "binaries/linux64/TwoBuildings.so",
        "binaries/win64/TwoBuildings.dll",
        "binaries/aarch64-darwin/TwoBuildings.dylib",
        "binaries/linux64/",
        "documentation/",
    ] {
        assert_eq!(findings(good), [""; 0], "{good}");
    }
    for bad in [
        "readme.txt",
        "resources/more.txt",
        "resources/record_channel_.txt",
        "resources/more/",
        "sources/a.c",
        "modeldescription.xml",
        "binaries",
    ] {
        assert_eq!(
            findings(bad),
            [format!(
                "{bad:?}: {}",
                if bad == "binaries" {
                    "expected binaries/<platform>/TwoBuildings.so, .dll or .dylib"
                } else {
                    "not a file of such an FMU"
                }
            )]
        );
    }
    for bad in ["binaries/linux64/Two.so", "binaries/TwoBuildings.so", "binaries/linux64/TwoBuildings.txt"] {
        assert!(findings(bad)[0].contains("expected binaries/<platform>/TwoBuildings.so"), "{bad}");
    }
}

#[test]
fn only_our_fmus_are_ours() {
    let text = package(SCENE).model_description(FmiVersion::V2);
    assert!(origin(&text).is_ok());
    let made_by = |tool: &str| origin(&text.replace(concat!("pounding-fmu ", env!("CARGO_PKG_VERSION")), tool));
    assert!(made_by("pounding-fmu 99.0.0").is_ok());
    assert!(made_by("Other 1.0").unwrap_err().to_string().contains("made by \"Other 1.0\""));
    let silent = text.replace("generationTool", "author");
    assert!(origin(&silent).unwrap_err().to_string().contains("does not say which tool made it"));
}
