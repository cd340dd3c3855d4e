//! A scene with every kind of parameter, and the place of each parameter in it.

use toml::{Table, Value};

/// Every law that has a number of its own kind; all pairs meet within the second that the tests run.
pub const RICH: &str = r#"
name = "Rich"
stop_time = 1.0

[left]
mass = [3.65, 3.5]
stiffness = [2910.0, 2800.0]
damping = { ratio = 0.01 }
initial_displacement = [0.001, 0.002]
initial_velocity = [0.3, 0.5]

[right]
mass = [3.65, 3.6, 3.4]
stiffness = [2910.0, 2700.0, 2600.0]
damping = { ratio = 0.02 }
initial_displacement = [0.0005, 0.001, 0.002]
initial_velocity = [-0.1, -0.2, -0.3]

[ground]
record = "motion.csv"
scale = 1.2

[[contact]]
left_floor = 1
right_floor = 1
gap = 0.002
law = "kelvin_voigt"
stiffness = 1.0e6
restitution = 0.65

[[contact]]
left_floor = 2
right_floor = 2
gap = 0.003
law = "hertz_damped"
stiffness = 1.0e6
exponent = 1.4
restitution = 0.6
damping_formula = "exact"

[[contact]]
left_floor = 1
right_floor = 2
gap = 0.0025
law = "jankowski"
stiffness = 2.0e6
restitution = 0.7

[[contact]]
left_floor = 2
right_floor = 1
gap = 0.0035
law = "hertz"
stiffness = 1.5e6
exponent = 1.6

[[contact]]
left_floor = 1
right_floor = 3
gap = 0.003
law = "stereomechanical"
restitution = 0.5

[[contact]]
left_floor = 2
right_floor = 3
gap = 0.004
law = "kelvin_voigt_no_tension"
stiffness = 5.0e5
restitution = 0.55

[outputs]
energy = true

[solver]
relative_tolerance = 1e-12
"#;

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
    assert_eq!(scene.left.mass, [3.65, 7.0]);
    assert_eq!(scene.contacts[1].law.exponent, 2.5);
    assert_eq!(scene.right.damping, pounding::scene::Damping::Ratio(0.3));
}
