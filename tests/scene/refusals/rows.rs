//! Rows of buildings: `[[building]]` with names, and contacts, links and `[facing]` between neighbours.

use crate::messages;
use pounding::scene::{BuildingId, Face, Scene};

/// The keys of a building of one floor.
const ONE: &str = "mass = [1e5]\nstiffness = [1e7]\ndamping = { ratio = 0.05 }\nheight = [3.0]\n";
const LAW: &str = "law = \"linear\"\nstiffness = 1e9\n";

/// A row of buildings of these names.
fn row(names: &[&str]) -> String {
    let building = |name: &&str| format!("[[building]]\nname = {name:?}\n{ONE}");
    format!("name = \"Row\"\n{}", names.iter().map(building).collect::<String>())
}

/// Three buildings and a contact with these keys.
fn meeting(keys: &str) -> String {
    format!("{}[[contact]]\n{keys}gap = 0.01\n{LAW}", row(&["A", "B", "C"]))
}

fn read(text: &str) -> Scene {
    Scene::from_toml(text).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

/// What is said of a text, in any order.
fn expect(text: &str, expected: &[&str]) {
    let mut said = messages(text);
    said.sort();
    let mut expected: Vec<String> = expected.iter().map(|text| (*text).to_owned()).collect();
    expected.sort();
    assert_eq!(said, expected, "{text}");
}

#[test]
fn a_row_is_read() {
    let scene = read(&format!(
        "{}left = \"B\"\nright = \"C\"\nleft_floor = 1\nright_floor = 1\ngap = 0.02\n{LAW}\
         [[contact]]\nleft = \"C\"\nleft_floor = 1\nwall = \"right\"\ngap = 0.03\n{LAW}\
         [[link]]\nleft = \"A\"\nright = \"B\"\nleft_floor = 1\nright_floor = 1\ndashpot = 1e5\n\
         [[link]]\nright = \"A\"\nright_floor = 1\nwall = \"left\"\ndashpot = 1e5\n",
        meeting("left = \"A\"\nright = \"B\"\nleft_floor = 1\nright_floor = 1\n") + "[[contact]]\n"
    ));
    let names: Vec<&str> = scene.buildings.iter().map(|building| building.name.as_str()).collect();
    assert_eq!(names, ["A", "B", "C"]);
    let floor = |place| Face::Floor(BuildingId::new(place), 1);
    let faces: Vec<[Face; 2]> = scene.contacts.iter().map(|pair| [pair.left, pair.right]).collect();
    assert_eq!(faces, [[floor(0), floor(1)], [floor(1), floor(2)], [floor(2), Face::Wall]]);
    let ends = |l: usize| [scene.links[l].left, scene.links[l].right].map(|end| end.map(|(id, _)| id.index()));
    assert_eq!([ends(0), ends(1)], [[Some(0), Some(1)], [None, Some(0)]]);
    assert_eq!(read(&row(&["alone"])).buildings.len(), 1);
}

#[test]
fn names_have_defaults_by_place() {
    let text = format!("name = \"Row\"\n[[building]]\n{ONE}[[building]]\nname = \"x\"\n{ONE}[[building]]\n{ONE}");
    let names: Vec<String> = read(&text).buildings.into_iter().map(|building| building.name).collect();
    assert_eq!(names, ["b1", "x", "b3"]);
    expect(
        &format!("name = \"Row\"\n[[building]]\nname = \"b2\"\n{ONE}[[building]]\n{ONE}"),
        &["building[2].name = \"b2\": expected a name other than that of building[1]"],
    );
}

#[test]
fn names_are_refused() {
    expect(&row(&["A", "A"]), &["building[2].name = \"A\": expected a name other than that of building[1]"]);
    expect(
        &row(&["2nd", "link"]),
        &[
            "building[1].name = \"2nd\": expected a C identifier: letters, digits and _, no digit first",
            "building[2].name = \"link\": expected a name that the FMU does not use itself (contact, energy, ground, \
             impacts, link, solver, system, time)",
        ],
    );
    let same = |place: usize, other: usize| {
        format!(
            "building[{place}].name = \"a_residual\": expected a name that does not begin with that of building[{other}] \
             and \"_residual\""
        )
    };
    expect(&row(&["a", "a_residual"]), &[&same(2, 1)]);
    expect(&row(&["a_residual", "b", "a"]), &[&same(1, 3)]);
    assert!(messages(&row(&["a", "b_residual", "aa"])).is_empty());
}

#[test]
fn it_is_one_way_or_the_other() {
    expect(
        &format!("{}[left]\n{ONE}", row(&["A"])),
        &["building = [[building]]: expected either [[building]] tables or [left] and [right], not both"],
    );
    expect(
        &format!("name = \"Row\"\n[building]\n{ONE}"),
        &[&format!(
            "building = {}: expected [[building]], with two brackets on either side, above every building",
            messages(&format!("name = \"Row\"\n[building]\n{ONE}"))[0]
                .split_once(" = ")
                .unwrap()
                .1
                .split_once(": exp")
                .unwrap()
                .0
        )],
    );
    expect("name = \"Row\"\nbuilding = []\n", &["building = []: expected at least one [[building]] table"]);
    let names: Vec<String> = (0..101).map(|place| format!("n{place}")).collect();
    let many = row(&names.iter().map(String::as_str).collect::<Vec<_>>());
    expect(&many, &["building: expected at most 100 buildings, not 101"]);
    // A scene of two has no names for the ends of a contact.
    let two = format!(
        "name = \"Two\"\n[left]\n{ONE}[right]\n{ONE}[[contact]]\nleft = \"left\"\nleft_floor = 1\nright_floor = 1\ngap = 0\n{LAW}"
    );
    let said = messages(&two);
    assert!(
        said.len() == 1 && said[0].starts_with("contact[1].left = \"left\": expected a key of law linear"),
        "{said:?}"
    );
}

#[test]
fn ends_of_contacts() {
    let floors = "left_floor = 1\nright_floor = 1\n";
    let of = |keys: &str| meeting(&format!("{keys}{floors}"));
    let name =
        |side: &str| format!("contact[1].{side}: expected the name of the building on the {side} of the gap (missing)");
    expect(&of(""), &[&name("left"), &name("right")]);
    expect(&of("left = \"A\"\n"), &[&name("right")]);
    expect(
        &of("left = \"A\"\nright = \"D\"\n"),
        &["contact[1].right = \"D\": expected the name of a building (A, B, C); did you mean A?"],
    );
    expect(
        &of("left = \"A\"\nright = \"C\"\n"),
        &["contact[1].right = \"C\": expected \"B\", the right neighbour of \"A\""],
    );
    expect(
        &of("left = \"B\"\nright = \"A\"\n"),
        &["contact[1].right = \"A\": expected \"C\", the right neighbour of \"B\""],
    );
    expect(
        &of("left = \"C\"\nright = \"A\"\n"),
        &["contact[1].left = \"C\": expected a building that has a right neighbour"],
    );
    expect(&of("left = 1\nright = \"B\"\n"), &["contact[1].left = 1: expected text in quotation marks"]);
}

#[test]
fn floors_and_storeys_of_named_buildings() {
    let of = |keys: &str| meeting(&format!("left = \"A\"\nright = \"B\"\n{keys}"));
    expect(
        &of("left_floor = 4\nright_floor = 0\n"),
        &[
            "contact[1].left_floor = 4: expected a floor of building \"A\", from 1 to 1",
            "contact[1].right_floor = 0: expected a floor of building \"B\", from 1 to 1",
        ],
    );
    expect(
        &of("left_floor = 1\nright_storey = 2\nright_position = 0.5\n"),
        &["contact[1].right_storey = 2: expected a storey of building \"B\", from 1 to 1"],
    );
    expect(
        &of("left_floor = 1\nright_storey = 1\n"),
        &[
            "contact[1].right_storey = 1: expected a storey that A floor 1 stands before, or right_position: its level, 3 m, is \
         that of B floor 1",
        ],
    );
    let twice = "left = \"A\"\nright = \"B\"\nleft_floor = 1\nright_floor = 1\n";
    expect(
        &format!("{}[[contact]]\n{twice}gap = 0.1\n{LAW}", meeting(twice)),
        &["contact[2] = left_floor 1, right_floor 1: expected a pair other than that of contact[1]"],
    );
}

#[test]
fn walls_of_a_row() {
    expect(
        &meeting("left = \"A\"\nright = \"B\"\nleft_floor = 1\nwall = \"left\"\n"),
        &["contact[1].right: expected no such key: at a wall there is one building"],
    );
    expect(
        &meeting("right_floor = 1\nwall = \"left\"\n"),
        &["contact[1].right: expected the name of the building at the wall (missing)"],
    );
    expect(
        &meeting("right = \"C\"\nright_floor = 3\nwall = \"left\"\n"),
        &["contact[1].right_floor = 3: expected a floor of building \"C\", from 1 to 1"],
    );
    for side in ["left", "right"] {
        let scene = read(&meeting(&format!("right = \"B\"\nright_floor = 1\nwall = {side:?}\n")));
        let floor = Face::Floor(BuildingId::new(1), 1);
        let faces = if side == "left" { [Face::Wall, floor] } else { [floor, Face::Wall] };
        assert_eq!([scene.contacts[0].left, scene.contacts[0].right], faces);
    }
}

#[test]
fn ends_of_links() {
    let of = |keys: &str| format!("{}[[link]]\n{keys}dashpot = 1e5\n", row(&["A", "B", "C"]));
    expect(
        &of("left_floor = 1\nright_floor = 1\n"),
        &[
            "link[1].left: expected the name of the building on the left of the gap (missing)",
            "link[1].right: expected the name of the building on the right of the gap (missing)",
        ],
    );
    expect(
        &of("left = \"A\"\nright = \"C\"\nleft_floor = 1\nright_floor = 1\n"),
        &["link[1].right = \"C\": expected \"B\", the right neighbour of \"A\""],
    );
    expect(
        &of("left = \"A\"\nright = \"B\"\nleft_floor = 1\nwall = \"right\"\n"),
        &["link[1].right: expected no such key: at a wall there is one building"],
    );
    expect(
        &of("left = \"A\"\nright = \"B\"\nleft_floor = 0\nright_floor = 2\n"),
        &[
            "link[1].left_floor = 0: expected a floor of building \"A\", counted from 1; 0 is the foundation, and the building \
         has none: the ground is a wall",
            "link[1].right_floor = 2: expected a floor of building \"B\", from 1 to 1",
        ],
    );
}

#[test]
fn facing_makes_the_contacts_of_all_neighbours() {
    let of = |gap: &str| format!("{}[facing]\ngap = {gap}\n{LAW}", row(&["A", "B", "C"]));
    let gaps = |text: &str| read(text).contacts.iter().map(|pair| pair.gap).collect::<Vec<_>>();
    assert_eq!(gaps(&of("0.02")), [0.02, 0.02]);
    assert_eq!(gaps(&of("[0.02, 0.05]")), [0.02, 0.05]);
    let wall = format!("[[contact]]\nleft = \"A\"\nleft_floor = 1\nwall = \"left\"\ngap = 0.1\n{LAW}");
    assert_eq!(gaps(&format!("{}{wall}", of("0.02"))), [0.02, 0.02, 0.1]);
    expect(&of("[0.02]"), &["facing.gap = [0.02]: expected 2 numbers, one per pair of neighbours, not 1"]);
    expect(&of("[0.02, nan]"), &["facing.gap[2] = nan: expected a finite distance in m"]);
    expect(&of("nan"), &["facing.gap = nan: expected a finite distance in m"]);
    // What is wrong beside it stands where the file has it.
    expect(
        &format!("{}{}", of("0.02"), wall.replace("left_floor = 1", "left_floor = 2")),
        &["contact[1].left_floor = 2: expected a floor of building \"A\", from 1 to 1"],
    );
    expect(
        &format!("{}{wall}{wall}", of("0.02")),
        &["contact[2] = wall \"left\", left_floor 1: expected a pair other than that of contact[1]"],
    );
    let pair = format!("[[contact]]\nleft = \"A\"\nright = \"B\"\nleft_floor = 1\nright_floor = 1\ngap = 0.1\n{LAW}");
    let said = messages(&format!("{}{pair}", of("0.02")));
    assert_eq!(said.len(), 1, "{said:?}");
    assert!(said[0].ends_with(": expected a wall: [facing] makes the contacts between neighbours"), "{said:?}");
    expect(
        &format!("{}[facing]\ngap = 0.02\n{LAW}", row(&["A"])),
        &["facing = [facing]: expected two buildings or more, which face each other"],
    );
    expect(
        &of("0.02").replacen("height = [3.0]\n", "", 1),
        &["building[1].height: expected the heights of the storeys in m, which [facing] needs (missing)"],
    );
    // One gap for each pair is for rows: a scene of two has one.
    let two = format!("name = \"Two\"\n[left]\n{ONE}[right]\n{ONE}[facing]\ngap = [0.02]\n{LAW}");
    expect(&two, &["facing.gap = [0.02]: expected a number"]);
}

#[test]
fn floors_of_all_buildings_together() {
    let tall = |floors: usize| {
        let of = |value: &str| format!("[{}]", vec![value; floors].join(", "));
        format!("[[building]]\nmass = {}\nstiffness = {}\ndamping = {{ ratio = 0.05 }}\n", of("1e5"), of("1e8"))
    };
    let row = |count: usize, floors: usize| format!("name = \"Tall\"\n{}", tall(floors).repeat(count));
    let links = |count: usize| -> String {
        let link = |k: usize| {
            format!(
                "[[link]]\nleft = \"b{k}\"\nright = \"b{}\"\nleft_floor = 1\nright_floor = 1\ndashpot = 1e5\n",
                k + 1
            )
        };
        (1..count).map(link).collect()
    };
    let said = "in all, or fewer of them joined by links, which would take minutes to prepare";
    assert!(messages(&row(8, 1000)).is_empty());
    expect(&row(9, 1000), &[&format!("building: expected fewer floors than 9000 {said}")]);
    assert!(messages(&format!("{}{}", row(20, 100), links(20))).is_empty());
    expect(&format!("{}{}", row(21, 100), links(21)), &[&format!("building: expected fewer floors than 2100 {said}")]);
}
