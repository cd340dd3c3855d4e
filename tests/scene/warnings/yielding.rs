//! Storeys that yield: what looks like a slip in their forces and in the damping of isolators.

use super::{OFFICES, Slip, edited, expect, found, paths};

const YIELDING: &str = include_str!("../../../examples/scenes/yielding.toml");
const ISOLATED: &str = include_str!("../../../examples/scenes/isolated.toml");
const FORCES: &str = "[1490, 1330, 1010, 530]";
/// Of [`OFFICES`], in SI units.
const STIFFNESS: &str = "stiffness = [300e6, 300e6, 300e6, 300e6, 300e6]";

#[test]
fn forces_that_are_never_reached_or_always_exceeded() {
    expect(&[
        (YIELDING, &[(FORCES, "[1490e3, 1330e3, 1010e3, 530e3]")], &["left.yield_force"], "200 times the weight above"),
        (YIELDING, &[(FORCES, "[1490e3, inf, 1010e3, inf]")], &["left.yield_force"], "was it given in N?"),
        (YIELDING, &[(FORCES, "[1490, 1330, 1010, 530e3]")], &["left.yield_force[4]"], "never yield, which inf"),
        (YIELDING, &[(FORCES, "[14.9, 1330, 1010, 530]")], &["left.yield_force[1]"], "0.002 times the weight above"),
        (YIELDING, &[(FORCES, "[1490, 1330, 1010, 5.3]")], &["left.yield_force[4]"], "slide all the time"),
        (
            OFFICES,
            &[(
                STIFFNESS,
                "stiffness = [300e6, 300e6, 300e6, 300e6, 300e6]\nyield_force = [1900, 1750, 1450, 1050, 550]",
            )],
            &["left.yield_force"],
            "was it given in kN?",
        ),
    ]);
}

#[test]
fn a_storey_unlike_those_beside_it() {
    let slips: [Slip; 4] = [
        (YIELDING, &[(FORCES, "[1490, 133, 1010, 530]")], &["left.yield_force[2]"], "is its power of ten right?"),
        (YIELDING, &[(FORCES, "[1490, 1330, 10100, 530]")], &["left.yield_force[3]"], "8.47 times that of the storeys"),
        (YIELDING, &[(FORCES, "[1490, 1330, 1010, 53]")], &["left.yield_force[4]"], "1/7.17 of that of the storeys"),
        (YIELDING, &[(FORCES, "[20000, 1330, inf, 530]")], &["left.yield_force[1]"], "2.68 times the weight above, "),
    ];
    expect(&slips);
}

/// Their own dashpots, N s/m, are what they have.
#[test]
fn a_damping_ratio_of_isolators() {
    const DASHPOTS: &str = "damping = { dashpots = [1350, 1500, 1500, 1250, 1000] }";
    const YIELDS: &str = "yield_force = [620, inf, inf, inf, inf]\npost_yield_ratio = 0.1";
    for (damping, path) in [
        ("ratio = 0.05", "left.damping.ratio"),
        ("ratios = [0.05, 0.02, 0.02, 0.02, 0.02]", "left.damping.ratios[1]"),
        ("rayleigh = { ratio = 0.05, modes = [1, 3] }", "left.damping.rayleigh.ratio"),
    ] {
        let text = edited(ISOLATED, &[(DASHPOTS, &format!("{YIELDS}\ndamping = {{ {damping} }}"))]);
        let told = found(&text, None);
        assert_eq!(paths(&told), [path], "{told:?}");
        assert!(told[0].text.contains("0.0445 times the weight, as isolators do"), "{}", told[0]);
        // Isolators without damping; storeys that carry as little or more; a first storey that is no isolator.
        for (from, to) in [
            ("0.05", "0.0"),
            ("620, inf", "620, 1300"),
            ("620, inf", "1700, inf"),
            ("620, inf, inf, inf, inf", "inf, 1300, 900, 600, 300"),
        ] {
            assert_eq!(found(&edited(&text, &[(from, to)]), None), [], "{damping}: {to}");
        }
        assert_eq!(paths(&found(&edited(&text, &[("620, inf", "620, 4000")]), None)), [path]);
    }
}

#[test]
fn sound_buildings_that_yield() {
    const DAMPING: &str = "damping = { dashpots";
    for (scene, from, to) in [
        (YIELDING, FORCES, "[745, 665, 505, 265]"),
        (YIELDING, FORCES, "[7450, 6650, 5050, 2650]"),
        (YIELDING, FORCES, "[1490, inf, inf, inf]"),
        (YIELDING, "post_yield_ratio = 0.05", "post_yield_ratio = 0"),
        (YIELDING, "pga = 3.43", "pga = 0.6"),
        // Isolators of 2 and 4 % of the weight, under storeys that can yield, too.
        (ISOLATED, DAMPING, "yield_force = [280, inf, inf, inf, inf]\ndamping = { dashpots"),
        (ISOLATED, DAMPING, "yield_force = [560, 4000, 3500, 2500, 1200]\ndamping = { dashpots"),
    ] {
        let found = found(&edited(scene, &[(from, to)]), None);
        assert!(found.is_empty(), "{to}: {found:?}");
    }
}
