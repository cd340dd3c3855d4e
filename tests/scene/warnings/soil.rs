//! Foundations: soil that is none, or that lets a building swing far too slowly or not at all.

use super::{found, paths};

const SOUND: &str = "mass = 3e4\ninertia = 3e5\nsway = { stiffness = 9e7, dashpot = 1.5e6 }\nrocking = { stiffness = 1.2e9, dashpot = 4e6 }";

fn building(from: &str, to: &str) -> String {
    assert!(SOUND.contains(from));
    format!(
        "name = \"Soil\"\nstop_time = 5.0\ninputs = {{ floor_forces = true }}\n[left]\nmass = [4e4, 3e4]\nheight = [4.0, 3.0]\n\
         stiffness = [3e7, 2e7]\ndamping = {{ ratio = 0.05 }}\n[left.foundation]\n{}",
        SOUND.replacen(from, to, 1)
    )
}

fn tell(from: &str, to: &str, path: &str, words: &str) {
    let told = found(&building(from, to), None);
    assert_eq!(paths(&told), [path], "{told:?}");
    assert!(told[0].text.contains(words), "{words:?} is not in {}", told[0]);
}

#[test]
fn foundations_as_buildings_have_them() {
    assert_eq!(found(&building("mass", "mass"), None), []);
}

#[test]
fn springs_of_another_unit() {
    tell("9e7", "9e4", "left.foundation.sway.stiffness", "it is in N/m, was it given in kN/m?");
    tell("1.2e9", "1.2e6", "left.foundation.rocking.stiffness", "it is in N m/rad, was it given in kN m/rad?");
    let rock = building("9e7", "9e12").replacen("1.2e9", "1.2e14", 1);
    let told = found(&rock, None);
    assert_eq!(paths(&told), ["left.foundation.rocking.stiffness"], "{told:?}");
    assert!(told[0].text.starts_with("hardly any soil: the first period is 1.000"), "{}", told[0]);
}

#[test]
fn dashpots_and_inertia() {
    // 2 sqrt(9e7 x 1e5) = 6e6 N s/m.
    tell("1.5e6", "1.2e7", "left.foundation.sway.dashpot", "2 times critical damping of the building as it sways");
    assert_eq!(found(&building("1.5e6", "5.9e6"), None), []);
    // 2 sqrt(1.2e9 (3e5 + 4e4 x 16 + 3e4 x 49)) = 1.07e8 N m s/rad.
    tell("4e6", "4.29e8", "left.foundation.rocking.dashpot", "3.99 times critical damping of the building as it rocks");
    tell("3e5", "2.9", "left.foundation.inertia", "at 0.00983 m from its centre");
    tell("3e5", "3.3e8", "left.foundation.inertia", "at 105 m from its centre");
}

#[test]
fn a_foundation_that_only_sways_has_no_inertia_to_look_at() {
    let (sway, _) = SOUND.split_once("\nrocking").unwrap();
    let scene = building("mass", "mass").replace(SOUND, &sway.replace("inertia = 3e5\n", ""));
    assert!(!scene.contains("rocking") && !scene.contains("inertia"));
    assert_eq!(found(&scene, None), []);
}

/// The same building in t and kN.
#[test]
fn springs_in_newtons_where_kilonewtons_are_meant() {
    let mut scene = format!("units = \"kN-t\"\n{}", building("mass", "mass"));
    let edits =
        [("[4e4, 3e4]", "[40, 30]"), ("[3e7, 2e7]", "[3e4, 2e4]"), ("mass = 3e4", "mass = 30"), ("= 3e5", "= 300")];
    let soil = [("9e7", "9e4"), ("1.5e6", "1.5e3"), ("1.2e9", "1.2e6"), ("4e6", "4e3")];
    for (from, to) in edits.into_iter().chain(soil) {
        assert_eq!(scene.matches(from).count(), 1, "{from}");
        scene = scene.replace(from, to);
    }
    assert_eq!(found(&scene, None), []);
    let told = found(&scene.replace("9e4", "9e7").replace("1.2e6", "1.2e9"), None);
    assert_eq!(paths(&told), ["left.foundation.rocking.stiffness"], "{told:?}");
    assert!(told[0].text.contains("it is in kN m/rad, was it given in N m/rad?"), "{}", told[0]);
}

/// Of a building whose storeys are in other units than its soil, the building alone is told of.
#[test]
fn the_soil_of_a_building_in_other_units() {
    let told = found(&building("mass", "mass").replace("[3e7, 2e7]", "[3e4, 2e4]"), None);
    assert_eq!(paths(&told), ["left.stiffness"], "{told:?}");
}
