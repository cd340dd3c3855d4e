//! Random scenes: two frames that face each other at some floors, shaken for two seconds.

use crate::common::problems::laws::contact;
use crate::common::{record, scene};
use crate::random_frames::frame;
use pounding::record::Record;
use pounding::scene::Scene;
use proptest::prelude::*;

/// A scene with its record, and what it reads like.
#[derive(Clone)]
pub struct Case {
    pub scene: Scene,
    pub record: Record,
    pub text: String,
}

impl std::fmt::Debug for Case {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.text)
    }
}

impl Case {
    pub fn duration(&self) -> f64 {
        self.record.times[self.record.times.len() - 1] - self.record.times[0]
    }
}

/// Stiffness over the mass of a floor, restitution, exponent.
type Numbers = (f64, f64, f64);

fn law() -> impl Strategy<Value = (&'static str, Numbers)> {
    let name = prop_oneof![
        Just("stereomechanical"),
        Just("linear"),
        Just("kelvin_voigt"),
        Just("kelvin_voigt_no_tension"),
        Just("hertz"),
        Just("jankowski"),
        Just("hertz_damped"),
    ];
    let exponent = prop_oneof![Just(1.0), Just(1.5), Just(2.0), 1.0..3.0_f64];
    (name, ((4.0..8.0_f64).prop_map(|k| 10.0_f64.powf(k)), 0.1..0.95_f64, exponent))
}

/// The keys of a law.
pub fn law_toml((name, (stiffness, restitution, exponent)): (&str, Numbers), mass: f64) -> String {
    let stiffness = stiffness * mass;
    let mut text = format!("law = \"{name}\"\n");
    if name != "stereomechanical" {
        text += &format!("stiffness = {stiffness:?}\n");
    }
    if name.starts_with("hertz") {
        text += &format!("exponent = {exponent:?}\n");
    }
    if !matches!(name, "linear" | "hertz") {
        text += &format!("restitution = {restitution:?}\n");
    }
    if name == "hertz_damped" {
        text += "damping_formula = \"exact\"\n";
    }
    text
}

/// Frames of up to so many storeys, with contacts at the floors that face each other and one across.
pub fn case(most_storeys: usize) -> impl Strategy<Value = Case> {
    let laws = prop::collection::vec((law(), prop_oneof![Just(0.0), 1e-4..2e-2_f64]), 9);
    ([frame(most_storeys), frame(most_storeys)], laws, any::<bool>()).prop_map(|(frames, laws, across)| {
        let mut text =
            format!("name = \"Any\"\n{}{}[outputs]\nenergy = true\n", frames[0].toml("left"), frames[1].toml("right"));
        let (left, right) = (frames[0].storeys.len(), frames[1].storeys.len());
        let mut pairs: Vec<(usize, usize)> = (1..=left.min(right)).map(|floor| (floor, floor)).collect();
        // Two pairs of one floor.
        if across && right > 1 {
            pairs.push((1, 2));
        }
        for (&pair, (law, gap)) in pairs.iter().zip(&laws) {
            text += &contact(pair, *gap, &law_toml(*law, frames[0].mass));
        }
        let mut scene = scene(&text);
        scene.ground.record = Some("motion.csv".into());
        Case { scene, record: motion(), text }
    })
}

/// 2 s at 64 Hz that begin with 0.
fn motion() -> Record {
    let t = |k: i32| f64::from(k) / 64.0;
    record(1.0 / 64.0, &(0..=128).map(|k| 4.0 * (9.0 * t(k)).sin() + 2.0 * (31.0 * t(k)).sin()).collect::<Vec<_>>())
}
