//! The descriptions of the example scenes are committed: a change shows what it does to the users.
//!
//! `UPDATE_MODEL_DESCRIPTION=1 cargo test --test description` writes them anew.

use pounding::description::Package;
use std::fs;
use std::path::{Path, PathBuf};

#[test]
fn the_example_scenes_have_the_committed_descriptions() {
    let update = std::env::var_os("UPDATE_MODEL_DESCRIPTION").is_some_and(|value| value == "1");
    for scene in scenes() {
        let package = Package::from_scene_file(&scene).unwrap();
        let text = package.model_description(pounding::FmiVersion::V2);
        let golden = golden_file(&scene);
        if update {
            fs::create_dir_all(golden.parent().unwrap()).unwrap();
            fs::write(&golden, &text).unwrap();
        }
        // Git may have changed the ends of the lines.
        let expected = fs::read_to_string(&golden).unwrap_or_default().replace('\r', "");
        assert!(text == expected, "{} is not what it was: {}", golden.display(), first_difference(&text, &expected));
        assert_eq!(super::problems(&text), [""; 0], "{}", scene.display());
    }
}

#[test]
fn there_is_no_description_without_its_scene() {
    let expected = scenes().iter().map(|scene| golden_file(scene)).collect::<Vec<_>>();
    for file in fs::read_dir(root().join("modelDescription")).unwrap() {
        let path = file.unwrap().path();
        assert!(expected.contains(&path), "{} belongs to no scene", path.display());
    }
}

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn scenes() -> Vec<PathBuf> {
    let files = fs::read_dir(root().join("examples/scenes")).unwrap().map(|file| file.unwrap().path());
    let scenes = files.filter(|path| path.extension().is_some_and(|extension| extension == "toml")).collect::<Vec<_>>();
    assert!(!scenes.is_empty());
    scenes
}

fn golden_file(scene: &Path) -> PathBuf {
    root().join("modelDescription").join(scene.with_extension("xml").file_name().unwrap())
}

fn first_difference(found: &str, expected: &str) -> String {
    let mut lines = found.lines().zip(expected.lines().chain(std::iter::repeat("(nothing)"))).enumerate();
    let line = lines.find(|(_, (found, expected))| found != expected);
    line.map_or("it is longer".into(), |(i, (found, expected))| {
        format!("line {}\n  was {}\n  is  {}", i + 1, expected.trim(), found.trim())
    })
}
