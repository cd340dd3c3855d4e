//! The place of each parameter in the scene that has every kind.

use crate::support::RICH;
use toml::{Table, Value};

/// The rich scene with a number of it changed, as text.
pub fn edited(parameters: &[(&str, f64)]) -> String {
    let mut scene: Table = toml::from_str(RICH).unwrap();
    for (parameter, value) in parameters {
        *place(&mut scene, parameter) = Value::Float(*value);
    }
    toml::to_string(&scene).unwrap()
}

/// Where a user writes the number that a parameter is named after.
fn place<'s>(scene: &'s mut Table, parameter: &str) -> &'s mut Value {
    let (first, key) = parameter.split_once('.').unwrap();
    let table = match indexed(first) {
        ("contact", Some(p)) => &mut scene["contact"][p],
        (name @ ("left" | "right" | "ground" | "solver"), None) => &mut scene[name],
        _ => panic!("{parameter}: no such table"),
    };
    match indexed(key) {
        ("damping_ratio", None) => &mut table["damping"]["ratio"],
        (key, None) => &mut table[key],
        (key, Some(i)) => &mut table[key][i],
    }
}

/// The name and, counted from 0, the index of `name[i]`.
fn indexed(name: &str) -> (&str, Option<usize>) {
    match name.split_once('[') {
        None => (name, None),
        Some((name, index)) => (name, Some(index.trim_end_matches(']').parse::<usize>().unwrap() - 1)),
    }
}

#[test]
fn edits_land_where_they_should() {
    let scene = edited(&[("left.mass[2]", 7.0), ("contact[2].exponent", 2.5), ("right.damping_ratio", 0.3)]);
    let scene = pounding::scene::Scene::from_toml(&scene).unwrap();
    assert_eq!(scene.buildings[0].mass, [3.65, 7.0]);
    assert_eq!(scene.contacts[1].law.exponent, 2.5);
    assert_eq!(scene.buildings[1].damping, pounding::scene::Damping::Ratio(0.3));
}
