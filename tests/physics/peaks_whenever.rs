//! Peaks are the same, to the last bit, however often and whenever they are read, and the state is saved or restored, on the
//! way: flights are logged, and the peaks raised over many of them at once.

use crate::common::peaks::all;
use crate::common::{Run, record, scene};
use pounding::engine::Side;
use pounding::record::Record;
use pounding::scene::Scene;

/// A fixed sequence of numbers between 0 and 1.
pub struct Sequence(pub u64);

impl Sequence {
    pub fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }
}

fn building(storeys: usize, stiffness: f64, more: &str) -> String {
    let list = |of: f64| vec![format!("{of:?}"); storeys].join(", ");
    format!("mass = [{}]\nstiffness = [{}]\ndamping = {{ ratio = 0.03 }}\n{more}", list(1e5), list(stiffness))
}

fn text(left: &str, right: &str, contact: &str) -> String {
    format!("name = \"Whenever\"\n[left]\n{left}\n[right]\n{right}\n{contact}")
}

/// Length of a master's steps, s.
const PUSHED: f64 = 0.02;

/// Even samples, then a jump of the interval between them, for 12 s.
fn shaking() -> Record {
    let wave = |k: usize| 2.5 * (0.13 * k as f64).sin() + 1.5 * (0.41 * k as f64).sin() + (1.3 * k as f64).sin();
    record(0.01, &(0..1200).map(wave).collect::<Vec<f64>>())
}

fn bits(run: &Run) -> Vec<u64> {
    all(run).into_iter().flatten().map(|read| read.peak.to_bits()).collect()
}

/// A run to a time, in steps of a master that sets forces on floors at the start of each, if it does.
fn go(run: &mut Run, time: f64, is_pushed: bool) {
    while is_pushed && run.state.time() < time {
        let now = run.state.time();
        push(run, now);
        run.to(next_push(now).min(time));
    }
    run.to(time);
}

/// The end of the master's step that begins at a time.
fn next_push(time: f64) -> f64 {
    ((time / PUSHED).round() + 1.0) * PUSHED
}

/// Sets the forces that act from a time on: none, held ones on all floors, or on one floor one that is linear in time. Between
/// the ends of the master's steps they stay as they are.
fn push(run: &mut Run, time: f64) {
    let step = (time / PUSHED).round();
    if (step * PUSHED - time).abs() > 1e-9 {
        return;
    }
    let kind = (step / 40.0) as u32 % 4;
    for side in [Side::Left, Side::Right] {
        for floor in 0..run.model.floors(side) {
            let wave = 4e5 * (0.9 * step + floor as f64).sin();
            let (force, rate) = match kind {
                1 => (wave, 0.0),
                2 if floor == 1 => (wave, 1e6 * (0.3 * step).cos()),
                3 => (2e5 * floor as f64, 0.0),
                _ => (0.0, 0.0),
            };
            run.state.set_floor_force(side, floor, force);
            run.state.set_floor_force_rate(side, floor, rate);
        }
    }
}

fn check(text: &str, stop: f64) {
    check_run(&scene(text), stop, false);
}

/// With forces on floors: the communication points are those of the master.
fn check_pushed(text: &str, stop: f64) {
    check_run(&scene(&format!("{text}[inputs]\nfloor_forces = true\n")), stop, true);
}

fn check_run(scene: &Scene, stop: f64, is_pushed: bool) {
    let shaking = shaking();
    let start = || Run::new(scene, Some(&shaking));
    let mut whole = start();
    go(&mut whole, stop, is_pushed);
    let expected = bits(&whole);
    for seed in 0..4 {
        let mut sequence = Sequence(seed);
        let mut run = start();
        let mut time = 0.0;
        while time < stop {
            let wanted = time + 10.0_f64.powf(-3.0 + 3.0 * sequence.next());
            time = if is_pushed { next_push(wanted) } else { wanted }.min(stop);
            go(&mut run, time, is_pushed);
            match (5.0 * sequence.next()) as u32 {
                // Read here, then go on.
                0 => drop(bits(&run)),
                1 => drop(run.save()),
                // Go on in another state, and come back.
                2 => {
                    let saved = run.save();
                    go(&mut run, (time + 0.7).min(stop), is_pushed);
                    drop(bits(&run));
                    run.model.restore(&saved, &mut run.state);
                    go(&mut run, time, is_pushed);
                }
                // A copy goes another way, whose point is read in turn with this one.
                3 => {
                    let mut copy = run.state.clone();
                    run.model.advance(&mut copy, (time + 0.3).min(stop), &mut |_| ()).unwrap();
                    let mine = std::mem::replace(&mut run.state, copy);
                    run.model.observe(&run.state, &mut run.point);
                    drop(bits(&run));
                    run.state = mine;
                    go(&mut run, time, is_pushed);
                    drop(bits(&run));
                }
                _ => {}
            }
        }
        assert!(bits(&run) == expected, "other peaks, seed {seed}");
    }
    // Where a master pushes floors, the engine's steps end where the master's do.
    if !is_pushed {
        check_often(scene, &shaking, stop);
    }
}

/// Read at every point: the same, at every time, as when they are read there for the first time.
fn check_often(scene: &Scene, shaking: &Record, stop: f64) {
    for step in [0.01, 0.0037, 0.025] {
        let mut run = Run::new(scene, Some(shaking));
        for k in 1..=(stop / step) as u32 {
            let time = step * f64::from(k);
            let often = bits(run.to(time));
            if k % 61 == 0 {
                let once = bits(Run::new(scene, Some(shaking)).to(time));
                assert!(often == once, "other peaks at {time} s when read every {step} s");
            }
        }
    }
}

const CONTACT: &str = "[[contact]]\nleft_floor = 2\nright_floor = 2\ngap = 0.02\n";

#[test]
fn apart() {
    check(&text(&building(3, 8e7, ""), &building(2, 2e8, ""), ""), 12.0);
}

#[test]
fn of_tall_buildings() {
    check(&text(&building(30, 4e8, ""), &building(22, 1e9, ""), ""), 12.0);
}

#[test]
fn with_impacts() {
    let law = "law = \"hertz\"\nstiffness = 1e9\n";
    check(&text(&building(3, 8e7, ""), &building(2, 2e8, ""), &format!("{CONTACT}{law}")), 12.0);
}

#[test]
fn with_impulses() {
    let law = "law = \"stereomechanical\"\nrestitution = 0.6\n";
    check(&text(&building(3, 8e7, ""), &building(2, 2e8, ""), &format!("{CONTACT}{law}")), 12.0);
}

#[test]
fn with_yields() {
    let yielding = "yield_force = [4e5, 4e5, 4e5]\npost_yield_ratio = 0.05\n";
    let law = "law = \"linear\"\nstiffness = 1e8\n";
    check(&text(&building(3, 8e7, yielding), &building(2, 2e8, ""), &format!("{CONTACT}{law}")), 12.0);
}

/// Runs that start from rest where the peaks of another one have just been read, and are read through the same point: the
/// same loads of the ground, other motions.
#[test]
fn of_two_runs_in_turn() {
    let (scene, shaking) = (scene(&text(&building(3, 8e7, ""), &building(2, 2e8, ""), "")), shaking());
    let mut run = Run::new(&scene, Some(&shaking));
    for k in (100..200).step_by(3) {
        // The second read looks ahead.
        drop(bits(run.to(0.01 * f64::from(k))));
        let time = 0.01 * f64::from(k + 1);
        drop(bits(run.to(time)));
        let mut alone = Run::new(&scene, Some(&shaking));
        alone.state = alone.model.start(time);
        let late = alone.state.clone();
        let first = std::mem::replace(&mut run.state, late);
        assert!(bits(run.to(time + 0.005)) == bits(alone.to(time + 0.005)), "{time} s");
        run.state = first;
    }
}

#[test]
fn under_floor_forces() {
    check_pushed(&text(&building(3, 8e7, ""), &building(2, 2e8, ""), ""), 8.0);
    check_pushed(&text(&building(9, 2e8, ""), &building(12, 6e8, ""), ""), 8.0);
}

#[test]
fn under_floor_forces_with_impacts_and_yields() {
    let yielding = "yield_force = [4e5, 4e5, 4e5]\npost_yield_ratio = 0.05\n";
    let law = "law = \"linear\"\nstiffness = 1e8\n";
    check_pushed(&text(&building(3, 8e7, yielding), &building(2, 2e8, ""), &format!("{CONTACT}{law}")), 8.0);
}
