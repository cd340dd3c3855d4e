//! `cargo fmu check --json`: the shape that `docs/check.schema.json` promises to scripts, whatever there is to report.

use crate::common::{changed_description, checked, feup_fmu, files, replace_once, root, write_fmu};
use serde_json::Value;
use std::path::Path;
use tempfile::TempDir;

/// As much of JSON Schema as the schema uses; a key that it does not describe is wrong too.
fn violations(schema: &Value, value: &Value, place: &str) -> Vec<String> {
    let mut wrong = Vec::new();
    let is_of_type = match schema["type"].as_str() {
        Some("object") => value.is_object(),
        Some("array") => value.is_array(),
        Some("string") => value.is_string(),
        Some("boolean") => value.is_boolean(),
        Some("number") => value.is_number(),
        Some(other) => panic!("{place}: type {other}"),
        None => true,
    };
    let is_allowed = schema["enum"].as_array().is_none_or(|allowed| allowed.contains(value));
    let is_constant = schema.get("const").is_none_or(|constant| constant == value);
    if !(is_of_type && is_allowed && is_constant) {
        wrong.push(format!("{place} is {value}"));
    }
    for key in schema["required"].as_array().into_iter().flatten().map(|key| key.as_str().unwrap()) {
        if value.get(key).is_none() {
            wrong.push(format!("{place}.{key} is missing"));
        }
    }
    for (key, value) in value.as_object().into_iter().flatten() {
        let place = format!("{place}.{key}");
        match schema["properties"].get(key).or(schema.get("additionalProperties")) {
            Some(schema) => wrong.extend(violations(schema, value, &place)),
            None => wrong.push(format!("{place} is not described")),
        }
    }
    for (i, value) in value.as_array().into_iter().flatten().enumerate() {
        wrong.extend(violations(&schema["items"], value, &format!("{place}[{i}]")));
    }
    wrong
}

#[test]
fn the_json_is_as_the_schema_says() {
    let schema = std::fs::read_to_string(root().join("docs/check.schema.json")).unwrap();
    let schema: Value = serde_json::from_str(&schema).unwrap();
    let directory = TempDir::new().unwrap();
    let bad = directory.path().join("bad.fmu");
    write_fmu(&bad, &changed_description(|text| replace_once(text, "start=\"3.65\"", "start=\"-3.65\"")));
    let text = directory.path().join("text.fmu");
    std::fs::write(&text, "no zip").unwrap();
    let names = |report: &Value| {
        let checks = report["checks"].as_array().unwrap().iter();
        checks.map(|check| check["name"].as_str().unwrap().to_owned()).collect::<Vec<_>>()
    };
    let all: Vec<&str> = schema["properties"]["checks"]["items"]["properties"]["name"]["enum"]
        .as_array()
        .unwrap()
        .iter()
        .map(|name| name.as_str().unwrap())
        .collect();
    for (fmu, expected, checks) in
        [(feup_fmu(), 0, &all[..]), (&bad, 1, &all), (&text, 1, &["archive"]), (Path::new("none.fmu"), 1, &["archive"])]
    {
        let (code, report) = checked(fmu);
        assert_eq!(code, Some(expected), "{report:#}");
        assert_eq!(violations(&schema, &report, "report"), [""; 0], "{report:#}");
        assert_eq!(names(&report), checks, "{report:#}");
        assert_eq!(report["valid"], expected == 0);
        assert_eq!(report["file"], fmu.to_str().unwrap());
        assert_eq!(report.get("run").is_some(), checks.len() == all.len());
    }
}

#[test]
fn the_figures_of_the_run_are_those_at_its_end() {
    let (_, report) = checked(feup_fmu());
    let run = &report["run"];
    assert_eq!((&run["start"], &run["stop"], &run["step"]), (&0.0.into(), &20.0.into(), &0.01.into()));
    assert_eq!(run["values"]["left.mass[1]"], 3.65);
    assert_eq!(run["values"]["contact[1].gap"], 0.005);
    let contacts = [1, 2].map(|p| run["values"][format!("contact[{p}].impacts")].as_f64().unwrap());
    assert_eq!(run["values"]["impacts"], contacts[0] + contacts[1]);
    let numbers = files(feup_fmu()).iter().find(|(name, _)| name == "modelDescription.xml").map(|(_, text)| {
        let text = std::str::from_utf8(text).unwrap();
        text.matches("<ScalarVariable").count() - text.matches("<String").count()
    });
    assert_eq!(run["values"].as_object().unwrap().len(), numbers.unwrap());
}

/// One look at an FMU tells everything that is wrong with it.
#[test]
fn what_is_written_and_what_the_library_does_is_reported_at_once() {
    let directory = TempDir::new().unwrap();
    let fmu = directory.path().join("bad.fmu");
    let mut files = changed_description(|text| {
        let text = replace_once(text, "start=\"2910\"", "start=\"-2910\"");
        let text = replace_once(&text, "name=\"logAll\"", "name=\"logEvents\"");
        replace_once(&text, "unit=\"kg\"", "")
    });
    files.push(("readme.txt".into(), Vec::new()));
    write_fmu(&fmu, &files);
    let (code, report) = checked(&fmu);
    assert_eq!(code, Some(1));
    let said = report["checks"].to_string();
    for expected in [
        "left.stiffness[1]: start -2910",
        "left.stiffness[1]: start is \\\"-2910\\\", the library has Real(2910.0)",
        "LogCategories: no Category logAll",
        "left.mass[1]: no unit",
        "readme.txt\\\": not a file of such an FMU",
    ] {
        assert!(said.contains(expected), "no {expected}: {report:#}");
    }
}
