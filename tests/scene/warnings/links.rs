//! Links: what acts as a tie, and what never slips or always does.

use super::{OFFICES, edited, found, paths};

/// In t and kN.
const YIELDING: &str = include_str!("../../../examples/scenes/yielding.toml");
const AFTER: &str = "[[contact]]\nleft_floor = 1\n";
/// A damper and a friction damper as buildings have them, N/m, N s/m and N.
const LINK: &str = "[[link]]\nleft_floor = 3\nright_floor = 3\nstiffness = 5e6\ndashpot = 1.5e6\n";
const BRACE: &str = "[[link]]\nleft_floor = 3\nright_floor = 3\nstiffness = 30e6\nslip_force = 60e3\n";

/// The offices with a link.
fn linked(link: &str, changes: &[(&str, &str)]) -> String {
    edited(OFFICES, &[(AFTER, &format!("{}\n{AFTER}", edited(link, changes)))])
}

fn tell(text: &str, path: &str, words: &str) {
    let told = found(text, None);
    assert_eq!(paths(&told), [path], "{told:?}");
    assert!(told[0].text.contains(words), "{words:?} is not in {}", told[0]);
}

#[test]
fn springs_and_dashpots_that_are_ties() {
    tell(
        &linked(LINK, &[("= 5e6", "= 3.3e9")]),
        "link[1].stiffness",
        "11 times the stiffest storey, so it ties the buildings",
    );
    let wall = ("right_floor = 3", "wall = \"right\"");
    tell(&linked(LINK, &[("= 5e6", "= 3.3e9"), wall]), "link[1].stiffness", "ties the floor to the ground");
    tell(&linked(LINK, &[("1.5e6", "1.5e8")]), "link[1].dashpot", "times critical damping, so it ties the buildings");
    tell(&linked(LINK, &[("1.5e6", "1.5e9"), wall]), "link[1].dashpot", "so it ties the floor to the ground");
    let two = linked(LINK, &[("= 5e6", "= 3.3e9")]);
    let two = edited(&two, &[(AFTER, &format!("{}{AFTER}", edited(LINK, &[("= 5e6", "= 3.4e9")])))]);
    tell(&two, "link[1].stiffness", "(likewise link[2])");
}

/// Equal storeys that move against each other, with a dashpot c: c / (m w) of critical damping.
#[test]
fn the_damping_of_two_equal_storeys() {
    let scene = |dashpot: f64| {
        format!(
            "name = \"Pair\"\n\
             left = {{ mass = [2e5], stiffness = [8e7], damping = {{ ratio = 0.05 }} }}\n\
             right = {{ mass = [2e5], stiffness = [8e7], damping = {{ ratio = 0.05 }} }}\n\
             link = [{{ left_floor = 1, right_floor = 1, dashpot = {dashpot:?} }}]"
        )
    };
    // w = 20 /s, m w = 4e6 N s/m.
    assert_eq!(found(&scene(3.9e7), None), []);
    tell(&scene(4.4e7), "link[1].dashpot", " 11 times critical damping");
}

#[test]
fn springs_that_never_slip_or_always_do() {
    for (force, words) in [
        ("60e6", "13.4 times the weight of the lighter building: the spring will never slip"),
        ("29e6", "reached at a displacement of 0.967 m"),
        ("60", "the spring will slip in every motion and hold nothing; it is in N, was it given in kN?"),
    ] {
        tell(&linked(BRACE, &[("60e3", force)]), "link[1].slip_force", words);
    }
    let in_kn = "[[link]]\nleft_floor = 1\nright_floor = 1\nstiffness = 30e3\nslip_force = 60\n";
    let with = |force: &str| format!("{YIELDING}\n{}", edited(in_kn, &[("= 60", force)]));
    assert_eq!(found(&with("= 60"), None), []);
    tell(&with("= 60e3"), "link[1].slip_force", "it is in kN, was it given in N?");
    tell(&with("= 60e-3"), "link[1].slip_force", "will slip in every motion and hold nothing");
}

#[test]
fn sound_links() {
    for (link, changes) in [
        (LINK, &[][..]),
        (LINK, &[("= 5e6", "= 2.9e9")]),
        (LINK, &[("right_floor = 3", "wall = \"right\"")]),
        (LINK, &[("left_floor = 3", "wall = \"left\"")]),
        (LINK, &[("stiffness = 5e6\n", "")]),
        (LINK, &[("right_floor = 3", "right_floor = 2")]),
        (BRACE, &[]),
        // A brace is as stiff as one likes.
        (BRACE, &[("30e6", "30e9")]),
        (BRACE, &[("60e3", "600e3")]),
        (BRACE, &[("60e3", "6e3")]),
        // A thousandth of the weight of the lighter floor, less of the other.
        (BRACE, &[("60e3", "1.3e3")]),
    ] {
        assert_eq!(found(&linked(link, changes), None), [], "{changes:?}");
    }
}

/// A force beyond the reach of this ground motion, in a motion that has another start; one that a weak record does not reach,
/// which stands for the ground motion that it will be scaled to.
#[test]
fn slip_forces_that_another_motion_reaches() {
    let moving = ("stiffness = [141e6", "initial_velocity = [0.1, 0.2, 0.3]\nstiffness = [141e6");
    assert_eq!(found(&edited(&linked(BRACE, &[("60e3", "29e6")]), &[moving]), None), []);
    let weak = [("pga = 3.43", "pga = 0.6")];
    assert_eq!(found(&edited(&linked(BRACE, &[("30e6", "300e6"), ("60e3", "8e6")]), &weak), None), []);
    tell(
        &edited(&linked(BRACE, &[("30e6", "300e6"), ("60e3", "10e6")]), &weak),
        "link[1].slip_force",
        "2.23 times the weight of the lighter building",
    );
}

/// Masses in t, or a ground motion in g, make the link beside them look odd.
#[test]
fn what_is_odd_beside_a_link_is_told_alone() {
    let in_t = [("mass = [198e3, 198e3, 198e3, 198e3, 154e3]", "mass = [198, 198, 198, 198, 154]")];
    for force in ["60e3", "200e3"] {
        let told = found(&edited(&linked(BRACE, &[("60e3", force)]), &in_t), None);
        assert!(!told.is_empty() && told.iter().all(|warning| warning.path.starts_with("left.")), "{told:?}");
    }
    let in_g = edited(&linked(BRACE, &[("60e3", "60e6")]), &[("pga = 3.43", "pga = 0.35")]);
    assert_eq!(paths(&found(&in_g, None)), ["ground.pga"]);
}

#[test]
fn buildings_that_are_linked_need_no_contact() {
    let (before, _) = OFFICES.split_once("[[contact]]").unwrap();
    assert_eq!(paths(&found(before, None)), ["contact"]);
    assert_eq!(found(&format!("{before}{LINK}"), None), []);
    let wall = edited(LINK, &[("right_floor = 3", "wall = \"right\"")]);
    assert_eq!(paths(&found(&format!("{before}{wall}"), None)), ["contact"], "the buildings may still meet");
}
