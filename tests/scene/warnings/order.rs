//! Lists with the top floor first, levels in place of heights: dozens of slips, and dozens of buildings that are sound.

use super::{OFFICES, Slip, edited, expect, found, paths};

const YIELDING: &str = include_str!("../../../examples/scenes/yielding.toml");

/// Two equal buildings of soft storeys and usual masses with these keys, and contacts by `[facing]`.
fn twins(floors: usize, keys: &str) -> String {
    let building = |name: &str, keys: &str| {
        let own = |key: &str, value: f64| match keys.contains(&format!("{key} =")) {
            true => String::new(),
            false => format!("{key} = {:?}\n", vec![value; floors]),
        };
        let (mass, stiffness) = (own("mass", 2e5), own("stiffness", 3e8));
        format!("[{name}]\n{mass}{stiffness}damping = {{ ratio = 0.05 }}\n{keys}\n")
    };
    let contact = "[[contact]]\nleft_floor = 1\nright_floor = 1\ngap = 0.04\nlaw = \"linear\"\nstiffness = 1e9\n";
    format!("name = \"Twins\"\n{}{}{contact}", building("left", keys), building("right", ""))
}

fn told(floors: usize, keys: &str) -> Vec<String> {
    found(&twins(floors, keys), None).iter().map(ToString::to_string).collect()
}

fn list(values: &[f64]) -> String {
    format!("{values:?}")
}

#[test]
fn the_top_floor_first() {
    assert_eq!(
        told(4, "mass = [120e3, 150e3, 180e3, 200e3]"),
        [
            "left.mass = [120000.0, 150000.0, 180000.0, 200000.0]: the top floor has 1.67 times what the lowest one has, \
          floor by floor more, where buildings are lighter towards the top or the same; lists begin with the lowest floor, \
          was the top floor given first?"
        ]
    );
    // From the ground up, as they should be; the other way round each is told.
    let lists: [&[f64]; 12] = [
        &[1.0, 0.9, 0.8, 0.7],
        &[1.0, 0.95, 0.9, 0.85],
        &[1.0, 1.0, 0.8, 0.6],
        &[1.0, 0.9, 0.75, 0.55],
        &[8.8, 8.8, 8.5, 8.5, 8.0, 8.0, 7.5, 7.5, 7.0],
        &[5.0, 5.0, 5.0, 4.6, 4.6, 4.2, 4.2, 4.0],
        &[5.0, 4.8, 4.5, 4.2],
        &[2.2, 2.1, 2.0, 1.9, 1.8, 1.6],
        &[1.0, 0.95, 0.8, 0.55],
        &[2.0, 2.0, 1.6, 1.6, 1.2, 1.2, 0.8],
        &[1.0, 0.97, 0.94, 0.91, 0.88, 0.85, 0.82, 0.79, 0.76, 0.73, 0.7, 0.67, 0.64, 0.61, 0.58, 0.55, 0.52, 0.5],
        &[3.0, 2.8, 2.6, 2.2, 2.0],
    ];
    for shares in lists {
        for (key, size) in [("mass", 1e5), ("stiffness", 2e8), ("yield_force", 2e6)] {
            let mut values: Vec<f64> = shares.iter().map(|share| size * share / shares[0]).collect();
            let floors = values.len();
            let sound = told(floors, &format!("{key} = {}", list(&values)));
            assert_eq!(sound, [""; 0], "{key} {values:?}");
            values.reverse();
            let slip = found(&twins(floors, &format!("{key} = {}", list(&values))), None);
            assert_eq!(paths(&slip), [format!("left.{key}")], "{values:?}: {slip:?}");
            assert!(slip[0].text.contains("was the top floor given first?"), "{}", slip[0]);
        }
    }
    let slips: [Slip; 2] = [
        (
            YIELDING,
            &[("[1490, 1330, 1010, 530]", "[530, 1010, 1330, 1490]")],
            &["left.yield_force"],
            "all that is above",
        ),
        (YIELDING, &[("[200e3, 190e3, 160e3, 110e3]", "[110e3, 160e3, 190e3, 200e3]")], &["left.stiffness"], "softer"),
    ];
    expect(&slips);
}

/// Heavier or stiffer at one place, or by the scatter of measured values, or in three floors only.
#[test]
fn what_grows_and_is_no_slip() {
    for (key, values) in [
        ("mass", &[2e5, 2e5, 2e5, 3e5][..]),
        ("mass", &[1.5e5, 2e5, 2e5, 2e5]),
        ("mass", &[1.5e5, 2e5, 2e5, 2.5e5]),
        ("mass", &[1.98e5, 2.0e5, 2.01e5, 2.04e5]),
        ("mass", &[2e5, 1.9e5, 2.2e5, 2.4e5]),
        ("mass", &[1.2e5, 1.6e5, 2e5]),
        ("mass", &[2e5, 2e5, 2e5, 1e5, 1e5, 1.5e5]),
        ("stiffness", &[0.5e8, 3e8, 3e8, 3e8]),
        ("stiffness", &[0.5e8, 2e8, 3e8, 3e8]),
        ("stiffness", &[1.0e8, 3.0e8, 3.1e8, 3.2e8]),
        ("stiffness", &[2e8, 3e8, 3e8, 2.5e8]),
        ("stiffness", &[3e8, 3e8, 3.01e8, 3.02e8]),
        ("stiffness", &[1e8, 2e8, 3e8]),
        ("stiffness", &[3e8, 3e8, 3e8, 4e8, 4e8, 4e8]),
        ("yield_force", &[9e5, 2.4e6, 2.4e6, 2.4e6]),
        ("yield_force", &[2e6, f64::INFINITY, f64::INFINITY, f64::INFINITY]),
        ("yield_force", &[1e6, 1.5e6, 2e6, f64::INFINITY]),
        ("yield_force", &[2e6, 2e6, 2e6, 2e6]),
        ("yield_force", &[2e6, 1.8e6, 1.4e6, 0.8e6]),
    ] {
        assert_eq!(told(values.len(), &format!("{key} = {}", list(values))), [""; 0], "{key} {values:?}");
    }
    // What has been told of units is not told of the order.
    let tonnes = edited(OFFICES, &[("198e3, 198e3, 198e3, 198e3, 154e3", "120, 140, 160, 180, 200")]);
    assert_eq!(paths(&found(&tonnes, None)), ["left.mass"]);
}

#[test]
fn levels_in_place_of_heights() {
    assert_eq!(
        told(3, "height = [3.2, 6.4, 9.6]\nbase_level = 0.0"),
        [
            "left.height = [3.2, 6.4, 9.6]: each storey would be higher than the last by a whole storey, and the roof 19.2 m \
          above the ground floor; heights are those of the storeys, lowest first, were levels of the floors given (storeys of \
          3.2, 3.2, 3.2 m)?"
        ]
    );
    for (heights, base, meant) in [
        ("[3.2, 6.4, 9.6, 12.8, 16.0]", "0.0", "3.2, 3.2, 3.2, 3.2, 3.2 m"),
        ("[3.2, 6.4]", "0.0", "3.2, 3.2 m"),
        ("[4.0, 7.2]", "0.0", "4.0, 3.2 m"),
        ("[4.5, 7.7, 10.9]", "0.0", "4.5, 3.2, 3.2 m"),
        ("[6.0, 9.0, 12.0, 15.0]", "0.0", "6.0, 3.0, 3.0, 3.0 m"),
        ("[3.0, 6.5, 9.5, 13.0]", "0.0", "3.0, 3.5, 3.0, 3.5 m"),
        ("[0.5, 3.8, 7.1, 10.4]", "0.0", "0.5, 3.3, 3.3, 3.3 m"),
        ("[103.2, 106.4, 109.6]", "100.0", "3.2, 3.2, 3.2 m"),
        ("[13.2, 16.4, 19.6]", "10.0", "3.2, 3.2, 3.2 m"),
        ("[103.2, 106.4, 109.6]", "0.0", "3.2, 3.2 m"),
        ("[9.6, 6.4, 3.2]", "0.0", "3.2, 3.2, 3.2 m"),
        ("[16.0, 12.8, 9.6, 6.4, 3.2]", "0.0", "3.2, 3.2, 3.2, 3.2, 3.2 m"),
        ("[0.5, 1.0, 1.5]", "0.0", "0.5, 0.5, 0.5 m"),
        ("[0.4, 0.8]", "0.0", "0.4, 0.4 m"),
        (
            "[3, 6, 9, 12, 15, 18, 21, 24, 27, 30, 33, 36]",
            "0.0",
            "3.0, 3.0, 3.0, 3.0, 3.0, 3.0, 3.0, 3.0, 3.0, 3.0, 3.0, 3.0",
        ),
    ] {
        let floors = heights.matches(',').count() + 1;
        let told = found(&twins(floors, &format!("height = {heights}\nbase_level = {base}")), None);
        assert_eq!(paths(&told), ["left.height"], "{heights}: {told:?}");
        assert!(told[0].text.contains(&format!("(storeys of {meant}")), "{}", told[0]);
    }
}

#[test]
fn heights_that_differ_and_are_no_levels() {
    for heights in [
        "[3.2, 3.2, 3.2]",
        "[4.5, 3.2, 3.2]",
        "[3.0, 4.0, 5.0]",
        "[3, 4, 5, 6]",
        "[3.4, 3.5, 3.6, 3.7]",
        "[2.74, 2.98, 3.47]",
        "[0.5, 3.3, 3.3, 3.3]",
        "[0.5, 3.3, 3.6, 3.7]",
        "[0.5, 3.3]",
        "[0.5, 3.3, 4.2]",
        "[3.0, 4.5]",
        "[3.5, 6.0]",
        "[6.0, 3.0]",
        "[6.0, 4.5, 3.0]",
        "[8.0, 4.0]",
        "[3.0, 3.0, 6.0]",
        "[3.0, 6.0, 3.0]",
        "[4.2, 3.6, 3.6, 3.6]",
        "[0.5, 0.5, 0.5]",
        "[0.4, 0.45]",
        "[0.3, 0.4, 0.45]",
        "[12.0]",
    ] {
        let floors = heights.matches(',').count() + 1;
        assert_eq!(told(floors, &format!("height = {heights}")), [""; 0], "{heights}");
    }
}
