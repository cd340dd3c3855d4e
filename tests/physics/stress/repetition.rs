//! Shaking that comes again and again, with pauses in which the buildings lose more of what they remember than the impacts
//! before had multiplied it by. So their motion, impacts included, becomes one that comes again with the shaking, and stays
//! that. An answer that drifts, or a contact that depends on what is long past, does not. Nothing needs to be known of that
//! motion but its period.

use crate::common::{Run, record, scene};
use pounding::engine::BuildingId;
use std::f64::consts::PI;

/// Samples a second and s: times that binary numbers have exactly, for rounded ones would not come again.
const RATE: u32 = 128;
const PERIOD: u32 = 16;

/// Displacements of all floors, 16 a second, over one period from `start` on.
fn period(run: &mut Run, start: u32) -> Vec<f64> {
    let mut motion = Vec::new();
    for k in 1..=16 * PERIOD {
        run.to(f64::from(start) + f64::from(k) / 16.0);
        for (side, floors) in [(BuildingId::LEFT, 2), (BuildingId::RIGHT, 3)] {
            motion.extend((0..floors).map(|floor| run.displacement(side, floor)));
        }
    }
    motion
}

/// After eight minutes what is left of the beginning is rounding.
#[test]
fn a_motion_comes_again_with_the_shaking() {
    for law in [
        "law = \"stereomechanical\"\nrestitution = 0.65",
        "law = \"kelvin_voigt\"\nstiffness = 1.0e6\nrestitution = 0.65",
        "law = \"jankowski\"\nstiffness = 1.0e6\nrestitution = 0.65",
        "law = \"hertz_damped\"\nstiffness = 1.0e6\nrestitution = 0.65\ndamping_formula = \"exact\"",
    ] {
        let building = |floors: usize| {
            let (mass, stiffness) = (vec![3.65; floors], vec![2910.0; floors]);
            format!("mass = {mass:?}\nstiffness = {stiffness:?}\ndamping = {{ ratio = 0.05 }}\n")
        };
        let contact = |floor| format!("[[contact]]\nleft_floor = {floor}\nright_floor = {floor}\ngap = 0.005\n{law}\n");
        let mut scene = scene(&format!(
            "name = \"Repetition\"\n[left]\n{}initial_displacement = [-0.02, -0.03]\n[right]\n{}{}{}",
            building(2),
            building(3),
            contact(1),
            contact(2)
        ));
        scene.ground.record = Some("again.csv".into());
        // 6 s of shaking, 10 s of rest, in which the slowest mode falls to 2e-3.
        let samples: Vec<f64> = (0..=RATE * 520)
            .map(|k| {
                let t = f64::from(k % (RATE * PERIOD)) / f64::from(RATE);
                let strength = if t < 6.0 { (PI * t / 6.0).sin().powi(2) } else { 0.0 };
                strength * (4.0 * (9.0 * t).sin() + 3.0 * (17.7 * t).sin() + 2.0 * (31.4 * t).cos())
            })
            .collect();
        let mut run = Run::new(&scene, Some(&record(1.0 / f64::from(RATE), &samples)));
        let early = period(&mut run, 0);
        run.to(480.0);
        let (one, next) = (period(&mut run, 480), period(&mut run, 496));
        let largest = next.iter().fold(0.0_f64, |largest, u| largest.max(u.abs()));
        let apart =
            |other: &[f64]| next.iter().zip(other).fold(0.0_f64, |most, (a, b)| most.max((a - b).abs())) / largest;
        assert!(run.point.impacts > 500, "{law}: {} impacts", run.point.impacts);
        assert!(apart(&early) > 1e-3, "{law}: the beginning differs");
        assert!(apart(&one) < 1e-13, "{law}: {:e}", apart(&one));
    }
}
