//! Peaks in continuous time: against closed forms, against ever denser readings of the same run, at any communication steps.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod common;

use common::{Run, assert_close, record, scene};
use pounding::engine::{PeakOf, Side};
use pounding::record::Record;
use pounding::scene::Scene;
use std::f64::consts::PI;

/// All peaks of a model, with what they are.
fn all_of(run: &Run) -> Vec<PeakOf> {
    let of_side = |side: Side| {
        let floors = 0..run.model.floors(side);
        let of_floor = move |floor| {
            [PeakOf::Displacement(side, floor), PeakOf::Drift(side, floor), PeakOf::Acceleration(side, floor)]
        };
        floors.flat_map(of_floor).chain([PeakOf::BaseShear(side)])
    };
    [Side::Left, Side::Right].into_iter().flat_map(of_side).collect()
}

fn peaks(run: &Run) -> Vec<f64> {
    all_of(run).into_iter().map(|of| run.peak(of)).collect()
}

/// What the peaks are of, at the present time.
fn now(run: &Run) -> Vec<f64> {
    let value = |of| match of {
        PeakOf::Displacement(side, floor) => run.displacement(side, floor),
        PeakOf::Drift(side, 0) => run.displacement(side, 0),
        PeakOf::Drift(side, storey) => run.displacement(side, storey) - run.displacement(side, storey - 1),
        PeakOf::Acceleration(side, floor) => run.model.acceleration(&run.point, side, floor),
        PeakOf::BaseShear(side) => run.model.base_shear(&run.point, side),
    };
    all_of(run).into_iter().map(|of| f64::abs(value(of))).collect()
}

/// The largest magnitudes of a run: read `count` times, then again around the largest of them, ever denser.
fn dense(scene: &Scene, record: Option<&Record>, stop: f64, count: usize) -> Vec<f64> {
    let mut run = Run::new(scene, record);
    run.to(0.0);
    let mut largest: Vec<(f64, f64)> = now(&run).into_iter().map(|value| (value, 0.0)).collect();
    let step = stop / count as f64;
    // States from which to read again.
    let mut saved = vec![run.state.save()];
    for k in 1..=count {
        run.to(k as f64 * step);
        saved.push(run.state.save());
        for (largest, value) in largest.iter_mut().zip(now(&run)) {
            if value > largest.0 {
                *largest = (value, k as f64);
            }
        }
    }
    for (i, (value, at)) in largest.iter_mut().enumerate() {
        let first = &saved[f64::max(*at - 1.0, 0.0) as usize];
        *at *= step;
        let mut width = 2.0 * step;
        for _ in 0..6 {
            let from = f64::max(*at - 0.5 * width, first.time());
            run.model.restore(first, &mut run.state);
            for k in 0..=60 {
                let time = from + width * f64::from(k) / 60.0;
                if time > stop {
                    break;
                }
                run.to(time);
                let read = now(&run)[i];
                if read > *value {
                    (*value, *at) = (read, time);
                }
            }
            width /= 30.0;
        }
    }
    largest.into_iter().map(|(value, _)| value).collect()
}

fn compare(what: &str, scene: &Scene, record: Option<&Record>, stop: f64, count: usize) {
    let mut run = Run::new(scene, record);
    run.to(stop);
    let got = peaks(&run);
    let dense = dense(scene, record, stop, count);
    for ((of, got), dense) in all_of(&run).into_iter().zip(&got).zip(&dense) {
        let error = got / dense - 1.0;
        assert!(
            *got == *dense || error.abs() < 1e-10,
            "{what}, {of:?}: {got:e}, while a dense reading has {dense:e}, off by {error:.1e}"
        );
    }
    for step in [stop / 7.0, stop / 101.0, stop / 1013.7] {
        let mut run = Run::new(scene, record);
        run.in_steps(step, stop);
        for ((of, got), other) in all_of(&run).into_iter().zip(&got).zip(peaks(&run)) {
            assert!((got - other).abs() <= 1e-12 * got, "{what}, {of:?}: {got:e} and {other:e} in steps of {step} s");
        }
    }
}

fn frame(side: &str, storeys: usize, mass: f64, frequency: f64, ratio: f64) -> String {
    let w = 2.0 * PI * frequency;
    let masses: Vec<f64> = (0..storeys).map(|i| mass * (1.0 - 0.05 * i as f64)).collect();
    let stiffness: Vec<f64> = (0..storeys).map(|i| mass * w * w * (1.0 + 0.1 * i as f64)).collect();
    format!("[{side}]\nmass = {masses:?}\nstiffness = {stiffness:?}\ndamping = {{ ratio = {ratio:?} }}\n")
}

fn shaking(step: f64, count: i32, peak: f64) -> Record {
    let sample = |k: i32| f64::from((k * 37 + k * k % 53) % 64 - 32) / 32.0;
    let envelope = |k: i32| libm::sin(PI * f64::from(k) / f64::from(count - 1));
    let samples: Vec<f64> = (0..count).map(|k| peak * envelope(k) * sample(k)).collect();
    record(step, &samples)
}

const LAWS: [&str; 8] = [
    "law = \"stereomechanical\"\nrestitution = 0.6",
    "law = \"linear\"\nstiffness = 2e7",
    "law = \"kelvin_voigt\"\nstiffness = 2e7\nrestitution = 0.5",
    "law = \"kelvin_voigt_no_tension\"\nstiffness = 2e7\nrestitution = 0.5",
    "law = \"hertz\"\nstiffness = 3e8",
    "law = \"hertz\"\nstiffness = 3e8\nexponent = 2.2",
    "law = \"jankowski\"\nstiffness = 3e8\nrestitution = 0.6",
    "law = \"hertz_damped\"\nstiffness = 3e8\nrestitution = 0.6\ndamping_formula = \"exact\"",
];

fn with_record(text: &str) -> Scene {
    let mut scene = scene(text);
    scene.ground.record = Some("r.csv".into());
    scene
}

#[test]
fn free_vibration_has_the_peaks_of_a_textbook() {
    // 1 m/s on an oscillator of 1 Hz: u = v / w, a = v w, V = m v w.
    let w = 2.0 * PI;
    for ratio in [0.0_f64, 0.05] {
        let building = format!(
            "mass = [1000.0]\nstiffness = [{:?}]\ndamping = {{ ratio = {ratio:?} }}\ninitial_velocity = [1.0]\n",
            1000.0 * w * w
        );
        let scene = scene(&format!("name = \"Free\"\n[left]\n{building}[right]\n{building}"));
        for step in [10.0, 1.0, 0.37, 0.01] {
            let mut run = Run::new(&scene, None);
            run.in_steps(step, 10.0);
            let wd = w * (1.0 - ratio * ratio).sqrt();
            // tan(wd t) = wd / (z w).
            let t = libm::atan2(wd, ratio * w) / wd;
            let u = libm::exp(-ratio * w * t) * libm::sin(wd * t) / wd;
            assert_close(run.peak(PeakOf::Displacement(Side::Left, 0)), u, 1e-13, "displacement");
            assert_close(run.peak(PeakOf::Drift(Side::Right, 0)), u, 1e-13, "drift");
            if ratio == 0.0 {
                assert_close(run.peak(PeakOf::Acceleration(Side::Left, 0)), w, 1e-13, "acceleration");
                assert_close(run.peak(PeakOf::BaseShear(Side::Left)), 1000.0 * w, 1e-13, "base shear");
            }
        }
    }
}

#[test]
fn a_motion_that_starts_at_its_peak_has_it_at_once() {
    let building = "mass = [2.0]\nstiffness = [50.0]\ndamping = { ratio = 0.1 }\ninitial_displacement = [-0.02]\n";
    let scene = scene(&format!("name = \"Still\"\n[left]\n{building}[right]\n{building}"));
    for step in [1.0, 0.1] {
        let mut run = Run::new(&scene, None);
        run.to(0.0);
        let expected = [0.02, 0.02, 0.5, 1.0];
        for (got, expected) in peaks(&run).into_iter().zip(expected) {
            assert_close(got, expected, 1e-15, "at the start");
        }
        let first = peaks(&run);
        run.in_steps(step, 3.0);
        assert_eq!(peaks(&run)[..2], first[..2]);
    }
}

#[test]
fn peaks_without_contact_are_those_of_a_dense_reading() {
    for (storeys, spacing) in [([1, 2], 0.01), ([2, 3], 0.02), ([5, 7], 0.02), ([1, 1], 0.3), ([3, 20], 0.01)] {
        let text = format!(
            "name = \"Flight\"\n{}{}",
            frame("left", storeys[0], 1e5, 6.0, 0.03),
            frame("right", storeys[1], 2e5, 4.0, 0.05)
        );
        let record = shaking(spacing, 200, 4.0);
        compare(&format!("{storeys:?}"), &with_record(&text), Some(&record), 250.0 * spacing, 5000);
    }
}

#[test]
fn peaks_with_contacts_are_those_of_a_dense_reading() {
    for law in LAWS {
        for storeys in [[1, 1], [2, 3], [9, 8]] {
            let contact = |floor: usize| {
                format!("[[contact]]\nleft_floor = {floor}\nright_floor = {floor}\ngap = 0.004\n{law}\n")
            };
            let contacts: String = (1..=storeys[0].min(storeys[1]).min(3)).map(contact).collect();
            let text = format!(
                "name = \"Contacts\"\n{}{}{contacts}",
                frame("left", storeys[0], 1e3, 3.0, 0.03),
                frame("right", storeys[1], 2e3, 5.0, 0.05)
            );
            let record = shaking(0.02, 100, 6.0);
            compare(&format!("{law} {storeys:?}"), &with_record(&text), Some(&record), 2.5, 20_000);
        }
    }
}
