//! Contacts of buildings with many storeys, which are followed floor by floor instead of mode by mode.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod common;

use common::{Run, record, scene};
use pounding::engine::Side;
use pounding::record::Record;
use pounding::scene::Scene;

/// 9 and 8 storeys that swing against each other.
fn towers(contacts: &str, more: &str) -> (Scene, Record) {
    let building = |storeys: usize, mass: f64, stiffness: f64| {
        let damping = "damping = { rayleigh = { ratio = 0.02, modes = [1, 3] } }";
        format!("mass = {:?}\nstiffness = {:?}\n{damping}", vec![mass; storeys], vec![stiffness; storeys])
    };
    let (left, right) = (building(9, 2e5, 2e8), building(8, 3e5, 6e8));
    let mut scene = scene(&format!("name = \"T\"\n[left]\n{left}\n[right]\n{right}\n{more}\n{contacts}"));
    scene.ground.record = Some("r.csv".into());
    let samples: Vec<f64> = (0..500_i32).map(|k| f64::from((k * 37 + k * k % 53) % 64 - 32) / 4.0).collect();
    (scene, record(1.0 / 64.0, &samples))
}

fn contact(left: usize, right: usize, law: &str) -> String {
    format!("[[contact]]\nleft_floor = {left}\nright_floor = {right}\ngap = 0.01\n{law}\n")
}

const HERTZ: &str = "law = \"hertz\"\nstiffness = 2.0e9";
const LINEAR: &str = "law = \"linear\"\nstiffness = 1.0e8";

/// A penetration is carried along by its own increments; two pairs that share a floor feel each other's force in them.
#[test]
fn penetrations_are_those_of_the_floors_where_pairs_share_one() {
    for more in [contact(7, 6, HERTZ) + &contact(7, 7, LINEAR), contact(8, 7, LINEAR) + &contact(7, 7, HERTZ)] {
        let (scene, record) = towers(&(contact(8, 8, HERTZ) + &more), "");
        let mut run = Run::new(&scene, Some(&record));
        let mut both = 0;
        for k in 1..=6000 {
            run.to(f64::from(k) * 1e-3);
            for (contact, pair) in run.point.contacts.iter().zip(&scene.contacts).filter(|(contact, _)| contact.active)
            {
                let at = |side, floor: usize| run.displacement(side, floor - 1);
                let gap = at(Side::Left, pair.left_floor) - at(Side::Right, pair.right_floor) - pair.gap;
                let error = (contact.penetration - gap).abs();
                assert!(error < 1e-14, "t = {} s: {:e} m, floors {gap:e} m", 1e-3 * f64::from(k), contact.penetration);
            }
            both += i32::from(run.point.contacts[1..].iter().all(|contact| contact.active));
        }
        assert!(both > 20, "both pairs of a floor closed at {both} times");
    }
}

/// The account counts the work of external forces in contact too.
#[test]
fn forces_on_floors_do_their_work_in_contact() {
    let more = "[inputs]\nfloor_forces = true\n[outputs]\nenergy = true";
    let (scene, record) = towers(&(contact(8, 8, HERTZ) + &contact(6, 6, LINEAR)), more);
    let mut run = Run::new(&scene, Some(&record));
    let (mut work, mut closed) = (0.0_f64, 0);
    for k in 1..=600 {
        let force = if k % 7 < 3 { 3e5 } else { -2e5 };
        run.state.set_floor_force(Side::Left, 7, force);
        run.to(0.01 * f64::from(k));
        let energy = run.point.energy.unwrap();
        assert!(energy.residual.abs() < 1e-13, "t = {} s: residual {:e}", 0.01 * f64::from(k), energy.residual);
        work = work.max(energy.external.abs());
        closed += i32::from(run.point.contacts.iter().any(|contact| contact.active));
    }
    assert!(work > 1e3 && closed > 50, "{work} J, closed at {closed} of 600 times");
}

/// Peak drifts are those of contacts too: some storeys drift most while others hold theirs back.
#[test]
fn peak_drifts_see_what_happens_in_contact() {
    let (scene, record) = towers(&(contact(8, 8, LINEAR) + &contact(6, 6, LINEAR)), "");
    let mut run = Run::new(&scene, Some(&record));
    let mut largest = [(0.0_f64, false); 9];
    for k in 1..=30_000 {
        run.to(f64::from(k) * 2e-4);
        let active = run.point.contacts.iter().any(|contact| contact.active);
        for (floor, largest) in largest.iter_mut().enumerate() {
            let below = if floor == 0 { 0.0 } else { run.displacement(Side::Left, floor - 1) };
            let drift = (run.displacement(Side::Left, floor) - below).abs();
            if drift > largest.0 {
                *largest = (drift, active);
            }
        }
    }
    assert!(largest.iter().any(|(_, active)| *active), "no storey drifts most in contact");
    for (floor, (drift, _)) in largest.iter().enumerate() {
        let peak = run.model.peak_drift(&run.state, Side::Left, floor);
        assert!(peak >= 0.98 * drift && peak <= (1.0 + 1e-6) * drift, "storey {floor}: {peak} instead of {drift}");
    }
}
