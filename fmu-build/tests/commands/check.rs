//! `cargo fmu check`: nothing wrong in a good FMU, and every planted defect found.

use crate::common::libraries::{exporting, functions, library};
use crate::common::{
    Files, cargo_fmu, changed_description, checked, feup_fmu, files, findings, replace_once, stderr, stdout, write_fmu,
};
use pounding::FmiVersion;
use pounding::description::guid_of;
use serde_json::Value;
use tempfile::TempDir;

/// Plants a defect in a good FMU and requires the check of that name to find it and to say so.
fn plant(change: impl Fn(Files) -> Files, name: &str, expected: &str) {
    let directory = TempDir::new().unwrap();
    let fmu = directory.path().join("defective.fmu");
    write_fmu(&fmu, &change(files(feup_fmu())));
    let (code, report) = checked(&fmu);
    assert_eq!((code, &report["valid"]), (Some(1), &Value::Bool(false)), "{report:#}");
    let found = findings(&report, name);
    assert!(found.contains(expected), "{name} does not say {expected:?}: {report:#}");
    let output = cargo_fmu(&["check", fmu.to_str().unwrap()]);
    assert_eq!(output.status.code(), Some(1));
    assert!(stdout(&output).contains("WRONG"), "{}", stdout(&output));
}

/// A defect in the description.
fn plant_in_description(change: impl Fn(&str) -> String, name: &str, expected: &str) {
    let change = |mut files: Files| {
        let text = String::from_utf8(std::mem::take(&mut files[0].1)).unwrap();
        files[0].1 = change(&text).into_bytes();
        files
    };
    plant(change, name, expected);
}

/// The text with `old` replaced in the variable of that name.
fn in_variable(text: &str, variable: &str, old: &str, new: &str) -> String {
    let from = text.find(&format!("name=\"{variable}\"")).expect("the variable");
    let (before, after) = text.split_at(from);
    let (element, rest) = after.split_at(after.find("</ScalarVariable>").expect("the end of the variable"));
    format!("{before}{}{rest}", replace_once(element, old, new))
}

/// The text with its first two elements of that opening exchanged.
fn exchange(text: &str, section: &str, element: &str) -> String {
    let section = text.find(section).unwrap();
    let one = section + text[section..].find(element).unwrap();
    let next = one + 1 + text[one + 1..].find(element).unwrap();
    let end = next + text[next..].find("/>").unwrap() + 2;
    let (first, second) = (text[one..next].trim_end(), &text[next..end]);
    format!("{}{second}{first}{}", &text[..one], &text[end..])
}

#[test]
fn a_good_fmu_is_in_order_and_has_run() {
    let (code, report) = checked(feup_fmu());
    assert_eq!(code, Some(0), "{report:#}");
    assert_eq!(report["valid"], true);
    assert_eq!(report["run"]["stop"], 20.0);
    assert!(report["run"]["values"]["impacts"].as_f64().unwrap() > 0.0);
    let output = cargo_fmu(&["check", feup_fmu().to_str().unwrap()]);
    assert!(stdout(&output).contains("nothing wrong found"));
    assert!(stdout(&output).contains("2.7774, 7.2712 Hz"));
}

#[test]
fn defects_of_the_description_that_validators_miss() {
    let lint = "description lint";
    plant_in_description(|text| exchange(text, "<InitialUnknowns>", "<Unknown "), lint, "expected ascending");
    let negative = |text: &str| in_variable(text, "left.mass[1]", "start=\"3.65\"", "start=\"-3.65\"");
    plant_in_description(negative, lint, "left.mass[1]: start -3.65");
    let upside_down = |text: &str| in_variable(text, "left.mass[1]", "start=", "min=\"9\" max=\"2\" start=");
    plant_in_description(|text| upside_down(&text.replace("min=\"0\"", "")), lint, "min 9 is greater than max 2");
    let nominal = |text: &str| in_variable(text, "left.displacement[1]", "nominal=\"", "nominal=\"-");
    plant_in_description(nominal, lint, "left.displacement[1]: nominal");
    let backwards = |text: &str| replace_once(text, "stopTime=\"20\"", "stopTime=\"-1\"");
    plant_in_description(backwards, lint, "stopTime -1");
    let too_long = |text: &str| replace_once(text, "stepSize=\"0.01\"", "stepSize=\"21\"");
    plant_in_description(too_long, lint, "stepSize 21");
    let unit = |text: &str| replace_once(text, "<Unit name=\"kg\"", "<Unit name=\"slug\"");
    plant_in_description(unit, lint, "unit \"kg\"");
    let alias = |text: &str| {
        let reference = |name: &str| {
            let at = text.find(&format!("name=\"{name}\"")).unwrap();
            text[at..].split("valueReference=\"").nth(1).unwrap().split('"').next().unwrap().to_owned()
        };
        let (one, other) = (reference("left.mass[1]"), reference("left.mass[2]"));
        let quoted = |number: &str| format!("valueReference=\"{number}\"");
        in_variable(text, "left.mass[2]", &quoted(&other), &quoted(&one))
    };
    plant_in_description(alias, lint, "left.mass[2] and left.mass[1]");
}

/// What is well formed and makes sense, and is not what the scene says.
#[test]
fn descriptions_of_another_scene() {
    let plant = |change: &dyn Fn(&str) -> String, expected| plant_in_description(change, "scene", expected);
    let plant_text = |old: &str, new: &str, expected| plant(&|text| text.replace(old, new), expected);
    let (one, two) = ("name=\"left.mass[1]\"", "name=\"left.mass[2]\"");
    let exchanged = |text: &str| text.replace(one, "name=\"\"").replace(two, one).replace("name=\"\"", two);
    plant(&exchanged, "ModelVariables/ScalarVariable left.mass[1]: valueReference");
    plant_text(one, "name=\"left.weight[1]\"", "ModelVariables: ScalarVariable left.weight[1]; expected none");
    let tunable = "ScalarVariable left.mass[1]: variability \"tunable\"; expected \"fixed\"";
    plant_text("variability=\"fixed\"", "variability=\"tunable\"", tunable);
    plant_text("m=\"1\" s=\"-2\"", "m=\"1\" s=\"-1\"", "Unit m/s2/BaseUnit: s \"-1\"; expected \"-2\"");
    let factor = "Unit kg/DisplayUnit t: factor \"100\"; expected \"0.001\"";
    plant(&|text| replace_once(text, "name=\"t\" factor=\"0.001\"", "name=\"t\" factor=\"100\""), factor);
    let minimum = |text: &str| in_variable(text, "left.mass[1]", "min=\"0\"", "min=\"-5\"");
    plant(&minimum, "ScalarVariable left.mass[1]/Real: min \"-5\"; expected \"0\"");
    let snapshots = "CoSimulation: canGetAndSetFMUstate \"false\"; expected \"true\"";
    plant_text("canGetAndSetFMUstate=\"true\"", "canGetAndSetFMUstate=\"false\"", snapshots);
    plant_text("modelIdentifier=\"Feup", "modelIdentifier=\"Feup ", "modelIdentifier \"Feup Frames\"; expected");
    let scene = |mut files: Files| {
        files[2].1 = b"name = 3".to_vec();
        files
    };
    crate::check::plant(scene, "scene", "resources/scene.toml: name = 3: ");
}

/// This program does not know what another version of it writes, but whether it is as it was.
#[test]
fn a_description_by_another_version_is_that_of_its_guid() {
    let files = files(feup_fmu());
    let text = String::from_utf8(files[0].1.clone()).unwrap();
    let guid = text.split('"').find(|part| part.starts_with('{')).unwrap();
    let other = text.replace(&format!("pounding-fmu {}", env!("CARGO_PKG_VERSION")), "pounding-fmu 0.0.1");
    let scene = String::from_utf8(files[2].1.clone()).unwrap();
    let own = guid_of(&other.replace(guid, ""), &scene, &files[3].1);
    plant_in_description(|_| other.clone(), "scene", &format!("GUID {guid:?}; expected {own:?}"));
    let directory = TempDir::new().unwrap();
    let fmu = directory.path().join("other.fmu");
    write_fmu(&fmu, &changed_description(|_| other.replace(guid, &own)));
    let (_, report) = checked(&fmu);
    assert_eq!(findings(&report, "scene"), "", "{report:#}");
}

#[test]
fn defects_of_the_description_that_the_importer_finds() {
    plant_in_description(|text| replace_once(text, "</ModelVariables>", ""), "description", "ModelVariables");
    plant_in_description(|text| replace_once(text, "fmiVersion=\"2.0\"", "fmiVersion=\"1.0\""), "description", "2.0");
    let missing = |text: &str| {
        let (start, end) = (text.find("<InitialUnknowns>").unwrap(), text.find("</ModelStructure>").unwrap());
        text[..start].to_owned() + &text[end..]
    };
    plant_in_description(missing, "description", "initial unknowns");
    let twice = |text: &str| replace_once(text, "name=\"left.mass[2]\"", "name=\"left.mass[1]\"");
    plant_in_description(twice, "description", "Duplicate variable name");
}

#[test]
fn a_library_that_does_not_belong_to_the_description() {
    let guid = |text: &str| {
        let at = text.find("guid=\"{").unwrap() + 7;
        let other = if text[at..].starts_with('0') { "1" } else { "0" };
        text[..at].to_owned() + other + &text[at + 1..]
    };
    plant_in_description(guid, "start values", "GUID");
    let start = |text: &str| in_variable(text, "left.mass[1]", "start=\"3.65\"", "start=\"3.66\"");
    plant_in_description(start, "start values", "left.mass[1]: start is \"3.66\", the library has Real(3.65)");
    let scene = |mut files: Files| {
        files[2].1 = replace_once(std::str::from_utf8(&files[2].1).unwrap(), "gap = 0.005", "gap = 0.004").into_bytes();
        files
    };
    plant(scene, "start values", "GUID");
}

#[test]
fn a_library_that_lacks_a_function_or_is_none() {
    let rename = |name: &'static [u8], other: &'static [u8]| {
        move |mut files: Files| {
            let library = &mut files[1].1;
            let places: Vec<usize> =
                library.windows(name.len()).enumerate().filter(|(_, bytes)| *bytes == name).map(|(at, _)| at).collect();
            assert!(!places.is_empty());
            for at in places {
                library[at..at + other.len()].copy_from_slice(other);
            }
            files
        }
    };
    plant(rename(b"fmi2CancelStep", b"fmi2CancelStop"), "exported functions", "fmi2CancelStep is not exported");
    // Of Model Exchange, which there are importers that look for in every FMU.
    plant(rename(b"fmi2SetTime", b"fmi2SetTome"), "exported functions", "fmi2SetTime is not exported");
    let garbage = |mut files: Files| {
        files[1].1 = b"not a library".to_vec();
        files
    };
    plant(garbage, "library", "FeupFrames.so: no library that can be read");
    let elsewhere = |mut files: Files| {
        files[1].0 = "binaries/vax/FeupFrames.exe".into();
        files
    };
    plant(elsewhere, "library", "it has: binaries/vax/FeupFrames.exe");
    plant(elsewhere, "library", "\"vax\" is no platform that is known here");
}

#[test]
fn libraries_for_other_machines_are_looked_at_too() {
    let with = |path: &str, bytes: Vec<u8>| {
        let file = (format!("binaries/{path}"), bytes);
        move |mut files: Files| {
            files.push(file.clone());
            files
        }
    };
    plant(with("win64/FeupFrames.dll", b"MZ".to_vec()), "library", "no library that can be read");
    let intel =
        "FeupFrames.dll: a library in the format Elf for X86_64; expected a library in the format Pe for X86_64";
    plant(with("win64/FeupFrames.dll", library("linux64")), "library", intel);
    let arm = "a library in the format Elf for X86_64; expected a library in the format Elf for Aarch64";
    plant(with("aarch64-linux/FeupFrames.so", library("linux64")), "library", arm);
    let name = "expected the name FeupFrames.dylib in darwin64";
    plant(with("darwin64/FeupFrames.so", library("darwin64")), "library", name);
    plant(with("darwin64/FeupFrames.dylib", library("aarch64-darwin")), "library", "for Aarch64; expected");
    let mut program = library("linux64");
    program[16] = 2;
    plant(with("x86_64-linux/FeupFrames.so", program), "library", "executable; expected a shared library");
    for folder in ["win64", "darwin64", "aarch64-linux"] {
        let mut cut = library(folder);
        cut.truncate(cut.len() / 2);
        let file = format!("{folder}/FeupFrames.{}", extension(folder));
        plant(with(&file, cut), "library", "no library that can be read");
        let rest = exporting(folder, &functions(FmiVersion::V2)[1..]);
        plant(
            with(&file, rest),
            "exported functions",
            &format!("{file}: {} is not exported", functions(FmiVersion::V2)[0]),
        );
    }
}

fn extension(folder: &str) -> &str {
    match folder {
        "win64" => "dll",
        "darwin64" => "dylib",
        _ => "so",
    }
}

#[test]
fn names_in_the_archive_that_lead_astray() {
    let with = |name: &'static str| {
        move |mut files: Files| {
            files.push((name.into(), Vec::new()));
            files
        }
    };
    plant(with("resources\\more.txt"), "file names", "a backslash");
    plant(with("/etc/more.txt"), "file names", "an absolute path");
    plant(with("C:/more.txt"), "file names", "an absolute path");
    plant(with("resources/../../more.txt"), "file names", "`..`");
    plant(with("resources/more.txt"), "file names", "not a file of such an FMU");
}

#[test]
fn files_that_are_no_fmu() {
    let directory = TempDir::new().unwrap();
    let file = directory.path().join("file.fmu");
    let refused = |expected: &str| {
        let (code, report) = checked(&file);
        assert_eq!(code, Some(1));
        let said = findings(&report, "archive") + &findings(&report, "description");
        assert!(said.contains(expected), "no {expected:?}: {report:#}");
    };
    refused("cannot open");
    std::fs::write(&file, "").unwrap();
    refused("is not an FMU");
    std::fs::write(&file, "name = \"FeupFrames\"\n".repeat(100)).unwrap();
    refused("is not an FMU");
    write_fmu(&file, &vec![("readme.txt".into(), b"hello".to_vec())]);
    refused("no modelDescription.xml");

    let good = std::fs::read(feup_fmu()).unwrap();
    std::fs::write(&file, &good[..good.len() / 2]).unwrap();
    refused("is not an FMU");
    // A flipped bit wherever it may be: in a file, in a header, in the directory. Never a crash.
    for place in 0..40 {
        let mut bytes = good.clone();
        let at = bytes.len() * place / 40;
        bytes[at] ^= 0x10;
        std::fs::write(&file, bytes).unwrap();
        let output = cargo_fmu(&["check", file.to_str().unwrap()]);
        assert!(matches!(output.status.code(), Some(0 | 1)), "byte {at}: {:?}", output.status);
        assert_eq!(stderr(&output), "", "byte {at}");
    }
    // In the middle of the compressed library the checksum tells.
    let mut bytes = good;
    let middle = bytes.len() / 2;
    bytes[middle] ^= 0x10;
    std::fs::write(&file, bytes).unwrap();
    refused("damaged at binaries/");
}
