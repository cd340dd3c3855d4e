//! Masses, stiffnesses and dampings.

use super::expect;
use crate::{SHORT, edited, messages};

#[test]
fn masses() {
    expect(&[
        ("[3.0, 4.0]", "[3.0, -4.0]", &["left.mass[2] = -4.0: expected a finite mass > 0 kg"]),
        (
            "[3.0, 4.0]",
            "[0, nan]",
            &["left.mass[1] = 0.0: expected a finite mass > 0 kg", "left.mass[2] = nan: expected a finite mass > 0 kg"],
        ),
        (
            "[3.0, 4.0]",
            "[\"3\", -4]",
            &["left.mass[1] = \"3\": expected a number", "left.mass[2] = -4.0: expected a finite mass > 0 kg"],
        ),
        (
            "[3.0, 4.0]",
            "3.0",
            &["left.mass = 3.0: expected a list of numbers, [3.0] for one floor, [3.0, 3.0] for two"],
        ),
        ("[3.0, 4.0]", "[]", &["left.mass = []: expected at least one floor"]),
        ("mass = [3.0, 4.0]", "", &["left.mass: expected a list of masses in kg, one per floor (missing)"]),
    ]);
}

#[test]
fn storey_stiffnesses() {
    expect(&[
        ("[2910.0, 2920.0]", "[2910.0, 0]", &["left.stiffness[2] = 0.0: expected a finite stiffness > 0 N/m"]),
        ("[2910.0, 2920.0]", "[2910.0]", &["left.stiffness = [2910.0]: expected 2 numbers, one per storey, not 1"]),
        (
            "[2910.0, 2920.0]",
            "[1, 2, -3]",
            &[
                "left.stiffness = [1.0, 2.0, -3.0]: expected 2 numbers, one per storey, not 3",
                "left.stiffness[3] = -3.0: expected a finite stiffness > 0 N/m",
            ],
        ),
        (
            "stiffness = [2910.0, 2920.0]",
            "",
            &["left.stiffness: expected a list in N/m, one per storey, or stiffness_matrix (missing)"],
        ),
        (
            "stiffness = [2910.0, 2920.0]",
            "stiffness = [1.0, -2.0]\nstiffness_matrix = [[2, -1], [-1, 2]]",
            &[
                "left.stiffness[2] = -2.0: expected a finite stiffness > 0 N/m",
                "left.stiffness_matrix = [[2, -1], [-1, 2]]: expected either stiffness or stiffness_matrix, not both",
            ],
        ),
    ]);
}

#[test]
fn matrices() {
    let stiffness =
        |matrix: &str| messages(&edited("stiffness = [2910.0, 2920.0]", &format!("stiffness_matrix = {matrix}")));
    assert_eq!(
        stiffness("[1, 2]"),
        [
            "left.stiffness_matrix[1] = 1: expected a list of numbers",
            "left.stiffness_matrix[2] = 2: expected a list of numbers",
        ]
    );
    assert_eq!(
        stiffness("[[1, 0, 0], [0, 1, 0], [0, 0, 1]]"),
        [
            "left.stiffness_matrix = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]: expected 2 rows, one per floor, not 3"
        ],
        "one mistake, said once"
    );
    assert_eq!(stiffness("[[1, 2]]"), ["left.stiffness_matrix = [[1.0, 2.0]]: expected 2 rows, one per floor, not 1"]);
    assert_eq!(
        stiffness("[[1, 2], [3]]"),
        ["left.stiffness_matrix[2] = [3.0]: expected 2 numbers, one per floor, not 1"]
    );
    assert_eq!(
        stiffness("[[1, nan], [0, inf]]"),
        [
            "left.stiffness_matrix[1][2] = nan: expected a finite number",
            "left.stiffness_matrix[2][2] = inf: expected a finite number",
        ]
    );
    assert_eq!(
        stiffness("[[3, -1], [-1.5, 3]]"),
        ["left.stiffness_matrix[2][1] = -1.5: expected -1.0, as in [1][2]: a symmetric matrix"]
    );
    let not_definite = |matrix: &str, least: &str, largest: &str| {
        let range = format!("eigenvalues go from {least} to {largest} N/m");
        format!("left.stiffness_matrix = {matrix}: expected a positive definite matrix, but its {range}")
    };
    for (matrix, least, largest) in [
        ("[[1.0, 2.0], [2.0, 1.0]]", "-1.0", "3.0"),
        ("[[1.0, -1.0], [-1.0, 1.0]]", "0.0", "2.0"),
        ("[[0.0, 0.0], [0.0, 0.0]]", "0.0", "0.0"),
        ("[[-2.0, 0.0], [0.0, -1.0]]", "-2.0", "-1.0"),
        ("[[1.0, 0.0], [0.0, 5e-13]]", "5e-13", "1.0"),
    ] {
        assert_eq!(stiffness(matrix), [not_definite(matrix, least, largest)]);
    }
    expect(&[(
        "{ ratio = 0.01 }",
        "{ matrix = [[1, 2], [2, 1]] }",
        &[
            "left.damping.matrix = [[1.0, 2.0], [2.0, 1.0]]: expected a positive semidefinite matrix, but its eigenvalues \
           go from -1.0 to 3.0 N s/m",
        ],
    )]);
}

#[test]
fn dampings() {
    const MISSING: &str = "expected one of ratio, ratios, rayleigh, dashpots, matrix";
    assert_eq!(messages(&edited("{ ratio = 0.01 }", "{}")), [format!("left.damping = {{}}: {MISSING}")]);
    let typo = "left.damping.rato = 0.01: expected a known key (ratio, ratios, rayleigh, dashpots, matrix); did you mean ratio?";
    let missing = format!("left.damping = {{ rato = 0.01 }}: {MISSING}");
    assert_eq!(messages(&edited("{ ratio = 0.01 }", "{ rato = 0.01 }")), [missing.as_str(), typo]);
    expect(&[
        (
            "damping = { ratio = 0.01 }",
            "",
            &["left.damping: expected a table with one of ratio, ratios, rayleigh, dashpots, matrix (missing)"],
        ),
        ("{ ratio = 0.01 }", "0.01", &["left.damping = 0.01: expected a table, such as { ratio = 0.01 }"]),
        (
            "{ ratio = 0.01 }",
            "{ ratio = -0.01, ratios = [0.01, 0.02] }",
            &[
                "left.damping.ratio = -0.01: expected a finite damping ratio >= 0",
                "left.damping.ratios = [0.01, 0.02]: expected one kind of damping only",
            ],
        ),
        (
            "{ ratio = 0.01 }",
            "{ ratios = [0.01, -0.02] }",
            &["left.damping.ratios[2] = -0.02: expected a finite damping ratio >= 0"],
        ),
        (
            "{ ratio = 0.01 }",
            "{ ratios = [0.01] }",
            &["left.damping.ratios = [0.01]: expected 2 numbers, one per mode, not 1"],
        ),
    ]);
}

#[test]
fn rayleigh() {
    expect(&[
        ("ratio = 0.05", "ratio = -1", &["right.damping.rayleigh.ratio = -1.0: expected a finite damping ratio >= 0"]),
        ("ratio = 0.05, ", "", &["right.damping.rayleigh.ratio: expected the damping ratio in both modes (missing)"]),
        (", modes = [1, 3]", "", &["right.damping.rayleigh.modes: expected two modes, counted from 1 (missing)"]),
        ("[1, 3]", "[2, 2]", &["right.damping.rayleigh.modes = [2, 2]: expected two different modes"]),
        (
            "[1, 3]",
            "[0, 4]",
            &[
                "right.damping.rayleigh.modes[1] = 0: expected a mode from 1 to 3",
                "right.damping.rayleigh.modes[2] = 4: expected a mode from 1 to 3",
            ],
        ),
        (
            "[1, 3]",
            "[-1, 1.0]",
            &[
                "right.damping.rayleigh.modes[1] = -1: expected a whole number from 1 on",
                "right.damping.rayleigh.modes[2] = 1.0: expected a whole number from 1 on",
            ],
        ),
        ("[1, 3]", "[1, 2, 3]", &["right.damping.rayleigh.modes = [1, 2, 3]: expected two modes, counted from 1"]),
        ("[1, 3]", "1", &["right.damping.rayleigh.modes = 1: expected two modes, counted from 1"]),
    ]);
    let one_floor = SHORT.replacen("ratio = 0", "rayleigh = { ratio = 0.1, modes = [1, 2] }", 1);
    let expected = "left.damping.rayleigh.modes = [1, 2]: expected a building with at least 2 floors; with 1 floor give \
                    damping = { ratio = ... }";
    assert_eq!(messages(&one_floor), [expected]);
}

#[test]
fn yield_forces() {
    const DAMPING: &str = "damping = { ratio = 0.01 }";
    let said = |keys: &str| messages(&edited(DAMPING, &format!("{DAMPING}\n{keys}")));
    for fine in [
        "yield_force = [40.0, 30]",
        "yield_force = [inf, 1e-9]",
        "yield_force = [inf, inf]\npost_yield_ratio = 0",
        "yield_force = [40.0, inf]\npost_yield_ratio = [0.999, 0.0]",
    ] {
        assert_eq!(said(fine), [""; 0], "{fine}");
    }
    const FORCE: &str = "expected a force > 0 N, or inf for a storey that stays elastic";
    for (force, of) in [
        ("[40.0, -3.0]", "[2] = -3.0"),
        ("[0, 30.0]", "[1] = 0.0"),
        ("[nan, 30.0]", "[1] = nan"),
        ("[40.0, -inf]", "[2] = -inf"),
    ] {
        assert_eq!(said(&format!("yield_force = {force}")), [format!("left.yield_force{of}: {FORCE}")]);
    }
    for (keys, expected) in [
        ("yield_force = [40.0]", "left.yield_force = [40.0]: expected 2 numbers, one per storey, not 1"),
        ("yield_force = [inf, 1, 2]", "left.yield_force = [inf, 1, 2]: expected 2 numbers, one per storey, not 3"),
        ("yield_force = [40.0, \"much\"]", "left.yield_force[2] = \"much\": expected a number"),
        (
            "yield_force = 40.0",
            "left.yield_force = 40.0: expected a list of numbers, [40.0] for one storey, [40.0, 40.0] for two",
        ),
        (
            "post_yield_ratio = 0.1",
            "left.post_yield_ratio = 0.1: expected yield_force as well, the storey shears at first yield",
        ),
    ] {
        assert_eq!(said(keys), [expected]);
    }
    let matrix = edited("stiffness = [2910.0, 2920.0]", "stiffness_matrix = [[3, -1], [-1, 2]]\nyield_force = [1, 2]");
    let expected = "left.yield_force = [1, 2]: expected a shear building, with stiffness instead of stiffness_matrix: only \
                    storeys yield";
    assert_eq!(messages(&matrix), [expected]);
    let typo = said("yield_forces = [40.0, 30.0]");
    assert!(typo.len() == 1 && typo[0].ends_with("did you mean yield_force?"), "{typo:?}");
}

#[test]
fn post_yield_ratios() {
    const DAMPING: &str = "damping = { ratio = 0.01 }";
    let said = |ratio: &str| {
        messages(&edited(DAMPING, &format!("{DAMPING}\nyield_force = [40.0, inf]\npost_yield_ratio = {ratio}")))
    };
    for (ratio, of) in [
        ("-0.1", " = -0.1"),
        ("1", " = 1"),
        ("1.5", " = 1.5"),
        ("nan", " = nan"),
        ("inf", " = inf"),
        ("[0.1, 1.0]", "[2] = 1.0"),
        ("[-1e-300, 0.0]", "[1] = -1e-300"),
        ("[0.0, nan]", "[2] = nan"),
    ] {
        assert_eq!(said(ratio), [format!("left.post_yield_ratio{of}: expected 0 <= r < 1")], "{ratio}");
    }
    let expected = "left.post_yield_ratio = [0.1]: expected 2 numbers, one per storey, not 1";
    assert_eq!(said("[0.1]"), [expected]);
    let several = said("[\"5 %\", 2.0]");
    assert_eq!(several.len(), 2, "{several:?}");
}
