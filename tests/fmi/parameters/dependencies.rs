//! The model structure of the description, against what the library does: an unknown changes with the knowns that it is
//! said to depend on, and with no others.

use crate::support::*;
use fmi::model_description::fmi2::{Causality, ModelDescription, ScalarVariable, Unknown};
use std::collections::{BTreeMap, BTreeSet};
use std::fs;

/// The knowns of each unknown.
pub type Structure = BTreeMap<String, BTreeSet<String>>;

pub fn declared(description: &ModelDescription, unknowns: &[Unknown]) -> Structure {
    let name = |index: u32| description.variable_by_index(index).unwrap().name.clone();
    let known = |unknown: &Unknown| unknown.dependencies.as_ref().unwrap().iter().map(|i| name(*i)).collect();
    unknowns.iter().map(|unknown| (name(unknown.index), known(unknown))).collect()
}

/// Every unknown as a number.
fn read(instance: &Instance<'_>, unknowns: &[&ScalarVariable]) -> Vec<f64> {
    let one = |variable: &&ScalarVariable| match variable.variableType.name() {
        "Real" => instance.real(&variable.name),
        "Integer" => f64::from(instance.integer(&variable.name)),
        _ => f64::from(instance.booleans(&[variable.valueReference]).unwrap()[0]),
    };
    unknowns.iter().map(one).collect()
}

/// More than the rounding of sums over modes.
fn differ(one: f64, other: f64) -> bool {
    one.is_finite() != other.is_finite() || (one - other).abs() > 1e-9 + 1e-10 * one.abs().max(other.abs())
}

/// Which unknowns change in initialization mode with which knowns, with the gaps open or closed to begin with.
pub fn seen_at_start(fmu: &Fmu, record: &str) -> Structure {
    let variables = &fmu.description.modelVariables;
    let of = |wanted: fn(&Causality) -> bool| variables.iter().filter(|v| wanted(&v.causality)).collect::<Vec<_>>();
    let unknowns = of(|c| matches!(c, Causality::Output | Causality::CalculatedParameter));
    let knowns = of(|c| matches!(c, Causality::Input | Causality::Parameter));
    let rigid = |name: &str| !variables.iter().any(|v| v.name == name.replace(".gap", ".stiffness"));
    let mut seen: Structure = unknowns.iter().map(|v| (v.name.clone(), BTreeSet::new())).collect();
    for gap in [0.05, -0.05] {
        let instance = fmu.instance();
        // Not at 0 s, where the record is 0.
        assert_eq!(instance.enter_from(0.3, None), OK);
        for known in knowns.iter().filter(|v| v.name.ends_with(".gap")) {
            let gap = if rigid(&known.name) { 0.01 } else { gap };
            assert_eq!(instance.set_real(&known.name, gap), OK, "{:?}", instance.log());
        }
        for input in knowns.iter().filter(|v| v.causality == Causality::Input) {
            assert_eq!(instance.set_real(&input.name, 0.7), OK);
        }
        let before = read(&instance, &unknowns);
        for known in &knowns {
            if known.name == "ground.record" {
                assert_eq!(instance.set_string(&known.name, record), OK);
            } else {
                let value = instance.real(&known.name);
                let changes: &[f64] = match known.name.rsplit('.').next().unwrap() {
                    // Floors that cannot overlap can at least touch.
                    "gap" if rigid(&known.name) => {
                        &[0.02, value + instance.real(&known.name.replace("gap", "penetration"))]
                    }
                    "gap" => &[-value, 1.5 * value],
                    "restitution" => &[0.45],
                    "exponent" => &[value + 0.2],
                    "relative_tolerance" => &[1e-6],
                    "position" => &[0.45],
                    name if name.starts_with("post_yield_ratio") => &[0.5 * value],
                    _ => &[1.0 + 1.3 * value],
                };
                let mut differs = vec![false; before.len()];
                for change in changes {
                    assert_eq!(instance.set_real(&known.name, *change), OK, "{:?}", instance.log());
                    let after = read(&instance, &unknowns);
                    differs.iter_mut().zip(before.iter().zip(&after)).for_each(|(d, (b, a))| *d |= differ(*b, *a));
                }
                assert_eq!(instance.set_real(&known.name, value), OK);
                note(&mut seen, &unknowns, &known.name, &differs);
                continue;
            }
            let after = read(&instance, &unknowns);
            let differs = before.iter().zip(&after).map(|(b, a)| differ(*b, *a)).collect::<Vec<_>>();
            assert_eq!(instance.set_string(&known.name, ""), OK);
            note(&mut seen, &unknowns, &known.name, &differs);
        }
        assert_eq!(read(&instance, &unknowns), before, "everything is back");
    }
    seen
}

fn note(seen: &mut Structure, unknowns: &[&ScalarVariable], known: &str, differs: &[bool]) {
    for (unknown, _) in unknowns.iter().zip(differs).filter(|(_, differs)| **differs) {
        seen.get_mut(&unknown.name).unwrap().insert(known.to_owned());
    }
}

pub fn compare(seen: &Structure, declared: &Structure) {
    let mut wrong = Vec::new();
    for (unknown, expected) in seen {
        let said = &declared[unknown];
        let (missing, idle) = (expected.difference(said), said.difference(expected));
        wrong.extend(missing.map(|known| format!("{unknown} depends on {known}, which is not declared")));
        wrong.extend(idle.map(|known| format!("{unknown} does not depend on {known}, as is declared")));
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
    assert_eq!(seen.len(), declared.len());
}

/// Gravity by the masses on one building, by given loads on the other.
fn leaning() -> String {
    let with = |scene: &str, stiffness: &str, keys: &str| {
        assert!(scene.contains(stiffness));
        scene.replace(stiffness, &format!("{stiffness}\nheight = [0.5, 0.4]\np_delta = {keys}"))
    };
    let left = with(YIELDING, "stiffness = [2910.0, 2000.0]", "true");
    with(&left, "stiffness = [2500.0, 2200.0]", "[false, true]\ngravity_load = [10.0, 400.0]")
}

/// The same with corrections of what the buildings resist with.
fn corrected(scene: &str) -> String {
    let inputs = "[inputs]\nrestoring_corrections = true\n";
    if scene.contains("[inputs]\n") { scene.replace("[inputs]\n", inputs) } else { format!("{scene}\n{inputs}") }
}

#[test]
fn initial_unknowns_depend_on_what_they_are_said_to_depend_on() {
    let at_rest = {
        let lines = RICH.lines().filter(|line| !line.starts_with("initial_"));
        lines.collect::<Vec<_>>().join("\n")
    };
    let only = |kind: &str| {
        let lines = RICH.lines().filter(|line| !line.starts_with("initial_") || line.starts_with(kind));
        lines.collect::<Vec<_>>().join("\n")
    };
    let leaning = leaning();
    let corrected = [SCENE, YIELDING, &at_rest].map(corrected);
    let [driven_and, yielding_and, at_rest_and] = corrected.each_ref();
    for scene in [
        driven_and,
        yielding_and,
        at_rest_and,
        RICH,
        SCENE,
        UNEVEN,
        YIELDING,
        LINKED,
        &leaning,
        &at_rest,
        &only("initial_velocity"),
        &only("initial_displacement"),
    ] {
        let fmu = Fmu::new(scene);
        let record = fmu.directory.path().join("other.csv");
        fs::write(&record, "time_s,accel_m_s2\n0.0,0.5\n1.0,0.0\n").unwrap();
        let seen = seen_at_start(&fmu, record.to_str().unwrap());
        compare(&seen, &declared(&fmu.description, &fmu.description.initialUnknowns));
    }
}

#[test]
fn outputs_answer_at_once_to_what_they_are_said_to_depend_on() {
    let rigid = SCENE.replace("law = \"hertz\"\nstiffness = 1.0e6", "law = \"stereomechanical\"\nrestitution = 0.0");
    assert_ne!(rigid, SCENE);
    let corrected = [SCENE, YIELDING, &rigid].map(corrected);
    let [driven_and, yielding_and, rigid_and] = corrected.each_ref();
    for scene in [SCENE, YIELDING, LINKED, &rigid, driven_and, yielding_and, rigid_and, CORRECTED] {
        let fmu = Fmu::new(scene);
        let instance = fmu.instance();
        let variables = &fmu.description.modelVariables;
        let outputs = variables.iter().filter(|v| v.causality == Causality::Output).collect::<Vec<_>>();
        let inputs = variables.iter().filter(|v| v.causality == Causality::Input).collect::<Vec<_>>();
        let mut seen: Structure = outputs.iter().map(|v| (v.name.clone(), BTreeSet::new())).collect();
        instance.start();
        // Pressed together, so that rigid floors are held as one before long.
        for (name, force) in [("left.force[2]", 400.0), ("right.force[2]", -400.0)] {
            assert_eq!(instance.set_real(name, force), OK);
        }
        for k in 0..40 {
            assert_eq!(instance.step(f64::from(k) * 0.05, 0.05), OK, "{:?}", instance.log());
            let before = read(&instance, &outputs);
            for input in &inputs {
                let value = instance.real(&input.name);
                assert_eq!(instance.set_real(&input.name, value + 1.5), OK);
                let after = read(&instance, &outputs);
                assert_eq!(instance.set_real(&input.name, value), OK);
                let differs = before.iter().zip(&after).map(|(b, a)| differ(*b, *a)).collect::<Vec<_>>();
                note(&mut seen, &outputs, &input.name, &differs);
            }
        }
        compare(&seen, &declared(&fmu.description, &fmu.description.outputs));
    }
}

/// Held against a wall a floor goes with the ground, and so does one that is held against columns on the ground.
#[test]
fn floors_that_are_held_by_the_ground_answer_to_it_at_once() {
    let building = |side: &str| format!("[{side}]\nmass = [3.0]\nstiffness = [400.0]\ndamping = {{ ratio = 0.05 }}\n");
    let law = "gap = 0.0\nlaw = \"stereomechanical\"\nrestitution = 0.0\n";
    for (meeting, held) in [
        ("left_floor = 1\nwall = \"right\"", &["left"][..]),
        ("left_floor = 1\nright_storey = 1\nright_position = 0.4", &["left", "right"]),
        ("left_floor = 1\nright_floor = 1", &[]),
    ] {
        let scene = format!(
            "name = \"Held\"\n{}{}[inputs]\nfloor_forces = true\n[[contact]]\n{meeting}\n{law}",
            building("left"),
            building("right")
        );
        let fmu = Fmu::new(&scene);
        let said = declared(&fmu.description, &fmu.description.outputs);
        for name in ["left.acceleration[1]", "right.acceleration[1]", "contact[1].force"] {
            let expected =
                held.iter().any(|side| name.starts_with(side)) || name.starts_with("contact") && !held.is_empty();
            assert_eq!(said[name].contains("ground.acceleration"), expected, "{name} with {meeting}");
        }
        let instance = fmu.instance();
        instance.start();
        for (name, force) in [("left.force[1]", 40.0), ("right.force[1]", -40.0)] {
            assert_eq!(instance.set_real(name, force), OK);
        }
        assert_eq!(instance.step(0.0, 0.2), OK, "{:?}", instance.log());
        let accelerations = ["left.acceleration[1]", "right.acceleration[1]"];
        let before = accelerations.map(|name| instance.real(name));
        let force = instance.real("contact[1].force");
        assert!(force > 1.0, "held: {force}");
        assert_eq!(instance.set_real("ground.acceleration", -1.5), OK);
        for (name, before) in accelerations.iter().zip(before) {
            let expected = held.iter().any(|side| name.starts_with(side));
            assert_eq!(differ(before, instance.real(name)), expected, "{name} with {meeting}");
        }
        assert_eq!(differ(force, instance.real("contact[1].force")), !held.is_empty(), "force with {meeting}");
    }
}

/// By which factor an output answers: 1/m is one that the parameters decide, a hold that may end is none.
#[test]
fn the_kind_of_a_dependence_is_fixed_where_no_contact_decides() {
    let rigid = SCENE.replace("law = \"hertz\"\nstiffness = 1.0e6", "law = \"stereomechanical\"\nrestitution = 0.0");
    for (scene, held) in [(SCENE, false), (&rigid, true)] {
        let text = crate::support::Fmu::new(scene).package.model_description(pounding::FmiVersion::V2);
        let document = roxmltree::Document::parse(&text).unwrap();
        let variables = document.descendants().filter(|n| n.has_tag_name("ScalarVariable")).collect::<Vec<_>>();
        let unknowns = |list: &str| {
            let list = document.descendants().find(|n| n.has_tag_name(list)).unwrap();
            list.children().filter(|n| n.is_element()).collect::<Vec<_>>()
        };
        for unknown in unknowns("Outputs") {
            let index = unknown.attribute("index").unwrap().parse::<usize>().unwrap();
            let name = variables[index - 1].attribute("name").unwrap();
            let is_held = held && matches!(name, "left.acceleration[2]" | "right.acceleration[2]");
            let is_fixed = name.contains(".acceleration[") && !is_held;
            assert_eq!(unknown.attribute("dependenciesKind"), is_fixed.then_some("fixed"), "{name}");
        }
        assert!(unknowns("InitialUnknowns").iter().all(|n| !n.has_attribute("dependenciesKind")));
    }
}
