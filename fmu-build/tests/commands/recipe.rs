//! `cargo fmu SCENE.toml`: what it writes, what it says, and how it fails.

use crate::common::{
    build, cargo_fmu, cargo_fmu_in, changed_feup, feup, feup_fmu, files, replace_once, root, stderr, stdout,
};
use std::path::Path;
use tempfile::TempDir;

#[test]
fn the_same_scene_gives_the_same_bytes() {
    let directory = TempDir::new().unwrap();
    let (one, other) = (directory.path().join("one.fmu"), directory.path().join("other.fmu"));
    build(&feup(), &one);
    // From another place, through another file of the same content, a clock tick later.
    std::thread::sleep(std::time::Duration::from_millis(2100));
    let copy = directory.path().join("scenes");
    std::fs::create_dir_all(directory.path().join("records")).unwrap();
    std::fs::create_dir_all(&copy).unwrap();
    let record = "records/el_centro_1940_ns.csv";
    std::fs::copy(root().join("examples").join(record), directory.path().join(record)).unwrap();
    std::fs::copy(feup(), copy.join("feup.toml")).unwrap();
    build(&copy.join("feup.toml"), &other);
    assert!(std::fs::read(one).unwrap() == std::fs::read(other).unwrap());
}

#[test]
fn another_scene_gives_another_guid() {
    let guid = |fmu: &Path| {
        let description = String::from_utf8(files(fmu)[0].1.clone()).unwrap();
        description.split("guid=\"").nth(1).unwrap().split('"').next().unwrap().to_owned()
    };
    let directory = TempDir::new().unwrap();
    let scene = changed_feup(directory.path(), |text| replace_once(text, "gap = 0.005", "gap = 0.006"));
    let fmu = directory.path().join("other.fmu");
    build(&scene, &fmu);
    assert_ne!(guid(&fmu), guid(feup_fmu()));
}

#[test]
fn the_archive_has_the_layout_of_fmi() {
    let names: Vec<String> = files(feup_fmu()).into_iter().map(|(name, _)| name).collect();
    let library = if cfg!(windows) { "binaries/win64/FeupFrames.dll" } else { "binaries/linux64/FeupFrames.so" };
    assert_eq!(
        names,
        [
            "modelDescription.xml",
            library,
            "resources/scene.toml",
            "resources/record.csv",
            "model.png",
            "documentation/index.html",
            "documentation/licenses/license.txt",
            "documentation/licenses/LICENSE-APACHE",
            "documentation/licenses/LICENSE-MIT",
        ]
    );
}

#[test]
fn the_page_says_what_the_model_is_and_the_icon_is_a_picture() {
    let entry = |wanted: &str| files(feup_fmu()).into_iter().find(|(name, _)| name == wanted).unwrap().1;
    let page = String::from_utf8(entry("documentation/index.html")).unwrap();
    // Well formed: as XML but for its first line.
    let body = page.split_once('\n').unwrap().1.replace("<meta charset=\"utf-8\">", "");
    let tree = roxmltree::Document::parse(&body).unwrap();
    let text: String = tree.descendants().filter_map(|node| node.text()).collect();
    assert!(text.contains("buildings of 2 and 3 storeys") && text.contains("with 2 contacts"), "{text}");
    // The scene as it was written, and a row for each variable.
    assert!(text.contains(std::fs::read_to_string(feup()).unwrap().trim()), "{text}");
    let description = String::from_utf8(entry("modelDescription.xml")).unwrap();
    let description = roxmltree::Document::parse(&description).unwrap();
    let names = description.descendants().filter(|node| node.has_tag_name("ScalarVariable"));
    for name in names.map(|node| node.attribute("name").unwrap()) {
        assert!(tree.descendants().any(|node| node.has_tag_name("td") && node.text() == Some(name)), "no {name}");
    }
    assert!(entry("model.png").starts_with(b"\x89PNG\r\n"));
}

#[test]
fn the_default_scene_goes_to_the_default_place_and_says_what_happened() {
    let fmu = root().join("target/fmu/FeupFrames.fmu");
    let _ = std::fs::remove_file(&fmu);
    let output = cargo_fmu(&[]);
    assert!(output.status.success(), "{}", stderr(&output));
    assert_eq!(stderr(&output), "", "quiet in a pipe");
    assert!(fmu.is_file());
    let said = stdout(&output);
    // Frequencies as in the seed paper, section 3.2.
    for expected in ["2.7774, 7.2712 Hz", "2.0000, 5.6038, 8.0977 Hz", "0 s to 20 s (stop_time of the scene)", "guid"] {
        assert!(said.contains(expected), "no {expected:?} in\n{said}");
    }
}

#[test]
fn another_scene_of_the_same_name_is_not_replaced_without_a_word() {
    let fmu = root().join("target/fmu/TwoOfOneName.fmu");
    let named = |text: &str| replace_once(text, "\"FeupFrames\"", "\"TwoOfOneName\"");
    let directories = [TempDir::new().unwrap(), TempDir::new().unwrap()];
    let scenes = directories.each_ref().map(|directory| changed_feup(directory.path(), named));
    let build = |scene: &Path| {
        let output = cargo_fmu(&[scene.to_str().unwrap()]);
        assert!(output.status.success(), "{}", stderr(&output));
        stderr(&output)
    };
    let _ = std::fs::remove_file(&fmu);
    assert_eq!(build(&scenes[0]), "");
    // The same contents from elsewhere, and the same scene changed, are no other scene.
    assert_eq!(build(&scenes[1]), "");
    let changed = |text: &str| replace_once(&named(text), "gap = 0.005", "gap = 0.006");
    changed_feup(directories[1].path(), changed);
    assert_eq!(build(&scenes[1]), "");
    let said = build(&scenes[0]);
    let [one, other] = scenes.each_ref().map(|scene| scene.canonicalize().unwrap().display().to_string());
    let expected = format!("warning: {} = {one}: it was {other}, a scene of the same name;", fmu.display());
    assert!(said.starts_with(&expected) && said.lines().count() == 1, "{said}");
    assert_eq!(build(&scenes[0]), "");
    // A place that is named is for whoever names it.
    let arguments = [scenes[1].to_str().unwrap(), "-o", fmu.to_str().unwrap()];
    assert_eq!(stderr(&cargo_fmu(&arguments)), "");
}

#[test]
fn the_scene_is_relative_to_the_current_directory() {
    let directory = TempDir::new().unwrap();
    changed_feup(directory.path(), str::to_owned);
    let output = cargo_fmu_in(directory.path(), &["scene.toml", "-o", "sub/here.fmu"]);
    assert!(output.status.success(), "{}", stderr(&output));
    assert!(directory.path().join("sub/here.fmu").is_file());
}

#[test]
fn a_directory_for_the_fmu_is_made_where_the_scene_is_in_order() {
    let directory = TempDir::new().unwrap();
    let scene = changed_feup(directory.path(), |text| replace_once(text, "[3.65, 3.65]", "[3.65, -1.0]"));
    let made = directory.path().join("one/other");
    let fmu = made.join("here.fmu");
    let arguments = [scene.to_str().unwrap(), "-o", fmu.to_str().unwrap()];
    assert_eq!(cargo_fmu(&arguments).status.code(), Some(1));
    assert!(!directory.path().join("one").exists());
    changed_feup(directory.path(), str::to_owned);
    assert!(cargo_fmu(&arguments).status.success());
    let names = std::fs::read_dir(made).unwrap().map(|entry| entry.unwrap().file_name());
    assert_eq!(names.collect::<Vec<_>>(), ["here.fmu"]);
    assert!(stdout(&cargo_fmu(&["--help"])).contains("in a directory that is made if need be"));
}

#[test]
fn a_trial_run_that_takes_too_long_is_stopped_and_leaves_nothing_behind() {
    let directory = TempDir::new().unwrap();
    let scene = changed_feup(directory.path(), |text| replace_once(text, "stop_time = 20.0", "stop_time = 1e9"));
    let fmu = directory.path().join("one/other/here.fmu");
    let arguments = [scene.to_str().unwrap(), "-o", fmu.to_str().unwrap(), "--time-limit", "1"];
    let clock = std::time::Instant::now();
    let output = cargo_fmu(&arguments);
    assert!(clock.elapsed().as_secs() < 200, "compiling included: {:?}", clock.elapsed());
    assert_eq!((output.status.code(), stdout(&output).as_str()), (Some(1), ""));
    let said = stderr(&output);
    let expected = "the FMU has been built but does not run: not over after 1 s, so it was stopped (--time-limit)";
    assert!(said.contains(expected), "{said}");
    assert!(!directory.path().join("one").exists());

    // A directory that was there stays, with what is in it.
    std::fs::create_dir_all(fmu.parent().unwrap()).unwrap();
    std::fs::write(&fmu, "old").unwrap();
    assert_eq!(cargo_fmu(&arguments).status.code(), Some(1));
    assert_eq!(std::fs::read_to_string(&fmu).unwrap(), "old");
    assert_eq!(std::fs::read_dir(fmu.parent().unwrap()).unwrap().count(), 1);
    assert_eq!(cargo_fmu(&["--time-limit", "0"]).status.code(), Some(2));
}

/// Compiling takes minutes, writing does not: a destination that cannot be is refused before.
#[test]
fn what_cannot_be_written_is_refused_before_anything_is_compiled() {
    let directory = TempDir::new().unwrap();
    let scene = changed_feup(directory.path(), str::to_owned);
    std::fs::write(directory.path().join("file"), "").unwrap();
    let too_long = format!("{}.fmu", "n".repeat(300));
    for (destination, expected) in [
        (directory.path().to_path_buf(), "is a directory"),
        (directory.path().join("file/x.fmu"), "cannot write to"),
        (directory.path().join(too_long), "cannot write"),
    ] {
        // No cargo, no compiling.
        let output = std::process::Command::new(env!("CARGO_BIN_EXE_cargo-fmu"))
            .args([scene.as_os_str(), "-o".as_ref(), destination.as_os_str()])
            .current_dir(directory.path())
            .env("CARGO", "/nowhere/cargo")
            .output()
            .unwrap();
        assert_eq!(output.status.code(), Some(1));
        assert!(stderr(&output).contains(expected), "{}", stderr(&output));
    }
    // A name that a scene may have is one that a file can have.
    let longest = changed_feup(directory.path(), |text| replace_once(text, "FeupFrames", &"n".repeat(128)));
    build(&longest, &directory.path().join(format!("{}.fmu", "n".repeat(128))));
}

#[test]
fn every_problem_is_named_and_an_old_fmu_stays() {
    let directory = TempDir::new().unwrap();
    let scene = changed_feup(directory.path(), |text| {
        let text = replace_once(text, "mass = [3.65, 3.65]", "mass = [3.65, -1.0]");
        let text = replace_once(&text, "restitution = 0.65", "restitution = 1.4");
        replace_once(&text, "[outputs]", "[outputs]\nnonsense = 1")
    });
    let fmu = directory.path().join("old.fmu");
    std::fs::write(&fmu, "old").unwrap();
    let output = cargo_fmu(&[scene.to_str().unwrap(), "-o", fmu.to_str().unwrap()]);
    assert_eq!(output.status.code(), Some(1));
    assert_eq!(stdout(&output), "");
    let said = stderr(&output);
    for expected in ["left.mass[2] = -1", "contact[1].restitution = 1.4: expected 0 < e <= 1", "nonsense"] {
        assert!(said.contains(expected), "no {expected:?} in\n{said}");
    }
    assert!(!said.contains("panicked"), "{said}");
    assert_eq!(std::fs::read_to_string(&fmu).unwrap(), "old");
    assert_eq!(std::fs::read_dir(directory.path()).unwrap().count(), 3, "nothing half-written is left");
    // Those of the record as well.
    std::fs::write(directory.path().join("record.csv"), "time_s,accel_m_s2\n0,1\n1,x\n1,2\n1,3\n").unwrap();
    let said = stderr(&cargo_fmu(&[scene.to_str().unwrap(), "-o", fmu.to_str().unwrap()]));
    for expected in ["left.mass[2] = -1", "line 3: accel_m_s2 = x", "line 5: time 1 s", "nonsense"] {
        assert!(said.contains(expected), "no {expected:?} in\n{said}");
    }
}

#[test]
fn what_cannot_be_read_or_written_is_named() {
    let directory = TempDir::new().unwrap();
    let refused = |arguments: &[&str], expected: &str| {
        let output = cargo_fmu(arguments);
        assert_eq!(output.status.code(), Some(1), "{arguments:?}");
        assert!(stderr(&output).contains(expected), "{}", stderr(&output));
        assert!(!stderr(&output).contains("panicked"), "{}", stderr(&output));
    };
    refused(&["no/such/scene.toml"], "no/such/scene.toml");
    refused(&[directory.path().to_str().unwrap()], directory.path().to_str().unwrap());
    let scene = changed_feup(directory.path(), |text| replace_once(text, "record.csv", "elsewhere.csv"));
    refused(&[scene.to_str().unwrap()], "elsewhere.csv");
    let scene = changed_feup(directory.path(), str::to_owned);
    refused(&[scene.to_str().unwrap(), "-o", directory.path().to_str().unwrap()], "is a directory");
    std::fs::write(directory.path().join("file"), "").unwrap();
    let below = directory.path().join("file/x.fmu");
    refused(&[scene.to_str().unwrap(), "-o", below.to_str().unwrap()], "cannot write");
    std::fs::write(&scene, [0xff, 0xfe, 0x00]).unwrap();
    refused(&[scene.to_str().unwrap()], scene.to_str().unwrap());
}

#[test]
fn wrong_usage_has_its_own_exit_code() {
    for arguments in [&["--nonsense"][..], &["a.toml", "b.toml"], &["check"], &["-o"], &["check", "a.fmu", "b.fmu"]] {
        let output = cargo_fmu(arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        assert!(stderr(&output).contains("try '--help'"), "{}", stderr(&output));
        assert_eq!(stdout(&output), "");
    }
}

#[test]
#[cfg(target_os = "linux")]
fn help_that_is_lost_is_no_success() {
    for arguments in [&["--help"][..], &["--version"], &["check", "--help"], &["help", "merge"]] {
        let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_cargo-fmu"));
        let full = std::fs::OpenOptions::new().write(true).open("/dev/full").unwrap();
        let output = command.args(arguments).stdout(full).output().unwrap();
        assert_eq!(output.status.code(), Some(1), "{arguments:?}");
        assert!(stderr(&output).starts_with("error: cannot write to standard output"), "{}", stderr(&output));
    }
}
