//! Yields and turns at awkward times: on samples, at communication points, both within one sample, by the thousand.

use crate::bilinear::Oscillator;
use crate::common::problems::frames::zigzag;
use crate::common::{Run, assert_close, record, scene};
use crate::yielding::{OneStorey, assert_like};
use pounding::engine::BuildingId;
use pounding::record::Record;

/// A ground that rests, with a sample at this time too.
fn rest_with(time: f64) -> Record {
    Record::new(vec![0.0, time, 2.0 * time, 9.0], vec![0.0; 4])
}

fn beside(time: f64, ulps: i64) -> f64 {
    f64::from_bits(time.to_bits().wrapping_add_signed(ulps))
}

#[test]
fn a_yield_and_a_turn_on_a_sample_and_at_a_communication_point() {
    for ratio in [0.0, 0.05] {
        let one = OneStorey { ratio, rate: 0.3, ..OneStorey::USUAL };
        let start = one.oscillator();
        let switches = start.switches(1.0);
        for switch in switches.iter().take(3) {
            for ulps in -3..=3 {
                let time = beside(switch.time, ulps);
                let what = format!("r = {ratio}, switch at {time} s, {ulps} ulps");
                let (mut scene, rest) = (one.scene(), rest_with(time));
                scene.ground.record = Some("rest.csv".into());
                let mut sampled = Run::new(&scene, Some(&rest));
                let mut stopped = one.run();
                for run in [&mut sampled, &mut stopped] {
                    run.to(time);
                    assert_like(run, &one, &start.at(time), 2e-14, &what);
                    for later in [time + 1e-10, 0.3, 0.5, 3.0] {
                        run.to(later);
                        assert_like(run, &one, &start.at(later), 2e-12, &what);
                    }
                    let sense = start.at(time + 1e-10).sense as i32;
                    let mut again = Run::new(&scene, Some(&rest));
                    again.to(time + 1e-10);
                    assert_eq!(again.storey(BuildingId::LEFT, 0).sense, sense, "{what}");
                }
            }
        }
    }
}

/// However short a yield is, one sample of the record or none is around it: 1e-3 to 1e-7 of the yield drift.
#[test]
fn a_yield_and_its_turn_within_one_sample() {
    for beyond in [1e-3, 1e-5, 1e-7] {
        for times in [vec![0.0, 1.0, 2.0, 3.0], vec![0.0, 0.07, 0.1, 3.0]] {
            let one = OneStorey { rate: 0.1 * (1.0 + beyond), ..OneStorey::USUAL };
            let (mut scene, rest) = (one.scene(), Record::new(times.clone(), vec![0.0; times.len()]));
            scene.ground.record = Some("rest.csv".into());
            let mut run = Run::new(&scene, Some(&rest));
            // (v0^2 - w^2 limit^2) / (2 w^2 limit)
            let plastic = 5e-3 * beyond * (1.0 + 0.5 * beyond);
            run.to(3.0);
            let shown = run.storey(BuildingId::LEFT, 0);
            assert!((shown.plastic - plastic).abs() < 1e-14 * 5e-3, "{beyond} beyond: {shown:?} not {plastic:e}");
            assert!(shown.cumulative - shown.plastic < 1e-14 * 5e-3, "{beyond} beyond: {shown:?}");
        }
    }
}

/// A force that changes its sign again and again: two yields each time, 100 000 in all, each a part of a closed form. What
/// has been dissipated is what the account lacks otherwise.
#[test]
fn a_hundred_thousand_yields() {
    for (ratio, share) in [(0.0, 0.9), (0.05, 3.0)] {
        let one = OneStorey { ratio, ..OneStorey::USUAL };
        let mut run = one.run();
        let mut exact = one.oscillator();
        let (mut yields, mut k) = (0, 0);
        while yields < 100_000 {
            let load = if k % 2 == 0 { share } else { -share };
            exact = Oscillator { load: load * one.force / one.mass, ..exact };
            let time = 0.15 * f64::from(k + 1);
            let switches = exact.switches(time);
            yields += switches.iter().filter(|now| now.sense != 0.0).count();
            exact = exact.at(time);
            run.state.set_floor_force(BuildingId::LEFT, 0, load * one.force);
            run.to(time);
            k += 1;
            let residual = run.energy().residual;
            assert!(residual.abs() < 1e-12, "r = {ratio}, {yields} yields: {residual:e}");
        }
        let shown = run.storey(BuildingId::LEFT, 0);
        assert!(shown.cumulative > 1e4 * exact.limit, "{shown:?}");
        let what = format!("r = {ratio}, {yields} yields");
        assert_close(shown.cumulative, exact.cumulative, 1e-11, &what);
        assert_close(shown.hysteretic, (1.0 - ratio) * one.force * exact.cumulative, 1e-11, &what);
        // What is left of many small differences.
        let error = (shown.plastic - exact.plastic).abs() / (exact.limit + exact.furthest);
        assert!(error < 1e-10, "{what}: plastic drift {:e} not {:e}", shown.plastic, exact.plastic);
    }
}

/// Shaken by a record instead, with contacts on both sides.
#[test]
fn a_hundred_thousand_samples_each_of_which_yields() {
    let one = OneStorey { ratio: 0.02, force: 5e2, ..OneStorey::USUAL };
    let mut scene = one.scene();
    scene.ground.record = Some("square.csv".into());
    let samples: Vec<f64> = (0..100_000).map(|k| if k % 2 == 0 { 2.0 } else { -2.0 }).collect();
    let mut run = Run::new(&scene, Some(&record(1.0 / 16.0, &samples)));
    let (mut last, mut least) = (0.0, f64::MAX);
    for k in 0..1000 {
        run.to(6.25 * f64::from(k + 1));
        let shown = run.storey(BuildingId::LEFT, 0);
        least = f64::min(least, shown.cumulative - last);
        last = shown.cumulative;
        assert!(run.energy().residual.abs() < 1e-12, "{:?}", run.energy());
    }
    // 100 samples each, which would swing over 2 (pi / 0.125)^-2 m and yield at 5e-5 m.
    assert!(least > 100.0 * 2e-4, "{least} m");
}

/// The instants that a state notes are the corners of the hysteresis loops: rows there lie on a yield line, V = r k d +-
/// (1 - r) V_y, and no yield or turn is missed.
#[test]
fn noted_instants_are_the_corners_of_the_loops() {
    let (force, stiffness, ratio) = ([9e4, 6e4], [3e7, 2.5e7], [0.1, 0.0]);
    let mut scene = scene(&format!(
        "name = \"Loops\"\n[left]\nmass = [4e4, 3e4]\nstiffness = {stiffness:?}\ndamping = {{ ratio = 0.03 }}\n\
         yield_force = {force:?}\npost_yield_ratio = {ratio:?}\n[[contact]]\nleft_floor = 2\nwall = \"right\"\n\
         gap = 0.004\nlaw = \"hertz\"\nstiffness = 2e9\n"
    ));
    scene.ground.record = Some("zigzag.csv".into());
    let record = record(1.0 / 64.0, &(0..640).map(|k| zigzag(k) / 5.0).collect::<Vec<_>>());
    let mut first = Run::new(&scene, Some(&record));
    first.to(5.0);
    assert!(first.state.switches().is_empty(), "nobody has asked");
    first.state.note_switches();
    first.to(10.0);
    let switches = first.state.switches();
    assert!(switches.len() > 30 && switches[0] > 5.0 && switches.is_sorted(), "{switches:?}");
    let mut run = Run::new(&scene, Some(&record));
    let senses =
        |run: &mut Run, time: f64| run.to(time).storeys().iter().map(|storey| storey.sense).collect::<Vec<_>>();
    let (mut last, mut before) = (5.0, Vec::new());
    for &time in switches {
        if time - last > 1e-6 {
            // All of the way from the last one.
            before = senses(&mut run, last + 2e-7);
            assert!(senses(&mut run, time - 2e-7) == before, "a switch between {last} and {time} s is not noted");
        }
        let is_corner = {
            run.to(time);
            (0..2).any(|i| {
                let storey = run.storey(BuildingId::LEFT, i);
                let below = if i == 0 { 0.0 } else { run.displacement(BuildingId::LEFT, 0) };
                let drift = run.displacement(BuildingId::LEFT, i) - below;
                let line = |sign: f64| ratio[i] * stiffness[i] * drift + sign * (1.0 - ratio[i]) * force[i];
                [1.0, -1.0].iter().any(|sign| (storey.shear - line(*sign)).abs() <= 1e-12 * force[i])
            })
        };
        assert!(is_corner, "{time} s, after {before:?}: no storey is on its yield line");
        last = time;
    }
}
