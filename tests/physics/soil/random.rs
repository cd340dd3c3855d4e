//! Random frames on random soil, beside exponentials of the matrices of their phases (`physics/piecewise/`).

use super::shaking;
use crate::common::problems::laws::contact;
use crate::common::scene;
use crate::piecewise::assert_same_motion;
use crate::random_frames::{Frame, frame};
use crate::random_soil::{on_soil, soil};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;

/// Hz. The other way takes steps that are short for the fastest motion.
const FASTEST: f64 = 5.0;

/// Where nothing is hit, the rounding of the other way adds up to 1e-12 in a million steps. Impacts multiply what there is,
/// most where rebounds follow each other within milliseconds: to 2e-10 over 34 of them. With steps half as long the other
/// way differs from itself by as much.
const ALLOWED: f64 = 1e-9;

/// The gap, and where columns of the left building are hit, share of their height; without it floors meet.
fn meeting() -> impl Strategy<Value = (f64, Option<f64>)> {
    (1e-4..1e-2_f64, prop::option::of(0.1..0.9_f64))
}

/// Stiffness over mass, and restitution; without stiffness floors are rigid.
fn law() -> impl Strategy<Value = (Option<f64>, f64)> {
    (prop::option::weighted(0.7, (3.0..5.5_f64).prop_map(|k| 10.0_f64.powf(k))), 0.3..0.9_f64)
}

fn text(
    frames: &[Frame; 2],
    (gap, position): (f64, Option<f64>),
    (stiffness, restitution): (Option<f64>, f64),
) -> String {
    let law = match stiffness {
        Some(k) => {
            format!("law = \"kelvin_voigt\"\nstiffness = {:?}\nrestitution = {restitution:?}\n", k * frames[0].mass)
        }
        None => format!("law = \"stereomechanical\"\nrestitution = {restitution:?}\n"),
    };
    let contact = match position {
        Some(s) => {
            format!("[[contact]]\nleft_storey = 1\nleft_position = {s:?}\nright_floor = 1\ngap = {gap:?}\n{law}")
        }
        None => contact((1, 1), gap, &law),
    };
    format!("name = \"Any\"\n{}{}{contact}", frames[0].toml("left"), frames[1].toml("right"))
}

proptest! {
    // The same scenes in every run; another seed and more cases look further.
    #![proptest_config(ProptestConfig { cases: 60, rng_seed: RngSeed::Fixed(41), ..ProptestConfig::default() })]

    #[test]
    fn frames_move_as_matrices_say(
        frames in [frame(3), frame(3)],
        soils in [soil(), soil()],
        leans in any::<[bool; 2]>(),
        meeting in meeting(),
        law in law(),
    ) {
        let frames = frames.map(|mut frame| {
            frame.frequency = frame.frequency.min(FASTEST);
            frame
        });
        let mut scene = scene(&on_soil(&text(&frames, meeting, law), &frames, &soils, leans));
        scene.ground.record = Some("motion.csv".into());
        let motion = shaking();
        let times: Vec<f64> = (1..=40).map(|k| 0.05 * f64::from(k) + 0.003 * f64::from(k % 7)).collect();
        assert_same_motion(&scene, &motion, &times, ALLOWED);
    }
}
