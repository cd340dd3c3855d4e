//! Peaks beside what is read at the same time: never below it, never falling, the same for every communication step. The
//! first scenes are those in which one of these was found not to hold.

use crate::common::peaks::{Watch, all};
use crate::common::problems::two_masses::{Mass, TwoMasses};
use crate::common::{Run, record, scene};
use crate::peaks_whenever::Sequence;
use pounding::engine::{BuildingId, PeakOf};
use pounding::record::Record;
use pounding::scene::Scene;
use std::f64::consts::PI;

const PLASTIC_ROOF: &str = include_str!("../problems/peaks/perfectly_plastic_roof.toml");
const DAMPED_ENTRY: &str = include_str!("../problems/peaks/damped_entry_while_yielding.toml");
const PRESSED_AND_MOVING: &str = include_str!("../problems/peaks/pressed_and_moving.toml");
const PRESSED_AT_REST: &str = include_str!("../problems/peaks/pressed_at_rest.toml");
const STIFF_ON_SOIL: &str = include_str!("../problems/peaks/stiff_contacts_on_soil.toml");
const LONG_FLIGHT: &str = include_str!("../problems/peaks/long_coupled_flight.toml");
const MOVING_IN_CONTACT: &str = include_str!("../problems/peaks/moving_in_contact.toml");

fn el_centro() -> Record {
    let text = include_bytes!("../../examples/records/el_centro_1940_ns.csv");
    Record::parse("el_centro_1940_ns.csv", text).unwrap()
}

fn uneven() -> Record {
    let times = [0.07817437623771502, 0.13879673678168455, 0.1526350028822538, 0.1740234927397743];
    Record::new(times.to_vec(), vec![-0.412664, -0.238105, -0.0534462, 0.131213])
}

/// The scene in steps of several lengths to `stop`, s, and with a record, whose steps are the engine's own, in one step too:
/// the same bits of every peak.
fn check(text: &str, record: Option<&Record>, stop: f64) {
    check_scene(&scene(text), record, stop);
}

fn check_scene(scene: &Scene, record: Option<&Record>, stop: f64) {
    let bits = |run: &Run| all(run).into_iter().flatten().map(|read| read.peak.to_bits()).collect::<Vec<_>>();
    let mut leap = Run::new(scene, record);
    let expected = bits(leap.to(stop));
    for step in [0.001, 0.00037, 0.01] {
        let (mut run, mut watch) = (Run::new(scene, record), Watch::default());
        run.model.observe(&run.state, &mut run.point);
        watch.look(&run).unwrap();
        for k in 1..=(stop / step).ceil() as u32 {
            run.to((step * f64::from(k)).min(stop));
            watch.look(&run).unwrap_or_else(|wrong| panic!("steps of {step} s: {wrong}"));
        }
        assert!(record.is_none() || bits(&run) == expected, "other peaks in steps of {step} s");
    }
}

/// Storeys so stiff that a mode is up to a million times as fast as the others, and dies out or creeps.
#[test]
fn modes_that_settle_have_the_peaks_of_every_step() {
    for (stiffness, damping) in [
        (1e11, "ratio = 0.05"),
        (1e14, "ratio = 0.02"),
        (1e16, "rayleigh = { ratio = 0.05, modes = [1, 2] }"),
        (1e12, "rayleigh = { ratio = 0.05, modes = [1, 2] }"),
    ] {
        let building = |first: f64| {
            format!("mass = [1e5, 1e5, 8e4]\nstiffness = [{first:e}, 9e7, 8e7]\ndamping = {{ {damping} }}\n")
        };
        let text = format!("name = \"Stiff\"\n[left]\n{}[right]\n{}", building(stiffness), building(1e8));
        let mut scene = scene(&text);
        scene.ground.record = Some("r.csv".into());
        check_scene(&scene, Some(&el_centro()), 0.6);
    }
}

/// One flight of 5 s of modes that damping couples.
#[test]
fn a_long_flight_has_the_peaks_of_every_step() {
    let mut scene = scene(LONG_FLIGHT);
    scene.ground.record = Some("r.csv".into());
    check_scene(&scene, Some(&Record::new(vec![0.0, 5.0], vec![0.0, 0.3])), 1.2);
}

/// A contact closes while a storey yields, without the double series of an entry: just after it the power series of a damped
/// force is far off.
#[test]
fn a_force_counts_when_it_is_reached() {
    check(DAMPED_ENTRY, Some(&el_centro()), 1.3);
    let mut run = Run::new(&scene(DAMPED_ENTRY), Some(&el_centro()));
    let mut largest = 0.0_f64;
    for k in 0..=400 {
        let contact = run.to(1.21415 + 5e-8 * f64::from(k)).contact(3);
        largest = largest.max(contact.force);
        let (time, promised) = (run.state.time(), largest * (1.0 + 1e-10));
        assert!(contact.peak_force <= promised, "{time} s: peak {:e} of a force up to {largest:e}", contact.peak_force);
    }
    assert!(largest > 1e3, "{largest} N");
}

/// Floors that press each other through a damped contact so stiff that its rate is hardly more than their rounding: the
/// force at the end of a step is that of the rate of the floors, not of the series.
#[test]
fn a_force_counts_with_the_rate_of_the_floors() {
    let t = |k: u32| f64::from(k) * 0.02;
    let motion = |k: u32| 4.0 * (9.0 * t(k)).sin() + 2.0 * (31.0 * t(k)).sin();
    check(STIFF_ON_SOIL, Some(&record(0.02, &(0..=10).map(motion).collect::<Vec<_>>())), 0.1);
}

/// A mass is pressed into a damped spring at a wall when another hits it: an impulse raises the rate of the spring at once,
/// and with it its force, which falls from then on.
#[test]
fn a_force_counts_when_an_impulse_raises_it() {
    let spring = "stiffness = 1e7\nrestitution = 0.05\n";
    let law = format!(
        "law = \"stereomechanical\"\nrestitution = 0.5\n\
         [[contact]]\nleft_floor = 1\nwall = \"left\"\ngap = 1e-3\nlaw = \"kelvin_voigt_no_tension\"\n{spring}"
    );
    let masses = TwoMasses::new(Mass::free(1e5, -0.1), Mass::free(1e5, -1.0), 0.02, &law).toml();
    let mut run = Run::new(&scene(&masses), None);
    // The entry at the wall, and the impulse.
    for _ in 0..2 {
        run.model.handle_event(&mut run.state, &mut |_| {}).unwrap();
        assert!(run.model.advance_to_event(&mut run.state, 0.1, &mut |_| {}).unwrap());
    }
    let contact = |run: &mut Run| {
        run.model.observe(&run.state, &mut run.point);
        run.contact(1)
    };
    let before = contact(&mut run).force;
    run.model.handle_event(&mut run.state, &mut |_| {}).unwrap();
    let now = contact(&mut run);
    assert!(now.force > 3.0 * before && now.peak_force == now.force, "{before} N, then {now:?}");
    let later = run.to(0.1).contact(1);
    assert!(later.force < now.force && later.peak_force == now.peak_force, "{now:?}, then {later:?}");
}

/// A contact begins with a jump of the force at the very start: what was read before it counts.
#[test]
fn what_is_shown_at_the_start_counts() {
    check(PRESSED_AND_MOVING, None, 0.01);
}

/// The same where floors move fast from the start: what was read there is the peak of the run, to the last bit.
#[test]
fn a_peak_at_the_start_is_the_same_for_every_step() {
    check(MOVING_IN_CONTACT, Some(&el_centro()), 0.1);
}

/// A storey far from a contact that has just begun swings by a billionth of what comes later.
#[test]
fn small_swings_at_the_start_of_a_step_count() {
    check(PRESSED_AT_REST, Some(&uneven()), 0.1);
}

/// Two masses whose contact hardly changes what their own springs and dashpots do to them, so that an acceleration turns just
/// after the entry, where the force of a power law begins like a root of the time: no less than what is read there, for good.
#[test]
fn what_turns_just_after_an_entry_counts() {
    let (mut sequence, quiet) = (Sequence(41), record(0.02, &[0.0; 8]));
    let mut between = |from: f64, to: f64| from + (to - from) * sequence.next();
    let laws =
        ["jankowski\"\nrestitution = 0.4", "hertz\"", "hertz_damped\"\nrestitution = 0.4\ndamping_formula = \"exact\""];
    for law in laws.iter().cycle().take(120) {
        let mut mass = |velocity: f64| {
            let (mass, w) = (10_f64.powf(between(3.5, 5.5)), 2.0 * PI * 10_f64.powf(between(-0.3, 1.2)));
            let (stiffness, ratio) = (mass * w * w, between(0.02, 0.5));
            format!(
                "mass = [{mass:?}]\nstiffness = [{stiffness:?}]\ndamping = {{ ratio = {ratio:?} }}\n\
                 initial_velocity = [{velocity:?}]\n"
            )
        };
        let (left, right) = (mass(0.5), mass(0.0));
        let stiffness = 10_f64.powf(between(6.5, 9.5));
        let text = format!(
            "name = \"Turns\"\n[left]\n{left}[right]\n{right}[[contact]]\nleft_floor = 1\nright_floor = 1\n\
             gap = 1e-3\nlaw = \"{law}\nstiffness = {stiffness:?}\n"
        );
        let (mut run, mut watch) = (Run::new(&scene(&text), Some(&quiet)), Watch::default());
        for time in (0..=1000).map(|k| 1e-4 * f64::from(k)) {
            run.to(time);
            watch.look(&run).unwrap_or_else(|wrong| panic!("{time} s: {wrong} in {text}"));
        }
    }
}

/// A contact so soft that its force hardly moves the floors, over a long window that resolves the motion: a power of the
/// penetration has more of a peak than the nodes of that window tell.
#[test]
fn the_peak_of_a_soft_force_is_found() {
    for stiffness in [4e2, 4e4, 4e6] {
        for law in [
            "hertz_damped\"\nrestitution = 0.3\ndamping_formula = \"exact\"\nexponent = 3.0",
            "jankowski\"\nrestitution = 0.3",
        ] {
            let text = format!(
                "name = \"Soft\"\n[left]\nmass = [12e3]\nstiffness = [6.4e6]\ninitial_velocity = [-0.014]\n\
                 damping = {{ ratio = 0.0 }}\n[right]\nmass = [94e3]\nstiffness = [210e6]\ninitial_velocity = [-0.168]\n\
                 damping = {{ ratio = 0.0 }}\n[[contact]]\nleft_floor = 1\nright_floor = 1\ngap = 0.001\n\
                 law = \"{law}\nstiffness = {stiffness:?}\n"
            );
            check(&text, Some(&record(1.0, &[0.0, 0.0])), 0.6);
        }
    }
}

/// A storey that is perfectly plastic and not damped gives the floor above it no more than its yield force over its mass.
#[test]
fn a_plastic_roof_is_accelerated_by_its_yield_force() {
    for exponent in [1.5, 1.2, 2.0, 2.7] {
        for speed in [0.4, 0.8, 1.5, 4.0, 12.0] {
            let text = PLASTIC_ROOF.replace("0.8, 0.8", &format!("{speed:?}, {speed:?}"));
            let text = format!("{text}exponent = {exponent}\n");
            let mut run = Run::new(&scene(&text), None);
            let off = run.to(0.5).peak(PeakOf::Acceleration(BuildingId::LEFT, 1)) / 7.8975 - 1.0;
            assert!(off.abs() < 2e-11, "{speed} m/s, exponent {exponent}: {off:e}");
        }
    }
}

/// One storey on each side, whose rebounds die out: the reaction of floors that are held counts from the instant at which it
/// is there, which is a row of a table.
#[test]
fn a_held_contact_has_a_peak_from_its_first_instant() {
    let text = "name = \"Held\"\n[left]\nmass = [1e5]\nstiffness = [4e7]\ndamping = { ratio = 0.05 }\n\
                [right]\nmass = [1.5e5]\nstiffness = [1.5e7]\ndamping = { ratio = 0.05 }\n\
                [[contact]]\nleft_floor = 1\nright_floor = 1\ngap = 0.0\nlaw = \"stereomechanical\"\nrestitution = 0.4\n";
    let (mut first, record) = (Run::new(&scene(text), Some(&el_centro())), el_centro());
    first.to(10.0);
    let held = first.episodes.iter().filter(|episode| episode.end.is_some_and(|end| end > episode.start));
    let starts: Vec<f64> = held.map(|episode| episode.start).collect();
    assert!(starts.len() > 5, "{starts:?}");
    let mut at_once = 0;
    for start in starts {
        let (mut run, mut watch) = (Run::new(&scene(text), Some(&record)), Watch::default());
        for time in [start, start + 1e-7] {
            run.to(time);
            watch.look(&run).unwrap();
            let (contact, open) = (run.contact(0), run.model.open_episode(&run.state, 0));
            at_once += i32::from(time == start && contact.force > 0.0);
            assert!(open.is_none_or(|open| open.peak_force >= contact.force), "{time} s: {open:?}");
        }
    }
    assert!(at_once > 2, "a reaction at the first instant in {at_once} cases");
}

/// A peak force that is read again and again never falls, not by a rounding either.
#[test]
fn a_peak_force_never_falls() {
    let text = include_str!("../../examples/scenes/feup.toml").replace("../records/", "records/");
    let mut run = Run::new(&scene(&text), Some(&el_centro()));
    let mut before = [0.0; 2];
    for k in 1..=20_000 {
        let time = f64::from(k) * 1e-3;
        for (p, (contact, before)) in run.to(time).contacts().into_iter().zip(&mut before).enumerate() {
            assert!(
                contact.peak_force >= *before,
                "contact {}, {time} s: {} after {before}",
                p + 1,
                contact.peak_force
            );
            *before = contact.peak_force;
        }
    }
    assert!(before[0] > 100.0, "{before:?} N");
}
