//! Gravity on storeys that lean, beside scenes in which smaller stiffnesses and yield forces stand for it, and beside none.

use crate::common::problems::frames::zigzag;
use crate::common::problems::laws::Laws;
use crate::common::{Run, record, scene};
use pounding::engine::{BuildingId, PeakOf};

/// Draws numbers between two others (linear congruential generator).
struct Draw(u64);

impl Draw {
    fn between(&mut self, low: f64, high: f64) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        low + (high - low) * ((self.0 >> 11) as f64 / (1_u64 << 53) as f64)
    }

    /// One building with gravity, and the one that stands for it.
    fn building(&mut self, side: &str) -> [String; 2] {
        let storeys = 1 + self.between(0.0, 2.99) as usize;
        let mut loads = Vec::new();
        let mut list = |low: f64, high: f64| (0..storeys).map(|_| self.between(low, high)).collect::<Vec<f64>>();
        let (mass, stiffness, height) = (list(2e4, 4e4), list(1.5e7, 3e7), list(3.0, 4.5));
        let (force, hardening, weights) = (list(8e4, 2e5), list(0.0, 0.3), list(1e5, 2e6));
        let mut ratios = Vec::new();
        let mut net = [Vec::new(), Vec::new(), Vec::new()];
        for storey in 0..storeys {
            let above: f64 = weights[storey..].iter().rev().fold(0.0, |sum, weight| sum + weight);
            let theta = above / height[storey] / stiffness[storey];
            let ratio = theta + hardening[storey];
            net[0].push(stiffness[storey] - above / height[storey]);
            net[1].push(force[storey] * (1.0 - theta));
            net[2].push((ratio - theta) / (1.0 - theta));
            ratios.push(ratio);
            loads.push(weights[storey]);
        }
        let text = |stiffness: &[f64], force: &[f64], ratio: &[f64]| {
            format!(
                "[{side}]\nmass = {mass:?}\nstiffness = {stiffness:?}\ndamping = {{ ratio = 0.04 }}\nyield_force = {force:?}\n\
                 post_yield_ratio = {ratio:?}\n"
            )
        };
        let gravity = format!("height = {height:?}\np_delta = true\ngravity_load = {loads:?}\n");
        [text(&stiffness, &force, &ratios) + &gravity, text(&net[0], &net[1], &net[2])]
    }
}

/// Random buildings with gravity, beside those typed in with the stiffness, yield force and ratio that it leaves.
#[test]
fn smaller_stiffnesses_and_yield_forces_stand_for_gravity() {
    let mut draw = Draw(7);
    let (mut impacts, mut worst) = (0, 0.0_f64);
    for case in 0..40 {
        let (left, right) = (draw.building("left"), draw.building("right"));
        let law = Laws { spring: 2e8, hertz: 2e9, exponent: 1.5, restitution: 0.6 }.all()[case % 8].clone();
        let [mut with, mut without] = [0, 1].map(|i| {
            let contact = format!("[[contact]]\nleft_floor = 1\nright_floor = 1\ngap = 0.01\n{law}\n");
            let text = format!("name = \"Net\"\n{}{}[outputs]\nenergy = true\n{contact}", left[i], right[i]);
            let mut scene = scene(&text);
            scene.ground.record = Some("zigzag.csv".into());
            Run::new(&scene, Some(&record(1.0 / 64.0, &(0..256).map(|k| zigzag(k) / 5.0).collect::<Vec<_>>())))
        });
        for k in 1..=40 {
            with.to(0.1 * f64::from(k));
            without.to(0.1 * f64::from(k));
            worst = worst.max(apart(&with, &without));
        }
        impacts += with.point.impacts;
        assert!(with.storeys().iter().any(|storey| storey.cumulative > 1e-3), "case {case}");
    }
    println!("{impacts} impacts, worst {worst:.1e}");
    assert!(impacts > 100, "{impacts} impacts");
    assert!(worst < 1e-13, "off by {worst:.1e}");
}

/// The largest difference of displacements and plastic drifts, relative to the largest displacement so far, of energies and of
/// impulses of contacts.
fn apart(with: &Run, without: &Run) -> f64 {
    let mut worst = 0.0_f64;
    for side in [BuildingId::LEFT, BuildingId::RIGHT] {
        let floors = with.model.floors(side);
        let size = (0..floors).map(|floor| with.peak(PeakOf::Displacement(side, floor))).fold(0.0, f64::max);
        for floor in 0..floors {
            worst = worst.max((with.displacement(side, floor) - without.displacement(side, floor)).abs() / size);
            let plastic = [with, without].map(|run| run.storey(side, floor).plastic);
            worst = worst.max((plastic[0] - plastic[1]).abs() / size);
        }
    }
    let (one, other) = (with.energy(), without.energy());
    let size = one.kinetic.max(one.strain).max(one.hysteretic).max(one.input);
    let pairs = [(one.strain + one.gravity, other.strain), (one.kinetic, other.kinetic), (one.input, other.input)];
    pairs.iter().for_each(|(one, other)| worst = worst.max((one - other).abs() / size));
    worst = worst.max((one.hysteretic - other.hysteretic).abs() / size);
    for (one, other) in with.contacts().iter().zip(without.contacts()) {
        assert_eq!(one.impacts, other.impacts, "{} s", with.state.time());
        // Relative to the momentum of the lightest floor with all that energy: a contact may have just begun.
        worst = worst.max((one.impulse - other.impulse).abs() / f64::sqrt(2.0 * 2e4 * size));
    }
    worst
}

/// Storeys that lean under no weight show the same bits as storeys that gravity does not push on.
#[test]
fn no_weight_is_no_gravity() {
    let building = |side: &str, mass: f64, force: &str, gravity: &str| {
        format!(
            "[{side}]\nmass = {:?}\nstiffness = [3e7, 2.5e7, 2e7]\ndamping = {{ ratio = 0.03 }}\nyield_force = {force}\n\
             post_yield_ratio = [0.05, 0.0, 0.1]\nheight = [4.0, 3.5, 3.0]\n{gravity}",
            [mass, mass, 0.8 * mass]
        )
    };
    let law = Laws { spring: 2e8, hertz: 2e9, exponent: 1.5, restitution: 0.6 }.hertz_damped("exact");
    let [with, without] = ["p_delta = true\ngravity_load = [0.0, 0.0, 0.0]\n", ""].map(|gravity| {
        let mut scene = scene(&format!(
            "name = \"Frames\"\n{}{}[outputs]\nenergy = true\n[[contact]]\nleft_floor = 3\nright_floor = 3\ngap = 0.004\n{law}\n",
            building("left", 4e4, "[4e5, 3e5, inf]", gravity),
            building("right", 2.5e4, "[inf, 2e5, 1.2e5]", gravity)
        ));
        scene.ground.record = Some("zigzag.csv".into());
        let record = record(1.0 / 64.0, &(0..640).map(|k| zigzag(k) / 5.0).collect::<Vec<_>>());
        let mut run = Run::new(&scene, Some(&record));
        (1..=100).map(|k| (run.to(0.1 * f64::from(k)).bits(), run.energy())).collect::<Vec<_>>()
    });
    assert!(with.iter().zip(&without).all(|(with, without)| with.0 == without.0));
    for ((_, with), (_, without)) in with.iter().zip(&without) {
        assert_eq!(
            (with.strain.to_bits(), with.residual.to_bits()),
            (without.strain.to_bits(), without.residual.to_bits())
        );
        assert_eq!(with.gravity, 0.0);
    }
}
