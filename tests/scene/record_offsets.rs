//! Records whose mean is not 0: warned of, refused with `pga`, read without it by `remove_mean`; and other motions that are none.

use pounding::record::{Record, RecordFile};
use pounding::scene::Package;
use pounding::warnings;

/// A sine of 1 m/s2 about a level, m/s2, that begins and ends at it.
fn about(level: f64) -> String {
    let rows = (0..=200)
        .map(|k| format!("{},{}\n", f64::from(k) * 0.01, level + (f64::from(k) * 0.01 * std::f64::consts::TAU).sin()));
    format!("time_s,accel_m_s2\n{}", rows.collect::<String>())
}

fn package(ground: &str, file: &str) -> Result<Package, Vec<String>> {
    let building = "mass = [1e5]\nstiffness = [4e7]\ndamping = { ratio = 0.05 }\n";
    let text = format!("name = \"One\"\n[left]\n{building}[right]\n{building}[ground]\n{ground}\n");
    let found = Package::from_memory(text, |name| (name == "a.csv").then(|| file.as_bytes().to_vec()));
    found.map_err(|error| error.problems.iter().map(ToString::to_string).collect())
}

fn warned(ground: &str, file: &str) -> Vec<String> {
    let package = package(ground, file).unwrap();
    let found = warnings::of_file(&package.scene, package.record.as_ref().map(|packaged| &packaged.record));
    found.iter().map(ToString::to_string).filter(|text| text.starts_with("ground.")).collect()
}

#[test]
fn a_scene_scales_no_record_by_its_offset() {
    let named = r#"record = "a.csv""#;
    let removed = r#"record = { file = "a.csv", remove_mean = true }"#;
    for level in [0.3, -0.3, 5.0, 0.011] {
        let problems = package(&format!("{named}\npga = 3"), &about(level)).unwrap_err();
        assert!(
            problems.len() == 1
                && problems[0].starts_with("ground.pga = 3")
                && problems[0].contains("remove_mean = true"),
            "{level}: {problems:?}"
        );
        let mean = warned(named, &about(level));
        assert!(
            mean.len() == 1 && mean[0].contains("ground.record") && mean[0].contains("remove_mean = true"),
            "{mean:?}"
        );
        // Without its mean it is the sine.
        let free = package(&format!("{removed}\npga = 3"), &about(level)).unwrap();
        let record = &free.record.as_ref().unwrap().record;
        assert!((record.peak() - 1.0).abs() < 1e-14, "{}", record.peak());
        assert_eq!(warned(&format!("{removed}\npga = 3"), &about(level)), [""; 0]);
    }
    for level in [0.0, 0.009] {
        assert!(package(&format!("{named}\npga = 3"), &about(level)).is_ok(), "{level}");
        assert_eq!(warned(named, &about(level)), [""; 0], "{level}");
    }
}

/// A pulse has a mean and no offset: it begins or ends at 0; nor have a few corners drawn by hand.
#[test]
fn a_pulse_is_no_offset() {
    let half_sine: String =
        (0..100).map(|k| format!("{k},{}\n", (f64::from(k) * 0.01 * std::f64::consts::PI).sin())).collect();
    for rows in ["0,0\n0.1,3\n0.3,0\n", "0,1\n1,-4\n2,1\n", &half_sine] {
        let pulse = format!("time_s,accel_m_s2\n{rows}");
        assert!(package("record = \"a.csv\"\npga = 3", &pulse).is_ok(), "{rows}");
        assert!(warned("record = \"a.csv\"", &pulse).iter().all(|text| !text.contains("remove_mean")), "{rows}");
    }
}

#[test]
fn numbers_of_one_sign_look_like_a_spectrum() {
    let rows: String =
        (0..100).map(|k| format!("{} {}\n", f64::from(k) * 0.02, 0.3 + 0.1 * f64::from(k % 7))).collect();
    let file = RecordFile::named("a.csv", format!("time_s accel_g\n{rows}").into_bytes());
    let said = warnings::of_record("a.csv", &file.parse().unwrap().record);
    assert!(said.len() == 1 && said[0].text.starts_with("all its numbers are of one sign"), "{said:?}");
}

#[test]
fn a_vertical_component_is_warned_of() {
    let file = |component: &str| format!("time_s,{component}\n0,1\n1,-1\n2,1\n3,-1\n");
    for component in ["U-D [m/s2]", "Up (m/s2)", "UD_m_s2", "HNZ [m/s2]", "vertical [m/s2]", "Z [m/s2]"] {
        let said = warned("record = \"a.csv\"", &file(component));
        assert!(said.len() == 1 && said[0].contains("is vertical"), "{component}: {said:?}");
    }
    for component in ["N-S [m/s2]", "HNE [m/s2]", "090 [m/s2]", "Upland [m/s2]", "accel (m/s2)"] {
        assert_eq!(warned("record = \"a.csv\"", &file(component)), [""; 0], "{component}");
    }
}

#[test]
fn the_component_of_a_peer_file_stands_in_its_title() {
    let at2 = |component: &str| {
        format!(
            "PEER\nSomewhere, 1/2/2003, A station, {component}\nACCELERATION IN UNITS OF G\nNPTS= 2, DT= .01 SEC\n.1 -.1\n"
        )
    };
    for (component, is_vertical) in [("UP", true), ("DWN", true), ("090", false), ("a name that is longer", false)] {
        let record = Record::parse("a.at2", at2(component).as_bytes()).unwrap();
        assert_eq!(
            (record.component == component, record.is_vertical()),
            (component.len() < 9, is_vertical),
            "{component}"
        );
    }
}

#[test]
fn the_mean_is_taken_away_exactly() {
    let mut record = Record::new(vec![0.0, 1.0, 2.0, 3.0], vec![1e16, 1.0, -1e16, 2.0]);
    assert_eq!(record.mean(), 0.75);
    record.remove_mean();
    assert_eq!(record.accelerations[1], 0.25);
}

#[test]
fn a_table_says_what_is_wrong_with_it() {
    let wrong =
        "record = { file = \"a.csv\", step = 0, unit = \"kg\", column = 0, skip_lines = -1, remove_mean = 1, stp = 2 }";
    let said = package(wrong, "").unwrap_err();
    let expected = [
        "ground.record.step = 0: expected the s from sample to sample, a number > 0 and at most 1000000",
        "ground.record.unit = \"kg\": expected a unit of acceleration (m/s2, cm/s2, mm/s2, g, %g, mg, g/10, ft/s2, in/s2)",
        "ground.record.column = 0: expected the number of a column, from 1 on, or its name in quotation marks",
        "ground.record.skip_lines = -1: expected how many lines above the numbers are not read, a whole number",
        "ground.record.remove_mean = 1: expected true or false",
        "ground.record.stp = 2: expected a known key (file, step, unit, column, skip_lines, remove_mean); did you mean step?",
    ];
    assert_eq!(said[..expected.len()], expected);
    assert!(
        package("record = {}", "").unwrap_err()[0]
            .starts_with("ground.record.file: expected the name of a record file (missing)")
    );
    assert!(
        package("record = 3", "").unwrap_err()[0].starts_with(
            "ground.record = 3: expected text in quotation marks, the name of a record file, or a table {"
        )
    );
    let read = package("record = { file = \"a.csv\", step = 0.5, unit = \"g\" }", "1\n-2\n1\n").unwrap();
    assert_eq!(read.record.unwrap().record.times, [0.0, 0.5, 1.0]);
}
