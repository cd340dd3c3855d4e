//! Storeys that fall: where the run ends, and that it ends there whatever else happens at that time.

use crate::common::peaks::Watch;
use crate::common::problems::frames::zigzag;
use crate::common::{Run, assert_close, record, scene};
use crate::p_delta::Leaning;
use pounding::engine::{BuildingId, Collapse, Output, PeakOf, YieldingOf};
use pounding::record::Record;
use pounding::scene::Scene;

/// A storey alone that falls in a second.
fn falling() -> Leaning {
    Leaning::new(0.25, 0.0).with_share(1.2)
}

fn collapse(run: &Run) -> Collapse {
    run.model.collapse(&run.state).expect("a storey falls")
}

/// Two storeys beside two, under a record that makes the left ones fall; with contacts or without.
fn frames(contacts: &str) -> (Scene, Record) {
    let building = |side: &str, mass: f64, force: &str| {
        format!(
            "[{side}]\nmass = {:?}\nstiffness = [1.2e7, 1e7]\ndamping = {{ ratio = 0.03 }}\nyield_force = {force}\n\
             post_yield_ratio = [0.02, 0.0]\nheight = [3.5, 3.0]\np_delta = true\ngravity_load = [1.2e6, 1.6e6]\n",
            [mass, 0.8 * mass]
        )
    };
    let (left, right) = (building("left", 4e4, "[9e4, 1.2e5]"), building("right", 2.5e4, "[2e5, inf]"));
    let mut scene = scene(&format!("name = \"Frames\"\n{left}{right}[outputs]\nenergy = true\n{contacts}"));
    scene.ground.record = Some("zigzag.csv".into());
    (scene, record(1.0 / 64.0, &(0..1200).map(|k| zigzag(k) / 4.0).collect::<Vec<_>>()))
}

const CONTACT: &str = "[[contact]]\nleft_floor = 2\nright_floor = 2\ngap = 0.02\nlaw = \"hertz_damped\"\nstiffness = 2e9\n\
                       restitution = 0.6\ndamping_formula = \"exact\"\n";

/// All that is shown, and where the run has ended.
fn seen(run: &Run) -> (Vec<u64>, Option<Collapse>) {
    let mut bits = run.bits();
    let energy = run.energy();
    let terms = [energy.input, energy.viscous, energy.impact, energy.strain, energy.hysteretic, energy.gravity];
    bits.extend(terms.iter().chain(&[energy.residual]).map(|term| term.to_bits()));
    bits.extend(
        run.yielding.iter().map(|&(side, storey)| {
            run.read(Output::OfYielding(YieldingOf::PeakStabilityIndex, side, storey)).to_bits()
        }),
    );
    (bits, run.model.collapse(&run.state))
}

/// The account closes through a fall, up to its end, and tells what the weights have given.
#[test]
fn the_energy_account_closes_through_a_fall() {
    for contacts in ["", CONTACT] {
        let (scene, record) = frames(contacts);
        let mut run = Run::new(&scene, Some(&record));
        for k in 1..=2000 {
            run.to(0.01 * f64::from(k));
            assert!(run.energy().residual.abs() < 1e-12, "{:?} at {} s", run.energy(), run.state.time());
        }
        let end = collapse(&run);
        let given: f64 = (0..2)
            .map(|storey| {
                let below = if storey == 0 { 0.0 } else { run.displacement(BuildingId::LEFT, 0) };
                let drift = run.displacement(BuildingId::LEFT, storey) - below;
                0.5 * [2.8e6 / 3.5, 1.6e6 / 3.0][storey] * drift * drift
            })
            .sum();
        let right = scene.buildings[1].gravity_stiffness();
        let (one, two) = (run.displacement(BuildingId::RIGHT, 0), run.displacement(BuildingId::RIGHT, 1));
        let given = given + 0.5 * (right[0] * one * one + right[1] * (two - one) * (two - one));
        assert_close(run.energy().gravity, -given, 1e-12, "energy of gravity");
        assert_eq!(end.building, BuildingId::LEFT);
        assert!(given > 1e5, "{given:e} J at {} s", end.time);
    }
}

/// The time of the fall is the end, and nothing moves beyond it.
#[test]
fn the_run_ends_where_a_storey_has_collapsed() {
    let mut run = falling().run();
    run.to(20.0);
    let end = collapse(&run);
    assert_eq!((end.building, end.storey, run.state.time()), (BuildingId::LEFT, 0, end.time));
    assert_eq!(run.read(Output::Collapsed(BuildingId::LEFT)), 1.0);
    assert_eq!(run.read(Output::CollapseTime(BuildingId::LEFT)), end.time);
    assert_eq!(run.read(Output::Collapsed(BuildingId::RIGHT)), 0.0);
    assert_eq!(run.read(Output::CollapseTime(BuildingId::RIGHT)), -1.0);
    let bits = seen(&run);
    for time in [end.time, 20.0, 20.0 + 1e-9, 1e6] {
        assert!(seen(run.to(time)) == bits, "to {time} s");
        assert_eq!(run.state.time(), end.time);
        let again = run.model.advance(&mut run.state, time, &mut |_| ()).unwrap();
        assert_eq!(again, Some(end));
    }
}

/// Ends of communication steps and samples of a record at the time of the fall and beside it.
#[test]
fn a_fall_at_a_communication_point_or_a_sample() {
    let one = falling();
    let mut scene = one.scene("");
    scene.ground.record = Some("zeros.csv".into());
    // Without a record steps would end where the master's do.
    let start = || Run::new(&scene, Some(&record(32.0, &[0.0; 2])));
    let mut run = start();
    let (end, bits) = (collapse(run.to(20.0)).time, seen(&run));
    for last in [end.next_down(), end, end.next_up()] {
        let mut run = start();
        run.to(last);
        assert_eq!(run.state.time(), last.min(end));
        assert_eq!(run.model.collapse(&run.state).is_some(), last >= end, "to {last} s");
        assert!(seen(run.to(20.0)) == bits, "by {last} s");
    }
    for sample in [end - 1e-9, end.next_down().next_down(), end.next_down(), end, end.next_up(), end + 1e-9] {
        let record = Record::new(vec![0.0, sample, sample + 1.0], vec![0.0; 3]);
        let mut run = Run::new(&scene, Some(&record));
        run.to(20.0);
        assert!((collapse(&run).time - end).abs() < 1e-14, "a sample at {sample} s: {:?}, not {end}", collapse(&run));
        assert_close(run.displacement(BuildingId::LEFT, 0), one.collapse, 1e-14, "drift");
    }
}

/// A storey that starts a rounding before its collapse, or a nanometre: it ends in the first step.
#[test]
fn a_fall_in_the_first_step() {
    for before in [1e-9, 0.0] {
        for sign in [1.0, -1.0] {
            let one = Leaning { speed: sign * 0.5, ..Leaning::new(0.25, 0.0) };
            let start = sign * if before > 0.0 { one.collapse - before } else { one.collapse.next_down() };
            let mut scene = one.scene("");
            scene.buildings[0].initial_displacement = vec![start];
            let mut run = Run::new(&scene, None);
            run.to(1e-3);
            assert!((collapse(&run).time - before / 0.5).abs() < 2e-15, "{before} m: {:?}", collapse(&run));
            assert_close(run.displacement(BuildingId::LEFT, 0), sign * one.collapse, 1e-14, "drift");
        }
    }
}

/// A storey that falls pushes its neighbour before it, and has collapsed before they part.
#[test]
fn a_fall_in_mid_contact() {
    let one = falling();
    let gap = one.collapse - 0.01;
    let mut run = Run::new(
        &one.scene(&format!(
            "[right]\nmass = [2.5e3]\nstiffness = [1e5]\ndamping = {{ ratio = 0.02 }}\n[[contact]]\nleft_floor = 1\nright_floor = 1\n\
             gap = {gap:?}\nlaw = \"linear\"\nstiffness = 1e6\n"
        )),
        None,
    );
    run.to(20.0);
    assert!(collapse(&run).time > one.reaches(gap) && run.contact(0).active, "{:?}", run.contact(0));
    assert!(run.contact(0).force > 0.0 && run.episodes.is_empty());
    assert_eq!(run.model.open_episode(&run.state, 0).map(|episode| episode.end), Some(None));
    assert!(run.energy().residual.abs() < 1e-12, "{:?}", run.energy());
}

/// A push that goes on lets a storey fall: under floor forces steps end at communication points.
#[test]
fn a_fall_under_a_force_of_the_master() {
    let one = Leaning::new(0.25, 0.0);
    let end = |step: f64| {
        let mut run = Run::new(&one.scene("[inputs]\nfloor_forces = true\n"), None);
        run.state.set_floor_force(BuildingId::LEFT, 0, -5e4);
        run.in_steps(step, 20.0);
        assert_close(run.displacement(BuildingId::LEFT, 0), -one.collapse, 1e-14, "drift");
        assert!(run.energy().residual.abs() < 1e-12, "{:?}", run.energy());
        collapse(&run).time
    };
    let ends = [20.0, 0.37, 1e-3].map(end);
    assert!(ends.iter().all(|time| (time - ends[0]).abs() < 1e-13), "{ends:?}");
}

/// Beyond the drift at which nothing static brings it back, an elastic wall does: until then an exponential, from there on the
/// cosine of the elastic storey.
#[test]
fn a_neighbour_pushes_back_what_would_fall() {
    let one = falling();
    let drift = 1.05 * one.critical();
    let wall = format!(
        "[[contact]]\nleft_floor = 1\nwall = \"right\"\ngap = {drift:?}\nlaw = \"stereomechanical\"\nrestitution = 1.0\n"
    );
    let mut run = Run::new(&one.scene(&wall), None);
    let (meets, plastic, w) = (one.reaches(drift), drift - one.limit(), one.w());
    let (_, speed) = one.falling(meets - one.yields().0);
    let rest = (1.0 + one.limit() / one.reach()) * plastic;
    for k in 1..=10 {
        let phase = 0.1 * f64::from(k);
        run.to(meets + phase / w);
        let expected = rest + (drift - rest) * phase.cos() - speed / w * phase.sin();
        let error = (run.displacement(BuildingId::LEFT, 0) - expected).abs() / drift;
        assert!(expected > drift - 2.0 * one.limit(), "it yields the other way at {expected} m");
        assert!(error < 1e-12, "{k}: {expected:e} m, off by {error:.1e}");
    }
    assert!(run.read(Output::OfYielding(YieldingOf::PeakStabilityIndex, BuildingId::LEFT, 0)) > 1.049);
    assert_eq!(run.storey(BuildingId::LEFT, 0).residual, one.critical());
    assert!(run.displacement(BuildingId::LEFT, 0) < one.critical());
    run.to(20.0);
    assert!(run.energy().residual.abs() < 1e-12, "{:?}", run.energy());
    assert!(run.peak(PeakOf::Displacement(BuildingId::LEFT, 0)) >= drift);
}

/// No reading is beyond a peak while a storey falls, and the peaks at the end are those of the fall.
#[test]
fn peaks_are_true_while_a_storey_falls() {
    for contacts in ["", CONTACT] {
        let (scene, record) = frames(contacts);
        let (mut run, mut watch) = (Run::new(&scene, Some(&record)), Watch::default());
        while run.model.collapse(&run.state).is_none() && run.state.time() < 20.0 {
            run.to(run.state.time() + 1.7e-3);
            watch.look(&run).unwrap_or_else(|wrong| panic!("{wrong}"));
        }
        let Collapse { building: side, storey, .. } = collapse(&run);
        let drift = scene.building(side).collapse_drift(storey).unwrap();
        assert_close(run.peak(PeakOf::Drift(side, storey)), drift, 1e-10, "peak drift");
        let of = scene.building(side).net_storey(storey).unwrap();
        assert_close(run.storey(side, storey).ductility, drift / of.yield_drift(), 1e-13, "ductility");
        // Read once, at the end: the same peaks.
        let mut once = Run::new(&scene, Some(&record));
        assert!(seen(once.to(20.0)) == seen(&run));
    }
}

/// The drift of a collapse is that of the scene, from just beyond the critical one to far beyond all sense.
#[test]
fn the_limit_of_the_scene_decides() {
    let one = falling();
    for collapse_at in [0.021, 0.1, 1.0, 4.0, 400.0] {
        let one = Leaning { collapse: collapse_at, ..one };
        let mut run = one.run();
        run.to(20.0);
        assert_close(run.displacement(BuildingId::LEFT, 0), collapse_at, 1e-14, "drift");
        let error = (collapse(&run).time - one.reaches(collapse_at)).abs() * one.rate();
        assert!(error < 1e-12, "{collapse_at} m: {:?}, off by {error:.1e}", collapse(&run));
    }
}
