//! What is odd about a row of buildings.

use super::found;
use pounding::scene::{Damping, Scene};
use pounding::variables::Settings;
use pounding::warnings;

fn told(text: &str) -> Vec<String> {
    found(text, None).iter().map(ToString::to_string).collect()
}

/// A row of buildings of these names, with contacts between those that are named in pairs, at rest beside each other.
fn row(names: &[&str], pairs: &[[&str; 2]]) -> String {
    let building = |name: &&str| {
        format!(
            "[[building]]\nname = {name:?}\nmass = [2e5, 2e5]\nstiffness = [3e8, 3e8]\ndamping = {{ ratio = 0.05 }}\n\
             height = [3.0, 3.0]\n"
        )
    };
    let contact = |[left, right]: &[&str; 2]| {
        format!(
            "[[contact]]\nleft = {left:?}\nright = {right:?}\nleft_floor = 2\nright_floor = 2\ngap = 0.04\n\
             law = \"linear\"\nstiffness = 2e9\n"
        )
    };
    let (buildings, contacts): (String, String) =
        (names.iter().map(building).collect(), pairs.iter().map(contact).collect());
    format!("name = \"Row\"\n{buildings}{contacts}")
}

#[test]
fn names_that_differ_in_case_only() {
    assert_eq!(told(&row(&["a", "b"], &[["a", "b"]])), [""; 0]);
    assert_eq!(
        told(&row(&["Tower", "b", "tower"], &[["Tower", "b"], ["b", "tower"]])),
        [
            "building[3].name = \"tower\": differs from \"Tower\", building[1].name, in case only; is it another building?"
        ]
    );
}

#[test]
fn a_building_that_nothing_is_with() {
    assert_eq!(
        told(&row(&["a", "b", "c"], &[["a", "b"]])),
        [
            "building[3] = \"c\": no contact, wall or link is with it, where other buildings have some: its neighbours pass \
          through it"
        ]
    );
    let wall =
        "[[contact]]\nleft = \"c\"\nleft_floor = 1\nwall = \"right\"\ngap = 0.04\nlaw = \"linear\"\nstiffness = 2e9\n";
    assert_eq!(told(&(row(&["a", "b", "c"], &[["a", "b"]]) + wall)), [""; 0]);
}

/// Contacts of different gaps do not cross, and what is odd in a table stands at its path in the file.
#[test]
fn paths_of_a_row() {
    let text = row(&["a", "b", "c"], &[["a", "b"], ["b", "c"]]);
    let crossed = text.replacen("left_floor = 2", "left_floor = 1", 1).replacen("gap = 0.04", "gap = 0.0001", 1);
    let told = told(&crossed);
    assert!(told.iter().any(|warning| warning.starts_with("contact[1].gap = 0.0001: 1/400 of the gap")), "{told:?}");
    assert!(!told.iter().any(|warning| warning.contains("floors cannot be")), "{told:?}");
    let heavy = text.replacen("mass = [2e5, 2e5]", "mass = [200, 200]", 1);
    let told = self::told(&heavy);
    assert!(told.iter().any(|warning| warning.starts_with("building[1].mass")), "{told:?}");
}

#[test]
fn gaps_of_facing_stand_in_its_table() {
    let text = row(&["a", "b", "c"], &[])
        + "[facing]\ngap = [0.04, 3.0]\nlaw = \"linear\"\nstiffness = 2e9\n\
           [[contact]]\nleft = \"c\"\nleft_floor = 1\nwall = \"right\"\ngap = 4.0\nlaw = \"linear\"\nstiffness = 2e9\n";
    let scene = Scene::from_toml(&text).unwrap();
    let paths: Vec<String> = warnings::of_file(&scene, None).into_iter().map(|warning| warning.path).collect();
    assert_eq!(paths, ["facing.gap[2]"], "and likewise at the wall");
}

/// An FMU tells of its variables, whose names begin with that of a building.
#[test]
fn an_fmu_names_its_variables() {
    let mut settings = Settings::new(Scene::from_toml(&row(&["a", "b"], &[["a", "b"]])).unwrap(), None);
    settings.scene.buildings[1].damping = Damping::Ratio(5.0);
    let warnings: Vec<String> = settings.warnings().into_iter().map(|warning| warning.path).collect();
    assert_eq!(warnings, ["b.damping_ratio"]);
    settings.scene.buildings[0].mass[1] = -1.0;
    settings.scene.buildings[1].damping = Damping::Ratio(-1.0);
    let error = settings.check().unwrap_err();
    let problems: Vec<&str> = error.problems.iter().map(|problem| problem.path.as_str()).collect();
    assert_eq!(problems, ["a.mass[2]", "b.damping_ratio"]);
}
