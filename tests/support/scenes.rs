//! Scenes that between them have every kind of variable, and their packages without any file.
#![allow(dead_code, unused_imports, clippy::unwrap_used)] // each test uses its share

#[path = "../problems/two_and_three_storeys.rs"]
pub mod two_and_three_storeys;

use pounding::scene::{Package, PackagedRecord, Scene};
pub use two_and_three_storeys::{RECORD_SCENE, RICH, SCENE};

/// A burst of 2 Hz, about 2.4 m/s2 at most.
pub fn record() -> String {
    let sample = |k: u32| {
        let t = f64::from(k) * 0.02;
        format!("{t},{}\n", 2.5 * (12.566 * t).sin() * (1.57 * t).sin())
    };
    format!("time_s,accel_m_s2\n{}", (0..=100).map(sample).collect::<String>())
}

/// The scene of an FMU that has numbers alone.
pub fn numbers_only(scene_text: &str) -> String {
    let key = "[outputs]\nnumbers_only = true\n";
    let text = if scene_text.contains("[outputs]\n") { scene_text } else { &format!("{scene_text}\n[outputs]\n") };
    text.replacen("[outputs]\n", key, 1)
}

/// The least that a scene may have, with a description that XML has to escape.
pub const NO_CONTACT: &str = "name = \"Apart\"\ndescription = \"a < b & \\\"c\\\"\"\n\
    [left]\nmass = [1e5]\nstiffness = [1e7]\ndamping = { matrix = [[1e3]] }\n\
    [right]\nmass = [2e5]\nstiffness = [1e7]\ndamping = { ratio = 0 }\n";

/// The package of a scene; a record that it names is [`record`].
pub fn package(scene_text: &str) -> Package {
    let scene = Scene::from_toml(scene_text).unwrap();
    let packaged = |name| PackagedRecord::parse(name, record().into_bytes()).unwrap();
    let record = scene.ground.record.as_deref().map(packaged);
    Package { scene_text: scene_text.to_owned(), scene, record }
}

/// What meets is not level: slabs against columns, a wall, dashpots, heights; all that moves at the start.
pub const UNEVEN: &str = r#"
name = "Uneven"
[left]
mass = [3.65, 4.2]
stiffness = [2910.0, 2000.0]
damping = { dashpots = [3.0, 2.0] }
height = [0.5, 0.5]
initial_displacement = [0.1, 0.02]
initial_velocity = [0.1, -0.05]
[right]
mass = [3.0, 2.0]
stiffness = [2500.0, 1500.0]
damping = { ratio = 0.02 }
height = [0.4, 0.45]
initial_displacement = [0.02, 0.12]
initial_velocity = [0.05, 0.2]
[inputs]
floor_forces = true
[outputs]
energy = true
[[contact]]
left_floor = 1
right_storey = 2
right_position = 0.3
gap = 0.01
law = "kelvin_voigt_no_tension"
stiffness = 1.0e4
restitution = 0.6
[[contact]]
right_floor = 1
left_storey = 1
gap = 0.01
law = "jankowski"
stiffness = 1.0e5
restitution = 0.6
[[contact]]
left_floor = 2
wall = "right"
gap = 0.01
law = "kelvin_voigt"
stiffness = 1.0e4
restitution = 0.6
"#;

/// Storeys that yield, three of which are beyond their yield drift at the start, and one that does not.
pub const YIELDING: &str = r#"
name = "Yielding"
[left]
mass = [3.65, 4.2]
stiffness = [2910.0, 2000.0]
damping = { ratio = 0.02 }
yield_force = [18.0, 12.0]
post_yield_ratio = [0.1, 0.05]
initial_displacement = [0.01, 0.02]
initial_velocity = [0.3, 0.5]
[right]
mass = [3.0, 2.5]
stiffness = [2500.0, 2200.0]
damping = { dashpots = [2.0, 1.5] }
yield_force = [15.0, inf]
post_yield_ratio = [0.2, 0.3]
initial_displacement = [-0.012, -0.009]
initial_velocity = [-0.2, -0.1]
[inputs]
floor_forces = true
[outputs]
energy = true
[[contact]]
left_floor = 1
right_floor = 1
gap = 0.03
law = "kelvin_voigt"
stiffness = 1.0e4
restitution = 0.65
[[contact]]
left_floor = 2
right_floor = 2
gap = 0.04
law = "hertz_damped"
stiffness = 1.0e5
restitution = 0.6
damping_formula = "exact"
"#;

/// Every kind of link: one that slips at the start, one that is stretched but does not, a dashpot, one to the ground.
pub const LINKED: &str = r#"
name = "Linked"
[left]
mass = [3.65, 4.2]
stiffness = [2910.0, 2000.0]
damping = { ratio = 0.02 }
initial_displacement = [0.01, 0.02]
initial_velocity = [0.3, 0.5]
[right]
mass = [3.0, 2.5, 2.2]
stiffness = [2500.0, 2200.0, 1800.0]
damping = { dashpots = [2.0, 1.5, 1.0] }
initial_displacement = [-0.012, -0.009, 0.004]
initial_velocity = [-0.2, -0.1, 0.1]
[inputs]
floor_forces = true
[outputs]
energy = true
[[link]]
left_floor = 2
right_floor = 2
stiffness = 900.0
slip_force = 10.0
post_yield_ratio = 0.1
[[link]]
left_floor = 1
right_floor = 1
stiffness = 500.0
dashpot = 12.0
[[link]]
left_floor = 1
right_floor = 3
dashpot = 7.0
[[link]]
right_floor = 2
wall = "left"
stiffness = 300.0
dashpot = 3.0
slip_force = 1.5
post_yield_ratio = 0.2
[[contact]]
left_floor = 1
right_floor = 1
gap = 0.03
law = "kelvin_voigt"
stiffness = 1.0e4
restitution = 0.65
"#;

/// What resists is corrected, of a building on soil and of one with a matrix; its floors can be pushed too.
pub const CORRECTED: &str = r#"
name = "Corrected"
[left]
mass = [3.65, 4.2]
height = [0.5, 0.4]
stiffness = [2910.0, 2000.0]
damping = { dashpots = [3.0, 2.0] }
initial_velocity = [0.1, 0.3]
[left.foundation]
mass = 2.0
inertia = 0.3
sway = { stiffness = 4.0e3, dashpot = 20.0 }
rocking = { stiffness = 2.0e3, dashpot = 8.0 }
[right]
mass = [3.0, 2.5]
stiffness_matrix = [[4700.0, -2200.0], [-2200.0, 2200.0]]
damping = { matrix = [[6.0, -2.0], [-2.0, 3.0]] }
[inputs]
floor_forces = true
restoring_corrections = true
[outputs]
energy = true
[[contact]]
left_floor = 2
right_floor = 2
gap = 0.003
law = "kelvin_voigt"
stiffness = 1.0e4
restitution = 0.65
"#;

/// A storey whose side is pushed over: the run ends with its collapse.
pub const COLLAPSE: &str = "name = \"Falls\"\n[left]\nmass = [1.0e5]\nstiffness = [1.0e6]\nheight = [3.0]\n\
    damping = { ratio = 0.0 }\nyield_force = [1.0e4]\npost_yield_ratio = [0.0]\np_delta = true\n\
    collapse_drift_ratio = 0.1\ninitial_velocity = [2.0]\n";
