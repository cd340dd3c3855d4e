//! Floors that are not level, and what is odd about the contacts of `[facing]`.

use crate::{found, paths};
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
fn what_is_odd_about_facing_is_told_there() {
    let text = uneven("[3.0, 3.0, 3.0]", "[3.6, 3.6, 3.6]", "[facing]").replace("gap = 0.04", "gap = 40.0");
    let scene = Scene::from_toml(&text).unwrap();
    let found = warnings::of_file(&scene, None);
    assert_eq!(paths(&found), ["facing.gap"]);
    assert!(!found[0].text.contains("likewise"), "{}", found[0]);
}
