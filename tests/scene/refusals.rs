//! What a user may not write, and what is said about it.

use super::{SCENE, SHORT, edited, messages};
use pounding::contact::LawKind;
use pounding::scene::{Damping, Scene, Stiffness, law_key};

/// One change of the scene and all that is then said about it.
type Refusal = (&'static str, &'static str, &'static [&'static str]);

fn expect(refusals: &[Refusal]) {
    for (from, to, expected) in refusals {
        assert_eq!(messages(&edited(from, to)), *expected, "{from:?} -> {to:?}");
    }
}

#[test]
fn names_and_times() {
    const NOT_C: &str = "expected a C identifier: letters, digits and _, no digit first";
    for name in ["2 frames", "Zwei_Türme", "", "a-b"] {
        let expected = format!("name = \"{name}\": {NOT_C}");
        assert_eq!(messages(&edited("TwoFrames", name)), [expected]);
    }
    let longest = "n".repeat(128);
    assert!(Scene::from_toml(&edited("TwoFrames", &longest)).is_ok());
    let too_long = messages(&edited("TwoFrames", &(longest + "n")));
    assert_eq!(too_long.len(), 1);
    assert!(too_long[0].starts_with("name = \"nnn"), "{too_long:?}");
    assert!(too_long[0].ends_with(": expected a C identifier of at most 128 characters"), "{too_long:?}");
    expect(&[
        ("name = \"TwoFrames\"", "", &["name: expected a C identifier (missing)"]),
        ("TwoFrames", "double", &["name = \"double\": expected a C identifier that is not a keyword of C"]),
        ("\"TwoFrames\"", "2", &["name = 2: expected text in quotation marks"]),
        ("a test", "\\u0001", &["description = \"\\u{1}\": expected text without control characters"]),
        ("stop_time = 20.0", "stop_time = 0", &["stop_time = 0.0: expected a finite time > 0 s"]),
        ("stop_time = 20.0", "stop_time = inf", &["stop_time = inf: expected a finite time > 0 s"]),
        ("stop_time = 20.0", "stop_time = \"20 s\"", &["stop_time = \"20 s\": expected a number"]),
        ("stop_time = 20.0", "stop_time = 1e400", &["stop_time = 1e400: expected a number"]),
        ("stop_time = 20.0", "stop_time = 1979-05-27", &["stop_time = 1979-05-27: expected a number"]),
    ]);
}

#[test]
fn keys() {
    const KNOWN: &str =
        "a known key (name, description, stop_time, left, right, ground, inputs, contact, outputs, solver)";
    let message = |found: &str, suggestion: &str| format!("{found}: expected {KNOWN}{suggestion}");
    let stop_time = edited("stop_time", "stoptime");
    assert_eq!(messages(&stop_time), [message("stoptime = 20.0", "; did you mean stop_time?")]);
    let inputs = edited("[inputs]", "[input]");
    assert_eq!(messages(&inputs), [message("input = [input]", "; did you mean inputs?")]);
    let quoted = edited("stop_time = 20.0", "\"a.b\" = [1,\n 2]");
    assert_eq!(messages(&quoted), [message("\"a.b\" = [1, 2]", "")]);
    let dotted = edited("stop_time = 20.0", "a.b = 1");
    assert_eq!(messages(&dotted), [message("a = a", "")]);
    expect(&[
        ("energy = true", "work = true", &["outputs.work = true: expected a known key (energy)"]),
        ("energy = true", "energy = \"yes\"", &["outputs.energy = \"yes\": expected true or false"]),
        ("floor_forces = true", "floor_forces = 1", &["inputs.floor_forces = 1: expected true or false"]),
        (
            "floor_forces = true",
            "floor_force = true",
            &["inputs.floor_force = true: expected a known key (floor_forces); did you mean floor_forces?"],
        ),
    ]);
}

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
        ("[3.0, 4.0]", "3.0", &["left.mass = 3.0: expected a list of numbers"]),
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
    const MISSING: &str = "expected one of ratio, ratios, rayleigh, matrix";
    assert_eq!(messages(&edited("{ ratio = 0.01 }", "{}")), [format!("left.damping = {{}}: {MISSING}")]);
    let typo = "left.damping.rato = 0.01: expected a known key (ratio, ratios, rayleigh, matrix); did you mean ratio?";
    let missing = format!("left.damping = {{ rato = 0.01 }}: {MISSING}");
    assert_eq!(messages(&edited("{ ratio = 0.01 }", "{ rato = 0.01 }")), [missing.as_str(), typo]);
    expect(&[
        (
            "damping = { ratio = 0.01 }",
            "",
            &["left.damping: expected a table with one of ratio, ratios, rayleigh, matrix (missing)"],
        ),
        ("{ ratio = 0.01 }", "0.01", &["left.damping = 0.01: expected a table"]),
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
fn initial_conditions_and_solver() {
    expect(&[
        (
            "[0.0, 0.001, 0.002]",
            "[0.0, 0.001]",
            &["right.initial_displacement = [0.0, 0.001]: expected 3 numbers, one per floor, not 2"],
        ),
        (
            "[0.0, 0.001, 0.002]",
            "[0.0, nan, 0]",
            &["right.initial_displacement[2] = nan: expected a finite displacement in m"],
        ),
        (
            "[0.0, 0.1, 0.2]",
            "[0.0, 0.1, -inf]",
            &["right.initial_velocity[3] = -inf: expected a finite velocity in m/s"],
        ),
        ("1e-10", "1e-15", &["solver.relative_tolerance = 1e-15: expected 1e-15 < tolerance <= 1e-2"]),
        ("1e-10", "0.1", &["solver.relative_tolerance = 0.1: expected 1e-15 < tolerance <= 1e-2"]),
        ("1e-3", "0.0", &["solver.min_approach_velocity = 0.0: expected a finite velocity > 0 m/s"]),
        ("1e-3", "-1e-3", &["solver.min_approach_velocity = -0.001: expected a finite velocity > 0 m/s"]),
        ("1e-3", "inf", &["solver.min_approach_velocity = inf: expected a finite velocity > 0 m/s"]),
        ("[solver]", "[[solver]]", &["solver = [[solver]]: expected a table"]),
    ]);
}

#[test]
fn ground() {
    let ground = |table: &str| messages(&format!("{SHORT}\n[ground]\n{table}"));
    assert_eq!(ground("scale = 1.0"), ["ground.scale = 1.0: expected a record to scale, in ground.record"]);
    assert_eq!(ground("pga = -1.0"), ["ground.pga = -1.0: expected a record to scale, in ground.record"]);
    assert_eq!(
        ground("record = \"a\"\nscale = inf\npga = 2"),
        ["ground.scale = inf: expected a finite factor", "ground.pga = 2: expected either scale or pga, not both"]
    );
    assert_eq!(ground("record = \"a\"\npga = 0"), ["ground.pga = 0.0: expected a finite peak acceleration > 0 m/s2"]);
    assert_eq!(ground("record = \" \""), ["ground.record = \" \": expected the name of a record file"]);
    assert_eq!(ground("record = 1\npga = 1"), ["ground.record = 1: expected text in quotation marks"]);
}

#[test]
fn contacts() {
    expect(&[
        ("right_floor = 1\n", "", &["contact[1].right_floor: expected a floor, counted from 1 (missing)"]),
        (
            "right_floor = 1\n",
            "right_floor = 4\n",
            &["contact[1].right_floor = 4: expected a floor of the right building, from 1 to 3"],
        ),
        (
            "left_floor = 2\n",
            "left_floor = 0\n",
            &["contact[2].left_floor = 0: expected a floor of the left building, from 1 to 2"],
        ),
        ("left_floor = 2\n", "left_floor = -1\n", &["contact[2].left_floor = -1: expected a whole number from 1 on"]),
        (
            "left_floor = 2\nright_floor = 2",
            "left_floor = 1\nright_floor = 1",
            &["contact[2] = left_floor 1, right_floor 1: expected a pair of floors other than that of contact[1]"],
        ),
        ("gap = 0.002\n", "", &["contact[1].gap: expected the clear distance at rest in m (missing)"]),
        ("gap = 0.002\n", "gap = nan\n", &["contact[1].gap = nan: expected a finite distance in m"]),
        // A key that is the beginning of another does not hide it.
        (
            "gap = 0.002\n",
            "g = 1\ngap = nan\n",
            &[
                "contact[1].g = 1: expected a key of law kelvin_voigt (left_floor, right_floor, gap, law, stiffness, \
                 restitution)",
                "contact[1].gap = nan: expected a finite distance in m",
            ],
        ),
    ]);
    let contact = |value: &str| messages(&format!("contact = {value}\n{SHORT}"));
    assert_eq!(contact("3"), ["contact = 3: expected [[contact]] tables"]);
    assert_eq!(contact("[3]"), ["contact[1] = 3: expected a table"]);
    // Two contacts whose floors are unknown are not the same pair.
    let missing =
        |i: usize| ["left_floor", "right_floor", "gap", "law"].map(|key| format!("contact[{i}].{key}: expected "));
    let said = contact("[{}, {}]");
    assert_eq!(said.len(), 8, "{said:?}");
    for (line, start) in said.iter().zip([missing(1), missing(2)].iter().flatten()) {
        assert!(line.starts_with(start) && line.ends_with("(missing)"), "{line}");
    }
    let one_table = format!("{SHORT}\n[contact]\ngap = 1");
    assert_eq!(messages(&one_table), ["contact = [contact]: expected [[contact]] tables"]);
}

#[test]
fn laws() {
    expect(&[
        ("stiffness = 1.0e6\n", "", &["contact[1].stiffness: expected a finite stiffness > 0 (missing)"]),
        ("stiffness = 1.0e6\n", "stiffness = 0\n", &["contact[1].stiffness = 0.0: expected a finite stiffness > 0"]),
        ("restitution = 0.65", "", &["contact[1].restitution: expected 0 < e <= 1 (missing)"]),
        ("restitution = 0.65", "restitution = 1.4", &["contact[1].restitution = 1.4: expected 0 < e <= 1"]),
        ("restitution = 0.65", "restitution = 0.0", &["contact[1].restitution = 0.0: expected 0 < e <= 1"]),
        ("2.0e6", "2.0e6\nexponent = 0.9", &["contact[2].exponent = 0.9: expected 1 <= n <= 3"]),
        ("2.0e6", "2.0e6\nexponent = 3.1", &["contact[2].exponent = 3.1: expected 1 <= n <= 3"]),
        (
            "restitution = 0.65",
            "restitution = 0.65\nexponent = 1.5",
            &["contact[1].exponent = 1.5: expected a key of law kelvin_voigt (left_floor, right_floor, gap, law, \
               stiffness, restitution)"],
        ),
        (
            "stiffness = 2.0e6",
            "stifness = 2.0e6",
            &[
                "contact[2].stiffness: expected a finite stiffness > 0 (missing)",
                "contact[2].stifness = 2.0e6: expected a key of law hertz (left_floor, right_floor, gap, law, stiffness, \
                 exponent); did you mean stiffness?",
            ],
        ),
    ]);
}

#[test]
fn restitution_of_every_law() {
    for law in LawKind::ALL.iter().map(|law| law.info()) {
        let Some(key) = law.keys.iter().find(|key| law_key::number(**key).name == "restitution") else { continue };
        let others =
            law.keys.iter().filter(|other| *other != key).map(|key| format!("{} = 1\n", law_key::number(*key).name));
        let formula = law.has_damping_formula.then_some("damping_formula = \"exact\"\n".to_owned());
        let others: String = others.chain(formula).collect();
        let said = |restitution: &str| {
            let head = "left_floor = 1\nright_floor = 1\ngap = 0.1\n";
            messages(&format!("{SHORT}\n[[contact]]\n{head}law = \"{}\"\n{others}{restitution}", law.name))
        };
        let rigid = law.name == "stereomechanical";
        let range = if rigid { "0 <= e <= 1" } else { "0 < e <= 1" };
        for e in ["-0.1", "1.0000000000000002", "nan", "inf"] {
            let expected = format!("contact[1].restitution = {e}: expected {range}");
            assert_eq!(said(&format!("restitution = {e}")), [expected], "{}", law.name);
        }
        let zero = [format!("contact[1].restitution = 0.0: expected {range}")];
        assert_eq!(said("restitution = 0"), if rigid { &[] } else { zero.as_slice() }, "{}", law.name);
        for e in ["1e-300", "1"] {
            assert_eq!(said(&format!("restitution = {e}")), [""; 0], "{}", law.name);
        }
        assert_eq!(said(""), [format!("contact[1].restitution: expected {range} (missing)")], "{}", law.name);
    }
}

#[test]
fn rigid_floors() {
    let rigid = |gap: &str, more: &str| {
        let contact = "gap = -0.001\nlaw = \"hertz\"\nstiffness = 2.0e6";
        messages(&edited(contact, &format!("gap = {gap}\nlaw = \"stereomechanical\"\nrestitution = 0.5\n{more}")))
    };
    // The right floor stands 1 mm to the right at the start: they touch.
    assert_eq!(rigid("-0.001", ""), [""; 0]);
    let overlap = "for law stereomechanical: the floors must not overlap at the start";
    assert_eq!(rigid("-0.00101", ""), [format!("contact[2].gap = -0.00101: expected at least -0.001 {overlap}")]);
    assert_eq!(rigid("nan", ""), ["contact[2].gap = nan: expected a finite distance in m"]);
    let keys = "a key of law stereomechanical (left_floor, right_floor, gap, law, restitution)";
    for key in ["stiffness = 1.0e6", "exponent = 1.5"] {
        assert_eq!(rigid("0.0", key), [format!("contact[2].{key}: expected {keys}")]);
    }
}

#[test]
fn laws_that_do_not_exist() {
    let names: Vec<_> = LawKind::ALL.iter().map(|law| law.info().name).collect();
    let names = names.join(", ");
    let said = messages(&edited("\"hertz\"", "\"herz\""));
    let [unknown] = said.as_slice() else { panic!("{said:?}") };
    assert_eq!(*unknown, format!("contact[2].law = \"herz\": expected a known law ({names}); did you mean hertz?"));
    let said = messages(&edited("law = \"hertz\"\nstiffness = 2.0e6", "lav = 1\nstiffness = \"2\""));
    let [missing, lav, stiffness] = said.as_slice() else { panic!("{said:?}") };
    assert_eq!(*missing, format!("contact[2].law: expected a law ({names}) (missing)"));
    assert!(lav.starts_with("contact[2].lav = 1: expected a known key (left_floor, right_floor, gap, law,"), "{lav}");
    assert!(lav.ends_with("; did you mean law?"), "{lav}");
    assert_eq!(stiffness, "contact[2].stiffness = \"2\": expected a number");
}

#[test]
fn damping_formulas_that_do_not_fit() {
    let damped = |rest: &str| edited("law = \"hertz\"\nstiffness = 2.0e6", &format!("law = {rest}\nstiffness = 2.0e6"));
    let said = messages(&damped("\"hertz_damped\"\nrestitution = 0.5"));
    let [missing] = said.as_slice() else { panic!("{said:?}") };
    assert!(missing.starts_with("contact[2].damping_formula: expected a damping formula (lankarani_"), "{missing}");
    assert!(missing.ends_with(") (missing)"), "{missing}");
    let said = messages(&damped("\"hertz_damped\"\nrestitution = 0.5\ndamping_formula = \"exakt\""));
    let [unknown] = said.as_slice() else { panic!("{said:?}") };
    assert!(
        unknown.starts_with("contact[2].damping_formula = \"exakt\": expected a known damping formula"),
        "{unknown}"
    );
    assert!(unknown.ends_with("; did you mean exact?"), "{unknown}");
    let said = messages(&damped("\"hertz_damped\"\nrestitution = 0.5\ndamping_formula = 3"));
    assert_eq!(said, ["contact[2].damping_formula = 3: expected text in quotation marks"]);
    let said = messages(&damped("\"jankowski\"\nrestitution = 0.0\ndamping_formula = \"ye\""));
    let [restitution, formula] = said.as_slice() else { panic!("{said:?}") };
    assert_eq!(restitution, "contact[2].restitution = 0.0: expected 0 < e <= 1");
    assert!(formula.starts_with("contact[2].damping_formula = \"ye\": expected a key of law jankowski"), "{formula}");
}

#[test]
fn text_that_is_not_toml() {
    let unclosed = messages(&edited("mass = [3.0, 4.0]", "mass = [3.0, 4.0"));
    assert_eq!(unclosed.len(), 1, "{unclosed:?}");
    assert!(unclosed[0].starts_with("line 8, column "), "{unclosed:?}");
    let twice = messages(&edited("stop_time = 20.0", "# ü\n  name = \"Twice\""));
    assert_eq!(twice, ["line 5, column 3: expected valid TOML, but duplicate key"]);
}

#[test]
fn an_empty_scene_lacks_three_things() {
    let expected = [
        "name: expected a C identifier (missing)",
        "left: expected the building on the left (missing)",
        "right: expected the building on the right (missing)",
    ];
    assert_eq!(messages(""), expected);
}

#[test]
fn all_problems_come_at_once_in_the_order_of_the_file() {
    let text = r#"
        [[contact]]
        right_floor = 9
        restitution = 1.4
        law = "kelvin_voigt"
        gap = 0.1
        left_floor = 1
        [solver]
        relative_tolerance = 2
        [right]
        stiffness = [1, -1]
        mass = [1, 1]
        damping.ratio = -0.5
        damping.ratios = [1, 1]
        [left]
        mass = ["x", -1]
        damping = { matrix = [[1, 0], [1, 1]] }
        stiffness_matrix = [[1, 0], [0, 1]]
        [[contact]]
        law = "linear"
        stiffness = -1
        [ground]
        pga = 1.0
    "#;
    let expected = [
        "name: expected a C identifier (missing)",
        "contact[1].stiffness: expected a finite stiffness > 0 (missing)",
        "contact[1].right_floor = 9: expected a floor of the right building, from 1 to 2",
        "contact[1].restitution = 1.4: expected 0 < e <= 1",
        "solver.relative_tolerance = 2.0: expected 1e-15 < tolerance <= 1e-2",
        "right.stiffness[2] = -1.0: expected a finite stiffness > 0 N/m",
        "right.damping.ratio = -0.5: expected a finite damping ratio >= 0",
        "right.damping.ratios = [1, 1]: expected one kind of damping only",
        "left.mass[1] = \"x\": expected a number",
        "left.mass[2] = -1.0: expected a finite mass > 0 kg",
        "left.damping.matrix[2][1] = 1.0: expected 0.0, as in [1][2]: a symmetric matrix",
        "contact[2].left_floor: expected a floor, counted from 1 (missing)",
        "contact[2].right_floor: expected a floor, counted from 1 (missing)",
        "contact[2].gap: expected the clear distance at rest in m (missing)",
        "contact[2].stiffness = -1.0: expected a finite stiffness > 0",
        "ground.pga = 1.0: expected a record to scale, in ground.record",
    ];
    assert_eq!(messages(text), expected);
}

#[test]
fn a_changed_scene_is_refused_in_the_words_of_the_file() {
    type Change = (&'static str, &'static str, fn(&mut Scene));
    let changes: [Change; 9] = [
        ("[3.0, 4.0]", "[3.0, -4.0]", |s| s.left.mass[1] = -4.0),
        ("[2910.0, 2920.0]", "[2910.0, nan]", |s| s.left.stiffness = Stiffness::Shear(vec![2910.0, f64::NAN])),
        ("{ ratio = 0.01 }", "{ ratio = -0.5 }", |s| s.left.damping = Damping::Ratio(-0.5)),
        ("gap = 0.002", "gap = inf", |s| s.contacts[0].gap = f64::INFINITY),
        ("restitution = 0.65", "restitution = 0.0", |s| s.contacts[0].law.restitution = 0.0),
        ("stiffness = 1.0e6", "stiffness = -1.0", |s| s.contacts[0].law.stiffness = -1.0),
        ("stiffness = 2.0e6", "stiffness = 2.0e6\nexponent = 4.0", |s| s.contacts[1].law.exponent = 4.0),
        ("1e-10", "0.5", |s| s.solver.relative_tolerance = 0.5),
        ("left_floor = 2", "left_floor = 3", |s| s.contacts[1].left_floor = 3),
    ];
    for (from, to, change) in changes {
        let mut scene = Scene::from_toml(SCENE).unwrap();
        change(&mut scene);
        let error = scene.check().unwrap_err();
        assert_eq!(Scene::from_toml(&edited(from, to)).unwrap_err(), error, "{to}");
    }
}
