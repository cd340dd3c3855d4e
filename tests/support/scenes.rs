//! Scenes that between them have every kind of variable, and their packages without any file.
#![allow(dead_code, clippy::unwrap_used)] // each test uses its share

use pounding::scene::{Package, PackagedRecord, Scene};

/// Two storeys beside three, close together, driven by an input: everything that needs no record.
pub const SCENE: &str = r#"
name = "TwoBuildings"
description = "2 and 3 storeys, driven from outside"
stop_time = 4.0

[left]
mass = [3.65, 3.65]
stiffness = [2910.0, 2910.0]
damping = { ratio = 0.01 }
initial_velocity = [0.3, 0.5]

[right]
mass = [3.65, 3.65, 3.65]
stiffness = [2910.0, 2910.0, 2910.0]
damping = { ratio = 0.02 }

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
gap = 0.002
law = "hertz"
stiffness = 1.0e6

[outputs]
energy = true
"#;

/// The same buildings under a record, with the other ways to give stiffness and damping.
pub const RECORD_SCENE: &str = r#"
name = "UnderARecord"
stop_time = 2.0

[left]
mass = [3.65, 3.65]
stiffness_matrix = [[5820.0, -2910.0], [-2910.0, 2910.0]]
damping = { rayleigh = { ratio = 0.02, modes = [1, 2] } }

[right]
mass = [3.65, 3.65, 3.65]
stiffness = [2910.0, 2910.0, 2910.0]
damping = { ratios = [0.01, 0.02, 0.03] }

[ground]
record = "motion.csv"
pga = 3.0

[[contact]]
left_floor = 2
right_floor = 2
gap = 0.001
law = "kelvin_voigt_no_tension"
stiffness = 1.0e6
restitution = 0.5
"#;

/// A burst of 2 Hz, about 2.4 m/s2 at most.
pub fn record() -> String {
    let sample = |k: u32| {
        let t = f64::from(k) * 0.02;
        format!("{t},{}\n", 2.5 * (12.566 * t).sin() * (1.57 * t).sin())
    };
    format!("time_s,accel_m_s2\n{}", (0..=100).map(sample).collect::<String>())
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
