//! `modelDescription.xml`: valid for an importer that is not ours, what it says, and stable.

mod fmi3;
mod golden;

use crate::support::scenes::{CORRECTED, LINKED, NO_CONTACT, RECORD_SCENE, SCENE, numbers_only, package};
use fmi::model_description::fmi2::{Causality, ModelDescription, ScalarVariable, Variability, VariableType};
use pounding::FmiVersion;
use pounding::description::Package;
use std::sync::Mutex;

fn describe(scene_text: &str) -> ModelDescription {
    ModelDescription::from_string(&package(scene_text).model_description(FmiVersion::V2)).unwrap()
}

#[test]
fn another_importer_finds_it_valid() {
    for scene in [SCENE, RECORD_SCENE, NO_CONTACT, LINKED, CORRECTED] {
        for scene in [scene.to_owned(), numbers_only(scene)] {
            for version in FmiVersion::ALL {
                assert_eq!(problems(&package(&scene).model_description(version), version), [""; 0]);
            }
        }
    }
}

/// What the importer finds wrong; its parser of names is one for all threads.
fn problems(text: &str, version: FmiVersion) -> Vec<String> {
    static TURN: Mutex<()> = Mutex::new(());
    let _turn = TURN.lock().unwrap_or_else(|poisoned| poisoned.into_inner());
    let problems = match version {
        FmiVersion::V2 => ModelDescription::from_string(text).unwrap().validate(),
        FmiVersion::V3 => fmi3::describe(text).validate(),
    };
    problems.into_iter().map(|problem| problem.message).collect()
}

/// Those of storeys, of floors with a matrix, and what they make of the outputs.
#[test]
fn what_can_be_corrected_has_these_variables() {
    let described = describe(CORRECTED);
    let lines: Vec<String> = described.modelVariables.iter().map(in_words).collect();
    for i in 1..=2 {
        for expected in [
            format!("left.storey_correction[{i}] input Real N"),
            format!("left.storey_shear[{i}] output Real N"),
            format!("left.peak_storey_shear[{i}] output Real N"),
            format!("right.restoring_correction[{i}] input Real N"),
        ] {
            assert_eq!(lines.iter().filter(|line| **line == expected).count(), 1, "{expected}");
        }
    }
    assert!(lines.contains(&"energy.correction output Real J".to_owned()));
    let is_absent = |name: &str| !lines.iter().any(|line| line.starts_with(name));
    assert!(["left.restoring", "right.storey_"].into_iter().all(is_absent));
    let plain = describe(&CORRECTED.replace("restoring_corrections = true\n", ""));
    let knows = |variable: &ScalarVariable| ["correction", "storey_shear"].iter().any(|it| variable.name.contains(it));
    assert!(!plain.modelVariables.iter().any(knows));
}

/// Name, causality and type of every variable, in the words of the contract with the users.
#[test]
fn a_scene_without_record_has_these_variables() {
    let mut expected = vec!["ground.acceleration input Real m/s2", "impacts output Integer"];
    let mut names = Vec::new();
    for (side, floors) in [("left", 2), ("right", 3)] {
        names.extend(
            ["base_shear output Real N", "peak_base_shear output Real N", "damping_ratio parameter Real 1"]
                .map(|line| format!("{side}.{line}")),
        );
        for i in 1..=floors {
            names.extend(
                [
                    "force[i] input Real N",
                    "displacement[i] output Real m",
                    "velocity[i] output Real m/s",
                    "acceleration[i] output Real m/s2",
                    "peak_displacement[i] output Real m",
                    "peak_drift[i] output Real m",
                    "peak_acceleration[i] output Real m/s2",
                    "mass[i] parameter Real kg",
                    "stiffness[i] parameter Real N/m",
                    "frequency[i] calculatedParameter Real Hz",
                ]
                .map(|line| format!("{side}.{}", line.replace("[i]", &format!("[{i}]")))),
            );
        }
    }
    for p in 1..=2 {
        names.extend(
            [
                "gap parameter Real m",
                "force output Real N",
                "penetration output Real m",
                "active output Boolean",
                "impacts output Integer",
                "peak_force output Real N",
                "impulse output Real N.s",
                "dissipated_energy output Real J",
                "approach_velocity output Real m/s",
            ]
            .map(|line| format!("contact[{p}].{line}")),
        );
    }
    expected.extend([
        "contact[1].stiffness parameter Real N/m",
        "contact[1].restitution parameter Real 1",
        "contact[2].stiffness parameter Real N/m^exponent",
        "contact[2].exponent parameter Real 1",
        "energy.input output Real J",
        "energy.kinetic output Real J",
        "energy.strain output Real J",
        "energy.viscous output Real J",
        "energy.impact output Real J",
        "energy.external output Real J",
        "energy.residual output Real 1",
        "solver.relative_tolerance parameter Real 1",
    ]);
    expected.extend(names.iter().map(String::as_str));
    expected.sort_unstable();
    let description = describe(SCENE);
    let mut found = description.modelVariables.iter().map(in_words).collect::<Vec<_>>();
    found.sort_unstable();
    assert_eq!(found, expected);
}

fn in_words(variable: &ScalarVariable) -> String {
    let causality = match variable.causality {
        Causality::Parameter => "parameter",
        Causality::CalculatedParameter => "calculatedParameter",
        Causality::Input => "input",
        Causality::Output => "output",
        _ => "other",
    };
    let unit = match &variable.variableType {
        VariableType::Real { unit, .. } => format!(" {}", unit.as_deref().unwrap_or("without unit")),
        _ => String::new(),
    };
    format!("{} {causality} {}{unit}", variable.name, variable.variableType.name())
}

#[test]
fn links_have_these_variables() {
    let description = describe(LINKED);
    let found = description.modelVariables.iter().filter(|v| v.name.starts_with("link[4]")).map(in_words);
    let expected = [
        "stiffness parameter Real N/m",
        "dashpot parameter Real N.s/m",
        "slip_force parameter Real N",
        "post_yield_ratio parameter Real 1",
        "force output Real N",
        "displacement output Real m",
        "velocity output Real m/s",
        "peak_force output Real N",
        "peak_displacement output Real m",
        "slip output Real m",
        "slip_travel output Real m",
        "slipping output Integer",
        "dissipated_energy output Real J",
    ];
    assert_eq!(found.collect::<Vec<_>>(), expected.map(|line| format!("link[4].{line}")));
    let about = |name: &str| description.variable_by_name(name).unwrap().description.clone().unwrap();
    assert_eq!(about("link[1].stiffness"), "stiffness of the link between left floor 2 and right floor 2");
    assert_eq!(about("link[4].dashpot"), "dashpot of the link between the ground and right floor 2");
    assert!(about("energy.strain").ends_with(", links included"));
}

#[test]
fn what_a_scene_does_not_have_is_no_variable() {
    let names = |scene| describe(scene).modelVariables.iter().map(in_words).collect::<Vec<_>>();
    let under_a_record = names(RECORD_SCENE);
    for expected in [
        "ground.acceleration output Real m/s2",
        "ground.scale parameter Real 1",
        "ground.record parameter String",
        "right.stiffness[3] parameter Real N/m",
        "contact[1].restitution parameter Real 1",
    ] {
        assert!(under_a_record.iter().any(|name| name == expected), "{expected}");
    }
    for absent in ["left.stiffness", "damping_ratio", "force[", "energy.", "contact[1].exponent", "contact[2]"] {
        assert!(!under_a_record.iter().any(|name| name.contains(absent)), "{absent}");
    }
    let apart = names(NO_CONTACT);
    assert!(apart.iter().any(|name| name.starts_with("right.damping_ratio")));
    assert!(!apart.iter().any(|name| name.contains("contact") || name.contains("left.damping")));
}

#[test]
fn what_the_fmu_can_do_is_declared() {
    for scene in [SCENE, RECORD_SCENE, NO_CONTACT] {
        let text = package(scene).model_description(FmiVersion::V2);
        let document = roxmltree::Document::parse(&text).unwrap();
        let capabilities = document.descendants().find(|node| node.has_tag_name("CoSimulation")).unwrap();
        for (name, value) in [
            ("canHandleVariableCommunicationStepSize", "true"),
            ("canInterpolateInputs", "true"),
            ("maxOutputDerivativeOrder", "2"),
            ("providesDirectionalDerivative", "true"),
            ("canNotUseMemoryManagementFunctions", "true"),
        ] {
            assert_eq!(capabilities.attribute(name), Some(value), "{name}");
        }
    }
}

#[test]
fn parameters_are_fixed_and_events_are_discrete() {
    for variable in describe(SCENE).modelVariables {
        let expected = match (&variable.causality, variable.variableType.name()) {
            (Causality::Parameter | Causality::CalculatedParameter, _) => Variability::Fixed,
            (_, "Real") if !variable.name.ends_with("approach_velocity") => Variability::Continuous,
            _ => Variability::Discrete,
        };
        assert_eq!(variable.variability, expected, "{}", variable.name);
    }
}

#[test]
fn outputs_depend_at_once_on_the_force_on_their_own_floor_only() {
    let description = describe(SCENE);
    for unknown in &description.outputs {
        let name = &description.variable_by_index(unknown.index).unwrap().name;
        let known = unknown.dependencies.as_ref().unwrap_or_else(|| panic!("{name}: all dependencies"));
        let known = known.iter().map(|index| description.variable_by_index(*index).unwrap().name.clone());
        let expected = name.contains(".acceleration").then(|| name.replace("acceleration", "force"));
        let expected = expected.filter(|force| force != "ground.force").into_iter().collect::<Vec<_>>();
        assert_eq!(known.collect::<Vec<_>>(), expected, "{name}");
    }
}

#[test]
fn initial_unknowns_name_what_they_are_made_of() {
    let description = describe(SCENE);
    let known_of = |name: &str| {
        let index = u32::try_from(description.variable_index_by_name(name).unwrap()).unwrap();
        let position = [index, index + 1];
        let unknown = description.initialUnknowns.iter().find(|unknown| {
            position.contains(&unknown.index) && description.variable_by_index(unknown.index).unwrap().name == name
        });
        let known = unknown.unwrap().dependencies.clone().unwrap();
        known.iter().map(|index| description.variable_by_index(*index).unwrap().name.clone()).collect::<Vec<_>>()
    };
    let building = ["left.mass[1]", "left.stiffness[1]", "left.mass[2]", "left.stiffness[2]"];
    assert_eq!(known_of("left.frequency[2]"), building);
    assert_eq!(known_of("left.base_shear").len(), 5, "and the damping ratio");
    assert_eq!(known_of("right.displacement[1]"), [""; 0]);
    assert_eq!(known_of("contact[2].penetration"), ["contact[2].gap"]);
    assert_eq!(known_of("impacts"), ["contact[1].gap", "contact[2].gap"]);
    assert!(known_of("left.acceleration[2]").contains(&"contact[2].exponent".to_owned()));
    assert!(!known_of("left.acceleration[2]").contains(&"contact[1].restitution".to_owned()));
}

#[test]
fn units_have_their_dimensions_and_what_people_read() {
    let text = package(SCENE).model_description(FmiVersion::V2);
    let document = roxmltree::Document::parse(&text).unwrap();
    let unit = |name| document.descendants().find(|n| n.has_tag_name("Unit") && n.attribute("name") == Some(name));
    for (name, dimensions, display) in [
        ("1", [0, 0, 0], None),
        ("m", [0, 1, 0], Some(("mm", 1000.0))),
        ("m/s", [0, 1, -1], Some(("mm/s", 1000.0))),
        ("m/s2", [0, 1, -2], Some(("g", 1.0 / 9.80665))),
        ("Hz", [0, 0, -1], None),
        ("kg", [1, 0, 0], Some(("t", 0.001))),
        ("N", [1, 1, -2], Some(("kN", 0.001))),
        ("N.s", [1, 1, -1], Some(("kN.s", 0.001))),
        ("N/m", [1, 0, -2], Some(("kN/m", 0.001))),
        ("J", [1, 2, -2], Some(("kJ", 0.001))),
    ] {
        let children = unit(name).unwrap().children().filter(roxmltree::Node::is_element).collect::<Vec<_>>();
        let power = |base| children[0].attribute(base).map_or(0, |power| power.parse::<i32>().unwrap());
        assert_eq!(["kg", "m", "s"].map(power), dimensions, "{name}");
        assert!(children[0].has_tag_name("BaseUnit") && !children[0].has_attribute("factor"), "{name}");
        let shown = children.get(1).map(|shown| {
            (shown.attribute("name").unwrap(), shown.attribute("factor").unwrap().parse::<f64>().unwrap())
        });
        assert_eq!(shown, display, "{name}");
    }
    assert!(!unit("N/m^exponent").unwrap().has_children(), "no whole powers");
}

#[test]
fn the_default_experiment_ends_with_the_scene_or_with_the_record() {
    let stop = |scene: &str| describe(scene).defaultExperiment.unwrap().stopTime;
    assert_eq!(stop(SCENE).as_deref(), Some("4"));
    assert_eq!(stop(RECORD_SCENE).as_deref(), Some("2"));
    assert_eq!(stop(&RECORD_SCENE.replace("stop_time = 2.0", "")).as_deref(), Some("2"), "the record's last sample");
    assert_eq!(stop(NO_CONTACT), None);
    for scene in [SCENE, RECORD_SCENE, NO_CONTACT] {
        let experiment = describe(scene).defaultExperiment.unwrap();
        assert_eq!(experiment.startTime.as_deref(), Some("0"));
        assert_eq!(experiment.stepSize.as_deref(), Some("0.01"));
        assert_eq!(experiment.tolerance.as_deref(), Some("1e-12"));
    }
    let coarse = "[outputs]\nenergy = true\n[solver]\nrelative_tolerance = 1e-8";
    let tolerance = describe(&SCENE.replace("[outputs]\nenergy = true", coarse)).defaultExperiment.unwrap().tolerance;
    assert_eq!(tolerance.as_deref(), Some("1e-8"));
}

#[test]
fn the_guid_is_a_fingerprint() {
    let (package, guid) = (package(RECORD_SCENE), |package: &Package| package.guid(FmiVersion::V2));
    assert_eq!(guid(&package), guid(&package.clone()));
    assert!(package.model_description(FmiVersion::V2).contains(&guid(&package)));
    let mut commented = package.clone();
    commented.scene_text.push_str("# a remark");
    let mut other_record = package.clone();
    other_record.record.as_mut().unwrap().bytes.push(b'\n');
    let mut moved = package.clone();
    let last = moved.scene_text.pop().unwrap();
    moved.record.as_mut().unwrap().bytes.insert(0, last as u8);
    let guids = [&package, &commented, &other_record, &moved].map(guid);
    for (i, guid) in guids.iter().enumerate() {
        assert!(!guids[..i].contains(guid), "{guids:?}");
        assert_eq!((guid.len(), &guid[15..16]), (38, "5"), "a UUID of version 5");
    }
}

#[test]
fn text_that_xml_cannot_hold_does_not_break_it() {
    let mut package = package(NO_CONTACT);
    assert_eq!(describe(NO_CONTACT).description.as_deref(), Some("a < b & \"c\""));
    package.scene.description = "bell \u{7} and\nline <\u{fffe}>".to_owned();
    let description = ModelDescription::from_string(&package.model_description(FmiVersion::V2)).unwrap();
    assert_eq!(description.description.as_deref(), Some("bell   and line < >"));
}
