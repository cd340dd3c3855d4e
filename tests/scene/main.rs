//! Scenes: every form that a user may write, every refusal with its words, files, and rubbish.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod files;
mod forms;
mod record;
mod record_formats;
mod record_networks;
mod record_offsets;
mod record_tables;
mod refusals;
mod robustness;
#[path = "../problems/two_and_three_storeys.rs"]
mod two_and_three_storeys;
mod units;
mod warnings;

use pounding::scene::Scene;
use two_and_three_storeys::WITHOUT_REPETITION as SCENE;

/// The two shortest buildings that stand.
const SHORT: &str = r#"
name = "Short"
left = { mass = [1], stiffness = [2], damping = { ratio = 0 } }
right = { mass = [1], stiffness = [2], damping = { ratio = 0 } }
"#;

/// [`SCENE`] with one change.
fn edited(from: &str, to: &str) -> String {
    assert_eq!(SCENE.matches(from).count(), 1, "{from:?} must be in the scene once");
    SCENE.replace(from, to)
}

/// What is said about a scene.
fn messages(text: &str) -> Vec<String> {
    match Scene::from_toml(text) {
        Ok(_) => Vec::new(),
        Err(error) => error.problems.iter().map(ToString::to_string).collect(),
    }
}
