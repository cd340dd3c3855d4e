//! Storeys that yield: what looks like a slip in their forces and in the damping beside them.

use super::{OFFICES, Slip, edited, expect, found};

const YIELDING: &str = include_str!("../../examples/scenes/yielding.toml");
const ISOLATED: &str = include_str!("../../examples/scenes/isolated.toml");
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
            &["left.yield_force", "left.damping.rayleigh"],
            "was it given in kN?",
        ),
    ]);
}

#[test]
fn a_storey_unlike_those_beside_it() {
    let slips: [Slip; 4] = [
        (YIELDING, &[(FORCES, "[1490, 133, 1010, 530]")], &["left.yield_force[2]"], "is its power of ten right?"),
        (YIELDING, &[(FORCES, "[1490, 1330, 10100, 530]")], &["left.yield_force[3]"], "8.5 times that of the storeys"),
        (YIELDING, &[(FORCES, "[1490, 1330, 1010, 53]")], &["left.yield_force[4]"], "1/7.2 of that of the storeys"),
        (YIELDING, &[(FORCES, "[14900, 1330, inf, 530]")], &["left.yield_force[1]"], "2 times the weight above, "),
    ];
    expect(&slips);
}

#[test]
fn rayleigh_damping_beside_yield_forces() {
    const RATIO: &str = "{ ratio = 0.05 }";
    let rayleigh = edited(YIELDING, &[(RATIO, "{ rayleigh = { ratio = 0.05, modes = [1, 3] } }")]);
    let told = found(&rayleigh, None);
    let lines: Vec<String> = told.iter().map(ToString::to_string).collect();
    let expected = "damping.rayleigh = { ratio = 0.05, modes = [1, 3] }: beside yield_force dashpots in proportion to the \
                    initial stiffness resist a storey that yields by forces that no building has; { ratio = 0.05 } does not";
    assert_eq!(lines, ["left", "right"].map(|side| format!("{side}.{expected}")));
    // No storey that can yield, no damping.
    let elastic = edited(&rayleigh, &[(FORCES, "[inf, inf, inf, inf]"), ("[1150, 940, 540]", "[inf, inf, inf]")]);
    assert_eq!(found(&elastic, None), []);
    assert_eq!(found(&edited(&rayleigh, &[("ratio = 0.05", "ratio = 0.0")]), None), []);
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
