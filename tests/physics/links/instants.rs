//! Slips at awkward instants: at the start, on a sample, while a contact is closed, and ended by an impulse.

use super::devices::{Pair, between, linked, of_link, slipping};
use crate::bilinear::Oscillator;
use crate::common::Run;
use pounding::engine::{BuildingId, LinkOutput};
use pounding::record::Record;
use pounding::scene::{Link, Scene};

const SPRING: f64 = 3e6;

/// Half of what stretches the spring to its slip force, m.
const LIMIT: f64 = 4e-3;

fn damper() -> Link {
    slipping(between(1, 1, SPRING, 0.0), 2.0 * SPRING * LIMIT, 0.0)
}

/// One of two masses that move against each other, each held by a spring of `own` N/m besides what the damper does.
fn oscillator(own: f64) -> Oscillator {
    let Pair { mass, speeds: [speed, _], .. } = Pair::USUAL;
    let whole = own + 2.0 * SPRING;
    Oscillator { rate: speed, ..Oscillator::new((whole / mass).sqrt(), LIMIT, own / whole) }
}

fn scene() -> Scene {
    linked(&Pair::USUAL.text(), &[damper()])
}

#[track_caller]
fn assert_like(run: &Run, exact: &Oscillator, what: &str) {
    let reach = LIMIT + exact.furthest + exact.drift().abs();
    let slips = [LinkOutput::Slip, LinkOutput::SlipTravel].map(|of| 0.5 * of_link(run, 0, of));
    let left = [run.displacement(BuildingId::LEFT, 0), run.velocity(BuildingId::LEFT, 0) / exact.w];
    let right =
        [run.displacement(BuildingId::RIGHT, 0), run.velocity(BuildingId::RIGHT, 0) / exact.w].map(|value| -value);
    for (of, got, exact_value) in [
        ("slip", slips[0], exact.plastic),
        ("slip travel", slips[1], exact.cumulative),
        ("left displacement", left[0], exact.drift()),
        ("right displacement", right[0], exact.drift()),
        ("left velocity", left[1], exact.rate / exact.w),
        ("right velocity", right[1], exact.rate / exact.w),
    ] {
        let error = (got - exact_value).abs() / (reach + exact.cumulative);
        assert!(error < 1e-12, "{of}, {what}, {} s: {got:e} not {exact_value:e}: {error:.1e}", exact.time);
    }
    assert!(run.energy().residual.abs() < 1e-12, "{what}");
}

fn follow(mut run: Run, start: Oscillator, what: &str) {
    for k in 0..=200 {
        let time = 0.02 * f64::from(k);
        assert_like(run.to(time), &start.at(time), what);
    }
}

/// At its slip force and still stretched, at it and let go, and beyond it, where the excess has slipped before.
#[test]
fn at_the_start() {
    for (drift, rate) in [(LIMIT, 0.25), (LIMIT, -0.25), (LIMIT, 0.0), (3.0 * LIMIT, 0.25), (-3.0 * LIMIT, 0.4)] {
        let mut scene = scene();
        scene.buildings[0].initial_displacement = vec![drift];
        scene.buildings[1].initial_displacement = vec![-drift];
        scene.buildings[0].initial_velocity = vec![rate];
        scene.buildings[1].initial_velocity = vec![-rate];
        let plastic = drift.signum() * (drift.abs() - LIMIT).max(0.0);
        let start = Oscillator {
            elastic: drift - plastic,
            rate,
            plastic,
            furthest: plastic.abs(),
            ..oscillator(Pair::USUAL.stiffness)
        };
        follow(Run::new(&scene, None), start, &format!("from {drift} m with {rate} m/s"));
    }
}

/// A few rounding errors before, at and after the first slips and sticks.
#[test]
fn on_a_sample_and_at_a_communication_point() {
    let start = oscillator(Pair::USUAL.stiffness);
    let switches = start.switches(2.0);
    assert!(switches.len() > 3);
    for switch in switches.iter().take(4) {
        for ulps in -3..=3 {
            let time = f64::from_bits(switch.time.to_bits().wrapping_add_signed(ulps));
            let mut sampled = scene();
            sampled.ground.record = Some("rest.csv".into());
            let rest = Record::new(vec![0.0, time, 2.0 * time, 9.0], vec![0.0; 4]);
            for mut run in [Run::new(&sampled, Some(&rest)), Run::new(&scene(), None)] {
                for later in [time, time + 1e-10, time + 0.1, time + 1.0, time + 3.0] {
                    assert_like(run.to(later), &start.at(later), &format!("{ulps} ulps from {} s", switch.time));
                }
            }
        }
    }
}

/// A linear contact without a gap stiffens the pair from the start on: it slips and sticks within one contact.
#[test]
fn within_a_contact() {
    let contact = 1e7;
    let text = format!(
        "{}[[contact]]\nleft_floor = 1\nright_floor = 1\ngap = 0.0\nlaw = \"linear\"\nstiffness = {contact:?}\n",
        Pair::USUAL.text()
    );
    let start = oscillator(Pair::USUAL.stiffness + 2.0 * contact);
    let switches = start.switches(1.0);
    let [slips, sticks] = [0, 1].map(|i| switches[i]);
    assert!(slips.drift() > 0.0 && sticks.plastic > 0.0);
    // Until the masses are apart again.
    let mut end = sticks.time;
    while start.at(end).drift() > 0.0 {
        end += 1e-4;
    }
    let mut run = Run::new(&linked(&text, &[damper()]), None);
    for k in 1..=100 {
        let time = (end - 1e-4) * f64::from(k) / 100.0;
        assert_like(run.to(time), &start.at(time), "in contact");
        assert!(run.contact(0).active);
    }
    assert_eq!(run.contact(0).impacts, 1);
    for (time, senses) in [(slips.time, [0.0, 1.0]), (sticks.time, [1.0, 0.0])] {
        let mut run = Run::new(&linked(&text, &[damper()]), None);
        let shown = [-1e-9, 1e-9].map(|beside| of_link(run.to(time + beside), 0, LinkOutput::Slipping));
        assert_eq!(shown, senses, "{time} s");
    }
}

/// Rigid masses meet while the damper slips: the impulse turns them, and the slip ends at once.
#[test]
fn ended_by_an_impulse() {
    let start = oscillator(Pair::USUAL.stiffness);
    let switches = start.switches(1.0);
    let (slips, sticks) = (switches[0].time, switches[1].time);
    for (share, restitution) in [(0.5, 0.6), (0.1, 0.9), (0.95, 0.0), (0.5, 0.0)] {
        let meets = slips + share * (sticks - slips);
        let before = start.at(meets);
        let text = format!(
            "{}[[contact]]\nleft_floor = 1\nright_floor = 1\ngap = {:?}\nlaw = \"stereomechanical\"\nrestitution = {restitution:?}\n",
            Pair::USUAL.text(),
            2.0 * before.drift()
        );
        let after = Oscillator { rate: -restitution * before.rate, sense: 0.0, ..before };
        let mut run = Run::new(&linked(&text, &[damper()]), None);
        let what = format!("restitution {restitution}, {share} of the slip");
        assert_eq!(of_link(run.to(meets - 1e-9), 0, LinkOutput::Slipping), 1.0, "{what}");
        assert_eq!(of_link(run.to(meets + 1e-9), 0, LinkOutput::Slipping), 0.0, "{what}");
        assert_eq!(run.contact(0).impacts, 1, "{what}");
        // Until they come back to where they have met, if they do.
        let mut time = meets + 1e-9;
        while time < meets + 2.0 && after.at(time).drift() <= before.drift() {
            assert_like(run.to(time), &after.at(time), &what);
            time += 0.013;
        }
        assert!(time > meets + 0.1, "{what}");
    }
}
