//! The descriptions of the example scenes are committed: a change shows what it does to the users.
//!
//! `UPDATE_MODEL_DESCRIPTION=1 cargo test --test fmi description` writes them anew.

use pounding::FmiVersion;
use pounding::description::Package;
use std::fs;
use std::path::{Path, PathBuf};

/// Scenes whose description in FMI 3.0 is committed, too: two buildings, one floor each, isolators.
const IN_BOTH_VERSIONS: [&str; 3] = ["feup", "two_blocks", "isolated"];

#[test]
fn the_example_scenes_have_the_committed_descriptions() {
    let update = std::env::var_os("UPDATE_MODEL_DESCRIPTION").is_some_and(|value| value == "1");
    for (scene, version, golden) in goldens() {
        let package = Package::from_scene_file(&scene).unwrap();
        let text = package.model_description(version);
        if update {
            fs::create_dir_all(golden.parent().unwrap()).unwrap();
            fs::write(&golden, &text).unwrap();
        }
        // Git may have changed the ends of the lines.
        let expected = fs::read_to_string(&golden).unwrap_or_default().replace('\r', "");
        assert!(text == expected, "{} is not what it was: {}", golden.display(), first_difference(&text, &expected));
        assert_eq!(super::problems(&text, version), [""; 0], "{}", scene.display());
    }
}

#[test]
fn there_is_no_description_without_its_scene() {
    let expected = goldens().into_iter().map(|(.., golden)| golden).collect::<Vec<_>>();
    for file in fs::read_dir(root().join("modelDescription")).unwrap() {
        let path = file.unwrap().path();
        assert!(expected.contains(&path), "{} belongs to no scene", path.display());
    }
}

/// Scene, version and committed description.
fn goldens() -> Vec<(PathBuf, FmiVersion, PathBuf)> {
    let with = |version: FmiVersion, extension: &'static str| {
        scenes().into_iter().map(move |scene| {
            let golden = root().join("modelDescription").join(scene.with_extension(extension).file_name().unwrap());
            (scene, version, golden)
        })
    };
    let is_in_both = |scene: &Path| IN_BOTH_VERSIONS.iter().any(|name| scene.file_stem().unwrap() == *name);
    let in_fmi3 = with(FmiVersion::V3, "fmi3.xml").filter(|(scene, ..)| is_in_both(scene)).collect::<Vec<_>>();
    assert_eq!(in_fmi3.len(), IN_BOTH_VERSIONS.len());
    with(FmiVersion::V2, "xml").chain(in_fmi3).collect()
}

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap()
}

fn scenes() -> Vec<PathBuf> {
    let files = fs::read_dir(root().join("examples/scenes")).unwrap().map(|file| file.unwrap().path());
    let scenes = files.filter(|path| path.extension().is_some_and(|extension| extension == "toml")).collect::<Vec<_>>();
    assert!(!scenes.is_empty());
    scenes
}

fn first_difference(found: &str, expected: &str) -> String {
    let mut lines = found.lines().zip(expected.lines().chain(std::iter::repeat("(nothing)"))).enumerate();
    let line = lines.find(|(_, (found, expected))| found != expected);
    line.map_or("it is longer".into(), |(i, (found, expected))| {
        format!("line {}\n  was {}\n  is  {}", i + 1, expected.trim(), found.trim())
    })
}
