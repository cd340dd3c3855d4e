//! Buildings whose foundations sway and rock: against an independent solution in quadruple precision, closed forms,
//! matrices, and the same run told in another way. Here is what they share: a frame on soil and its ground motion.

mod closed_forms;
mod frames;
mod inputs;
mod invariants;
mod random;
mod reference;

use crate::common::{Run, record, scene};
use pounding::record::Record;
use pounding::scene::Scene;

/// 5 s at 50 Hz.
pub fn shaking() -> Record {
    let t = |k: i32| f64::from(k) / 50.0;
    record(0.02, &(0..=250).map(|k| 3.0 * (8.0 * t(k)).sin() + 2.0 * (23.0 * t(k)).sin()).collect::<Vec<_>>())
}

pub fn foundation(motions: &str) -> String {
    format!("[left.foundation]\nmass = 3e4\n{motions}")
}

/// Two storeys on the left, with more keys and a foundation, under that motion.
pub fn frame(keys: &str, foundation: &str) -> Scene {
    let mut scene = scene(&format!(
        "name = \"Frame\"\noutputs = {{ energy = true }}\n[left]\nmass = [4e4, 3e4]\nheight = [4.0, 3.0]\n\
         stiffness = [3e7, 2e7]\n{keys}{foundation}"
    ));
    scene.ground.record = Some("motion.csv".into());
    scene
}

pub fn run_for(scene: &Scene, time: f64) -> Run {
    let mut run = Run::new(scene, Some(&shaking()));
    run.to(time);
    run
}
