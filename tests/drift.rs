//! Peak storey drifts of tall buildings against the largest of all drifts at the record's samples.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod common;

use common::{Run, record, scene};
use pounding::engine::Side;
use pounding::record::Record;
use pounding::scene::Scene;

/// Exact in binary, so that samples are met exactly.
const STEP: f64 = 1.0 / 64.0;

/// 5 and 17 storeys, softer towards the top: some storeys reach their peaks early, others late.
fn towers(contacts: &str) -> (Scene, Record) {
    buildings([5, 17], contacts)
}

fn buildings([left, right]: [u32; 2], contacts: &str) -> (Scene, Record) {
    let building = |storeys: u32, stiffness: f64| {
        let stiffness: Vec<f64> = (0..storeys).map(|i| stiffness * (1.0 - 0.04 * f64::from(i))).collect();
        format!("mass = {:?}\nstiffness = {stiffness:?}\ndamping = {{ ratio = 0.03 }}", vec![3e5; storeys as usize])
    };
    let text = format!("name = \"D\"\n[left]\n{}\n[right]\n{}\n{contacts}", building(left, 3e8), building(right, 7e8));
    let mut scene = scene(&text);
    scene.ground.record = Some("r.csv".into());
    // Two bursts, the second a little stronger.
    let burst = |k: i32| if k % 450 < 200 { 1.0 + 0.1 * f64::from(k / 450) } else { 0.02 };
    let samples = (0..900_i32).map(|k| burst(k) * f64::from((k * 37 + k * k % 53) % 64 - 32) / 8.0);
    (scene, record(STEP, &samples.collect::<Vec<_>>()))
}

/// The drifts at the present time, left then right.
fn drifts(run: &Run) -> Vec<f64> {
    let of = |side: Side| {
        (0..run.model.floors(side)).map(move |floor| {
            let below = if floor == 0 { 0.0 } else { run.displacement(side, floor - 1) };
            run.displacement(side, floor) - below
        })
    };
    of(Side::Left).chain(of(Side::Right)).collect()
}

/// m, of the displacements that drifts are differences of.
fn rounding(run: &Run) -> f64 {
    let of = |side: Side| (0..run.model.floors(side)).map(move |floor| run.displacement(side, floor).abs());
    4.0 * f64::EPSILON * of(Side::Left).chain(of(Side::Right)).fold(0.0, f64::max)
}

fn peaks(run: &Run) -> Vec<f64> {
    let of = |side: Side| (0..run.model.floors(side)).map(move |floor| run.model.peak_drift(&run.state, side, floor));
    of(Side::Left).chain(of(Side::Right)).collect()
}

#[test]
fn peaks_of_few_storeys_are_the_largest_drifts_at_all_samples() {
    for storeys in [[1, 1], [2, 3], [4, 4], [1, 5], [7, 2]] {
        let (scene, record) = buildings(storeys, "");
        let mut run = Run::new(&scene, Some(&record));
        let mut largest = vec![0.0_f64; (storeys[0] + storeys[1]) as usize];
        let mut rounding_error = 0.0_f64;
        for k in 1..=890 {
            run.to(f64::from(k) * STEP);
            rounding_error = rounding_error.max(rounding(&run));
            for (largest, drift) in largest.iter_mut().zip(drifts(&run)) {
                *largest = largest.max(drift.abs());
            }
        }
        // At once, and beyond the last of the samples that have been compared.
        for (step, stop) in [(890.0, 890.0), (89.0, 890.0), (0.7, 890.3)] {
            let mut run = Run::new(&scene, Some(&record));
            run.in_steps(step * STEP, stop * STEP);
            for (storey, (peak, largest)) in peaks(&run).into_iter().zip(&largest).enumerate() {
                let error = (peak - largest).abs();
                assert!(error <= rounding_error, "{storeys:?}, {storey}: {peak:e} instead of {largest:e}");
            }
        }
    }
}

#[test]
fn peaks_are_the_largest_drifts_at_all_samples() {
    let (scene, record) = towers("");
    let mut run = Run::new(&scene, Some(&record));
    let mut largest = vec![0.0_f64; 22];
    let (mut raised, mut rounding_error) = (0, 0.0_f64);
    for k in 1..=900 {
        run.to(f64::from(k) * STEP);
        rounding_error = rounding_error.max(rounding(&run));
        for (largest, drift) in largest.iter_mut().zip(drifts(&run)) {
            raised += usize::from(drift.abs() > *largest);
            *largest = largest.max(drift.abs());
        }
        for (storey, (peak, largest)) in peaks(&run).into_iter().zip(&largest).enumerate() {
            let error = (peak - largest).abs();
            assert!(error <= rounding_error, "storey {storey} at sample {k}: {peak:e} instead of {largest:e}");
        }
    }
    assert!(raised > 300, "{raised} new peaks");
}

#[test]
fn no_drift_exceeds_its_peak_in_a_run_with_impacts() {
    let contact = |floor| {
        format!(
            "[[contact]]\nleft_floor = {floor}\nright_floor = {floor}\ngap = 0.01\nlaw = \"hertz\"\nstiffness = 2e9\n"
        )
    };
    let (scene, record) = towers(&(contact(4) + &contact(5)));
    let mut run = Run::new(&scene, Some(&record));
    for k in 1..=900 {
        run.to(f64::from(k) * STEP);
        for (storey, (peak, drift)) in peaks(&run).into_iter().zip(drifts(&run)).enumerate() {
            assert!(drift.abs() <= peak + rounding(&run), "storey {storey} at sample {k}: {drift:e} above {peak:e}");
        }
    }
    assert!(run.point.impacts > 10, "{} impacts", run.point.impacts);
}
