//! The same bits, whatever the communication steps are and whenever a state is saved: also while storeys yield, and at the
//! very instants at which they begin to and turn.

use crate::common::problems::frames::zigzag;
use crate::common::problems::laws::Laws;
use crate::common::{Run, record, scene};
use pounding::engine::SavedState;
use pounding::record::Record;
use pounding::scene::Scene;

/// Two frames that yield and meet at two levels.
fn frames(law: &str) -> (Scene, Record) {
    let building = |side: &str, mass: f64, force: &str| {
        format!(
            "[{side}]\nmass = {:?}\nstiffness = [3e7, 2.5e7, 2e7]\ndamping = {{ ratio = 0.03 }}\nyield_force = {force}\n\
             post_yield_ratio = [0.05, 0.0, 0.1]\n",
            [mass, mass, 0.8 * mass]
        )
    };
    let contact =
        |floor: usize| format!("[[contact]]\nleft_floor = {floor}\nright_floor = {floor}\ngap = 0.004\n{law}\n");
    let mut scene = scene(&format!(
        "name = \"Frames\"\n{}{}[outputs]\nenergy = true\n{}{}",
        building("left", 4e4, "[4e5, 3e5, inf]"),
        building("right", 2.5e4, "[inf, 2e5, 1.2e5]"),
        contact(2),
        contact(3)
    ));
    scene.ground.record = Some("zigzag.csv".into());
    (scene, record(1.0 / 64.0, &(0..1200).map(|k| zigzag(k) / 5.0).collect::<Vec<_>>()))
}

fn laws() -> [String; 4] {
    let laws = Laws { spring: 2e8, hertz: 2e9, exponent: 1.5, restitution: 0.6 };
    [laws.stereomechanical(), laws.kelvin_voigt_no_tension(), laws.hertz(), laws.hertz_damped("exact")]
}

/// All that is shown, and the counts of what has been done.
fn seen(run: &Run) -> (Vec<u64>, u64) {
    let mut bits = run.bits();
    let energy = run.energy();
    let terms = [energy.input, energy.viscous, energy.impact, energy.strain, energy.hysteretic, energy.residual];
    bits.extend(terms.map(f64::to_bits));
    (bits, run.state.counters().events)
}

/// Steps of a tenth of a millisecond to 20 s, some regular and some not: at each whole second that they share.
#[test]
fn communication_steps_do_not_matter() {
    for law in laws() {
        let (scene, record) = frames(&law);
        let mut fine = Run::new(&scene, Some(&record));
        let mut expected = Vec::new();
        let (mut yielding, mut touching) = (0, 0);
        for second in 0..20 {
            for k in 1..=10_000 {
                fine.to(if k == 10_000 { f64::from(second + 1) } else { f64::from(second) + 1e-4 * f64::from(k) });
                yielding += i32::from(fine.storeys().iter().any(|storey| storey.sense != 0));
                touching += i32::from(fine.contacts().iter().any(|contact| contact.active));
            }
            expected.push(seen(&fine));
        }
        assert!(yielding > 10_000, "{law}: storeys yield at {yielding} of 200 000 times");
        assert!(touching > 500 || law.contains("stereo"), "{law}: contact at {touching} of 200 000 times");
        assert!(fine.point.impacts > 2, "{law}: {} impacts", fine.point.impacts);
        // Several in each second; the ends of these are not those of samples.
        for count in [1000, 333, 64, 7, 1] {
            let mut run = Run::new(&scene, Some(&record));
            for (second, expected) in (0..20).zip(&expected) {
                for k in 1..count {
                    let uneven = 0.3 * f64::from(k * 7 % 5) / 5.0;
                    run.to(f64::from(second) + (f64::from(k) + uneven) / f64::from(count));
                }
                run.to(f64::from(second + 1));
                assert!(seen(&run) == *expected, "{law}: {count} steps a second, {} s", second + 1);
            }
        }
        let mut run = Run::new(&scene, Some(&record));
        assert!(seen(run.to(20.0)) == expected[19], "{law}: one step");
    }
}

/// Two neighbouring doubles between which what the storeys do changes, after a time at which it is still the same as in a
/// saved state.
fn switch(run: &mut Run, saved: &SavedState, mut before: f64, mut after: f64) -> [f64; 2] {
    let senses = |run: &mut Run, time: f64| {
        run.model.restore(saved, &mut run.state);
        run.to(time).storeys().iter().map(|storey| storey.sense).collect::<Vec<_>>()
    };
    let first = senses(run, before);
    loop {
        let middle = 0.5 * (before + after);
        if middle <= before || middle >= after {
            return [before, after];
        }
        *if senses(run, middle) == first { &mut before } else { &mut after } = middle;
    }
}

#[test]
fn a_state_saved_where_a_storey_begins_to_yield_or_turns_goes_on_to_the_same_bits() {
    for law in laws() {
        let (scene, record) = frames(&law);
        let mut plain = Run::new(&scene, Some(&record));
        let expected = seen(plain.to(8.0));
        let (mut run, mut other) = (Run::new(&scene, Some(&record)), Run::new(&scene, Some(&record)));
        run.to(0.0);
        let (mut switches, mut yielding) = (0, 0);
        for k in 1..=800 {
            let saved = run.save();
            let before = run.storeys();
            run.to(0.01 * f64::from(k));
            let now = run.storeys();
            let is_same = before.iter().zip(&now).all(|(before, now)| before.sense == now.sense);
            yielding += i32::from(is_same && now.iter().any(|storey| storey.sense != 0));
            let mut times = vec![run.state.time()];
            if !is_same {
                times.extend(switch(&mut other, &saved, saved.time(), run.state.time()));
                switches += 1;
            }
            if k % 10 != 0 && is_same {
                continue;
            }
            for time in times {
                other.model.restore(&saved, &mut other.state);
                other.to(time);
                let here = other.save();
                other.model.check_saved(&here).unwrap();
                let bits = seen(&other);
                other.to(7.9);
                other.model.restore(&here, &mut other.state);
                other.to(time);
                assert!(seen(&other) == bits, "{law}: another state is read at {time} s");
                assert!(seen(other.to(8.0)) == expected, "{law}: saved at {time} s");
            }
        }
        assert!(switches > 40 && yielding > 40, "{law}: {switches} switches, {yielding} times while a storey yields");
    }
}

/// Storeys beyond their yield drift, held there with no rate and let go: some yield at once, others turn. A state is one of
/// its model at any time in the first steps, and goes on to the same bits.
#[test]
fn storeys_let_go_beyond_their_yield_drift_can_be_saved_at_once() {
    let mut at_once = 0;
    for k in 0..40 {
        let pushed = |floor: u32| 0.03 * (f64::from(7 * k + 3 * floor) * 1.7).sin();
        let mut scene = scene(&format!(
            "name = \"Held\"\n[left]\nmass = [1.3e4, 8.5e3, 1.3e4]\nstiffness = [1.3e7, 1e7, 1.1e7]\n\
             yield_force = [9e4, 8.1e4, inf]\ndamping = {{ ratio = 0.0 }}\ninitial_displacement = {:?}\n\
             [outputs]\nenergy = true\n",
            [1, 2, 3].map(pushed)
        ));
        scene.ground.record = Some("quiet.csv".into());
        let record = record(0.05, &[0.0, 0.0]);
        let expected = seen(Run::new(&scene, Some(&record)).to(0.05));
        let mut run = Run::new(&scene, Some(&record));
        for n in 0..20 {
            run.to(0.0002 * f64::from(n));
            at_once += i32::from(n == 1 && run.storeys().iter().any(|storey| storey.sense != 0));
            let saved = run.save();
            run.model.check_saved(&saved).unwrap_or_else(|error| panic!("scene {k}, row {n}: {error}"));
            let mut other = Run::new(&scene, Some(&record));
            other.model.restore(&saved, &mut other.state);
            assert!(seen(other.to(0.05)) == expected, "scene {k}, row {n}");
        }
    }
    assert!(at_once > 5, "a storey yields from the first instant on in {at_once} of 40 scenes");
}
