//! Going back and doing it again: the same bits and the same messages, from every point, under every law.

use crate::common::problems::laws::{Laws, contact};
use crate::support::*;

/// Every law; the rigid one returns less, so that it is held.
fn laws() -> [String; 8] {
    let laws = Laws { spring: 2e7, hertz: 1e8, exponent: 1.7, restitution: 0.6 };
    let mut all = laws.all();
    all[0] = Laws { restitution: 0.3, ..laws }.stereomechanical();
    all
}

/// Two and three storeys with two pairs; energy account; driven by the record of the tests or by inputs.
pub fn scene(law: &str, has_record: bool) -> String {
    // Without a gap rigid floors are held together where the ground presses them.
    let gap = if law.contains("stereomechanical") { 0.0 } else { 0.003 };
    let driven = if has_record {
        "[ground]\nrecord = \"record.csv\"\npga = 6.0\n"
    } else {
        "[inputs]\nfloor_forces = true\nrestoring_corrections = true\n"
    };
    format!(
        "name = \"Saved\"\n[left]\nmass = [25e3, 20e3]\nstiffness = [3.46e6, 3e6]\ndamping = {{ ratio = 0.05 }}\n\
         initial_velocity = [0.1, 0.3]\n\
         [right]\nmass = [4e4, 4e4, 3e4]\nstiffness = [2.2e7, 2e7, 2e7]\ndamping = {{ ratio = 0.02 }}\n\
         {driven}[outputs]\nenergy = true\n{}{}",
        contact((1, 1), gap, law),
        contact((2, 2), gap, law)
    )
}

const POINTS: u32 = 250;

/// s: about 4 ms apart, with one step of 0.25 s.
fn time(k: u32) -> f64 {
    f64::from(k) * 0.004 + if k > 60 { 0.25 } else { 0.0 } + if k % 3 == 1 { 0.0007 } else { 0.0 }
}

/// Sets what the master sets at point k, makes the step, reads everything.
fn point(instance: &Instance<'_>, has_record: bool, k: u32) -> (Vec<u64>, Vec<Line>) {
    // Some lines go on from the point before.
    if !has_record && k % 4 != 3 {
        let force = if (100..180).contains(&k) { 4e5 } else { 1e3 };
        assert_eq!(instance.set_real("ground.acceleration", f64::from(k * 37 % 64) / 8.0 - 4.0), OK);
        assert_eq!(instance.set_real("left.force[2]", force), OK);
        assert_eq!(instance.set_real("left.storey_correction[2]", 2e3 * f64::from(k % 5)), OK);
        assert_eq!(instance.set_rate("left.storey_correction[2]", 1, 1e5 * f64::from(k % 3) - 1e5), OK);
        assert_eq!(instance.set_rate("ground.acceleration", 1, f64::from(k % 9) - 4.0), OK);
        assert_eq!(instance.set_rate("left.force[2]", 1, 1e4 * f64::from(k % 7) - 3e4), OK);
    }
    let (from, to) = (time(k), time(k + 1));
    assert_eq!(instance.step(from, to - from), OK, "{:?}", instance.log());
    (instance.outputs(), instance.log())
}

fn is_touching(instance: &Instance<'_>) -> bool {
    let references = [1, 2].map(|p| instance.fmu.vr(&format!("contact[{p}].active")));
    instance.booleans(&references).unwrap().contains(&1)
}

#[test]
fn going_back_and_on_again_gives_the_same_bits_and_messages() {
    for (law, has_record) in laws().iter().flat_map(|law| [(law, true), (law, false)]) {
        let what = format!("{law}, record inside: {has_record}");
        let fmu = Fmu::new(&scene(law, has_record));
        let plain = fmu.instance();
        plain.start();
        let expected: Vec<_> = (0..POINTS).map(|k| point(&plain, has_record, k)).collect();
        assert!(expected.iter().any(|(_, log)| !log.is_empty()), "{what}: nothing is ever logged");

        let saving = fmu.instance();
        saving.start();
        let mut saved: Vec<(State, Vec<u8>)> = Vec::new();
        let (mut touching, mut held) = (0, 0);
        for (k, expected) in (0..).zip(&expected) {
            let state = saving.recorded();
            saved.push((state, saving.serialized(state)));
            assert!(point(&saving, has_record, k) == *expected, "{what}: saving has changed point {k}");
            touching += usize::from(is_touching(&saving));
            held += usize::from(saving.real("contact[1].force") > 0.0 || saving.real("contact[2].force") > 0.0);
        }
        assert!(touching > 15 && held > 15, "{what}: {touching} points in contact, {held} under force");

        // In the instance itself and, by bytes, in another one; the last points first.
        let other = fmu.instance();
        other.start();
        for k in (0..POINTS).rev().step_by(2) {
            let (state, bytes) = &saved[k as usize];
            assert_eq!(saving.set_state(*state), OK);
            let mut copy = other.deserialized(bytes);
            assert_eq!(other.set_state(copy), OK);
            assert_eq!(other.serialized(copy), *bytes, "{what}: point {k}");
            assert_eq!(other.free_state(&raw mut copy), OK);
            for (instance, next) in [(&saving, k), (&other, k), (&saving, k + 1), (&other, k + 1)] {
                let Some(expected) = expected.get(next as usize) else { continue };
                assert!(point(instance, has_record, next) == *expected, "{what}: from point {k}, point {next}");
            }
        }
        // Where the state is read at once, it is read as it was; a long way on from a snapshot is the way it was.
        for k in (1..POINTS).step_by(7) {
            assert_eq!(saving.set_state(saved[k as usize].0), OK);
            assert!(saving.outputs() == expected[k as usize - 1].0, "{what}: point {k} reads otherwise");
        }
        assert_eq!(saving.set_state(saved[40].0), OK);
        for (k, expected) in (40..).zip(&expected[40..]) {
            assert!(point(&saving, has_record, k) == *expected, "{what}: point {k}");
        }
    }
}

#[test]
fn a_snapshot_brings_an_instance_back_from_errors_and_resets() {
    let [rigid, .., jankowski, _] = laws();
    for law in [&rigid, &jankowski] {
        for has_record in [true, false] {
            let fmu = Fmu::new(&scene(law, has_record));
            let instance = fmu.instance();
            instance.start();
            (0..20).for_each(|k| drop(point(&instance, has_record, k)));
            let state = instance.recorded();
            let expected: Vec<_> = (20..40).map(|k| point(&instance, has_record, k)).collect();
            let again = || (20..40).map(|k| point(&instance, has_record, k)).collect::<Vec<_>>();

            // After an error.
            assert_eq!(instance.step(0.0, -1.0), ERROR);
            assert_eq!(instance.step(time(40), 0.1), ERROR, "the instance is in error");
            instance.log();
            assert_eq!(instance.set_state(state), OK);
            assert!(again() == expected);
            // After a reset, in the middle of another initialisation with other parameters.
            assert_eq!(instance.reset(), OK);
            assert_eq!(instance.set_real("left.mass[1]", 1e5), OK);
            instance.enter();
            assert_ne!(instance.real("left.acceleration[1]"), 0.0);
            assert_eq!(instance.set_state(state), OK);
            assert_eq!(instance.real("left.mass[1]"), 25e3);
            assert!(again() == expected);
            // After the end.
            assert_eq!(instance.terminate(), OK);
            assert_eq!(instance.set_state(state), OK);
            assert!(again() == expected);
        }
    }
}
