//! Tall buildings that lean on each other at a few floors: windows from sample to sample, with exact flights and prepared
//! polynomials of all modes, against power series floor by floor. A scene in which a master may push the floors takes
//! those; nobody pushes here.

use crate::common::problems::frames::zigzag;
use crate::common::{Run, record, scene};
use pounding::engine::Side;
use pounding::record::Record;
use pounding::scene::Scene;

const HERTZ: &str = "law = \"hertz\"\nstiffness = 2.75e9";
const DAMPED: &str = "law = \"hertz_damped\"\nstiffness = 2.75e9\nrestitution = 0.65\ndamping_formula = \"exact\"";

/// With peaks, whose search reads a window many times, contacts are followed floor by floor.
const WITHOUT_PEAKS: &str = "[outputs]\npeaks = false\n";

/// Two towers of about the periods that 20 and 30 storeys have, whatever their storeys, and a record of 8 s.
fn towers(storeys: [usize; 2], contacts: &[(usize, &str)], more: &str) -> (Scene, Record) {
    let building = |n: usize, mass: f64, stiffness: f64| {
        let stiffness = stiffness * (n * n) as f64;
        let damping = "damping = { rayleigh = { ratio = 0.05, modes = [1, 2] } }";
        format!("mass = {:?}\nstiffness = {:?}\n{damping}", vec![mass; n], vec![stiffness; n])
    };
    let (left, right) = (building(storeys[0], 3e5, 1.25e6), building(storeys[1], 4e5, 7.3e5));
    let pair = |(floor, law): &(usize, &str)| {
        format!("[[contact]]\nleft_floor = {floor}\nright_floor = {floor}\ngap = 0.02\n{law}\n")
    };
    let contacts: String = contacts.iter().map(pair).collect();
    let mut scene = scene(&format!("name = \"T\"\n[left]\n{left}\n[right]\n{right}\n{more}\n{contacts}"));
    scene.ground.record = Some("r.csv".into());
    (scene, record(0.01, &(0..800).map(|k| zigzag(k) / 4.0).collect::<Vec<_>>()))
}

/// All that both ways show at the same times, between samples too.
fn compare(storeys: [usize; 2], contacts: &[(usize, &str)], allowed: f64) {
    let outputs = "[outputs]\nenergy = true\npeaks = false\n";
    let (scene, record) = towers(storeys, contacts, outputs);
    let (other, _) = towers(storeys, contacts, &format!("{outputs}[inputs]\nfloor_forces = true"));
    let [mut run, mut series] = [&scene, &other].map(|scene| Run::new(scene, Some(&record)));
    let (mut closed, mut farthest) = (0, 0.0_f64);
    let near = |what: &str, time: f64, got: f64, exact: f64, scale: f64| {
        let error = (got - exact).abs();
        assert!(error <= allowed * scale, "{what} at {time} s: {got} instead of {exact}, {:e}", error / scale);
    };
    for k in 1..=700 {
        let time = 0.0113 * f64::from(k);
        run.to(time);
        series.to(time);
        for (side, floors) in [(Side::Left, storeys[0]), (Side::Right, storeys[1])] {
            for floor in [0, floors / 2, floors - 1] {
                let [got, exact] = [&run, &series].map(|run| run.displacement(side, floor));
                farthest = farthest.max(exact.abs());
                near("displacement", time, got, exact, farthest.max(0.05));
                let [got, exact] = [&run, &series].map(|run| run.velocity(side, floor));
                near("velocity", time, got, exact, 1.0);
            }
        }
        for (got, exact) in run.contacts().iter().zip(series.contacts()) {
            assert_eq!(got.active, exact.active, "at {time} s");
            near("penetration", time, got.penetration, exact.penetration, 0.1);
            near("impulse", time, got.impulse, exact.impulse, exact.impulse.max(1e6));
            near("peak force", time, got.peak_force, exact.peak_force, exact.peak_force.max(1e6));
            near("dissipated energy", time, got.dissipated_energy, exact.dissipated_energy, 1e6);
            closed += i32::from(got.active);
        }
        let energy = run.energy();
        assert!(energy.residual.abs() < 1e-12, "residual {:e} at {time} s", energy.residual);
    }
    assert_eq!(run.point.impacts, series.point.impacts);
    assert!(closed > 50, "closed at {closed} times");
    let [steps, of_series] = [&run, &series].map(|run| run.state.counters().contact_steps);
    assert!(steps < of_series, "{steps} steps, {of_series} by series");
}

#[test]
fn windows_of_many_modes_are_power_series_of_many_floors() {
    compare([42, 40], &[(40, HERTZ)], 1e-11);
    compare([60, 33], &[(33, DAMPED)], 1e-11);
}

/// The quickest modes of 100 storeys are far too quick for one power series from sample to sample.
#[test]
fn a_hundred_storeys_beside_ninety_take_one_window_from_sample_to_sample() {
    compare([100, 90], &[(90, HERTZ)], 1e-11);
}

#[test]
fn two_floors_lean_at_once() {
    compare([48, 48], &[(48, HERTZ), (46, HERTZ)], 1e-11);
    compare([44, 40], &[(40, DAMPED)], 1e-11);
}

/// So soft that a contact is fresh, and its force still that of an entry, for a whole sample interval after the one in
/// which it begins.
#[test]
fn fresh_contacts_last_from_sample_to_sample() {
    for law in ["law = \"hertz\"\nstiffness = 2e7", "law = \"hertz\"\nstiffness = 2e6"] {
        compare([42, 40], &[(40, law)], 1e-11);
    }
}

/// What is read a rounding error beside a sample is what is read at the sample.
#[test]
fn a_window_is_continuous_at_its_ends() {
    let (scene, record) = towers([50, 40], &[(40, HERTZ)], WITHOUT_PEAKS);
    let mut run = Run::new(&scene, Some(&record));
    let mut closed = 0;
    for k in 100..700 {
        let time = 0.01 * f64::from(k);
        let mut seen = Vec::new();
        for off in [-2e-9, -1e-11, -1e-13, 0.0, 1e-13, 1e-11, 2e-9] {
            run.to(time + off);
            seen.push((off, run.displacement(Side::Left, 39), run.velocity(Side::Left, 39)));
        }
        closed += i32::from(run.contact(0).active);
        let (_, u, v) = seen[3];
        let acceleration = (seen[6].2 - seen[0].2) / 4e-9;
        for (off, displacement, velocity) in seen {
            assert!(
                (displacement - (u + off * v)).abs() < 1e-14,
                "{displacement} instead of {u} {off} s after {time} s"
            );
            let expected = v + off * acceleration;
            assert!((velocity - expected).abs() < 1e-13, "{velocity} instead of {expected} {off} s after {time} s");
        }
    }
    assert!(closed > 50, "closed at {closed} times");
}

/// One window for each sample of the record, where power series take several steps or one each of far more work.
#[test]
fn buildings_that_lean_take_a_step_from_sample_to_sample() {
    let (scene, record) = towers([100, 100], &[(100, HERTZ)], WITHOUT_PEAKS);
    let mut run = Run::new(&scene, Some(&record));
    let mut closed = 0;
    for k in 1..=780 {
        run.to(0.01 * f64::from(k));
        closed += u64::from(run.contact(0).active);
    }
    let counters = run.state.counters();
    assert!(closed > 100, "closed at {closed} samples");
    // Measured: one for each sample, and one or two more at entries and releases.
    assert!(counters.contact_steps <= closed + 3 * run.point.impacts, "{closed} samples, {counters:?}");
    // An entry is found in one piece.
    assert!(counters.narrow_phase_pieces <= 2 * run.point.impacts, "{counters:?}");
}
