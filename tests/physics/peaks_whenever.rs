//! Peaks of two runs that are read in turn through one point: flights are logged, and the peaks raised over many of them at
//! once. That they are the same whenever they are read, saved or restored: `invariants/`.

use crate::common::peaks::all;
use crate::common::{Run, record, scene};
use pounding::record::Record;

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

/// Even samples, then a jump of the interval between them, for 12 s.
fn shaking() -> Record {
    let wave = |k: usize| 2.5 * (0.13 * k as f64).sin() + 1.5 * (0.41 * k as f64).sin() + (1.3 * k as f64).sin();
    record(0.01, &(0..1200).map(wave).collect::<Vec<f64>>())
}

fn bits(run: &Run) -> Vec<u64> {
    all(run).into_iter().flatten().map(|read| read.peak.to_bits()).collect()
}

/// Runs that start from rest where the peaks of another one have just been read, and are read through the same point: the
/// same loads of the ground, other motions.
#[test]
fn of_two_runs_in_turn() {
    let (scene, shaking) = (scene(&text(&building(3, 8e7, ""), &building(2, 2e8, ""), "")), shaking());
    let mut run = Run::new(&scene, Some(&shaking));
    for k in (100..200).step_by(3) {
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

/// Who reads them at each step is told for how long none can rise; who has read nothing before sees the same.
#[test]
fn at_each_step_and_for_the_first_time() {
    let contact = "[[contact]]\nleft_floor = 2\nright_floor = 2\ngap = 0.02\nlaw = \"hertz\"\nstiffness = 1e9\n";
    for contact in ["", contact] {
        let scene = scene(&text(&building(3, 8e7, ""), &building(2, 2e8, ""), contact));
        let mut run = Run::new(&scene, Some(&shaking()));
        for k in 1..=2800 {
            let known = bits(run.to(0.005 * f64::from(k)));
            if k % 7 == 0 {
                let before = std::mem::take(&mut run.point);
                run.model.observe(&run.state, &mut run.point);
                assert!(known == bits(&run), "{contact:?}, step {k}");
                run.point = before;
            }
        }
        assert_eq!(run.state.counters().events > 10, !contact.is_empty());
    }
}
