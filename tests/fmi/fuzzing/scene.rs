//! Any bytes as a scene file: read or refused, and what is read can be described and made a model of.

use pounding::description::Package;
use pounding::engine::Model;
use pounding::scene::Scene;

/// Floors above which making a model takes longer than a case should.
const MOST_FLOORS: usize = 40;

/// Panics where the scene parser, the description or the model does what it should not.
pub fn check(bytes: &[u8]) {
    let Ok(text) = std::str::from_utf8(bytes) else { return };
    let scene = match Scene::from_toml(text) {
        Ok(scene) => scene,
        Err(error) => {
            assert!(!error.problems.is_empty(), "refused without a reason");
            assert!(error.problems.iter().all(|problem| !problem.to_string().is_empty()));
            return;
        }
    };
    assert_eq!(scene.check(), Ok(()), "what is read passes its own checks");
    if scene.ground.record.is_some() || scene.buildings[0].mass.len() + scene.buildings[1].mass.len() > MOST_FLOORS {
        return;
    }
    if let Err(error) = Model::new(&scene, None) {
        assert!(!error.problems.is_empty());
        return;
    }
    let package = Package { scene_text: text.to_owned(), scene, record: None };
    assert!(package.model_description(pounding::FmiVersion::V2).contains(&package.guid(pounding::FmiVersion::V2)));
}
