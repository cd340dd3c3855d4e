//! Links: their ends, springs, dashpots and slips.

use crate::{SHORT, messages};
use pounding::scene::{BuildingId, Link, Place, Scene, Slip};

/// Two buildings of one floor each with a link.
fn linked(keys: &str) -> String {
    format!("{SHORT}[[link]]\n{keys}\n")
}

/// Keys of a link and all that is then said.
fn expect(refusals: &[(&str, &[&str])]) {
    for (keys, expected) in refusals {
        assert_eq!(messages(&linked(keys)), *expected, "{keys:?}");
    }
}

#[test]
fn links_are_read() {
    let links = |keys: &str| Scene::from_toml(&linked(keys)).unwrap_or_else(|e| panic!("{e}\n{keys}")).links;
    let link = Link {
        left: Some((BuildingId::LEFT, Place::Floor(0))),
        right: Some((BuildingId::RIGHT, Place::Floor(0))),
        stiffness: 5e6,
        dashpot: 0.0,
        slip: None,
    };
    assert_eq!(links("left_floor = 1\nright_floor = 1\nstiffness = 5e6"), std::slice::from_ref(&link));
    let damper = Link { right: None, stiffness: 0.0, dashpot: 1.5e6, ..link.clone() };
    assert_eq!(links("left_floor = 1\nwall = \"right\"\ndashpot = 1.5e6"), [damper]);
    let slip = |ratio| Some(Slip { force: 60e3, ratio });
    let friction = Link { left: None, slip: slip(0.0), ..link.clone() };
    assert_eq!(links("right_floor = 1\nwall = \"left\"\nstiffness = 5e6\nslip_force = 60e3"), [friction]);
    let steel = Link { dashpot: 2.0, slip: slip(0.1), ..link.clone() };
    let keys =
        "left_floor = 1\nright_floor = 1\nstiffness = 5e6\ndashpot = 2\nslip_force = 60e3\npost_yield_ratio = 0.1";
    assert_eq!(links(keys), std::slice::from_ref(&steel));
    // Any number between the same floors.
    assert_eq!(links(&format!("{keys}\n[[link]]\n{keys}")), [steel.clone(), steel]);
    let floors = "stiffness = [2]".replace("[2]", "[2, 2]");
    let taller = linked("left_floor = 2\nright_floor = 1\nstiffness = 5e6")
        .replacen("stiffness = [2]", &floors, 1)
        .replacen("mass = [1]", "mass = [1, 1]", 1);
    assert_eq!(
        Scene::from_toml(&taller).unwrap().links,
        [Link { left: Some((BuildingId::LEFT, Place::Floor(1))), ..link }]
    );
}

#[test]
fn numbers_in_t_and_kn() {
    let keys =
        "left_floor = 1\nright_floor = 1\nstiffness = 3.65e3\ndashpot = 1.1\nslip_force = 0.07\npost_yield_ratio = 0.1";
    let links = Scene::from_toml(&format!("units = \"kN-t\"{}", linked(keys))).unwrap().links;
    let slip = Some(Slip { force: 70.0, ratio: 0.1 });
    assert_eq!(
        links,
        [Link {
            left: Some((BuildingId::LEFT, Place::Floor(0))),
            right: Some((BuildingId::RIGHT, Place::Floor(0))),
            stiffness: 3.65e6,
            dashpot: 1.1e3,
            slip
        }]
    );
    let wrong = keys.replace("3.65e3", "-3.65e3").replace("1.1", "-1.1").replace("0.07", "0.0");
    assert_eq!(
        messages(&format!("units = \"kN-t\"{}", linked(&wrong))),
        [
            "link[1].stiffness = -3650.0: expected a finite stiffness >= 0 kN/m",
            "link[1].dashpot = -1.1: expected a finite dashpot >= 0 kN s/m",
            "link[1].slip_force = 0.0: expected a finite force > 0 kN",
        ]
    );
    assert_eq!(
        messages(&format!("units = \"kN-t\"{}", linked("left_floor = 1\nright_floor = 1"))),
        ["link[1].stiffness: expected a stiffness in kN/m, or a dashpot in kN s/m, or both (missing)"]
    );
}

#[test]
fn springs_dashpots_and_slips() {
    const ENDS: &str = "left_floor = 1\nright_floor = 1\n";
    for (keys, expected) in [
        ("", &["link[1].stiffness: expected a stiffness in N/m, or a dashpot in N s/m, or both (missing)"][..]),
        (
            "stiffness = 0\ndashpot = 0.0",
            &["link[1].stiffness = 0: expected a stiffness > 0, or a dashpot > 0: nothing would be there"],
        ),
        (
            "stiffness = 0.0",
            &["link[1].stiffness = 0.0: expected a stiffness > 0, or a dashpot > 0: nothing would be there"],
        ),
        ("dashpot = 0", &["link[1].dashpot = 0: expected a stiffness > 0, or a dashpot > 0: nothing would be there"]),
        ("stiffness = 1\ndashpot = -1", &["link[1].dashpot = -1.0: expected a finite dashpot >= 0 N s/m"]),
        ("stiffness = inf", &["link[1].stiffness = inf: expected a finite stiffness >= 0 N/m"]),
        ("stiffness = -1", &["link[1].stiffness = -1.0: expected a finite stiffness >= 0 N/m"]),
        ("stiffness = nan", &["link[1].stiffness = nan: expected a finite stiffness >= 0 N/m"]),
        ("stiffness = \"soft\"", &["link[1].stiffness = \"soft\": expected a number"]),
        (
            "dashpot = 1\nslip_force = 2",
            &["link[1].stiffness: expected that of the spring that slips, in N/m (missing)"],
        ),
        (
            "stiffness = 0\ndashpot = 1\nslip_force = 2",
            &["link[1].stiffness = 0.0: expected a stiffness > 0, that of the spring that slips"],
        ),
        ("stiffness = 1\nslip_force = 0", &["link[1].slip_force = 0.0: expected a finite force > 0 N"]),
        ("stiffness = 1\nslip_force = inf", &["link[1].slip_force = inf: expected a finite force > 0 N"]),
        (
            "stiffness = 1\npost_yield_ratio = 0.1",
            &["link[1].post_yield_ratio = 0.1: expected slip_force as well, at which the spring yields"],
        ),
        (
            "stiffness = 1\nslip_force = 1\npost_yield_ratio = 1",
            &["link[1].post_yield_ratio = 1.0: expected 0 <= r < 1"],
        ),
        (
            "stiffness = 1\nslip_force = 1\npost_yield_ratio = -0.1",
            &["link[1].post_yield_ratio = -0.1: expected 0 <= r < 1"],
        ),
        (
            "stifness = 1\ndashpot = 1",
            &[concat!(
                "link[1].stifness = 1: expected a known key (left_floor, right_floor, wall, stiffness, dashpot, slip_force, ",
                "post_yield_ratio); did you mean stiffness?"
            )],
        ),
    ] {
        expect(&[(&format!("{ENDS}{keys}"), expected)]);
    }
}

#[test]
fn ends() {
    const NO_FOUNDATION: &str = "expected a floor of the right building, counted from 1; 0 is the foundation, and the building has none: the ground is a wall";
    const AT_FLOORS: &str = "expected left_floor and right_floor: devices are anchored at floors, not at columns";
    for (keys, expected) in [
        (
            "",
            &["link[1].left_floor: expected a floor, counted from 1, and right_floor, or one of them and a wall (missing)"
                .to_owned()][..],
        ),
        (
            "wall = \"left\"",
            &["link[1].left_floor: expected a floor, counted from 1, and right_floor, or one of them and a wall (missing)"
                .to_owned()],
        ),
        (
            "left_floor = 1",
            &["link[1].right_floor: expected a floor, counted from 1, or wall = \"right\" (missing)".to_owned()],
        ),
        (
            "right_floor = 1",
            &["link[1].left_floor: expected a floor, counted from 1, or wall = \"left\" (missing)".to_owned()],
        ),
        (
            "left_floor = 1\nwall = \"left\"",
            &["link[1].wall = \"left\": expected \"right\", the side of left_floor on which the device is".to_owned()],
        ),
        (
            "right_floor = 1\nwall = \"right\"",
            &["link[1].wall = \"right\": expected \"left\", the side of right_floor on which the device is".to_owned()],
        ),
        ("right_floor = 1\nwall = 1", &["link[1].wall = 1: expected text in quotation marks".to_owned()]),
        (
            "left_floor = 1\nright_floor = 1\nwall = \"left\"",
            &["link[1].wall = \"left\": expected no wall beside left_floor and right_floor: two ends only".to_owned()],
        ),
        (
            "left_floor = 2\nright_floor = 3",
            &[
                "link[1].left_floor = 2: expected a floor of the left building, from 1 to 1".to_owned(),
                "link[1].right_floor = 3: expected a floor of the right building, from 1 to 1".to_owned(),
            ],
        ),
        ("left_floor = 1\nright_floor = 0", &[format!("link[1].right_floor = 0: {NO_FOUNDATION}")]),
        (
            "left_floor = -1\nright_floor = 1",
            &["link[1].left_floor = -1: expected a whole number from 1 on".to_owned()],
        ),
        ("left_floor = 1\nright_floor = 1\nleft_storey = 1", &[format!("link[1].left_storey = 1: {AT_FLOORS}")]),
        (
            "left_floor = 1\nright_floor = 1\nright_position = 0.5",
            &[format!("link[1].right_position = 0.5: {AT_FLOORS}")],
        ),
    ] {
        assert_eq!(messages(&linked(&format!("{keys}\nstiffness = 1"))), expected, "{keys:?}");
    }
}

#[test]
fn tables_and_buildings() {
    let one = linked("left_floor = 1\nright_floor = 1\nstiffness = 1");
    let bracket = messages(&one.replace("[[link]]", "[link]"));
    assert_eq!(bracket, ["link = [link]: expected [[link]], with two brackets on either side, above every link"]);
    assert_eq!(messages(&format!("{SHORT}link = 1")), ["link = 1: expected [[link]] tables"]);
    let alone = SHORT.lines().filter(|line| !line.starts_with("right")).collect::<Vec<_>>().join("\n");
    let right = messages(&format!("{alone}\n[[link]]\nleft_floor = 1\nright_floor = 1\nstiffness = 1"));
    assert_eq!(right, ["right: expected the building on the right, which links are with (missing)"]);
    let to_ground = format!("{alone}\n[[link]]\nleft_floor = 1\nwall = \"right\"\nstiffness = 1");
    assert_eq!(messages(&to_ground), [""; 0]);
    // All at once, in the order of the file.
    let wrong = format!("{one}[[link]]\nleft_floor = 9\nright_floor = 0\npost_yield_ratio = 0.1");
    let paths =
        messages(&wrong).iter().map(|message| message.split([' ', ':']).next().unwrap().to_owned()).collect::<Vec<_>>();
    let expected = ["link[2].stiffness", "link[2].left_floor", "link[2].right_floor", "link[2].post_yield_ratio"];
    assert_eq!(paths, expected);
}
