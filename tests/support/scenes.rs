//! Scenes that between them have every kind of variable, and their packages without any file.
#![allow(dead_code, unused_imports, clippy::unwrap_used)] // each test uses its share

#[path = "../problems/two_and_three_storeys.rs"]
mod two_and_three_storeys;

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
