//! Heights, and what meets what: floors, columns, walls, `[facing]`, one building alone.

use crate::messages;
use pounding::scene::{BuildingId, ColumnShape, ContactPair, Face, Scene};

const LAW: &str = "gap = 0.02\nlaw = \"linear\"\nstiffness = 1e8\n";

/// Two storeys of 3 m beside three of 4, 3 and 3 m.
fn scene(left: &str, right: &str, rest: &str) -> String {
    let building = |storeys: usize, more: &str| {
        let list = |number: &str| vec![number; storeys].join(", ");
        let (mass, stiffness) = (list("1e5"), list("1e8"));
        format!("mass = [{mass}]\nstiffness = [{stiffness}]\ndamping = {{ ratio = 0.05 }}\n{more}\n")
    };
    format!("name = \"Levels\"\n[left]\n{}[right]\n{}{rest}", building(2, left), building(3, right))
}

fn with_heights(rest: &str) -> String {
    scene("height = [3.0, 3.0]", "height = [4.0, 3.0, 3.0]", rest)
}

fn contact(meeting: &str) -> String {
    format!("[[contact]]\n{meeting}\n{LAW}")
}

/// What meets, in short.
fn briefs(text: &str) -> Vec<String> {
    let scene = Scene::from_toml(text).unwrap_or_else(|error| panic!("{error}"));
    scene.contacts.iter().map(|pair| pair.brief(&scene)).collect()
}

fn contacts(text: &str) -> Vec<ContactPair> {
    Scene::from_toml(text).unwrap_or_else(|error| panic!("{error}\n{text}")).contacts
}

#[test]
fn heights() {
    let said = |left: &str| messages(&scene(left, "", ""));
    assert_eq!(said("height = [3.0]"), ["left.height = [3.0]: expected 2 numbers, one per storey, not 1"]);
    assert_eq!(said("height = [3.0, 0.0]"), ["left.height[2] = 0.0: expected a finite height > 0 m"]);
    assert_eq!(said("height = [3.0, inf]"), ["left.height[2] = inf: expected a finite height > 0 m"]);
    assert_eq!(
        said("base_level = 1.0"),
        ["left.base_level = 1.0: expected height as well, the heights of the storeys above that level"]
    );
    assert_eq!(said("height = [3.0, 3.0]\nbase_level = nan"), ["left.base_level = nan: expected a finite level in m"]);
}

#[test]
fn columns() {
    let at = |meeting: &str| messages(&scene("", "", &contact(meeting)));
    let expected = "contact[1].right_position: expected where the columns are hit, 0 < s < 1 from the storey's lower end; only \
                    where both buildings have their height it may be left out (missing)";
    assert_eq!(at("left_floor = 1\nright_storey = 2"), [expected]);
    for (position, found) in [("0", "0.0"), ("1.0", "1.0"), ("-0.1", "-0.1"), ("nan", "nan")] {
        let said = at(&format!("left_floor = 1\nright_storey = 2\nright_position = {position}"));
        assert_eq!(said, [format!("contact[1].right_position = {found}: expected 0 < s < 1")]);
    }
    let cases = [
        (
            "left_floor = 1\nright_storey = 4\nright_position = 0.5",
            "contact[1].right_storey = 4: expected a storey of the right building, from 1 to 3",
        ),
        (
            "left_floor = 1\nright_floor = 1\nright_storey = 2\nright_position = 0.5",
            "contact[1].right_storey = 2: expected either right_floor or right_storey, not both",
        ),
        (
            "left_storey = 1\nleft_position = 0.5\nright_storey = 2\nright_position = 0.5",
            "contact[1].right_storey = 2: expected a floor on one side: the columns of two storeys do not reach each other",
        ),
        (
            "left_floor = 1\nright_floor = 1\nright_position = 0.5",
            "contact[1].right_position = 0.5: expected right_storey, whose columns are hit there, instead of right_floor",
        ),
        (
            "left_floor = 1\nright_floor = 1\ncolumn_shape = \"fixed\"",
            "contact[1].column_shape = \"fixed\": expected left_storey or right_storey, whose columns have a shape",
        ),
        (
            "left_floor = 1\nright_storey = 2\nright_position = 0.5\ncolumn_shape = \"fixd\"",
            "contact[1].column_shape = \"fixd\": expected a known shape (fixed, straight); did you mean fixed?",
        ),
        ("right_storey = 2\nright_position = 0.5", "contact[1].left_floor: expected a floor, counted from 1 (missing)"),
    ];
    for (meeting, expected) in cases {
        assert_eq!(at(meeting), [expected], "{meeting}");
    }
}

#[test]
fn positions_by_levels() {
    // Left floor 1 at 3 m stands before right storey 1 (0 to 4 m), floor 2 at 6 m before storey 2 (4 to 7 m).
    let of = |meeting: &str| contacts(&with_heights(&contact(meeting))).remove(0);
    let pair = of("left_floor = 2\nright_storey = 2");
    assert_eq!((pair.left, pair.position()), (Face::Floor(BuildingId::LEFT, 2), Some(2.0 / 3.0)));
    let struck = of("right_floor = 1\nleft_storey = 2\ncolumn_shape = \"straight\"");
    let (side, storey, position, shape) = (BuildingId::LEFT, 2, 1.0 / 3.0, ColumnShape::Straight);
    assert_eq!(struck.left, Face::Columns { building: side, storey, position, shape });
    let said = |meeting: &str| messages(&with_heights(&contact(meeting)));
    let expected = "expected a storey that left floor 2 stands before, or right_position: its level, 6 m, ";
    assert_eq!(
        said("left_floor = 2\nright_storey = 3"),
        [format!("contact[1].right_storey = 3: {expected}is in storey 2, at 0.666667")]
    );
    let level = scene("height = [4.0, 3.0]", "height = [4.0, 3.0, 3.0]", &contact("left_floor = 2\nright_storey = 3"));
    let expected = expected.replace("6 m", "7 m");
    assert_eq!(
        messages(&level),
        [format!("contact[1].right_storey = 3: {expected}is that of right floor 2")],
        "position 0 is a floor"
    );
    // What is wrong with the heights or floors is told once.
    let wrong = scene("height = [3.0, -3.0]", "height = [4.0, 3.0, 3.0]", &contact("left_floor = 2\nright_storey = 1"));
    assert_eq!(messages(&wrong)[0], "left.height[2] = -3.0: expected a finite height > 0 m");
    let unknown = with_heights(&contact("left_floor = 9\nright_storey = 1"));
    assert_eq!(messages(&unknown), ["contact[1].left_floor = 9: expected a floor of the left building, from 1 to 2"]);
}

#[test]
fn walls() {
    let at = |meeting: &str| messages(&scene("", "", &contact(meeting)));
    for (meeting, left, right) in [
        ("left_floor = 1\nwall = \"right\"", Face::Floor(BuildingId::LEFT, 1), Face::Wall),
        ("left_floor = 2\nwall = \"left\"", Face::Wall, Face::Floor(BuildingId::LEFT, 2)),
        ("right_floor = 3\nwall = \"left\"", Face::Wall, Face::Floor(BuildingId::RIGHT, 3)),
        ("right_floor = 1\nwall = \"right\"", Face::Floor(BuildingId::RIGHT, 1), Face::Wall),
    ] {
        let pair = contacts(&scene("", "", &contact(meeting))).remove(0);
        assert_eq!((pair.left, pair.right), (left, right), "{meeting}");
    }
    let cases = [
        (
            "left_floor = 1\nwall = \"up\"",
            "contact[1].wall = \"up\": expected \"left\" or \"right\": the side of the floor that the wall is on",
        ),
        (
            "left_floor = 1\nright_floor = 1\nwall = \"right\"",
            "contact[1].right_floor = 1: expected one floor only at a wall",
        ),
        (
            "left_floor = 1\nright_storey = 1\nwall = \"right\"",
            "contact[1].right_storey = 1: expected no such key: a wall is hit by a floor, left_floor or right_floor",
        ),
        (
            "wall = \"right\"",
            "contact[1].left_floor: expected a floor, counted from 1, here or as right_floor (missing)",
        ),
        (
            "left_floor = 5\nwall = \"right\"",
            "contact[1].left_floor = 5: expected a floor of the left building, from 1 to 2",
        ),
    ];
    for (meeting, expected) in cases {
        assert_eq!(at(meeting), [expected], "{meeting}");
    }
    let twice = contact("left_floor = 1\nwall = \"right\"").repeat(2);
    assert_eq!(
        messages(&scene("", "", &twice)),
        ["contact[2] = left_floor 1, wall \"right\": expected a pair other than that of contact[1]"]
    );
    let both = contact("left_floor = 1\nwall = \"right\"") + &contact("left_floor = 1\nwall = \"left\"");
    assert_eq!(contacts(&scene("", "", &both)).len(), 2);
}

#[test]
fn one_building_alone() {
    let left = "name = \"Alone\"\n[left]\nmass = [1e5]\nstiffness = [1e8]\ndamping = { dashpots = [1e5] }\n";
    let alone = |rest: &str| format!("{left}{rest}");
    let scene = Scene::from_toml(&alone(&contact("left_floor = 1\nwall = \"right\""))).unwrap();
    assert!(scene.buildings.len() == 1 && scene.contacts.len() == 1);
    assert_eq!(
        messages(&alone(&contact("left_floor = 1\nright_floor = 1"))),
        ["right: expected the building on the right, which contacts are with (missing)"]
    );
    assert_eq!(
        messages(&alone("[right]\nmass = []\nstiffness = []\ndamping = { ratio = 0 }\n")),
        ["right.mass = []: expected at least one floor"]
    );
    assert_eq!(
        messages(&alone("").replace("1e5] }", "-1e5] }")),
        ["left.damping.dashpots[1] = -100000.0: expected a finite dashpot >= 0 N s/m"]
    );
}

#[test]
fn facing() {
    let facing = |rest: &str| format!("[facing]\n{LAW}{rest}");
    let all = briefs(&with_heights(&facing("")));
    // Levels 3 and 6 m beside 4, 7 and 10 m: right floor 2 is above the left roof.
    let expected = ["left 1 | columns of right 1 at 0.75", "columns of left 2 at 0.333333 | right 1"];
    assert_eq!(all[..2], expected);
    assert_eq!(all[2..], ["left 2 | columns of right 2 at 0.666667"]);
    // Level within the tolerance, the roof included.
    let level = |right: &str, rest: &str| scene("height = [3.0, 3.0]", right, &facing(rest));
    let all = |text: String| briefs(&text);
    assert_eq!(all(level("height = [3.1, 2.8, 3.0]", "")), ["left 1 | right 1", "left 2 | right 2"]);
    assert_eq!(
        all(level("height = [3.1, 2.8, 3.0]", "level_tolerance = 0.0")),
        [
            "left 1 | columns of right 1 at 0.967742",
            "columns of left 2 at 0.033333 | right 1",
            "columns of left 2 at 0.966667 | right 2",
            "left 2 | columns of right 3 at 0.033333"
        ]
    );
    let straight = contacts(&with_heights(&facing("column_shape = \"straight\"")));
    let shape_of = |face: Face| if let Face::Columns { shape, .. } = face { Some(shape) } else { None };
    let shapes = straight.iter().map(|pair| shape_of(pair.left).or(shape_of(pair.right)));
    assert_eq!(shapes.collect::<Vec<_>>(), [Some(ColumnShape::Straight); 3]);
    // A neighbour on a slope: floors not above its ground floor face nothing.
    assert_eq!(all(level("height = [3.0, 3.0, 3.0]\nbase_level = 3.0", "")), ["left 2 | right 1"]);

    let said = |text: String| messages(&text);
    assert_eq!(
        said(scene("height = [3.0, 3.0]", "", &facing(""))),
        ["right.height: expected the heights of the storeys in m, which [facing] needs (missing)"]
    );
    for (heights, expected) in [
        ("[3.0, 3.0, 3.0]", "left.height = [3.0, 3.0, 3.0]: expected 2 numbers, one per storey, not 3"),
        ("[3.0, -3.0]", "left.height[2] = -3.0: expected a finite height > 0 m"),
    ] {
        let text = scene(&format!("height = {heights}"), "height = [4.0, 3.0, 3.0]", &facing(""));
        assert_eq!(said(text), [expected], "nothing about the contacts that come of it");
    }
    assert_eq!(
        said(with_heights(&(facing("") + &contact("left_floor = 1\nright_floor = 1")))).len(),
        1,
        "either [facing] or [[contact]]"
    );
    assert_eq!(
        said(with_heights(&facing("").replace("0.02", "nan"))),
        ["facing.gap = nan: expected a finite distance in m"],
        "told once, not for every contact"
    );
    assert_eq!(
        said(with_heights(&facing("level_tolerance = -1.0"))),
        ["facing.level_tolerance = -1.0: expected a finite distance >= 0 m"]
    );
    let alone = "name = \"Alone\"\n[left]\nmass = [1]\nstiffness = [1]\ndamping = { ratio = 0 }\nheight = [3]\n";
    assert_eq!(
        said(alone.to_owned() + &facing("")),
        ["right: expected the building on the right, which contacts are with (missing)"]
    );
}

/// A table has the levels elsewhere; what meets is told without them.
#[test]
fn what_meets_in_a_row_is_told_by_floors() {
    let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap().join("examples/scenes");
    let read = |name: &str| Scene::from_toml(&std::fs::read_to_string(root.join(name)).unwrap()).unwrap();
    let told = |scene: &Scene| scene.contacts.iter().map(|pair| pair.meeting_by_floors(scene)).collect::<Vec<_>>();
    let (bridge, clinic, feup) = (read("bridge.toml"), read("clinic.toml"), read("feup.toml"));
    assert!(bridge.is_row() && clinic.is_row() && !feup.is_row());
    let of_walls = ["of west floor 1 against the wall on its left", "of east floor 1 against the wall on its right"];
    assert_eq!([told(&bridge)[0].as_str(), &told(&bridge)[3]], of_walls);
    assert_eq!(told(&clinic)[0], "between shop floor 1 and clinic floor 2");
    assert!(
        clinic.contacts[0].meeting(&clinic).contains("clinic floor 2, level "),
        "{}",
        clinic.contacts[0].meeting(&clinic)
    );
}
