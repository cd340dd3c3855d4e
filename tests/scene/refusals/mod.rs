//! What a user may not write, and what is said about it: here all that is not of one building or one contact.

mod buildings;
mod contacts;
mod foundations;
mod gravity;
mod links;
mod meant;
mod meetings;
mod rows;
mod together;

use crate::{SCENE, SHORT, edited, messages};
use pounding::scene::{BuildingId, Damping, Face, Scene, Stiffness};

/// Of the left building.
const DAMPING: &str = "damping = { ratio = 0.01 }";
const STIFFNESS: &str = "stiffness = [2910.0, 2920.0]";

/// What is said of more keys of the left building.
fn said(keys: &str) -> Vec<String> {
    messages(&edited(DAMPING, &format!("{DAMPING}\n{keys}")))
}

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
        ("stop_time = 20.0", "stop_time = 0", &["stop_time = 0.0: expected a time > 0 s and at most 1e12 s"]),
        ("stop_time = 20.0", "stop_time = inf", &["stop_time = inf: expected a time > 0 s and at most 1e12 s"]),
        ("stop_time = 20.0", "stop_time = 1e16", &["stop_time = 1e16: expected a time > 0 s and at most 1e12 s"]),
        ("stop_time = 20.0", "stop_time = \"20 s\"", &["stop_time = \"20 s\": expected a number"]),
        (
            "stop_time = 20.0",
            "stop_time = 1e400",
            &["stop_time = 1e400: expected a number that double precision holds, up to 1.8e308"],
        ),
        ("stop_time = 20.0", "stop_time = 1979-05-27", &["stop_time = 1979-05-27: expected a number"]),
    ]);
}

#[test]
fn keys() {
    const KNOWN: &str = "a known key (name, description, units, stop_time, building, left, right, ground, inputs, contact, facing, link, outputs, solver)";
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
        ("energy = true", "work = true", &["outputs.work = true: expected a known key (energy, peaks, numbers_only)"]),
        ("energy = true", "energy = \"yes\"", &["outputs.energy = \"yes\": expected true or false"]),
        ("energy = true", "peaks = 1", &["outputs.peaks = 1: expected true or false"]),
        ("energy = true", "numbers_only = \"real\"", &["outputs.numbers_only = \"real\": expected true or false"]),
        (
            "energy = true",
            "number_only = true",
            &[
                "outputs.number_only = true: expected a known key (energy, peaks, numbers_only); did you mean numbers_only?",
            ],
        ),
        ("floor_forces = true", "floor_forces = 1", &["inputs.floor_forces = 1: expected true or false"]),
        (
            "floor_forces = true",
            "floor_forces = 1\nrestoring_corrections = [true]\nstorey_corrections = true",
            &[
                "inputs.floor_forces = 1: expected true or false",
                "inputs.restoring_corrections = [true]: expected true or false",
                "inputs.storey_corrections = true: expected a known key (floor_forces, restoring_corrections); did you mean \
                 restoring_corrections?",
            ],
        ),
        (
            "floor_forces = true",
            "floor_force = true",
            &[
                "inputs.floor_force = true: expected a known key (floor_forces, restoring_corrections); did you mean floor_forces?",
            ],
        ),
    ]);
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
    assert_eq!(
        ground("record = 1\npga = 1"),
        [
            "ground.record = 1: expected text in quotation marks, the name of a record file, or a table { file = \"...\", step = ..., unit = \
         \"...\" }"
        ]
    );
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
fn an_empty_scene_lacks_two_things() {
    let expected = ["name: expected a C identifier (missing)", "left: expected the building on the left (missing)"];
    assert_eq!(messages(""), expected, "one building may stand alone");
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
        ("[3.0, 4.0]", "[3.0, -4.0]", |s| s.buildings[0].mass[1] = -4.0),
        ("[2910.0, 2920.0]", "[2910.0, nan]", |s| s.buildings[0].stiffness = Stiffness::Shear(vec![2910.0, f64::NAN])),
        ("{ ratio = 0.01 }", "{ ratio = -0.5 }", |s| s.buildings[0].damping = Damping::Ratio(-0.5)),
        ("gap = 0.002", "gap = inf", |s| s.contacts[0].gap = f64::INFINITY),
        ("restitution = 0.65", "restitution = 0.0", |s| s.contacts[0].law.restitution = 0.0),
        ("stiffness = 1.0e6", "stiffness = -1.0", |s| s.contacts[0].law.stiffness = -1.0),
        ("stiffness = 2.0e6", "stiffness = 2.0e6\nexponent = 4.0", |s| s.contacts[1].law.exponent = 4.0),
        ("1e-10", "0.5", |s| s.solver.relative_tolerance = 0.5),
        ("left_floor = 2", "left_floor = 3", |s| s.contacts[1].left = Face::Floor(BuildingId::LEFT, 3)),
    ];
    for (from, to, change) in changes {
        let mut scene = Scene::from_toml(SCENE).unwrap();
        change(&mut scene);
        let error = scene.check().unwrap_err();
        assert_eq!(Scene::from_toml(&edited(from, to)).unwrap_err(), error, "{to}");
    }
}
