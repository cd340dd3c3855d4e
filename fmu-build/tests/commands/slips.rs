//! What `cargo fmu` says about a scene that may be built and looks like a slip, and what went into the run.

use crate::common::{build, cargo_fmu, changed_feup, feup_fmu_of, option_of, replace_once, root, stderr, stdout};
use pounding::FmiVersion;
use tempfile::TempDir;

#[test]
fn slips_go_to_standard_error_and_the_fmu_is_built() {
    FmiVersion::ALL.into_iter().for_each(slips_go_to_standard_error_in);
}

fn slips_go_to_standard_error_in(version: FmiVersion) {
    let directory = TempDir::new().unwrap();
    let scene = changed_feup(directory.path(), |text| {
        let text = replace_once(text, "gap = 0.005", "gap = 40");
        replace_once(&text, "damping = { ratio = 0.01 }", "damping = { ratio = 5.0 }")
    });
    let fmu = directory.path().join("slips.fmu");
    let output = cargo_fmu(&[scene.to_str().unwrap(), option_of(version).1, "-o", fmu.to_str().unwrap()]);
    assert!(output.status.success() && fmu.is_file());
    let said = stderr(&output);
    let lines: Vec<&str> = said.lines().collect();
    assert_eq!(lines.len(), 2, "{said}");
    assert!(lines[0].starts_with("warning: left.damping.ratio = 5.0: "), "{said}");
    assert!(lines[1].starts_with("warning: contact[1].gap = 40.0: "), "{said}");
    assert!(!stdout(&output).contains("warning"), "said once: {}", stdout(&output));
    // The FMU says the same to whoever runs it.
    let said = stdout(&cargo_fmu(&["check", fmu.to_str().unwrap()]));
    for path in ["logStatusWarning: left.damping_ratio = 5.0: ", "logStatusWarning: contact[1].gap = 40.0: "] {
        assert!(said.contains(path), "no {path:?} in\n{said}");
    }
    let said = stdout(&cargo_fmu(&["check", feup_fmu_of(version).to_str().unwrap()]));
    assert!(!said.contains("logStatusWarning"), "{said}");
}

#[test]
fn the_summary_begins_with_what_went_in() {
    let directory = TempDir::new().unwrap();
    let fmu = directory.path().join("a.fmu");
    let summary = |from: &str, to: &str| {
        let scene = changed_feup(directory.path(), |text| replace_once(text, from, to));
        let output = cargo_fmu(&[scene.to_str().unwrap(), "-o", fmu.to_str().unwrap()]);
        assert!(output.status.success(), "{}", stderr(&output));
        stdout(&output)
    };
    // The peak is 0.319 g, as the record's own comment says; two floors of 3.65 kg; 1 / 2.7774 Hz is 0.36 s.
    let said = summary("gap = 0.005", "gap = 0.006");
    let place = |text: &str| said.find(text).unwrap_or_else(|| panic!("no {text:?} in\n{said}"));
    let record = place("  record       record.csv: 1560 samples, every 0.02 s, 31.18 s long\n");
    let ground = place("  ground       peak 3.127 m/s2, 0.319 g (as recorded)\n");
    let left = place("  left         2 floors, 7.3 kg in all, periods 0.36, 0.138 s (frequencies 2.7774, 7.2712 Hz)\n");
    let right = place("  right        3 floors, 10.95 kg in all, periods 0.5, 0.178, 0.123 s");
    let contacts = place("  contacts     2, gaps from 5 mm to 6 mm\n");
    let results = place("  impacts  ");
    assert!([record, ground, left, right, contacts, results].is_sorted(), "{said}");
    let said = summary("record.csv\"", "record.csv\"\npga = 4.903325");
    assert!(said.contains("peak 4.903 m/s2, 0.5 g (pga; the record's 3.127 m/s2 times 1.568)"), "{said}");
    assert!(said.contains("2, all gaps 5 mm"), "{said}");
    let said = summary("record = \"record.csv\"", "");
    assert!(said.contains("  ground       ground.acceleration is an input: 0 in this run\n"), "{said}");
}

#[test]
fn a_scene_in_t_and_kn_is_built_as_the_same_one_in_si_units() {
    let directory = TempDir::new().unwrap();
    let fmu = directory.path().join("a.fmu");
    let summary = |units: &str, changes: &[(&str, &str)]| {
        let scene = changed_feup(directory.path(), |text| {
            changes.iter().fold(format!("units = \"{units}\"\n{text}"), |text, (from, to)| text.replace(from, to))
        });
        let output = cargo_fmu(&[scene.to_str().unwrap(), "-o", fmu.to_str().unwrap()]);
        assert!(output.status.success() && stderr(&output).is_empty(), "{}", stderr(&output));
        let said = stdout(&output);
        // From the masses on, but for the time that it took.
        let results = said.split_once("  left  ").unwrap_or_else(|| panic!("no masses in\n{said}")).1;
        results.lines().filter(|line| !line.contains("solved in")).flat_map(|line| [line, "\n"]).collect::<String>()
    };
    let in_si = summary("SI", &[]);
    assert!(in_si.contains("7.3 kg in all"), "{in_si}");
    assert_eq!(units_of(&in_si, "contact"), ["m", "N", "m/s", "N", "s", "J"]);
    let in_kn_t = [("3.65", "0.00365"), ("2910.0", "2.91"), ("1.0e6", "1.0e3")];
    assert_eq!(summary("kN-t", &in_kn_t), in_si);
    // A million times as heavy and as stiff: numbers are large.
    let large = summary("kN-t", &[("3.65", "3650"), ("2910.0", "2910e3"), ("1.0e6", "1.0e7")]);
    assert!(large.contains("7300 t in all"), "{large}");
    assert_eq!(units_of(&large, "contact"), ["m", "kN", "m/s", "kN", "s", "kJ"]);
    assert_eq!(units_of(&large, "building"), ["kN"]);
    assert_eq!(units_of(&large, "energy at the end"), ["kJ"]);
}

/// The units below the headings of a table.
fn units_of<'t>(summary: &'t str, table: &str) -> Vec<&'t str> {
    let mut lines = summary.lines().skip_while(|line| !format!("{line} ").starts_with(&format!("  {table} ")));
    lines.nth(1).unwrap_or_else(|| panic!("no {table} in\n{summary}")).split_whitespace().collect()
}

#[test]
fn an_fmu_is_called_one() {
    let directory = TempDir::new().unwrap();
    let scene = changed_feup(directory.path(), str::to_owned);
    let names = [("x.zip", "x.fmu"), ("x", "x.fmu"), ("new/x.fmu.zip", "such as ")];
    for ((name, right), version) in names.into_iter().flat_map(|name| FmiVersion::ALL.map(|version| (name, version))) {
        let path = directory.path().join(name);
        let output = cargo_fmu(&[scene.to_str().unwrap(), option_of(version).1, "-o", path.to_str().unwrap()]);
        assert_eq!((output.status.code(), stdout(&output).as_str()), (Some(1), ""));
        let expected = format!("{}: expected a name that ends in .fmu", path.display());
        assert!(stderr(&output).contains(&expected) && stderr(&output).contains(right), "{}", stderr(&output));
        assert!(!path.exists() && !directory.path().join("new").exists());
    }
}

/// What was given in kN, and how far each storey has gone; one that stays elastic is not among them.
#[test]
fn the_summary_has_the_storeys_that_can_yield() {
    let directory = TempDir::new().unwrap();
    let text = std::fs::read_to_string(root().join("examples/scenes/yielding.toml")).unwrap();
    std::fs::copy(root().join("examples/records/el_centro_1940_ns.csv"), directory.path().join("record.csv")).unwrap();
    let text = replace_once(&text, "../records/el_centro_1940_ns.csv", "record.csv");
    let scene = directory.path().join("scene.toml");
    std::fs::write(&scene, replace_once(&text, "1010, 530]", "inf, 530]")).unwrap();
    let fmu = directory.path().join("a.fmu");
    let said = stdout(&build(&scene, &fmu));
    let report = stdout(&cargo_fmu(&["check", fmu.to_str().unwrap(), "--json"]));
    let report: serde_json::Value = serde_json::from_str(&report).unwrap();
    let value = |name: &str| report["run"]["values"][name].as_f64().unwrap();

    let lines: Vec<&str> = said.lines().skip_while(|line| !line.contains("storey that can yield")).collect();
    let cells = |line: &str| line.split_whitespace().map(str::to_owned).collect::<Vec<_>>();
    let rows: Vec<Vec<String>> =
        lines[2..].iter().take_while(|line| !line.is_empty()).map(|line| cells(line)).collect();
    assert_eq!(cells(lines[1]), ["kN", "m", "kJ", "%"], "{said}");
    let names = ["left 1", "left 2", "left 4", "right 1", "right 2", "right 3"];
    assert_eq!(rows.iter().map(|row| row[..2].join(" ")).collect::<Vec<_>>(), names, "{said}");
    let given: Vec<_> = rows.iter().map(|row| row[2..4].join(" ")).collect();
    assert_eq!(given, ["1490 0.05", "1330 0.05", "530 0.05", "1150 0.05", "940 0.05", "540 0.05"]);
    let energies =
        ["kinetic", "strain", "viscous", "hysteretic", "impact"].map(|name| value(&format!("energy.{name}")));
    for row in &rows {
        let end = |quantity: &str| value(&format!("{}.{quantity}[{}]", row[0], row[1]));
        let dissipated = end("hysteretic_energy");
        let share = 100.0 * dissipated / energies.iter().sum::<f64>();
        let expected = [end("ductility"), end("residual_drift"), dissipated / 1e3, share];
        for (cell, (expected, rounding)) in row[4..].iter().zip(expected.iter().zip([0.0, 0.0, 0.0, 0.051])) {
            let cell: f64 = cell.parse().unwrap();
            assert!((cell - expected).abs() <= 1e-4 * expected.abs() + rounding, "{row:?}: {expected}");
        }
    }
    assert!(said.lines().any(|line| line.starts_with("  hysteretic ")), "{said}");
}
