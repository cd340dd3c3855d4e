//! Corrections of what a building resists with, by a master that knows better: motion, shears, energies, peaks and what
//! answers to them at once, against closed forms, the same building by forces on its floors, and the softer building
//! itself.

use crate::common::problems::frames::zigzag;
use crate::common::problems::laws::{Laws, contact};
use crate::common::{Run, assert_close, record, scene};
use pounding::engine::{BuildingId, FoundationOutput as F, Input, Output, PeakOf, Response, StoreyPeak, YieldingOf};
use pounding::record::Record;
use pounding::scene::Scene;

const LEFT: BuildingId = BuildingId::LEFT;

/// Three storeys beside two, with an account of energy; `law` of their contacts at two levels.
fn frames(inputs: &str, left: &str, law: &str) -> Scene {
    let right = "mass = [4e4, 3e4]\nstiffness = [9e7, 7e7]\ndamping = { ratio = 0.05 }\n";
    let contacts = contact((1, 1), 0.004, law) + &contact((2, 2), 0.006, law);
    let mut scene = scene(&format!(
        "name = \"Frames\"\n[inputs]\n{inputs} = true\n[left]\nmass = [5e4, 4e4, 3e4]\n{left}[right]\n{right}{contacts}"
    ));
    scene.energy = true;
    scene
}

const SHEAR: &str = "stiffness = [6e7, 5e7, 4e7]\ndamping = { ratio = 0.03 }\n";
const MATRIX: &str = "stiffness_matrix = [[9e7, -5e7, 3e6], [-5e7, 9e7, -4e7], [3e6, -4e7, 4e7]]\n\
                      damping = { ratio = 0.03 }\n";

fn shaken(mut scene: Scene) -> (Scene, Record) {
    scene.ground.record = Some("r.csv".into());
    (scene, record(1.0 / 64.0, &(0..=256).map(|k| zigzag(k) / 8.0).collect::<Vec<_>>()))
}

/// N: what a master says of storey or floor `i` at its point k, 1/64 s apart.
fn said(k: usize, i: usize) -> f64 {
    2e3 * zigzag(k * (i + 1) + 5 * i)
}

/// Goes to a point of the master with the lines that lead from one to the next, `of` each input, or held ones.
fn drive(run: &mut Run, to: usize, is_held: bool, inputs: usize, of: &dyn Fn(usize, usize) -> (Input, f64)) {
    let from = (run.state.time() * 64.0).round() as usize;
    for k in from..to {
        for i in 0..inputs {
            let ((input, value), (_, next)) = (of(k, i), of(k + 1, i));
            run.state.set_input(input, value);
            run.state.set_input_rate(input, if is_held { 0.0 } else { 64.0 * (next - value) });
        }
        run.to((k + 1) as f64 / 64.0);
    }
}

fn shear(run: &Run, storey: usize) -> f64 {
    run.read(Output::OfYielding(YieldingOf::Shear, LEFT, storey))
}

/// As far as the motion goes it is a pair of forces; shears and accounts differ.
#[test]
fn the_motion_is_that_of_a_pair_of_forces() {
    let laws = Laws { spring: 2e8, hertz: 3e9, exponent: 1.5, restitution: 0.6 };
    for law in laws.all() {
        for (is_held, is_shear) in [(false, true), (true, true), (false, false)] {
            let of = if is_shear { SHEAR } else { MATRIX };
            let (scene, record) = shaken(frames("restoring_corrections", of, &law));
            let mut corrected = Run::new(&scene, Some(&record));
            let mut pushed = Run::new(&shaken(frames("floor_forces", of, &law)).0, Some(&record));
            for k in 1..=200 {
                let above = |k: usize, i: usize| if is_shear && i < 2 { said(k, i + 1) } else { 0.0 };
                drive(&mut corrected, k, is_held, 3, &|k, i| (Input::Correction(LEFT, i), said(k, i)));
                drive(&mut pushed, k, is_held, 3, &|k, i| (Input::Force(LEFT, i), said(k, i) - above(k, i)));
                let close = |of: Output, rounding: f64| {
                    let [one, other] = [&corrected, &pushed].map(|run| run.read(of));
                    assert!((one - other).abs() < rounding, "{law} {is_shear} {k}: {of:?} {one:e} {other:e}");
                };
                for i in 0..3 {
                    close(Output::Displacement(LEFT, i), 1e-13);
                    close(Output::Peak(PeakOf::Drift(LEFT, i)), 1e-13);
                    // A contact makes of 1e-13 m what its stiffness does.
                    close(Output::Acceleration(LEFT, i), 1e-6);
                }
                close(Output::Displacement(BuildingId::RIGHT, 1), 1e-13);
                let force = |i: usize| {
                    let now = if is_held { k - 1 } else { k };
                    said(now, i)
                };
                let of_base: f64 = if is_shear { force(0) } else { (0..3).map(force).sum() };
                let [one, other] = [&corrected, &pushed].map(|run| run.read(Output::BaseShear(LEFT)));
                assert!((other - one - of_base).abs() < 1e-7 * 6e7 * 0.01, "{law}: {one:e} {other:e} {of_base:e}");
                if is_shear {
                    for (i, stiffness) in [6e7, 5e7, 4e7].into_iter().enumerate() {
                        let expected = stiffness * corrected.drift(LEFT, i) - force(i);
                        assert!((shear(&corrected, i) - expected).abs() < 1e-7, "{law}: shear of storey {i}");
                    }
                }
                let [one, other] = [&corrected, &pushed].map(Run::energy);
                assert!(one.residual.abs() < 1e-12 && other.residual.abs() < 1e-12, "{law}: {one:?}");
                assert!((one.correction + other.external).abs() < 1e-9, "{law}: {one:?} {other:?}");
                assert!(one.external == 0.0 && other.correction == 0.0);
            }
            assert!(corrected.episodes.len() > 3 && corrected.energy().correction.abs() > 10.0, "{law}");
        }
    }
}

/// What resists with nothing flies on straight: K0 u is a line in time, and corrects itself away.
#[test]
fn what_resists_with_nothing_flies_straight() {
    let speeds = [0.3, 0.2, 0.5];
    let text = format!("{SHEAR}initial_velocity = {speeds:?}\n").replace("0.03", "0.0");
    for step in [0.07, 0.7] {
        let mut scene = frames("restoring_corrections", &text, "law = \"hertz\"\nstiffness = 1e9\n");
        scene.contacts.clear();
        let mut run = Run::new(&scene, None);
        for (i, stiffness) in [6e7, 5e7, 4e7].into_iter().enumerate() {
            let drifting = speeds[i] - if i > 0 { speeds[i - 1] } else { 0.0 };
            run.state.set_input_rate(Input::Correction(LEFT, i), stiffness * drifting);
        }
        run.in_steps(step, 0.7);
        let strain = run.energy().strain;
        for (i, speed) in speeds.into_iter().enumerate() {
            assert_close(run.displacement(LEFT, i), speed * 0.7, 1e-13, "displacement");
            assert!(shear(&run, i).abs() < 1e-12 * 6e7, "{:e}", shear(&run, i));
            assert!(run.read(Output::Acceleration(LEFT, i)).abs() < 1e-10);
        }
        assert!(run.read(Output::BaseShear(LEFT)).abs() < 1e-12 * 6e7);
        assert!(run.peak(PeakOf::BaseShear(LEFT)) < 1e-12 * 6e7);
        assert_close(run.energy().correction, -strain, 1e-13, "what nothing has taken up");
        assert!(run.energy().residual.abs() < 1e-13);
    }
}

/// Another program knows that the storeys are softer and says so by lines: second order in the step, and the shears and
/// the energies of what resists.
#[test]
fn a_softer_building_outside_is_that_building() {
    let soft = [0.7, 0.5, 0.9];
    let law = Laws { spring: 2e8, hertz: 3e9, exponent: 1.5, restitution: 0.6 }.hertz_damped("exact");
    let damping = "damping = { dashpots = [2e5, 2e5, 2e5] }\n";
    let stiffness = [6e7, 5e7, 4e7];
    let own: Vec<f64> = soft.iter().zip(stiffness).map(|(share, k)| share * k).collect();
    let (inside, record) = shaken(frames("floor_forces", &format!("stiffness = {own:?}\n{damping}"), &law));
    let (outside, _) = shaken(frames("restoring_corrections", &format!("stiffness = {stiffness:?}\n{damping}"), &law));
    let mut truth = Run::new(&inside, Some(&record));
    truth.to(3.0);
    let errors = [256.0_f64, 512.0, 1024.0].map(|rate| {
        let mut run = Run::new(&outside, Some(&record));
        let mut before = [0.0; 3];
        let steps = (3.0 * rate) as usize;
        for k in 0..steps {
            run.model.observe(&run.state, &mut run.point);
            for i in 0..3 {
                let correction = (1.0 - soft[i]) * stiffness[i] * run.drift(LEFT, i);
                run.state.set_input(Input::Correction(LEFT, i), correction);
                run.state.set_input_rate(Input::Correction(LEFT, i), (correction - before[i]) * rate);
                before[i] = correction;
            }
            run.go((k + 1) as f64 / rate);
        }
        run.to(3.0);
        assert!(run.energy().residual.abs() < 1e-12, "{:?}", run.energy());
        let now = |run: &Run| {
            let shear = [Output::BaseShear(LEFT), Output::Peak(PeakOf::BaseShear(LEFT))].map(|of| run.read(of) / 1e6);
            let energy = run.energy();
            let taken_up = (energy.strain + energy.correction) / 1e4;
            [shear[0], shear[1], 100.0 * run.displacement(LEFT, 2), taken_up]
        };
        let (got, exact) = (now(&run), now(&truth));
        assert_eq!(run.episodes.len(), truth.episodes.len());
        got.into_iter().zip(exact).map(|(got, exact)| (got - exact).abs()).collect::<Vec<_>>()
    });
    let [coarse, fine, finest] = errors;
    for (i, ((coarse, fine), finest)) in coarse.into_iter().zip(fine).zip(finest).enumerate() {
        assert!(finest < 0.1 * coarse && fine < 0.4 * coarse && finest < 2e-3, "{i}: {coarse:e} {fine:e} {finest:e}");
    }
}

/// Nothing but the building itself holds the forces: a foundation stays where it is.
#[test]
fn the_foundation_is_pushed_as_much_as_the_floor() {
    let (k, h, m0, s) = (4e7, 6.0, 6e4, 1e5);
    let mut scene = scene(&format!(
        "name = \"One\"\n[inputs]\nrestoring_corrections = true\n[left]\nmass = [1.8e5]\nheight = [{h:?}]\n\
         stiffness = [{k:?}]\ndamping = {{ ratio = 0.1 }}\n[left.foundation]\nmass = {m0:?}\ninertia = 9e5\n\
         sway = {{ stiffness = 1.2e8, dashpot = 3e6 }}\nrocking = {{ stiffness = 2.4e9, dashpot = 6e7 }}\n"
    ));
    scene.energy = true;
    let mut run = Run::new(&scene, None);
    let correction = Input::Correction(LEFT, 0);
    let foundation = |run: &Run, of| run.read(Output::Foundation(LEFT, of));
    run.to(0.0);
    let mut response = Response::default();
    run.now().respond([(correction, s)], &mut response);
    for (of, expected) in [
        (Output::Acceleration(LEFT, 0), s / 1.8e5),
        (Output::Foundation(LEFT, F::Acceleration), -s / m0),
        (Output::BaseShear(LEFT), -s),
        (Output::OfYielding(YieldingOf::Shear, LEFT, 0), -s),
    ] {
        assert_close(run.model.response_of(&response, of), expected, 1e-15, &format!("{of:?} at once"));
    }
    run.state.set_input(correction, s);
    run.model.observe(&run.state, &mut run.point);
    assert_close(foundation(&run, F::Acceleration), -s / m0, 1e-14, "pushed back");
    run.in_steps(0.013, 0.4);
    // The springs and dashpots of the soil are all that acts on the whole from outside.
    let pushed = 1.8e5 * run.read(Output::Acceleration(LEFT, 0)) + m0 * foundation(&run, F::Acceleration);
    assert_close(pushed, -foundation(&run, F::Force), 1e-11, "momentum");
    assert!(run.energy().residual.abs() < 1e-12 && run.energy().kinetic > 1.0, "{:?}", run.energy());
    run.to(200.0);
    assert_close(run.displacement(LEFT, 0), s / k, 1e-12, "drift at rest");
    for of in [F::Force, F::Moment] {
        assert!(foundation(&run, of).abs() < 1e-9 * s, "{of:?}");
    }
    assert!(run.read(Output::BaseShear(LEFT)).abs() < 1e-9 * s);
    assert!(run.peak(PeakOf::BaseShear(LEFT)) > 0.99 * s, "at once all of it");
}

/// The spring of the storey yields by its own drift, whatever is beside it.
#[test]
fn beside_a_storey_that_yields_a_correction_is_one_more_spring() {
    let (m, k, v_y, s) = (5e4_f64, 6e7, 3e5, 2e5);
    let scene = scene(&format!(
        "name = \"One\"\n[inputs]\nrestoring_corrections = true\n[outputs]\nenergy = true\n[left]\nmass = [{m:?}]\n\
         stiffness = [{k:?}]\ndamping = {{ ratio = 0.0 }}\nyield_force = [{v_y:?}]\n"
    ));
    for step in [0.001, 0.05] {
        let mut run = Run::new(&scene, None);
        run.state.set_input(Input::Correction(LEFT, 0), s);
        run.in_steps(step, 0.1);
        // It swings about s / k while it is elastic, and yields at V_y / k with the speed that s has given it.
        let (limit, w) = (v_y / k, (k / m).sqrt());
        let t = (1.0 - limit * k / s).acos() / w;
        let (speed, slowing) = ((2.0 * s * limit - k * limit * limit).max(0.0), v_y - s);
        let (speed, a) = ((speed / m).sqrt(), slowing / m);
        assert!(t < 0.1 && speed > a * (0.1 - t), "it still yields");
        let after = 0.1 - t;
        let plastic = speed * after - 0.5 * a * after * after;
        assert_close(run.displacement(LEFT, 0), limit + plastic, 1e-12, "displacement");
        assert_close(shear(&run, 0), v_y - s, 1e-12, "shear");
        assert_close(run.read(Output::BaseShear(LEFT)), v_y - s, 1e-10, "base shear");
        assert_close(run.storey(LEFT, 0).hysteretic, v_y * plastic, 1e-12, "what the spring has taken up");
        assert_close(run.energy().correction, -s * (limit + plastic), 1e-12, "what the correction has");
        assert_close(run.read(Output::OfStorey(StoreyPeak::Shear, LEFT, 0)), s, 1e-13, "as it was set");
        assert!(run.energy().residual.abs() < 1e-12);
    }
}
