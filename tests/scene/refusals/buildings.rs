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
