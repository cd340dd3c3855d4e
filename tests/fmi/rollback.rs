//! A state that has been saved goes on to the same bits: in another state of another model of the same scene, from
//! every kind of place in a run, whatever has happened since.

use crate::common::problems::frames::{Frames, MATRIX, RATIO, RAYLEIGH, zigzag};
use crate::common::problems::laws::Laws;
use crate::common::{Run, record, scene};
use pounding::engine::{BuildingId, SavedState};
use pounding::record::Record;
use pounding::scene::{Scene, Yielding};

/// How the ground is driven.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Drive {
    Record,
    /// A record, and forces on the floors.
    RecordAndForces,
    /// Ground acceleration and forces on the floors.
    Inputs,
}

#[derive(Clone, Debug)]
struct Case {
    law: String,
    damping: &'static str,
    storeys: usize,
    gap: f64,
    energy: bool,
    drive: Drive,
    /// Whether storeys of the left building can yield.
    yields: bool,
}

fn cases() -> Vec<Case> {
    let laws = Laws { spring: 2e7, hertz: 1e8, exponent: 1.7, restitution: 0.6 };
    let rigid = Laws { restitution: 0.3, ..laws }.stereomechanical();
    let plain = |law: &str, drive| {
        let law = law.to_owned();
        Case { law, damping: RATIO, storeys: 3, gap: 0.005, energy: true, drive, yields: false }
    };
    let mut every = laws.all();
    every[0].clone_from(&rigid);
    let mut cases = Vec::new();
    for drive in [Drive::Record, Drive::RecordAndForces, Drive::Inputs] {
        cases.extend(every.iter().map(|law| plain(law, drive)));
    }
    for law in [&rigid, &laws.kelvin_voigt_no_tension(), &laws.jankowski()] {
        // Floor by floor; damping that couples modes; floors that are pressed together from the start.
        cases.push(Case { storeys: 9, damping: RAYLEIGH, energy: false, ..plain(law, Drive::Record) });
        cases.push(Case { damping: MATRIX, ..plain(law, Drive::Record) });
        cases.push(Case { gap: 0.0, energy: false, ..plain(law, Drive::Record) });
        cases.push(Case { yields: true, ..plain(law, Drive::RecordAndForces) });
        cases.push(Case { yields: true, storeys: 9, damping: RAYLEIGH, ..plain(law, Drive::Record) });
        cases.push(Case { yields: true, energy: false, ..plain(law, Drive::Record) });
        cases.push(Case { yields: true, ..plain(law, Drive::Inputs) });
    }
    cases
}

impl Case {
    fn scene(&self) -> (Scene, Option<Record>) {
        let &Case { ref law, damping, storeys, gap, energy, drive, yields } = self;
        let floor_forces = drive != Drive::Record;
        let mut scene = scene(&Frames { storeys, damping, gap, law, energy, floor_forces }.toml());
        if yields {
            let force = (0..storeys).map(|i| if i == 1 { f64::INFINITY } else { 1e5 - 1e3 * i as f64 });
            scene.buildings[0].yielding = Some(Yielding::new(force.collect(), vec![0.05; storeys]));
        }
        let has_record = drive != Drive::Inputs;
        scene.ground.record = has_record.then(|| "zigzag.csv".into());
        let samples: Vec<f64> = (0..100).map(acceleration).collect();
        (scene, has_record.then(|| record(1.0 / 64.0, &samples)))
    }

    fn run(&self) -> Run {
        let (scene, record) = self.scene();
        Run::new(&scene, record.as_ref())
    }

    /// What a master sets at point k. Some of it presses the tops together for a while, some is linear in time, and some
    /// lines go on from the point before.
    fn drive(&self, run: &mut Run, k: usize) {
        if k % 4 == 3 {
            return;
        }
        if self.drive == Drive::Inputs {
            run.state.set_ground_acceleration(acceleration(k / 8 % 100));
            run.state.set_ground_acceleration_rate(acceleration(k % 100));
        }
        if self.drive != Drive::Record {
            let force = if (150..350).contains(&k) { 5e5 } else { 1e3 * (k % 7) as f64 };
            run.state.set_floor_force(BuildingId::LEFT, self.storeys - 1, force);
            run.state.set_floor_force_rate(BuildingId::LEFT, self.storeys - 1, 1e4 * acceleration(k % 50));
        }
    }
}

/// m/s2.
fn acceleration(k: usize) -> f64 {
    zigzag(k) / 4.0
}

const POINTS: usize = 500;

/// s, from 3 to 5 ms apart, with one step of 0.25 s: in most contacts there are several.
fn time(k: usize) -> f64 {
    let jump = if k > 100 { 0.25 } else { 0.0 };
    jump + 0.004 * k as f64 + 0.000_5 * ((k * 7 % 5) as f64 - 2.0) / 2.0
}

/// All that can be seen at a point, and the episodes on the way there.
fn seen(run: &mut Run) -> (Vec<u64>, String) {
    let mut bits = run.bits();
    if let Some(energy) = run.now().energy() {
        let terms = [energy.input, energy.viscous, energy.impact, energy.external, energy.kinetic, energy.residual];
        bits.extend(terms.map(f64::to_bits));
        bits.extend([energy.strain, energy.hysteretic].map(f64::to_bits));
    }
    let opens: Vec<_> = (0..run.model.contacts()).map(|p| run.model.open_episode(&run.state, p)).collect();
    (bits, format!("{:?} {opens:?} {:?}", run.state.counters(), std::mem::take(&mut run.episodes)))
}

fn to(case: &Case, run: &mut Run, k: usize) -> (Vec<u64>, String) {
    case.drive(run, k);
    run.to(time(k + 1));
    seen(run)
}

#[test]
fn a_saved_state_goes_on_to_the_same_bits() {
    for case in cases() {
        // Nobody saves anything.
        let mut plain = case.run();
        let expected: Vec<_> = (0..POINTS).map(|k| to(&case, &mut plain, k)).collect();

        let mut run = case.run();
        let mut saved = Vec::new();
        let (mut touching, mut held, mut yielding) = (0, 0, 0);
        for (k, expected) in expected.iter().enumerate() {
            saved.push(run.save());
            assert!(to(&case, &mut run, k) == *expected, "{case:?}: saving has changed point {k}");
            touching += usize::from(run.contacts().iter().any(|contact| contact.active));
            held += usize::from(run.contacts().iter().any(|contact| contact.active && contact.force > 0.0));
            yielding += usize::from(run.storeys().iter().any(|storey| storey.sense != 0));
        }
        assert!(touching > 20, "{case:?}: {touching} points in contact");
        assert!(held > 10, "{case:?}: {held} points under force");
        assert!(yielding > 50 || !case.yields, "{case:?}: {yielding} points at which a storey yields");

        // Another model of the scene, and a state that has seen other things; last points first.
        let mut other = case.run();
        other.to(0.9);
        other.episodes.clear();
        for k in (0..POINTS).rev() {
            restore(&mut other, &saved[k]);
            if k > 0 {
                other.model.observe(&other.state, &mut other.point);
                assert!(seen(&mut other).0 == expected[k - 1].0, "{case:?}: point {k} reads otherwise");
            }
            for (next, expected) in expected.iter().enumerate().skip(k).take(3) {
                assert!(to(&case, &mut other, next) == *expected, "{case:?}: from point {k}, point {next}");
            }
        }
        // From far back to the end.
        restore(&mut other, &saved[POINTS / 5]);
        for (next, expected) in expected.iter().enumerate().skip(POINTS / 5) {
            assert!(to(&case, &mut other, next) == *expected, "{case:?}: point {next}");
        }
    }
}

/// What the engine can come to, it takes back.
#[test]
fn every_state_of_a_run_passes_the_checks() {
    for case in cases() {
        let (mut run, other) = (case.run(), case.run());
        for k in 0..POINTS {
            if let Err(error) = other.model.check_saved(&run.save()) {
                panic!("{case:?}: point {k}: {error}");
            }
            to(&case, &mut run, k);
        }
    }
}

fn restore(run: &mut Run, saved: &SavedState) {
    run.model.restore(saved, &mut run.state);
    run.episodes.clear();
}
