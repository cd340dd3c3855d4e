//! Storeys that yield at one instant, and scenes that are alike: as many storeys as one likes move as one oscillator.

use crate::bilinear::Oscillator;
use crate::common::problems::frames::zigzag;
use crate::common::{Run, record, scene};
use pounding::engine::BuildingId;
use pounding::record::Record;
use pounding::scene::{Scene, Yielding};
use std::f64::consts::PI;

const MASS: f64 = 2e4;
const STIFFNESS: f64 = 3e7;
/// Yield drift at the roof when all storeys yield, m.
const LIMIT: f64 = 0.02;

/// Like storeys, n of them, whose yield forces are in proportion to their shears in the first mode: its shape sin(j a) with
/// a = pi / (2 n + 1), its frequency 2 sqrt(k / m) sin(a / 2).
struct InFirstMode {
    shape: Vec<f64>,
    w: f64,
    ratio: f64,
}

impl InFirstMode {
    fn new(n: usize, ratio: f64) -> InFirstMode {
        let angle = PI / (2 * n + 1) as f64;
        let roof = (n as f64 * angle).sin();
        let shape = (1..=n).map(|j| (j as f64 * angle).sin() / roof).collect();
        InFirstMode { shape, w: 2.0 * f64::sqrt(STIFFNESS / MASS) * (0.5 * angle).sin(), ratio }
    }

    /// Drift of a storey when that of the roof is 1.
    fn share(&self, storey: usize) -> f64 {
        self.shape[storey] - storey.checked_sub(1).map_or(0.0, |below| self.shape[below])
    }

    fn building(&self, side: &str, speed: f64) -> String {
        let n = self.shape.len();
        let force: Vec<f64> = (0..n).map(|i| STIFFNESS * LIMIT * self.share(i)).collect();
        let speeds: Vec<f64> = self.shape.iter().map(|shape| shape * speed).collect();
        format!(
            "{}yield_force = {force:?}\npost_yield_ratio = {:?}\n",
            crate::rows::building(side, &vec![MASS; n], &vec![STIFFNESS; n], &speeds),
            self.ratio
        )
    }

    fn assert_moves_like(&self, run: &Run, exact: &Oscillator, size: f64, what: &str) {
        for (i, shape) in self.shape.iter().enumerate() {
            let (u, v) = (run.displacement(BuildingId::LEFT, i), run.velocity(BuildingId::LEFT, i));
            let error =
                ((u - shape * exact.drift()).abs() / size).max((v - shape * exact.rate).abs() / (size * self.w));
            assert!(error < 1e-11, "{what}, floor {i} at {} s: {u:e}, {v:e}, off by {error:.1e}", exact.time);
            let shown = run.storey(BuildingId::LEFT, i);
            let error = (shown.plastic - self.share(i) * exact.plastic).abs() / size;
            assert!(error < 1e-11, "{what}, storey {i} at {} s: {shown:?}, off by {error:.1e}", exact.time);
            let error = (shown.cumulative - self.share(i) * exact.cumulative).abs() / (size + exact.cumulative);
            assert!(error < 1e-11, "{what}, storey {i} at {} s: {shown:?}, off by {error:.1e}", exact.time);
        }
    }
}

#[test]
fn storeys_that_all_switch_at_once_are_one_oscillator() {
    for n in [1, 2, 3, 8, 16] {
        assert_one_oscillator(n, "");
    }
}

/// Yields of more than 16 floors are followed floor by floor.
#[test]
fn many_storeys_that_all_switch_at_once() {
    for n in [16, 24] {
        assert_one_oscillator(n, &crate::rows::building("right", &[1e4], &[1e6], &[0.3]));
    }
}

#[test]
fn many_storeys_of_one_building_that_all_switch_at_once() {
    assert_one_oscillator(17, "");
}

/// `other` is the other building.
fn assert_one_oscillator(n: usize, other: &str) {
    for ratio in [0.0, 0.07] {
        let frame = InFirstMode::new(n, ratio);
        let speed = 4.0 * LIMIT * frame.w;
        let what = format!("{n} storeys, r = {ratio}");
        let text = format!("name = \"All\"\n{}{other}[outputs]\nenergy = true\n", frame.building("left", speed));
        let start = Oscillator { rate: speed, ..Oscillator::new(frame.w, LIMIT, ratio) };
        let switches = start.switches(3.0 * 2.0 * PI / frame.w);
        let size = switches.iter().map(|now| now.drift().abs()).fold(0.0, f64::max);
        let mut run = Run::new(&scene(&text), None);
        for k in 1..=60 {
            let time = 0.05 * f64::from(k) * 2.0 * PI / frame.w;
            run.to(time);
            frame.assert_moves_like(&run, &start.at(time), size, &what);
            assert!(run.energy().residual.abs() < 1e-12, "{what}: {:?}", run.energy());
        }
        for now in &switches[..2] {
            for (time, sense) in [(now.time - 1e-9, start.at(now.time - 1e-9).sense), (now.time + 1e-9, now.sense)] {
                let mut run = Run::new(&scene(&text), None);
                run.to(time);
                let senses: Vec<i32> = run.storeys().iter().map(|storey| storey.sense).collect();
                assert_eq!(senses, vec![sense as i32; n], "{what} at {time} s");
            }
        }
    }
}

/// Two frames that yield, under a record, with contacts or without.
fn frames(contacts: &str) -> Scene {
    let building = |side: &str, mass: f64, force: &str| {
        format!(
            "[{side}]\nmass = {:?}\nstiffness = [3e7, 2.5e7, 2e7]\ndamping = {{ ratio = 0.03 }}\nyield_force = {force}\n\
             post_yield_ratio = [0.05, 0.0, 0.1]\n",
            [mass, mass, 0.8 * mass]
        )
    };
    let mut scene = scene(&format!(
        "name = \"Frames\"\n{}{}[outputs]\nenergy = true\n{contacts}",
        building("left", 4e4, "[2e5, 1.5e5, inf]"),
        building("right", 2.5e4, "[inf, 1e5, 6e4]")
    ));
    scene.ground.record = Some("zigzag.csv".into());
    scene
}

fn shaking() -> Record {
    record(1.0 / 64.0, &(0..400).map(|k| zigzag(k) / 4.0).collect::<Vec<_>>())
}

const CONTACT: &str = "[[contact]]\nleft_floor = 3\nright_floor = 3\ngap = 0.02\nlaw = \"hertz_damped\"\nstiffness = 2e9\n\
                       restitution = 0.6\ndamping_formula = \"exact\"\n";

/// Two buildings that are alike never meet, however far they yield.
#[test]
fn identical_buildings_yield_alike_and_never_meet() {
    let mut scene = frames(&CONTACT.replace("0.02", "1e-9"));
    scene.buildings[1] = scene.buildings[0].clone();
    scene.buildings[1].yielding = Some(Yielding::new(vec![2e5, 1.5e5, f64::INFINITY], vec![0.05, 0.0, 0.1]));
    let mut run = Run::new(&scene, Some(&shaking()));
    for k in 1..=600 {
        run.to(0.01 * f64::from(k));
        for i in 0..3 {
            let (one, other) = (run.storey(BuildingId::LEFT, i), run.storey(BuildingId::RIGHT, i));
            assert!((one.plastic - other.plastic).abs() < 1e-14, "{one:?}, {other:?}");
            assert!((one.cumulative - other.cumulative).abs() < 1e-14, "{one:?}, {other:?}");
            assert_eq!(one.sense, other.sense);
            let apart = (run.displacement(BuildingId::LEFT, i) - run.displacement(BuildingId::RIGHT, i)).abs();
            assert!(apart < 1e-15, "{apart:e} m");
        }
    }
    assert_eq!(run.point.impacts, 0);
    assert!(run.storey(BuildingId::LEFT, 0).cumulative > 1e-3);
}
