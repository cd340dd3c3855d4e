//! Foundations: the values that they say, and what is refused of them.

use crate::messages;
use pounding::scene::{BuildingId, Foundation, Place, Scene, Soil};

/// A building in N and kg, which needs 3.65 MN m/rad to stand under gravity.
fn building(keys: &str, foundation: &str) -> String {
    format!(
        "name = \"Soil\"\n[left]\nmass = [4e4, 3e4]\nheight = [4.0, 3.0]\nstiffness = [3e7, 2e7]\ndamping = {{ ratio = 0.05 }}\n\
         {keys}\n[left.foundation]\n{foundation}"
    )
}

const BOTH: &str =
    "mass = 3e4\ninertia = 3e5\nsway = { stiffness = 9e7, dashpot = 1.5e6 }\nrocking = { stiffness = 1.2e9 }";

fn refused(keys: &str, foundation: &str, expected: &[&str]) {
    assert_eq!(messages(&building(keys, foundation)), expected, "{keys} {foundation}");
}

#[test]
fn all_that_a_foundation_says() {
    let scene = Scene::from_toml(&building("", BOTH)).unwrap();
    let sway = Some(Soil { stiffness: 9e7, dashpot: 1.5e6 });
    let both = Foundation { mass: 3e4, inertia: 3e5, sway, rocking: Some(Soil { stiffness: 1.2e9, dashpot: 0.0 }) };
    assert_eq!(scene.buildings[0].foundation, Some(both.clone()));
    assert_eq!(scene.buildings.len(), 1);
    let sway_alone =
        Scene::from_toml(&building("", "mass = 3e4\nsway = { stiffness = 9e7, dashpot = 1.5e6 }")).unwrap();
    assert_eq!(sway_alone.buildings[0].foundation, Some(Foundation { inertia: 0.0, rocking: None, ..both.clone() }));
    let tonnes = "name = \"Soil\"\nunits = \"kN-t\"\n[left]\nmass = [40, 30]\nheight = [4.0, 3.0]\nstiffness = [3e4, 2e4]\n\
                  damping = { ratio = 0.05 }\n[left.foundation]\nmass = 30\ninertia = 300\n\
                  sway = { stiffness = 9e4, dashpot = 1.5e3 }\nrocking = { stiffness = 1.2e6 }";
    assert_eq!(Scene::from_toml(tonnes).unwrap().buildings[0].foundation, Some(both));
    let linked = building("", BOTH) + "\n[[link]]\nleft_floor = 0\nwall = \"right\"\ndashpot = 1e5";
    assert_eq!(Scene::from_toml(&linked).unwrap().links[0].left, Some((BuildingId::LEFT, Place::Foundation)));
}

#[test]
fn values_and_keys() {
    for (from, to, expected) in [
        ("mass = 3e4", "mass = 0.0", "left.foundation.mass = 0.0: expected a finite mass > 0 kg"),
        ("mass = 3e4\n", "", "left.foundation.mass: expected the mass of the foundation in kg (missing)"),
        (
            "inertia = 3e5",
            "inertia = -1",
            "left.foundation.inertia = -1.0: expected a finite moment of inertia > 0 kg m2",
        ),
        (
            "inertia = 3e5\n",
            "",
            "left.foundation.inertia: expected the moment of inertia in kg m2 of what rocks, foundation and floors (missing)",
        ),
        ("= 9e7", "= 0", "left.foundation.sway.stiffness = 0.0: expected a finite stiffness > 0 N/m"),
        ("= 1.5e6", "= -2", "left.foundation.sway.dashpot = -2.0: expected a finite dashpot >= 0 N s/m"),
        ("= 1.2e9", "= -3", "left.foundation.rocking.stiffness = -3.0: expected a finite stiffness > 0 N m/rad"),
        (
            "stiffness = 1.2e9",
            "stiffness = 1.2e9, dashpot = -4",
            "left.foundation.rocking.dashpot = -4.0: expected a finite dashpot >= 0 N m s/rad",
        ),
        ("stiffness = 1.2e9", "", "left.foundation.rocking.stiffness: expected that of the soil in N m/rad (missing)"),
        (
            "rocking = { stiffness = 1.2e9 }",
            "",
            "left.foundation.inertia = 3e5: expected rocking as well: a foundation that does not rock turns no inertia",
        ),
        (
            "rocking",
            "roking",
            "left.foundation.roking = { stiffness = 1.2e9 }: expected a known key (mass, inertia, sway, rocking); did you mean \
             rocking?",
        ),
    ] {
        let told = messages(&building("", &BOTH.replacen(from, to, 1)));
        assert!(told.contains(&expected.to_owned()), "{from} -> {to}: {told:?}");
    }
    refused(
        "",
        "mass = 3e4",
        &[
            "left.foundation: expected sway, rocking or both: the springs and dashpots of the soil, without which it is a \
             fixed base",
        ],
    );
}

#[test]
fn buildings_that_have_none() {
    let no_height = building("", BOTH).replacen("height = [4.0, 3.0]\n", "", 1);
    let expected = "left.foundation: expected height as well, the heights of the storeys that lean with the foundation";
    assert_eq!(messages(&no_height), [expected]);
    let matrix =
        building("", BOTH).replacen("stiffness = [3e7, 2e7]", "stiffness_matrix = [[5e7, -2e7], [-2e7, 2e7]]", 1);
    let expected = "left.foundation: expected a shear building, with stiffness instead of stiffness_matrix: its storeys lean \
                    with the foundation";
    assert_eq!(messages(&matrix), [expected]);
}

#[test]
fn soil_on_which_gravity_pushes_the_building_over() {
    // P h / (1 - theta) of both storeys, by hand.
    let weights = [7e4 * 9.80665, 3e4 * 9.80665];
    let least: f64 =
        [(0, 4.0, 3e7), (1, 3.0, 2e7)].map(|(i, h, k)| weights[i] * h / (1.0 - weights[i] / h / k)).iter().sum();
    for (factor, stands) in [(1.0 + 1e-9, true), (1.0 - 1e-9, false)] {
        let foundation = BOTH.replacen("1.2e9", &format!("{:?}", factor * least), 1);
        let scene = Scene::from_toml(&building("p_delta = true", &foundation));
        assert_eq!(scene.is_ok(), stands, "{factor}");
        if let Ok(scene) = scene {
            assert!(pounding::engine::Model::new(&scene, None).is_ok());
        }
    }
    refused(
        "p_delta = true",
        &BOTH.replacen("1.2e9", "3e6", 1),
        &[
            "left.foundation: expected a building that stands: the soil's stiffness against rocking, 3000000.0 N m/rad, is not \
           above 3648610.0 N m/rad, with which gravity pushes it over",
        ],
    );
}

#[test]
fn floor_0() {
    let link =
        |foundation: &str| building("", foundation) + "\n[[link]]\nleft_floor = 0\nwall = \"right\"\ndashpot = 1e5";
    let rocks = "mass = 3e4\ninertia = 3e5\nrocking = { stiffness = 1.2e9 }";
    let expected = "link[1].left_floor = 0: expected a floor of the left building, counted from 1; 0 is the foundation, and that of \
                    the building does not sway";
    assert_eq!(messages(&link(rocks)), [expected]);
    let contact = "\n[[contact]]\nleft_floor = 0\nwall = \"right\"\ngap = 0.1\nlaw = \"linear\"\nstiffness = 1e8";
    let told = messages(&(building("", BOTH) + contact));
    assert_eq!(told, ["contact[1].left_floor = 0: expected a floor of the left building, from 1 to 2"]);
}
