//! Questions and answers as the page has them, asked natively. tests/browser/page_bits.py asks them in a browser.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use pounding_page::desk::Desk;
use serde_json::{Value, json};

const SCENE: &str = r#"
name = "Two"
stop_time = 3.0

[left]
mass = [1000.0]
stiffness = [4e4]
damping = { ratio = 0.02 }
initial_velocity = [0.5]

[right]
mass = [2000.0]
stiffness = [5e4]
damping = { ratio = 0.02 }

[[contact]]
left_floor = 1
right_floor = 1
gap = 0.01
law = "hertz"
stiffness = 1e8
"#;

fn question(header: &Value, parts: &[&[u8]]) -> Vec<u8> {
    let header = header.to_string();
    let all: Vec<&[u8]> = [header.as_bytes()].into_iter().chain(parts.iter().copied()).collect();
    let lengths = all.iter().map(|part| part.len());
    let numbers = [all.len()].into_iter().chain(lengths).flat_map(|number| (number as u32).to_le_bytes());
    numbers.chain(all.concat()).collect()
}

/// The JSON and the numbers of an answer, or the sentences of a refusal.
fn ask(desk: &mut Desk, header: &Value, parts: &[&[u8]]) -> Result<(Value, Vec<f64>), Vec<String>> {
    let is_well = desk.take(&question(header, parts));
    let answer = desk.answer();
    let json: Value = serde_json::from_slice(&answer.bytes).unwrap();
    match is_well {
        true => Ok((json, answer.numbers.clone())),
        false => Err(serde_json::from_value(json["problems"].clone()).unwrap()),
    }
}

/// The columns of a run and its impacts, in slices of so many rows; and how many impacts were told before the end.
fn run(wishes: &Value, pieces: usize) -> (Vec<Vec<f64>>, Vec<f64>, u64) {
    let mut desk = Desk::new();
    let (begun, _) = ask(&mut desk, wishes, &[SCENE.as_bytes()]).unwrap();
    let mut columns = vec![Vec::new(); begun["columns"].as_array().unwrap().len() + 1];
    let mut told_before = 0;
    loop {
        let (told, numbers) = ask(&mut desk, &json!({ "call": "goOn", "pieces": pieces }), &[]).unwrap();
        let rows = told["rows"].as_u64().unwrap() as usize;
        let (of_columns, impacts) = numbers.split_at(rows * columns.len());
        for (place, column) in columns.iter_mut().enumerate() {
            column.extend(&of_columns[place * rows..(place + 1) * rows]);
        }
        assert_eq!(impacts.len() as u64, 10 * told["impacts"].as_u64().unwrap());
        if told["done"].as_bool().unwrap() {
            assert!(columns[0].len() <= begun["rows"].as_u64().unwrap() as usize);
            assert!(ask(&mut desk, &json!({ "call": "goOn", "pieces": 1 }), &[]).is_err());
            return (columns, impacts.to_vec(), told_before);
        }
        told_before += told["impacts"].as_u64().unwrap();
    }
}

#[test]
fn slices_of_any_size_are_one_run() {
    for wishes in [
        json!({ "call": "run" }),
        json!({ "call": "run", "rowsPerImpact": 3, "step": 0.07, "outputs": ["contact[1].force", "time", "impacts"] }),
    ] {
        let (whole, impacts, none) = run(&wishes, 1_000_000);
        assert_eq!((none, whole[0].first(), whole[0].last()), (0, Some(&0.0), Some(&3.0)));
        assert!(impacts.len() >= 20, "{impacts:?}");
        for pieces in [1, 7, 100] {
            let (columns, same, told) = run(&wishes, pieces);
            assert_eq!((&columns, &same), (&whole, &impacts));
            assert!(pieces > 1 || told == impacts.len() as u64 / 10);
        }
    }
    let asked = run(&json!({ "call": "run", "step": 0.5, "stop": 1.0, "outputs": ["left.mass[1]", "impacts"] }), 9).0;
    assert_eq!(asked, [vec![0.0, 0.5, 1.0], vec![1000.0; 3], asked[2].clone()]);
}

#[test]
fn without_contacts_a_building_swings_by_itself() {
    let wishes = json!({ "call": "run", "withoutContacts": true, "outputs": ["left.displacement[1]"] });
    let (columns, impacts, _) = run(&wishes, 500);
    assert!(impacts.is_empty());
    // v e^(-zeta w t) sin(w_d t) / w_d.
    let (omega, zeta) = ((4e4_f64 / 1000.0).sqrt(), 0.02_f64);
    let damped = omega * (1.0 - zeta * zeta).sqrt();
    for (t, u) in columns[0].iter().zip(&columns[1]) {
        let expected = 0.5 * (-zeta * omega * t).exp() * (damped * t).sin() / damped;
        assert!((u - expected).abs() < 1e-12, "{t}: {u} {expected}");
    }
}

#[test]
fn findings_have_their_lines() {
    let mut desk = Desk::new();
    let find = |desk: &mut Desk, scene: &str| ask(desk, &json!({ "call": "findings" }), &[scene.as_bytes()]).unwrap().0;
    let line = |scene: &str, what: &str| scene.lines().position(|line| line.starts_with(what)).map(|line| line + 1);
    assert_eq!(find(&mut desk, SCENE), json!([]));
    let odd = SCENE.replace("gap = 0.01", "gap = 10.0");
    let found = find(&mut desk, &odd);
    assert_eq!((&found[0]["kind"], &found[0]["line"]), (&json!("warning"), &json!(line(&odd, "gap"))));
    let wrong = SCENE.replace("mass = [2000.0]", "mass = [0]");
    let found = find(&mut desk, &wrong);
    assert_eq!(found[0]["text"], json!("right.mass[1] = 0.0: expected a finite mass > 0 kg"));
    assert_eq!((&found[0]["kind"], &found[0]["line"]), (&json!("problem"), &json!(line(&wrong, "mass = [0]"))));
}

/// One floor and its height.
fn building(name: &str) -> String {
    let keys = "mass = [1e3]\nstiffness = [4e4]\ndamping = { ratio = 0.02 }\nheight = [3.0]\ninitial_velocity = [0.5]";
    format!("[[building]]\nname = \"{name}\"\n{keys}\n")
}

fn row(names: &[&str], gaps: &str) -> String {
    let buildings: String = names.iter().map(|name| building(name)).collect();
    let facing = format!("[facing]\ngap = {gaps}\nlaw = \"hertz\"\nstiffness = 1e8\n");
    format!("name = \"Row\"\nstop_time = 3.0\n{buildings}{facing}")
}

#[test]
fn a_row_is_looked_at_and_marked_by_its_places() {
    let mut desk = Desk::new();
    let mut say = |call: &str, scene: &str| ask(&mut desk, &json!({ "call": call }), &[scene.as_bytes()]).unwrap().0;
    let told = say("look", &row(&["a", "b", "c"], "[0.01, 0.02]"));
    let of = |key: &str| told["buildings"].as_array().unwrap().iter().map(|one| one[key].clone()).collect::<Vec<_>>();
    assert_eq!((of("name"), of("floors")), (vec![json!("a"), json!("b"), json!("c")], vec![json!(1); 3]));
    assert_eq!(of("path"), [json!("building[1]"), json!("building[2]"), json!("building[3]")]);
    assert_eq!(told["facing"], json!({ "contacts": 2, "hasGaps": true }));
    let pair = say("look", SCENE);
    assert_eq!((&pair["buildings"][1]["path"], &pair["facing"]), (&json!("right"), &Value::Null));
    let wrong = row(&["a", "b", "c"], "0.01").replace(&building("c"), &building("c").replace("[1e3]", "[0]"));
    let found = say("findings", &wrong);
    let line = wrong.lines().position(|line| line == "mass = [0]").map(|line| line + 1);
    assert_eq!((&found[0]["path"], &found[0]["line"]), (&json!("building[3].mass[1]"), &json!(line)));
}

#[test]
fn a_study_reads_every_building() {
    let mut desk = Desk::new();
    let scene = row(&["a", "b", "c"], "0.01");
    let (begun, _) = ask(&mut desk, &json!({ "call": "study", "gaps": [0.001, 0.5] }), &[scene.as_bytes()]).unwrap();
    let read: Vec<&str> = begun["columns"].as_array().unwrap().iter().map(|name| name.as_str().unwrap()).collect();
    for building in ["a", "b", "c"] {
        for part in ["peak_drift[1]", "peak_base_shear"] {
            assert!(read.contains(&format!("{building}.{part}").as_str()), "{read:?}");
        }
    }
    assert_eq!(read.len(), 9, "{read:?}");
}

#[test]
fn a_record_that_has_not_been_given_is_named() {
    let scene = format!("{SCENE}[ground]\nrecord = \"a.csv#1\"\n");
    let problems = |records: Value, parts: &[&[u8]]| {
        let parts: Vec<&[u8]> = [scene.as_bytes()].into_iter().chain(parts.iter().copied()).collect();
        ask(&mut Desk::new(), &json!({ "call": "problems", "records": records }), &parts).unwrap().0
    };
    let missing = "ground.record = \"a.csv#1\": expected a record file, but it has not been given";
    assert_eq!(problems(json!([]), &[]), json!([missing]));
    assert_eq!(problems(json!(["b.csv"]), &[b"time_s,accel_m_s2\n0,0\n1,1\n"]), json!([missing]));
    assert_eq!(problems(json!(["a.csv#1"]), &[b"time_s,accel_m_s2\n0,0\n1,1\n"]), json!([]));
    // The first channel of a file.
    assert_eq!(problems(json!(["a.csv"]), &[b"time_s,accel_m_s2\n0,0\n1,1\n"]), json!([]));
}

#[test]
fn what_is_no_question_is_refused() {
    let good = question(&json!({ "call": "look", "records": ["a"] }), &[SCENE.as_bytes(), b"x"]);
    let mut desk = Desk::new();
    assert!(desk.take(&good));
    for end in 0..good.len() {
        assert!(!desk.take(&good[..end]), "{end}");
        assert!(desk.answer().bytes.starts_with(b"{\"kind\":\"ValueError\""));
    }
    for byte in 0..8 {
        let mut wrong = good.clone();
        wrong[byte] = 0xff;
        assert!(!desk.take(&wrong), "{byte}");
    }
    for header in [json!({}), json!({ "call": "sing" }), json!({ "call": "run", "step": {} }), json!([])] {
        assert!(ask(&mut desk, &header, &[SCENE.as_bytes()]).is_err(), "{header}");
    }
    assert_eq!(ask(&mut desk, &json!({ "call": "goOn", "pieces": 1 }), &[]).unwrap_err().len(), 1);
    assert!(desk.take(&good));
}

#[test]
fn an_fmu_needs_a_version_and_libraries_of_known_platforms() {
    let fmu = |fmi: Value, libraries: Value| {
        ask(
            &mut Desk::new(),
            &json!({ "call": "fmu", "fmi": fmi, "libraries": libraries }),
            &[SCENE.as_bytes(), b"\x7fELF"],
        )
        .unwrap_err()
        .join("\n")
    };
    for fmi in [json!(1), json!("2"), json!(null), json!(2.5)] {
        assert_eq!(fmu(fmi.clone(), json!(["linux64"])), format!("fmi = {fmi}: expected 2 or 3"));
    }
    assert_eq!(fmu(json!(2), json!(["vax"])), "platform vax: expected such as linux64");
    assert!(fmu(json!(3), json!([])).contains("without the library of any platform"));
}
