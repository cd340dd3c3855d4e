//! Masses, stiffnesses, damping and initial motion of buildings: their units, and single entries.

use super::{FEUP, FILIATRAULT, ISOLATED, OFFICES, edited, expect, found, paths};

const STOREYS: &str = "300e6, 300e6, 300e6, 300e6, 300e6";
const MASSES: &str = "198e3, 198e3, 198e3, 198e3, 154e3";

#[test]
fn units_of_a_building() {
    expect(&[
        (OFFICES, &[(MASSES, "198, 198, 198, 198, 154")], &["left.mass"], "given in t?"),
        (
            OFFICES,
            &[(MASSES, "198, 198, 198, 198, 154"), ("165e3, 165e3, 128e3", "165, 165, 128")],
            &["left.mass", "right.mass"],
            "Hz, period 0.0",
        ),
        (OFFICES, &[(STOREYS, "300e3, 300e3, 300e3, 300e3, 300e3")], &["left.stiffness"], "given in kN/m (or"),
        (OFFICES, &[(STOREYS, "300, 300, 300, 300, 300")], &["left.stiffness"], "kN/mm"),
        (OFFICES, &[(STOREYS, "300e9, 300e9, 300e9, 300e9, 300e9")], &["left.stiffness"], "power of ten"),
        (OFFICES, &[("165e3, 165e3, 128e3", "165e6, 165e6, 128e6")], &["right.mass"], "given in g?"),
        (
            OFFICES,
            &[(MASSES, "198, 198, 198, 198, 154"), (STOREYS, "300e3, 300e3, 300e3, 300e3, 300e3")],
            &["left.mass"],
            "in t and kN/m?",
        ),
        (FEUP, &[("2910.0", "2.91")], &["left.stiffness", "right.stiffness"], "too slow"),
        (FEUP, &[("3.65", "0.00365")], &["left.mass", "right.mass"], "too fast"),
        (FEUP, &[("[2910.0, 2910.0]", "[2.91, 2.91]")], &["left.stiffness"], "too slow"),
        (
            OFFICES,
            &[(
                "stiffness = [141e6, 141e6, 141e6]",
                "stiffness_matrix = [[282e3, -141e3, 0], [-141e3, 282e3, -141e3], [0, -141e3, 141e3]]",
            )],
            &["right.stiffness_matrix"],
            "given in kN/m (or",
        ),
    ]);
}

/// [`OFFICES`] in t and kN, without saying so.
const TONNES: &[(&str, &str)] = &[
    (MASSES, "198, 198, 198, 198, 154"),
    ("165e3, 165e3, 128e3", "165, 165, 128"),
    (STOREYS, "300e3, 300e3, 300e3, 300e3, 300e3"),
    ("141e6, 141e6, 141e6", "141e3, 141e3, 141e3"),
    ("2.75e9", "2.75e6"),
];

#[test]
fn a_scene_in_t_and_kn_that_does_not_say_so() {
    const UNITS: &str = "units = \"kN-t\"";
    let silent = edited(OFFICES, TONNES);
    let told = found(&silent, None);
    assert_eq!(paths(&told), ["left.mass"], "{told:?}");
    assert!(told[0].text.contains(UNITS) && told[0].text.contains("189 kg on average"), "{}", told[0]);
    assert_eq!(found(&format!("{UNITS}\n{silent}"), None), []);
    // Beside a wall, which may have any mass.
    let isolated =
        [("320.0e3", "320.0"), ("12.6e6", "12.6e3"), ("600.0e6", "600.0e3"), ("1.0e9", "1.0e6"), ("1.0e16", "1e13")];
    let silent = edited(ISOLATED, &isolated);
    assert_eq!(paths(&found(&silent, None)), ["left.mass"]);
    assert_eq!(found(&format!("{UNITS}\n{silent}"), None), []);
    assert_eq!(paths(&found(&format!("{UNITS}\n{ISOLATED}"), None)), ["left.mass"]);
    // Frames of laboratories are as light, and faster, closer to each other or lower.
    for sound in [FILIATRAULT.to_owned(), edited(OFFICES, TONNES).replace("gap = 0.03", "gap = 0.01")] {
        assert_eq!(found(&sound, None), []);
    }
    // Where only some numbers are in t or kN, too.
    for change in [TONNES[0], TONNES[2], TONNES[4]] {
        let told = found(&edited(OFFICES, &[change]), None);
        assert!(told[0].text.contains(UNITS), "{told:?}");
    }
}

#[test]
fn units_of_a_scene_in_t_and_kn() {
    let tonnes = edited(OFFICES, TONNES);
    for (from, to, path, value, words) in [
        (
            TONNES[0].1,
            MASSES,
            "left.mass",
            "[198000.0, 198000.0, 198000.0, 198000.0, 154000.0]",
            "in t, were they given in kg?",
        ),
        (
            TONNES[2].1,
            "300e6, 300e6, 300e6, 300e6, 300e6",
            "left.stiffness",
            "[300000000.0, 300000000.0, 300000000.0, 300000000.0, 3000...",
            "in kN/m, were they given in N/m?",
        ),
        (
            TONNES[2].1,
            "300, 300, 300, 300, 300",
            "left.stiffness",
            "[300.0, 300.0, 300.0, 300.0, 300.0]",
            "kN/mm or MN/m",
        ),
        (TONNES[0].1, "198, 198, 198e3, 198, 154", "left.mass[3]", "198000.0", "all are in t; was it given in kg?"),
        (
            TONNES[2].1,
            "300e6, 300e3, 300e3, 300e3, 300e3",
            "left.stiffness[1]",
            "3e8",
            "all are in kN/m; was it given in N/m?",
        ),
        (TONNES[0].1, "198, 198, 0.198, 198, 154", "left.mass[3]", "0.198", "is its power of ten right?"),
        ("2.75e6", "2.75e9", "contact[1].stiffness", "2.75e9", "in kN/m^exponent, was it given in N/m^exponent?"),
        ("2.75e6", "2.75e3", "contact[1].stiffness", "2750.0", "in kN/m^exponent, was it given in MN/m^exponent?"),
        ("gap = 0.03\n", "gap = -0.03\n", "contact[1].gap", "-0.03", "kN, "),
        (
            "stiffness = 2.75e6",
            "exponent = 3.0\nstiffness = 2.75e6",
            "contact[1].exponent",
            "3.0",
            "the stiffness is in kN/m^exponent",
        ),
        (
            "128]\nstiffness = [141e3, 141e3, 141e3]\ndamping = { rayleigh = { ratio = 0.05, modes = [1, 3] } }",
            "128]\nstiffness = [141e3, 141e3, 141e3]\ndamping = { matrix = [[9e6, 0, 0], [0, 9e6, 0], [0, 0, 9e6]] }",
            "right.damping.matrix",
            "[[9000000.0, 0.0, 0.0], [0.0, 9000000.0, 0.0], [0.0, 0.0,...",
            "entries are in kN s/m",
        ),
    ] {
        let found = found(&format!("units = \"kN-t\"\n{}", edited(&tonnes, &[(from, to)])), None);
        assert_eq!((paths(&found).first(), found.len()), (Some(&path), 1), "{to}: {found:?}");
        assert_eq!(found[0].value, value);
        assert!(found[0].text.contains(words), "{words:?} is not in {}", found[0]);
    }
    // One building in SI units, then all of them.
    let left = edited(&tonnes, &[(TONNES[0].1, MASSES), (TONNES[2].1, STOREYS)]);
    let told = found(&format!("units = \"kN-t\"\n{left}"), None);
    assert_eq!(paths(&told), ["left.mass"], "{told:?}");
    assert!(
        told[0]
            .text
            .contains("masses are in t and stiffnesses in kN/m, were those of this building given in kg and N/m?")
    );
    let masses = edited(&tonnes, &[(TONNES[0].1, MASSES), (TONNES[1].1, TONNES[1].0)]);
    let told = found(&format!("units = \"kN-t\"\n{masses}"), None);
    assert_eq!(paths(&told), ["left.mass", "right.mass"], "{told:?}");
    assert!(told.iter().all(|warning| warning.text.contains("in t, were they given in kg?")), "{told:?}");
    let told = found(&format!("units = \"kN-t\"\n{OFFICES}"), None);
    assert_eq!(paths(&told), ["left.mass"], "{told:?}");
    assert!(told[0].text.contains("(units = \"SI\")") && told[0].text.contains("189000 t on average"), "{}", told[0]);
}

#[test]
fn one_entry_of_a_building() {
    expect(&[
        (OFFICES, &[(MASSES, "198e3, 198e3, 198, 198e3, 154e3")], &["left.mass[3]"], "given in t?"),
        (OFFICES, &[(MASSES, "198e3, 198e3, 198e3, 198e3, 154")], &["left.mass[5]"], "given in t?"),
        (OFFICES, &[(MASSES, "198e3, 198e3, 19.8e3, 198e3, 154e3")], &["left.mass[3]"], "power of ten"),
        (OFFICES, &[(MASSES, "198e3, 198e3, 198e3, 198, 154")], &["left.mass[4]"], "given in t?"),
        (OFFICES, &[(STOREYS, "300e6, 300e6, 300e3, 300e6, 300e6")], &["left.stiffness[3]"], "given in kN/m?"),
        (OFFICES, &[(STOREYS, "300e3, 300e6, 300e6, 300e6, 300e6")], &["left.stiffness[1]"], "given in kN/m?"),
        (OFFICES, &[(STOREYS, "300e9, 300e6, 300e6, 300e6, 300e6")], &["left.stiffness[1]"], "power of ten"),
        (OFFICES, &[(STOREYS, "300e6, 30e6, 300e6, 300e6, 300e6")], &["left.stiffness[2]"], "power of ten"),
        (FEUP, &[("mass = [3.65, 3.65]", "mass = [3.65, 3650.0]")], &["left.mass[2]"], "1000 times"),
        (FEUP, &[("mass = [3.65, 3.65]", "mass = [0.00365, 3.65]")], &["left.mass[1]"], "1/1000 of"),
        (FEUP, &[("[2910.0, 2910.0, 2910.0]", "[2910.0, 2910.0, 2.91]")], &["right.stiffness[3]"], "1/1000 of"),
    ]);
}

#[test]
fn damping_and_start_of_a_building() {
    const RAYLEIGH: &str = "rayleigh = { ratio = 0.05, modes = [1, 3] }";
    const MASS: &str = "mass = [3.65, 3.65]\n";
    expect(&[
        (FEUP, &[("ratio = 0.01", "ratio = 5.0")], &["left.damping.ratio", "right.damping.ratio"], "percent (0.05)"),
        (OFFICES, &[(RAYLEIGH, "ratio = 0.5")], &["left.damping.ratio", "right.damping.ratio"], "hardly swing"),
        (
            OFFICES,
            &[("ratio = 0.05, ", "ratio = 5, ")],
            &["left.damping.rayleigh.ratio", "right.damping.rayleigh.ratio"],
            "creep",
        ),
        (
            FEUP,
            &[(
                "stiffness = [2910.0, 2910.0]\ndamping = { ratio = 0.01 }",
                "stiffness = [2910.0, 2910.0]\ndamping = { ratios = [0.01, 2.0] }",
            )],
            &["left.damping.ratios[2]"],
            "percent (0.02)",
        ),
        (FEUP, &[("ratio = 0.01", "ratio = 1e-4")], &["left.damping.ratio", "right.damping.ratio"], "no damping"),
        // 5 % of the first mode would be some [[11.3, -5], [-5, 6.3]] N s/m.
        (
            FEUP,
            &[(
                "stiffness = [2910.0, 2910.0]\ndamping = { ratio = 0.01 }",
                "stiffness = [2910.0, 2910.0]\ndamping = { matrix = [[0.0113, -0.005], [-0.005, 0.0063]] }",
            )],
            &["left.damping.matrix"],
            "another unit",
        ),
        (
            FEUP,
            &[(
                "stiffness = [2910.0, 2910.0]\ndamping = { ratio = 0.01 }",
                "stiffness = [2910.0, 2910.0]\ndamping = { matrix = [[11300, -5000], [-5000, 6300]] }",
            )],
            &["left.damping.matrix"],
            "another unit",
        ),
        (
            FEUP,
            &[(MASS, "mass = [3.65, 3.65]\ninitial_displacement = [10.0, 10.0]\n")],
            &["left.initial_displacement"],
            "in mm?",
        ),
        (
            FEUP,
            &[(MASS, "mass = [3.65, 3.65]\ninitial_velocity = [0.0, -300.0]\n")],
            &["left.initial_velocity"],
            "mm/s",
        ),
        (FEUP, &[(MASS, "mass = [3.65, 3.65]\ninitial_velocity = [0.0, 30.0]\n")], &["left.initial_velocity"], "km/h"),
    ]);
}
