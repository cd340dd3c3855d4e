//! Floors that are not level, and what is odd about the contacts of `[facing]`.

use super::{found, paths};
use pounding::scene::Scene;
use pounding::warnings;

/// The frames of two offices, 3 m a storey beside 3.6 m, with these contacts.
fn uneven(left: &str, right: &str, contacts: &str) -> String {
    let building = |heights: &str| {
        format!(
            "mass = [2e5, 2e5, 2e5]\nstiffness = [3e8, 3e8, 3e8]\ndamping = {{ ratio = 0.05 }}\nheight = {heights}\n"
        )
    };
    let law = "gap = 0.04\nlaw = \"linear\"\nstiffness = 1e9\n";
    let contacts: String = contacts.split('|').map(|meeting| format!("{meeting}\n{law}")).collect();
    format!("name = \"Uneven\"\n[left]\n{}[right]\n{}{contacts}", building(left), building(right))
}

#[test]
fn floors_that_are_not_level() {
    let (left, right) = ("[3.0, 3.0, 3.0]", "[3.6, 3.6, 3.6]");
    let told = |text: &str| found(text, None).iter().map(ToString::to_string).collect::<Vec<_>>();
    let floors = uneven(left, right, "[[contact]]\nleft_floor = 2\nright_floor = 2");
    assert_eq!(
        told(&floors),
        [
            "contact[1].right_floor = 2: level 7.2 m, meets left floor 2 at 6 m, where it is not; was storey 2 meant, whose \
          columns it hits at 0.666667?"
        ]
    );
    let columns = |at: &str| {
        uneven(left, right, &format!("[[contact]]\nleft_floor = 2\nright_storey = 2\nright_position = {at}"))
    };
    assert_eq!(told(&columns("0.68")), [""; 0], "within the tolerance of 0.1 m");
    assert_eq!(
        told(&columns("0.5")),
        [
            "contact[1].right_position = 0.5: there the columns of right storey 2 are at 5.4 m, and left floor 2 is at 6 m; was \
          storey 2 meant, whose columns it hits at 0.666667?"
        ]
    );
    let level = uneven(
        left,
        "[3.05, 3.05, 3.0]",
        "[[contact]]\nleft_floor = 1\nright_floor = 1|[[contact]]\nleft_floor = 2\nright_floor = 2",
    );
    assert_eq!(told(&level), [""; 0], "5 and 10 cm apart");
    assert_eq!(told(&uneven(left, right, "[facing]")), [""; 0]);
    let slope = uneven(left, "[3.6, 3.6, 3.6]\nbase_level = 4.0", "[facing]");
    assert_eq!(
        told(&slope),
        [
            "right.base_level = 4.0: left floor 1, at 3 m, is not above the ground floor of the other building, at 4 m, and meets \
          nothing; what stands before it there may need a contact with a wall"
        ]
    );
    let millimetres = uneven("[3000.0, 3000.0, 3000.0]", right, "[[contact]]\nleft_floor = 1\nright_floor = 1");
    assert_eq!(
        told(&millimetres),
        ["left.height[1] = 3000.0: storeys are 2 to 6 m high; heights are in m, was it given in mm (3 m)?"]
    );
}

#[test]
fn buildings_that_do_not_face_each_other() {
    let heights = "[3.6, 3.6, 3.6]";
    let told = |left: &str, right: &str| {
        let scene =
            Scene::from_toml(&uneven(&format!("[3.0, 3.0, 3.0]{left}"), &format!("{heights}{right}"), "[facing]"));
        warnings::of_file(&scene.unwrap(), None).iter().map(ToString::to_string).collect::<Vec<_>>()
    };
    let base = |level: &str| format!("\nbase_level = {level}");
    assert_eq!(
        told(&base("-5.0"), &base("6.0")),
        [
            "right.base_level = 6.0: the right building goes from 6 m to 16.8 m and the other one from -5 m to 4 m: no floor \
          faces anything, so there is no contact and they pass through each other; is its sign right, was -6 m meant?"
        ]
    );
    for (left, right, path, words) in [
        ("", "-12.0", "right.base_level = -12.0", "are both levels from the same zero?"),
        ("100.0", "-105.0", "right.base_level = -105.0", "was 105 m meant?"),
        ("1500.0", "", "left.base_level = 1500.0", "given in mm (1.5 m)?"),
        ("", "-300.0", "right.base_level = -300.0", "given in cm (-3 m)?"),
        ("312.0", "", "left.base_level = 312.0", "in cm (3.12 m)?"),
    ] {
        let of = |level: &str| if level.is_empty() { String::new() } else { base(level) };
        let told = told(&of(left), &of(right));
        assert_eq!(told.len(), 1, "{told:?}");
        assert!(told[0].starts_with(path) && told[0].contains(words), "{told:?}");
    }
    for (left, right) in [("-2.0", "2.0"), ("0.0", "-6.0"), ("110.0", "108.5")] {
        let told = told(&base(left), &base(right));
        assert!(!told.iter().any(|text| text.contains("no floor faces anything")), "{told:?}");
    }
}

#[test]
fn a_tolerance_beyond_a_storey() {
    for (tolerance, expected) in [("0.0", 0), ("0.1", 0), ("0.5", 0), ("1.5", 0), ("1.6", 1), ("10", 1), ("100", 1)] {
        let facing = format!("[facing]\nlevel_tolerance = {tolerance}");
        let scene = Scene::from_toml(&uneven("[3.0, 3.0, 3.0]", "[3.6, 3.6, 3.6]", &facing)).unwrap();
        let told = warnings::of_file(&scene, None);
        assert_eq!(paths(&told), vec!["facing.level_tolerance"; expected], "{tolerance}: {told:?}");
    }
    // Storeys of laboratory frames are lower than twice the default. Gravity matters in those that are soft.
    let scene = Scene::from_toml(&uneven("[0.15, 0.15, 0.15]", "[0.18, 0.18, 0.18]", "[facing]")).unwrap();
    assert_eq!(paths(&warnings::of_file(&scene, None)), ["left.p_delta", "right.p_delta"]);
}

#[test]
fn what_is_odd_about_facing_is_told_there() {
    let text = uneven("[3.0, 3.0, 3.0]", "[3.6, 3.6, 3.6]", "[facing]").replace("gap = 0.04", "gap = 40.0");
    let scene = Scene::from_toml(&text).unwrap();
    let found = warnings::of_file(&scene, None);
    assert_eq!(paths(&found), ["facing.gap"]);
    assert!(!found[0].text.contains("likewise"), "{}", found[0]);
}
