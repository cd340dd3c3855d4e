//! Gravity on storeys that lean: left out, in other units, or beyond what they stand.

use super::{Slip, edited, expect, found, paths};

/// Two storeys whose weights over their heights are 0.065 and 0.044 of their stiffness.
const STOREYS: &str = r#"
name = "Gravity"
[left]
mass = [100e3, 100e3]
height = [3.0, 3.0]
stiffness = [1.0e7, 7.5e6]
p_delta = true
damping = { ratio = 0.05 }
initial_displacement = [0.0, 0.0]
[[contact]]
left_floor = 2
wall = "right"
gap = 0.05
law = "linear"
stiffness = 1e8
"#;
const HEIGHT: &str = "height = [3.0, 3.0]";
const PUSHED: &str = "p_delta = true";
const START: &str = "initial_displacement = [0.0, 0.0]";

#[test]
fn gravity_that_is_left_out() {
    let slips: [Slip; 2] = [
        (
            STOREYS,
            &[(PUSHED, ""), (HEIGHT, "height = [1.5, 1.5]")],
            &["left.p_delta"],
            "storey 1 over its height is 0.131",
        ),
        (
            STOREYS,
            &[(PUSHED, ""), (HEIGHT, "height = [0.9, 1.2]")],
            &["left.p_delta"],
            "(likewise 1 more), and codes neglect no more than 0.1: it matters, add p_delta = true",
        ),
    ];
    expect(&slips);
    // Small; said to be left out; bearings, by their height or their stiffness; no heights.
    for changes in [
        &[(PUSHED, "")][..],
        &[(PUSHED, "p_delta = false"), (HEIGHT, "height = [1.5, 1.5]")],
        &[(PUSHED, ""), (HEIGHT, "height = [0.5, 3.0]")],
        &[(PUSHED, ""), ("1.0e7, 7.5e6", "0.9e6, 7.5e6")],
        &[(PUSHED, ""), (HEIGHT, "")],
    ] {
        assert_eq!(found(&edited(STOREYS, changes), None), [], "{changes:?}");
    }
}

#[test]
fn a_stability_coefficient_that_codes_forbid() {
    let forbidden = edited(STOREYS, &[(HEIGHT, "height = [0.6, 3.0]")]);
    let told = found(&forbidden, None);
    assert_eq!(paths(&told), ["left.p_delta"], "{told:?}");
    assert!(told[0].to_string().starts_with("left.p_delta = true: storey 1 has the stability coefficient 0.327"));
    assert_eq!(found(&edited(STOREYS, &[(HEIGHT, "height = [0.7, 3.0]")]), None), []);
    assert_eq!(found(&edited(&forbidden, &[(PUSHED, "p_delta = [false, true]")]), None), []);
}

#[test]
fn storeys_that_may_fall() {
    const YIELDS: &str = "p_delta = true\nyield_force = [2e5, 2e5]\npost_yield_ratio = ";
    let with = |ratio: &str, changes: &[(&str, &str)]| {
        let text = edited(STOREYS, &[(PUSHED, &format!("{YIELDS}{ratio}"))]);
        found(&edited(&text, changes), None)
    };
    // 0.02 m x (1 - 0.03) / (0.0654 - 0.03).
    let told = with("[0.03, 0.05]", &[]);
    assert_eq!(paths(&told), ["left.p_delta"], "{told:?}");
    let text = "the stiffness after yield of storey 1 is negative, -0.0354 of the initial one; it can collapse beyond a drift \
                of 0.548 m";
    assert_eq!(told[0].text, text);
    assert!(with("0.03", &[])[0].text.ends_with("(likewise 1 more)"));
    assert_eq!(with("0.07", &[]), []);
    // Beyond 0.5 of the stiffness it falls as soon as it yields.
    let told = with("[0.03, 0.05]", &[(HEIGHT, "height = [0.36, 3.0]")]);
    assert_eq!(paths(&told), ["left.p_delta", "left.p_delta"], "{told:?}");
    assert!(told[1].text.ends_with("of 0.0377 m, only 1.88 times the drift at which it yields"), "{}", told[1]);

    let told = with("[0.03, 0.05]", &[(START, "initial_displacement = [-0.55, -0.55]")]);
    assert_eq!(paths(&told), ["left.initial_displacement", "left.p_delta"], "{told:?}");
    assert!(
        told[0].text.contains("storey 1 starts at a drift of -0.55 m, and beyond 0.548 m it resists no"),
        "{}",
        told[0]
    );
    assert_eq!(paths(&with("[0.03, 0.05]", &[(START, "initial_displacement = [-0.54, -0.54]")])), ["left.p_delta"]);
}

#[test]
fn loads_that_are_no_weights() {
    let loads = |loads: &str, scene: &str| {
        let told = found(&edited(scene, &[(PUSHED, &format!("{PUSHED}\ngravity_load = {loads}"))]), None);
        told.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n")
    };
    let in_kn = format!(
        "units = \"kN-t\"{}",
        edited(STOREYS, &[("[100e3, 100e3]", "[100, 100]"), ("[1.0e7, 7.5e6]", "[1.0e4, 7.5e3]")])
    );
    let in_kn = edited(&in_kn, &[("stiffness = 1e8", "stiffness = 1e5")]);
    for (scene, given, expected) in [
        (STOREYS, "[2e6, 2e6]", ""),
        (STOREYS, "[2e5, 0.0]", ""),
        (STOREYS, "[980.0, 980.0]", "left.gravity_load = [980.0, 980.0]: 1/1000 of the weight of the mass"),
        (STOREYS, "[980.0, 980.0]", "were they given in kN?"),
        (STOREYS, "[100e3, 100e3]", "was the mass given?"),
        (STOREYS, "[1e6, 1e5]", "left.gravity_load[2] = 100000.0: 1/9.81 of the weight"),
        (STOREYS, "[6e6, 1e6]", "left.gravity_load[1] = 6e6: 6.12 times the weight"),
        (STOREYS, "[0.0, 0.0]", "p_delta = false would say as well"),
        (&in_kn, "[980, 980]", ""),
        (&in_kn, "[0.98, 980]", "left.gravity_load[1] = 0.98: 1/1000 of the weight"),
    ] {
        let told = loads(given, scene);
        assert!(told.contains(expected) && told.is_empty() == expected.is_empty(), "{given}: {told}");
    }
}
