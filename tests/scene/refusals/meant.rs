//! What users write instead of TOML, or instead of what a key wants: the message says what was probably meant.

use super::expect;
use crate::{SCENE, SHORT, edited, messages};
use pounding::scene::Scene;

/// What is said about a text that is not TOML, without its place.
fn said(text: &str) -> String {
    let messages = messages(text);
    assert_eq!(messages.len(), 1, "{messages:?}");
    let (place, expected) = messages[0].split_once(": ").unwrap();
    assert!(place.starts_with("line "), "{place}");
    expected.to_owned()
}

#[test]
fn numbers_with_commas_and_units() {
    for (to, expected) in [
        ("gap = 0,04", "expected a decimal point, gap = 0.04, not a comma"),
        ("gap = -1,5 # mm", "expected a decimal point, gap = -1.5, not a comma"),
        ("gap = 2 mm", "expected a number alone, gap = 2: units are fixed, see the documentation of the key"),
        ("gap = 2e-3m", "expected a number alone, gap = 2e-3: units are fixed, see the documentation of the key"),
    ] {
        assert_eq!(said(&edited("gap = 0.002", to)), expected);
    }
}

#[test]
fn folders_of_windows() {
    let ground = |record: &str| format!("{SHORT}\n[ground]\nrecord = {record}");
    let expected =
        "expected / between folders, record = \"C:/quakes/a.csv\", or single quotes: in \"...\" a \\ begins an escape";
    assert_eq!(said(&ground("\"C:\\quakes\\a.csv\"")), expected);
    // Escapes that want digits, a quote that is hidden, a # that begins no comment.
    for (written, meant) in [
        (r#""C:\Uni\me\a.csv""#, "\"C:/Uni/me/a.csv\""),
        (r#""C:\users\a.csv" # a comment"#, "\"C:/users/a.csv\""),
        (r#""D:\xray\a.csv""#, "\"D:/xray/a.csv\""),
        (r#""C:\bridges\x.csv""#, "\"C:/bridges/x.csv\""),
        (r#""C:\Uni\me #2\a.csv""#, "\"C:/Uni/me #2/a.csv\""),
        (r#""\\server\share\a.csv""#, "\"//server/share/a.csv\""),
        (r#""C:\data\" # a folder"#, "\"C:/data/\""),
    ] {
        assert_eq!(said(&ground(written)), expected.replace("\"C:/quakes/a.csv\"", meant));
    }
    assert!(said("note = \"a \\\"b\\\" \" c").starts_with("expected valid TOML"), "escapes that are no folders");
    // Escapes that there are: a tab, a new line.
    for name in ["C:\\temp\\new.csv", "C:\\new", "C:\\records\\borah\\far.csv"] {
        let messages = messages(&ground(&format!("\"{name}\"")));
        assert_eq!(messages.len(), 1);
        let start =
            "a file name without control characters: in \"...\" a \\ begins an escape, so write / between folders";
        let meant = name.replace('\\', "/");
        assert!(messages[0].contains(&format!("{start}, \"{meant}\", or single quotes")), "{messages:?}");
    }
    for name in ["'C:\\quakes\\a.csv'", "\"C:/quakes/a.csv\"", "\"C:\\\\quakes\\\\a.csv\""] {
        assert!(Scene::from_toml(&ground(name)).is_ok(), "{name}");
    }
}

#[test]
fn one_bracket_where_there_are_two() {
    const TWO: &str = "expected [[contact]], with two brackets on either side, above every contact";
    let one = SCENE.replacen("[[contact]]", "[contact]", 1);
    assert_eq!(said(&one), TWO, "before another");
    let last = SCENE.rfind("[[contact]]").unwrap();
    let after = format!("{}[contact]{}", &SCENE[..last], &SCENE[last + "[[contact]]".len()..]);
    assert_eq!(said(&after), TWO, "after another");
    assert_eq!(messages(&format!("{SHORT}\n[contact]\ngap = 1")), [format!("contact = [contact]: {TWO}")]);
}

#[test]
fn a_number_for_a_list_or_a_table() {
    expect(&[
        (
            "mass = [3.0, 4.0]",
            "mass = 330e3",
            &["left.mass = 330e3: expected a list of numbers, [330e3] for one floor, [330e3, 330e3] for two"],
        ),
        (
            "stiffness = [2910.0, 2920.0]",
            "stiffness = 2e8",
            &["left.stiffness = 2e8: expected a list of numbers, [2e8] for one storey, [2e8, 2e8] for two"],
        ),
        (
            "damping = { ratio = 0.01 }",
            "damping = { ratios = 0.05 }",
            &["left.damping.ratios = 0.05: expected a list of numbers, [0.05] for one mode, [0.05, 0.05] for two"],
        ),
        (
            "damping = { ratio = 0.01 }",
            "damping = 0.05",
            &["left.damping = 0.05: expected a table, such as { ratio = 0.05 }"],
        ),
        ("damping = { ratio = 0.01 }", "damping = [0.05]", &["left.damping = [0.05]: expected a table"]),
    ]);
}

#[test]
fn what_is_no_number_is_shown_as_it_is_written() {
    let long = "9".repeat(309);
    let short = &long[..57];
    expect(&[(
        "[2910.0, 2920.0]",
        "[2910, \"x\", 3e3]",
        &[
            "left.stiffness = [2910, \"x\", 3e3]: expected 2 numbers, one per storey, not 3",
            "left.stiffness[2] = \"x\": expected a number",
        ],
    )]);
    let huge = |number: &str| messages(&edited("gap = 0.002", &format!("gap = {number}")));
    assert_eq!(huge(&long), [format!("contact[1].gap = {short}...: expected a finite distance in m")]);
    let expected = "expected a number that double precision holds, up to 1.8e308";
    assert_eq!(huge(&format!("{long}.0")), [format!("contact[1].gap = {short}...: {expected}")]);
}

#[test]
fn scale_and_pga_are_looked_at_together() {
    let ground = |scale: &str, pga: &str| {
        messages(&format!("{SHORT}\n[ground]\nrecord = \"a.csv\"\nscale = {scale}\npga = {pga}"))
    };
    let both = |pga: &str| format!("ground.pga = {pga}: expected either scale or pga, not both");
    let pga = |pga: &str| format!("ground.pga = {pga}: expected a finite peak acceleration > 0 m/s2");
    assert_eq!(ground("2", "3.0"), [both("3.0")]);
    assert_eq!(ground("2", "-1"), [both("-1"), pga("-1")]);
    assert_eq!(ground("inf", "-1"), ["ground.scale = inf: expected a finite factor".to_owned(), both("-1"), pga("-1")]);
    assert_eq!(
        ground("\"a\"", "\"b\""),
        [
            "ground.scale = \"a\": expected a number".to_owned(),
            both("\"b\""),
            "ground.pga = \"b\": expected a number".to_owned()
        ]
    );
}

#[test]
fn what_would_take_minutes_to_prepare_is_refused_at_once() {
    let tall = |floors: usize| {
        format!("{{ mass = {:?}, stiffness = {:?}, damping = {{ ratio = 0 }} }}", vec![1.0; floors], vec![2.0; floors])
    };
    let scene = |left: usize, right: usize, contacts: usize| {
        let pair = |k: usize| {
            format!(
                "{{ left_floor = {}, right_floor = {}, gap = 1, law = \"linear\", stiffness = 1 }}",
                k / right + 1,
                k % right + 1
            )
        };
        let contacts: Vec<String> = (0..contacts).map(pair).collect();
        format!("name = \"Tall\"\nleft = {}\nright = {}\ncontact = [{}]", tall(left), tall(right), contacts.join(", "))
    };
    assert_eq!(messages(&scene(1000, 1000, 1)), [""; 0]);
    let said = messages(&scene(1001, 2000, 1));
    assert_eq!(said.len(), 2, "{said:?}");
    for (line, (side, floors)) in said.iter().zip([("left", 1001), ("right", 2000)]) {
        let expected = format!("expected at most 1000 floors, not {floors}, which would take minutes to prepare");
        assert!(line.starts_with(&format!("{side}.mass = [1.0, ")) && line.ends_with(&expected), "{line}");
    }
    let expected = "contact: expected at most 40000 contacts where there are 500 floors, not 40001";
    assert_eq!(messages(&scene(250, 250, 40_001)), [expected]);
    assert_eq!(messages(&scene(250, 250, 40_000)), [""; 0]);
}
