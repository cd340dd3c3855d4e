//! `outputs.numbers_only`: an FMU that has numbers alone, beside that of the same scene without the key.

use crate::support::scenes::numbers_only;
use crate::support::*;
use pounding::FmiVersion;
use pounding::variables::{Row, Type, Unit, Variability};
use std::collections::BTreeMap;

const SCENES: [&str; 7] = [SCENE, RECORD_SCENE, UNEVEN, YIELDING, LINKED, CORRECTED, COLLAPSE];

/// What each variable is, by its name.
fn by_name(fmu: &Fmu) -> BTreeMap<&str, (u32, &Row)> {
    fmu.table.iter().map(|(reference, row)| (row.name.as_str(), (reference, row))).collect()
}

#[test]
fn counts_and_flags_are_numbers_and_there_is_no_text() {
    for scene in SCENES {
        let (all, numbers) = (Fmu::new(scene), Fmu::new(&numbers_only(scene)));
        let (all, numbers) = (by_name(&all), by_name(&numbers));
        let mut converted = 0;
        for (name, (_, row)) in &all {
            let Some((_, number)) = numbers.get(name) else {
                assert_eq!(*name, "ground.record");
                continue;
            };
            let limits = match row.ty {
                Type::Boolean => (Some(0.0), Some(1.0)),
                _ => (row.min, row.max),
            };
            let is_real = matches!(row.ty, Type::Real(_));
            let ty = if is_real { row.ty } else { Type::Real(Unit::One) };
            assert_eq!((number.ty, number.min, number.max), (ty, limits.0, limits.1), "{name}");
            assert_eq!((number.slot, number.variability), (row.slot, row.variability), "{name}");
            assert!(is_real || number.variability == Variability::Discrete, "{name}");
            converted += usize::from(!is_real);
        }
        let has_record = all.contains_key("ground.record");
        assert_eq!(numbers.len(), all.len() - usize::from(has_record));
        assert!(converted > 0, "{scene}");
    }
}

/// That of the last parameter alone changes where the text before it goes.
#[test]
fn value_references_are_those_of_the_scene_without_the_key() {
    for scene in SCENES {
        let (all, numbers) = (Fmu::new(scene), Fmu::new(&numbers_only(scene)));
        let (all, numbers) = (by_name(&all), by_name(&numbers));
        let differ = numbers.iter().filter(|(name, (reference, _))| all[*name].0 != *reference).map(|(name, _)| *name);
        let expected = if scene == RECORD_SCENE { vec!["solver.relative_tolerance"] } else { Vec::new() };
        assert_eq!(differ.collect::<Vec<_>>(), expected);
    }
}

#[test]
fn the_description_has_no_other_type_and_derivatives_of_order_1() {
    for scene in SCENES {
        let package = scenes::package(&numbers_only(scene));
        for (version, of_variables, number) in
            [(FmiVersion::V2, "ScalarVariable", "Real"), (FmiVersion::V3, "ModelVariables", "Float64")]
        {
            let text = package.model_description(version);
            let document = roxmltree::Document::parse(&text).unwrap();
            let parents = document.descendants().filter(|node| node.has_tag_name(of_variables));
            let children = parents.flat_map(|node| node.children()).filter(roxmltree::Node::is_element);
            let types: Vec<&str> = children.map(|node| node.tag_name().name()).collect();
            assert!(types.len() > 10 && types.iter().all(|ty| *ty == number), "{types:?}");
            let co_simulation = document.descendants().find(|node| node.has_tag_name("CoSimulation")).unwrap();
            assert_eq!(co_simulation.attribute("maxOutputDerivativeOrder"), Some("1"));
        }
    }
}

/// What all outputs are at a point, as numbers.
fn outputs(instance: &Instance<'_>) -> Vec<(String, f64)> {
    let outputs = instance.fmu.table.rows.iter().filter(|row| matches!(row.slot, pounding::variables::Slot::Output(_)));
    let value = |row: &Row| match row.ty {
        Type::Integer => f64::from(instance.integer(&row.name)),
        Type::Boolean => f64::from(instance.boolean(&row.name)),
        _ => instance.real(&row.name),
    };
    outputs.map(|row| (row.name.clone(), value(row))).collect()
}

#[test]
fn a_run_has_the_same_numbers() {
    for scene in [SCENE, RECORD_SCENE, YIELDING, LINKED] {
        for (all, numbers) in Fmu::both(scene).iter().zip(&Fmu::both(&numbers_only(scene))) {
            let (one, other) = (all.instance(), numbers.instance());
            one.start();
            other.start();
            let mut seen = 0;
            for k in 0..40 {
                for instance in [&one, &other] {
                    assert_eq!(instance.step(f64::from(k) * 0.05, 0.05), OK);
                }
                assert_eq!(outputs(&one), outputs(&other), "after step {k}");
                seen += one.discrete().into_iter().sum::<u64>();
            }
            assert!(seen > 0, "{scene}");
        }
    }
}

#[test]
fn counts_and_flags_wait_for_event_mode_as_ever() {
    let [all, numbers] = [SCENE.to_owned(), numbers_only(SCENE)].map(|scene| Fmu::v3(&scene));
    let (one, other) = (all.with_flags(true, false), numbers.with_flags(true, false));
    one.start();
    other.start();
    let mut events = 0;
    for k in 0..40 {
        let [first, second] = [&one, &other].map(|instance| instance.stepped(f64::from(k) * 0.05, 0.05));
        assert_eq!(first, second);
        assert_eq!(outputs(&one), outputs(&other), "after step {k}");
        if first.1.event == 1 {
            events += 1;
            assert!(events > 1 || other.real("impacts") == 0.0);
            one.handle();
            other.handle();
            assert!(other.real("impacts") > 0.0);
        }
    }
    assert!(events > 5);
}

#[test]
fn they_have_the_functions_of_numbers() {
    for fmu in Fmu::both(&numbers_only(SCENE)) {
        let instance = fmu.instance();
        instance.start();
        let (real, integer) = fmu.either(("Real", "Integer"), ("Float64", "Int32"));
        let vr = fmu.vr("impacts");
        assert_eq!(instance.integers(&[vr]), Err(ERROR));
        let expected = format!("impacts (value reference {vr}) is {real}, not {integer}");
        assert!(instance.only_error().ends_with(&expected));
    }
}

#[test]
fn derivatives_are_those_of_order_1() {
    for (fmu, all) in Fmu::both(&numbers_only(SCENE)).iter().zip(&Fmu::both(SCENE)) {
        let (instance, other) = (fmu.instance(), all.instance());
        for instance in [&instance, &other] {
            instance.start();
            assert_eq!(instance.step(0.0, 0.05), OK);
        }
        for name in ["left.velocity[2]", "contact[1].impulse"] {
            assert_eq!(instance.rate(name, 1), other.rate(name, 1));
            assert!(other.rate(name, 2).is_ok());
            assert_eq!(instance.rate(name, 2), Err(DISCARD));
            let expected = format!("{name}: derivative of order 2: expected order 1");
            assert!(instance.log().iter().any(|line| line.message.ends_with(&expected)));
        }
        for name in ["impacts", "contact[1].active"] {
            assert_eq!(instance.rate(name, 1), Ok(0.0), "{name} is constant between events");
            assert_eq!(instance.directional(&[fmu.vr(name)], &[fmu.vr("left.force[1]")], &[1.0]), Ok(vec![0.0]));
        }
    }
}
