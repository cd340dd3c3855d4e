//! Contacts, their laws and what these need.

use super::expect;
use crate::{SHORT, edited, messages};
use pounding::contact::LawKind;
use pounding::scene::law_key;

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
            &["contact[2] = left_floor 1, right_floor 1: expected a pair other than that of contact[1]"],
        ),
        ("gap = 0.002\n", "", &["contact[1].gap: expected the clear distance at rest in m (missing)"]),
        ("gap = 0.002\n", "gap = nan\n", &["contact[1].gap = nan: expected a finite distance in m"]),
        // A key that is the beginning of another does not hide it.
        (
            "gap = 0.002\n",
            "g = 1\ngap = nan\n",
            &[
                "contact[1].g = 1: expected a key of law kelvin_voigt (left_floor, right_floor, left_storey, right_storey, left_position, right_position, column_shape, wall, gap, law, stiffness, \
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
    let expected = "contact = [contact]: expected [[contact]], with two brackets on either side, above every contact";
    assert_eq!(messages(&one_table), [expected]);
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
            &[
                "contact[1].exponent = 1.5: expected a key of law kelvin_voigt (left_floor, right_floor, left_storey, right_storey, left_position, right_position, column_shape, wall, gap, law, \
               stiffness, restitution)",
            ],
        ),
        (
            "stiffness = 2.0e6",
            "stifness = 2.0e6",
            &[
                "contact[2].stiffness: expected a finite stiffness > 0 (missing)",
                "contact[2].stifness = 2.0e6: expected a key of law hertz (left_floor, right_floor, left_storey, right_storey, left_position, right_position, column_shape, wall, gap, law, stiffness, \
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
    let keys = "a key of law stereomechanical (left_floor, right_floor, left_storey, right_storey, left_position, right_position, column_shape, wall, gap, law, restitution)";
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
    assert!(lav.starts_with("contact[2].lav = 1: expected a known key (left_floor, right_floor, left_storey, right_storey, left_position, right_position, column_shape, wall, gap, law,"), "{lav}");
    assert_eq!(lav.matches("restitution").count(), 1, "{lav}");
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
