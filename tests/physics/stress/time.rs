//! Hazards of time: entries on knots and at the start, times far from 0, inputs cut into steps of a nanosecond, samples
//! that are uneven, inputs that jump in mid-contact.

use crate::common::problems::frames::{Frames, zigzag};
use crate::common::problems::laws::Laws;
use crate::common::problems::two_masses::{Mass, TwoMasses};
use crate::common::{Run, assert_close, record, scene};
use pounding::engine::BuildingId;
use pounding::record::Record;
use pounding::scene::Scene;

/// Every law; no free impact at 0.5 m/s loses its whole speed under them.
pub fn laws() -> [String; 8] {
    Laws { spring: 1e9, hertz: 1e10, exponent: 1.7, restitution: 0.5 }.all()
}

/// Free masses of 50 t and 75 t, the left one at `speed`.
fn free_masses(speed: f64, gap: f64, law: &str) -> Scene {
    scene(&TwoMasses::new(Mass::free(5e4, speed), Mass::free(7.5e4, 0.0), gap, law).toml())
}

/// A ground that rests, sampled every 1/64 s.
fn rest() -> Record {
    record(1.0 / 64.0, &[0.0; 65])
}

/// At 0.5 m/s a gap of k/128 m closes exactly at knot k: one contact, neither missed nor seen twice, with all of its
/// speed; and so it is for a gap that is larger or smaller by a rounding error.
#[test]
fn an_entry_on_a_knot_is_one_contact() {
    for law in &laws() {
        for knot in [1, 2, 17, 32] {
            for ulps in -2..=2_i64 {
                let gap = f64::from_bits((f64::from(knot) / 128.0).to_bits().wrapping_add_signed(ulps));
                let mut scene = free_masses(0.5, gap, law);
                scene.ground.record = Some("rest.csv".into());
                let mut run = Run::new(&scene, Some(&rest()));
                run.to(0.9);
                let what = format!("{law}, knot {knot}, {ulps} ulps");
                assert_eq!((run.point.impacts, run.episodes.len()), (1, 1), "{what}: {:?}", run.episodes);
                let start = run.episodes[0].start;
                // Each of up to 32 knots rounds the position once.
                assert!((start - 2.0 * gap).abs() <= 8.0 * f64::EPSILON * start, "{what}: {start}");
                assert_close(run.episodes[0].approach_velocity, 0.5, 1e-15, &what);
                // Momentum: what the contact has passed on is what the right mass has.
                assert_close(run.velocity(BuildingId::RIGHT, 0) * 7.5e4, run.contact(0).impulse, 1e-13, &what);
            }
        }
    }
}

/// Gap 0 at the start: floors that approach are in contact from t = 0 on with that speed, floors that part are not.
#[test]
fn an_entry_at_the_start_has_its_speed() {
    for law in &laws() {
        let mut meeting = Run::new(&free_masses(0.5, 0.0, law), None);
        meeting.to(0.5);
        let first = meeting.episodes[0];
        assert_eq!((first.start, meeting.episodes.len()), (0.0, 1), "{law}: {first:?}");
        assert_close(first.approach_velocity, 0.5, 1e-15, law);
        let mut later = Run::new(&free_masses(0.5, 0.125, law), None);
        later.to(0.75);
        let second = later.episodes[0];
        assert_close(first.separation_velocity, second.separation_velocity, 1e-12, law);
        assert_close(first.impulse, second.impulse, 1e-12, law);
        let mut parting = Run::new(&free_masses(-0.5, 0.0, law), None);
        parting.to(0.5);
        assert_eq!(parting.point.impacts, 0, "{law}");
    }
}

/// Two frames of two storeys, damped, which collide some twenty times in 4 s.
pub fn frames(law: &str) -> Scene {
    let damping = "{ ratio = 0.03 }";
    let frames = Frames { storeys: 2, damping, gap: 0.01, law, energy: true, floor_forces: false };
    let mut scene = scene(&frames.toml());
    scene.ground.record = Some("shaking.csv".into());
    scene
}

/// 4 s at 64 Hz, exact in binary.
pub fn shaking() -> Record {
    record(1.0 / 64.0, &(0..=256).map(|k| zigzag(k) / 6.0).collect::<Vec<_>>())
}

/// A spacing that is not exact in binary, at 1e6 s: the times are rounded to 1e-10 s there, 1e-8 of a sample. That much
/// may differ, times the growth of errors over some twenty contacts, and no more.
#[test]
fn decimal_times_at_a_million_seconds_lose_no_more_than_their_digits() {
    let accelerations = shaking().accelerations;
    let record = |start: f64| {
        let times = (0..accelerations.len()).map(|k| start + 0.01 * k as f64).collect();
        Record::new(times, accelerations.clone())
    };
    for law in &laws() {
        let [now, later] = [0.0, 1e6].map(|start| {
            let mut run = Run::from(&frames(law), Some(&record(start)), start);
            run.to(start + 2.5);
            run
        });
        assert_eq!(now.episodes.len(), later.episodes.len(), "{law}");
        let error = (now.displacement(BuildingId::LEFT, 1) - later.displacement(BuildingId::LEFT, 1)).abs();
        assert!(error < 1e-8 * 0.01, "{law}: {error:e} m, and the gap is 0.01 m");
    }
}

/// A master that drives the ground cuts the steps; the entry of free masses is where it is all the same.
#[test]
fn driven_steps_of_a_nanosecond_meet_on_time() {
    for law in &laws() {
        let mut run = Run::new(&free_masses(0.5, 0.125, law), None);
        run.to(0.25 - 5e-7);
        for k in 1..=1000 {
            run.to(0.25 - 5e-7 + 1e-9 * f64::from(k));
        }
        run.to(0.75);
        let mut whole = Run::new(&free_masses(0.5, 0.125, law), None);
        whole.to(0.75);
        let (split, whole) = (run.episodes[0], whole.episodes[0]);
        // A thousand steps, each with the rounding of the position.
        assert!((split.start - 0.25).abs() < 1e-14, "{law}: {split:?}");
        assert_close(split.separation_velocity, whole.separation_velocity, 1e-11, law);
        assert_close(split.impulse, whole.impulse, 1e-11, law);
        assert!(run.energy().residual.abs() < 1e-13, "{law}");
    }
}

/// The ground moves free masses alike, whatever it does: jumps of 10 g in mid-contact change nothing between them.
#[test]
fn an_input_that_jumps_in_mid_contact_moves_free_masses_alike() {
    for law in &laws() {
        let mut calm = Run::new(&free_masses(0.5, 0.125, law), None);
        calm.to(0.75);
        let calm = calm.episodes[0];
        let duration = calm.end.unwrap() - calm.start;
        let mut run = Run::new(&free_masses(0.5, 0.125, law), None);
        run.to(0.25);
        for k in 1..=8 {
            run.state.set_ground_acceleration(if k % 2 == 0 { 100.0 } else { -100.0 });
            run.to(0.25 + 0.125 * f64::from(k) * duration.max(1e-3));
        }
        run.to(0.75);
        let shaken = run.episodes[0];
        assert_eq!(run.episodes.len(), 1, "{law}");
        // The masses reach 25 m/s: the difference of their velocities has fifty times its own rounding.
        assert_close(shaken.separation_velocity, calm.separation_velocity, 1e-11, law);
        assert_close(shaken.peak_penetration, calm.peak_penetration, 1e-11, law);
        assert_close(shaken.impulse, calm.impulse, 1e-11, law);
        assert!((shaken.end.unwrap() - calm.end.unwrap()).abs() < 1e-11 * duration + 1e-16, "{law}");
    }
}

/// Samples added on the straight lines between those of a record are the same ground motion, however uneven they make it.
#[test]
fn samples_added_on_the_lines_between_samples_change_nothing() {
    let even = shaking();
    let mut uneven = Record::default();
    for (k, (times, accelerations)) in even.times.windows(2).zip(even.accelerations.windows(2)).enumerate() {
        for share in [0.0, 2f64.powi(-(k as i32 % 30) - 1), 0.625, 1.0 - 2f64.powi(-(k as i32 % 17) - 2)] {
            let time = times[0] + share * (times[1] - times[0]);
            if uneven.times.last().is_none_or(|last| *last < time) {
                uneven.times.push(time);
                uneven.accelerations.push(accelerations[0] + share * (accelerations[1] - accelerations[0]));
            }
        }
    }
    for law in &laws() {
        let [a, b] = [&even, &uneven].map(|record| {
            let mut run = Run::new(&frames(law), Some(record));
            run.to(3.9);
            run
        });
        assert_eq!(a.episodes.len(), b.episodes.len(), "{law}");
        for (a, b) in a.episodes.iter().zip(&b.episodes) {
            assert!((a.start - b.start).abs() < 1e-11, "{law}: {a:?} {b:?}");
        }
        let (a, b) = (a.displacement(BuildingId::LEFT, 1), b.displacement(BuildingId::LEFT, 1));
        assert!((a - b).abs() < 1e-10 * a.abs().max(0.01), "{law}: {a} {b}");
    }
}
