//! Contacts of buildings with many storeys, which are followed floor by floor instead of mode by mode.

use crate::common::problems::frames::zigzag;
use crate::common::{Run, record, scene};
use pounding::engine::{BuildingId, PeakOf};
use pounding::record::Record;
use pounding::scene::{Scene, Stiffness};

/// 9 and 8 storeys that swing against each other.
fn towers(contacts: &str, more: &str) -> (Scene, Record) {
    let building = |storeys: usize, mass: f64, stiffness: f64| {
        let damping = "damping = { rayleigh = { ratio = 0.02, modes = [1, 3] } }";
        format!("mass = {:?}\nstiffness = {:?}\n{damping}", vec![mass; storeys], vec![stiffness; storeys])
    };
    let (left, right) = (building(9, 2e5, 2e8), building(8, 3e5, 6e8));
    let mut scene = scene(&format!("name = \"T\"\n[left]\n{left}\n[right]\n{right}\n{more}\n{contacts}"));
    scene.ground.record = Some("r.csv".into());
    let samples: Vec<f64> = (0..500).map(|k| zigzag(k) / 4.0).collect();
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
            for (contact, pair) in run.contacts().iter().zip(&scene.contacts).filter(|(contact, _)| contact.active) {
                let of_floors: f64 = pair
                    .row(&scene)
                    .map(|share| share.weight * run.displacement(share.building, share.place.floor().unwrap()))
                    .sum();
                let gap = of_floors - pair.gap;
                let error = (contact.penetration - gap).abs();
                assert!(error < 1e-14, "t = {} s: {:e} m, floors {gap:e} m", 1e-3 * f64::from(k), contact.penetration);
            }
            both += i32::from(run.contacts()[1..].iter().all(|contact| contact.active));
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
        run.state.set_floor_force(BuildingId::LEFT, 7, force);
        run.to(0.01 * f64::from(k));
        let energy = run.energy();
        assert!(energy.residual.abs() < 1e-13, "t = {} s: residual {:e}", 0.01 * f64::from(k), energy.residual);
        work = work.max(energy.external.abs());
        closed += i32::from(run.contacts().iter().any(|contact| contact.active));
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
        let active = run.contacts().iter().any(|contact| contact.active);
        for (floor, largest) in largest.iter_mut().enumerate() {
            let below = if floor == 0 { 0.0 } else { run.displacement(BuildingId::LEFT, floor - 1) };
            let drift = (run.displacement(BuildingId::LEFT, floor) - below).abs();
            if drift > largest.0 {
                *largest = (drift, active);
            }
        }
    }
    assert!(largest.iter().any(|(_, active)| *active), "no storey drifts most in contact");
    for (floor, (drift, _)) in largest.iter().enumerate() {
        let peak = run.peak(PeakOf::Drift(BuildingId::LEFT, floor));
        assert!(
            peak >= (1.0 - 1e-13) * drift && peak <= (1.0 + 1e-6) * drift,
            "storey {floor}: {peak} instead of {drift}"
        );
    }
}

/// The same buildings given by their stiffness matrices are followed mode by mode: another way to the same motion, whether
/// floors face each other at one level or not, alone or two to one, under one law or several.
#[test]
fn floors_go_where_their_modes_go() {
    const DAMPED: &str = "law = \"hertz_damped\"\nstiffness = 2.0e9\nrestitution = 0.6\ndamping_formula = \"exact\"";
    const JANKOWSKI: &str = "law = \"jankowski\"\nstiffness = 2.0e9\nrestitution = 0.6";
    let level = |law: &str| (3..9).map(|floor| contact(floor, floor, law)).collect::<String>();
    let cases = [
        level(HERTZ),
        level(DAMPED),
        level(JANKOWSKI),
        level(LINEAR),
        contact(8, 8, HERTZ) + &contact(9, 8, LINEAR) + &contact(7, 6, DAMPED) + &contact(6, 5, JANKOWSKI),
        contact(8, 4, DAMPED) + &contact(7, 3, HERTZ) + &contact(6, 6, JANKOWSKI) + &contact(5, 5, LINEAR),
    ];
    for contacts in cases {
        let (scene, record) = towers(&contacts, "[solver]\nrelative_tolerance = 1e-11");
        let mut by_modes = scene.clone();
        for building in &mut by_modes.buildings {
            let Stiffness::Shear(storeys) = &building.stiffness else { panic!("a shear building") };
            let entry = |i: usize, j: usize| match i.abs_diff(j) {
                0 => storeys[i] + storeys.get(i + 1).unwrap_or(&0.0),
                1 => -storeys[i.max(j)],
                _ => 0.0,
            };
            let row = |i: usize| (0..storeys.len()).map(|j| entry(i, j)).collect();
            building.stiffness = Stiffness::Matrix((0..storeys.len()).map(row).collect());
        }
        let (mut floors, mut modes) = (Run::new(&scene, Some(&record)), Run::new(&by_modes, Some(&record)));
        let (mut largest, mut closed) = (0.0_f64, 0);
        for k in 1..=300 {
            let time = 0.01 * f64::from(k);
            floors.to(time);
            modes.to(time);
            for (side, storeys) in [(BuildingId::LEFT, 9), (BuildingId::RIGHT, 8)] {
                for floor in 0..storeys {
                    let (u, expected) = (floors.displacement(side, floor), modes.displacement(side, floor));
                    largest = largest.max(expected.abs());
                    assert!((u - expected).abs() < 1e-8 * largest, "t = {time} s, floor {floor}: {u} not {expected}");
                }
            }
            closed += i32::from(floors.contacts().iter().any(|contact| contact.active));
        }
        assert!(closed > 20, "closed at {closed} of 300 times");
    }
}
