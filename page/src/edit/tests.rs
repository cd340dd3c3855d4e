#![allow(clippy::unwrap_used)]
use super::edited;
use serde_json::{Value, json};

const SCENE: &str = r#"# Two frames.
name = "Two"   # a name
[left]
mass = [3.65, 3.65]  # kg
stiffness = [
  2910.0,  # lower
  1000,
]
damping = { ratio = 0.01 }
[right]
mass = [1.0]
stiffness = [500.0]
damping = { ratios = [0.02] }

# The lower floors.
[[contact]]
left_floor = 1
right_floor = 1
gap = 0.005      # m
law = "kelvin_voigt"
stiffness = 1.0e6
restitution = 0.5

[outputs]
energy = true
"#;

fn after(path: &str, value: Value) -> String {
    edited(SCENE.as_bytes(), &[(path.to_owned(), value)]).unwrap()
}

/// The text with each of these pieces replaced.
fn with(pieces: &[(&str, &str)]) -> String {
    pieces.iter().fold(SCENE.to_owned(), |text, (old, new)| {
        assert_eq!(text.matches(old).count(), 1, "{old}");
        text.replace(old, new)
    })
}

#[test]
fn a_value_changes_and_nothing_else() {
    for (path, value, old, new) in [
        ("contact[1].gap", json!(0.02), "gap = 0.005 ", "gap = 0.02 "),
        ("contact[*].gap", json!(2e-7), "gap = 0.005 ", "gap = 2e-7 "),
        ("contact[1].left_floor", json!(2), "left_floor = 1", "left_floor = 2"),
        ("name", json!("One \"x\""), "\"Two\" ", "'One \"x\"' "),
        ("left.mass[2]", json!(7), "[3.65, 3.65]", "[3.65, 7.0]"),
        ("left.stiffness[2]", json!(2e6), "  1000,", "  2000000,"),
        ("left.damping.ratio", json!(0.05), "ratio = 0.01", "ratio = 0.05"),
        ("outputs.energy", json!(false), "energy = true", "energy = false"),
    ] {
        assert_eq!(after(path, value), with(&[(old, new)]), "{path}");
    }
}

#[test]
fn what_is_not_there_is_added_and_null_takes_away() {
    assert_eq!(after("outputs.peaks", json!(true)), format!("{SCENE}peaks = true\n"));
    let with_ground = after("ground.scale", json!(2.5));
    assert!(with_ground.contains("[ground]\nscale = 2.5\n"), "{with_ground}");
    assert_eq!(after("contact[1].restitution", json!(null)), with(&[("restitution = 0.5\n", "")]));
}

#[test]
fn what_cannot_be_done_is_said() {
    for (path, value, said) in [
        ("contact[2].gap", json!(1.0), "expected the path of something that the scene has"),
        ("contact.gap", json!(1.0), "expected the path of something that the scene has"),
        ("contact[0].gap", json!(1.0), "expected a path such as contact[1].gap"),
        ("left", json!(1.0), "expected a value there, not a table"),
        ("contact[1].law", json!("rubber"), "expected a law"),
        ("left.storeys", json!(0), "expected a whole number from 1 to 100"),
        ("up.storeys", json!(2), "expected the path of something that the scene has"),
    ] {
        let refusal = edited(SCENE.as_bytes(), &[(path.to_owned(), value.clone())]).unwrap_err();
        assert!(refusal.problems[0].starts_with(&format!("{path} = {value}: {said}")), "{refusal:?}");
    }
    assert!(edited(b"name = ", &[]).unwrap_err().problems[0].starts_with("line 1, column 8"));
    assert!(edited(b"\xff", &[]).is_err());
}

#[test]
fn a_law_comes_with_its_numbers() {
    // k d = k' d^1.5 at d = 1 / 900 m: both push alike there.
    let hertz = [("kelvin_voigt", "hertz"), ("1.0e6", "3e7"), ("restitution = 0.5\n", "")];
    assert_eq!(after("contact[1].law", json!("hertz")), with(&hertz));
    let back = edited(with(&hertz).as_bytes(), &[("contact[1].law".to_owned(), json!("linear"))]).unwrap();
    assert!(back.contains("law = \"linear\"\nstiffness = 1e6\n"), "{back}");
    assert_eq!(
        after("contact[*].law", json!("stereomechanical")),
        with(&[("kelvin_voigt", "stereomechanical"), ("stiffness = 1.0e6\n", "")])
    );
    // 300 times the stiffest storey, where there was no stiffness.
    let rigid = after("contact[*].law", json!("stereomechanical"));
    let soft = edited(rigid.as_bytes(), &[("contact[*].law".to_owned(), json!("linear"))]).unwrap();
    assert!(soft.contains("law = \"linear\"\nstiffness = 8.73e5\n"), "{soft}");
    for kind in pounding::contact::LawKind::ALL {
        let text = after("contact[1].law", json!(kind.info().name));
        assert!(pounding::scene::Scene::from_toml(&text).is_ok(), "{text}");
    }
}

#[test]
fn a_building_grows_and_shrinks() {
    let grown = with(&[
        ("mass = [1.0]", "mass = [1.0, 1.0]"),
        ("stiffness = [500.0]", "stiffness = [500.0, 500.0]"),
        ("[0.02]", "[0.02, 0.02]"),
        (
            "restitution = 0.5\n",
            "restitution = 0.5\n\n[[contact]]\nleft_floor = 2\nright_floor = 2\ngap = 0.005      # m\n\
            law = \"kelvin_voigt\"\nstiffness = 1.0e6\nrestitution = 0.5\n",
        ),
    ]);
    assert_eq!(after("right.storeys", json!(2)), grown);
    assert!(pounding::scene::Scene::from_toml(&grown).is_ok());
    let shrunk = edited(grown.as_bytes(), &[("right.storeys".to_owned(), json!(1))]).unwrap();
    assert_eq!(shrunk, SCENE);
    let left = after("left.storeys", json!(3));
    let scene = pounding::scene::Scene::from_toml(&left).unwrap();
    assert_eq!((scene.buildings[0].mass.len(), scene.contacts.len()), (3, 1));
    assert!(left.contains("\n  1000,\n  1000,\n]"), "{left}");
}

/// Three buildings of which each meets its neighbour, and the last one a wall.
const ROW: &str = r#"name = "Row"
[[building]]
name = "a"
mass = [1.0, 1.0]
stiffness = [500.0, 500.0]
damping = { ratio = 0.02 }
[[building]]
mass = [1.0]
stiffness = [900.0]
damping = { ratio = 0.02 }
[[building]]
name = "c"
mass = [1.0, 1.0]
stiffness = [500.0, 500.0]
damping = { ratio = 0.02 }

[[contact]]
left = "a"
right = "b2"
left_floor = 1
right_floor = 1
gap = 0.01
law = "stereomechanical"
restitution = 0.5

[[contact]]
left = "b2"
right = "c"
left_floor = 1
right_floor = 1
gap = 0.02
law = "stereomechanical"
restitution = 0.5

[[contact]]
left = "c"
left_floor = 2
wall = "right"
gap = 0.03
law = "stereomechanical"
restitution = 0.5
"#;

fn row_after(text: &str, path: &str, value: Value) -> (String, pounding::scene::Scene) {
    let text = edited(text.as_bytes(), &[(path.to_owned(), value)]).unwrap();
    let scene = pounding::scene::Scene::from_toml(&text).unwrap();
    (text, scene)
}

#[test]
fn a_building_of_a_row_meets_its_neighbours_on_both_sides() {
    let (grown, scene) = row_after(ROW, "building[2].storeys", json!(2));
    assert_eq!(scene.buildings.iter().map(|building| building.mass.len()).collect::<Vec<_>>(), [2, 2, 2]);
    assert_eq!(scene.contacts.iter().map(|pair| pair.gap).collect::<Vec<_>>(), [0.01, 0.01, 0.02, 0.02, 0.03]);
    assert_eq!(scene.contacts[3].meeting(&scene), "between b2 floor 2 and c floor 2");
    assert_eq!(row_after(&grown, "building[2].storeys", json!(1)).0, ROW);
    // The wall is before the second floor of the last one alone.
    let (_, scene) = row_after(ROW, "building[3].storeys", json!(1));
    assert_eq!(scene.contacts.iter().map(|pair| pair.gap).collect::<Vec<_>>(), [0.01, 0.02]);
    let (_, scene) = row_after(ROW, "building[1].storeys", json!(1));
    assert_eq!((scene.buildings[0].mass.len(), scene.contacts.len()), (1, 3));
    assert!(edited(ROW.as_bytes(), &[("left.storeys".to_owned(), json!(2))]).is_err());
    assert!(edited(ROW.as_bytes(), &[("building[4].storeys".to_owned(), json!(2))]).is_err());
}

#[test]
fn values_of_a_row_change_by_path() {
    let (_, scene) = row_after(ROW, "contact[*].gap", json!(0.5));
    assert!(scene.contacts.iter().all(|pair| pair.gap == 0.5));
    let (_, scene) = row_after(ROW, "building[2].mass[1]", json!(7));
    assert_eq!(scene.buildings[1].mass, [7.0]);
    // 300 times the stiffest storey, which the second building has.
    let (soft, _) = row_after(ROW, "contact[2].law", json!("linear"));
    assert!(soft.contains("law = \"linear\"\nstiffness = 2.7e5\n"), "{soft}");
}
