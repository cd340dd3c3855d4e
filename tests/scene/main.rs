//! Scenes: every form that a user may write, every refusal with its words, files, and rubbish.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod files;
mod forms;
mod refusals;
mod robustness;

use pounding::scene::Scene;

/// Two floors on the left, three on the right, every optional table but `[ground]`.
const SCENE: &str = r#"
name = "TwoFrames"
description = "a test"
stop_time = 20.0

[left]
mass = [3.0, 4.0]
stiffness = [2910.0, 2920.0]
damping = { ratio = 0.01 }

[right]
mass = [5.0, 6.0, 7.0]
stiffness = [2930.0, 2940.0, 2950.0]
damping = { rayleigh = { ratio = 0.05, modes = [1, 3] } }
initial_displacement = [0.0, 0.001, 0.002]
initial_velocity = [0.0, 0.1, 0.2]

[inputs]
floor_forces = true

[[contact]]
left_floor = 1
right_floor = 1
gap = 0.002
law = "kelvin_voigt"
stiffness = 1.0e6
restitution = 0.65

[[contact]]
left_floor = 2
right_floor = 2
gap = -0.001
law = "hertz"
stiffness = 2.0e6

[outputs]
energy = true

[solver]
relative_tolerance = 1e-10
min_approach_velocity = 1e-3
"#;

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
