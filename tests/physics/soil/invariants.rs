//! Whether the foundation that sways is called a floor does not matter. And what must hold at any time: peaks are those of all
//! that is read, energies add up, heavy dashpots let a foundation creep.

use super::{foundation, frame, shaking};
use crate::common::{Run, record, scene};
use crate::piecewise::assert_same_motion;
use pounding::engine::{BuildingId, EnergyOutput, FoundationOutput as F, Output, PeakOf, PointRates};
use pounding::scene::Scene;

const LEFT: &str = "height = [4.0, 3.0]\nmass = [4e4, 3e4]\nstiffness = [3e7, 2e7]\ndamping = { dashpots = [2e5, 1e5] }\n\
                    yield_force = [9e4, 6e4]\npost_yield_ratio = [0.05, 0.0]\np_delta = true\n[left.foundation]\nmass = 3e4\n\
                    sway = { stiffness = 9e7, dashpot = 1.5e6 }\n";
const RIGHT: &str = "[right]\nmass = [5e4]\nheight = [3.0]\nstiffness = [6e7]\ndamping = { dashpots = [3e5] }\n";
/// The left building with its foundation as a floor more.
const TALLER: &str = "height = [1.0, 4.0, 3.0]\nmass = [3e4, 4e4, 3e4]\nstiffness = [9e7, 3e7, 2e7]\n\
                      damping = { dashpots = [1.5e6, 2e5, 1e5] }\nyield_force = [inf, 9e4, 6e4]\n\
                      post_yield_ratio = [0.0, 0.05, 0.0]\np_delta = [false, true, true]\n";

fn both(left: &str, more: &str) -> Scene {
    let mut scene = scene(&format!("name = \"Both\"\noutputs = {{ energy = true }}\n[left]\n{left}{RIGHT}{more}"));
    scene.ground.record = Some("motion.csv".into());
    scene
}

/// Floor and storey of the left building by number, with what is between the foundation and the floors on the right.
fn between(up: usize, law: &str) -> String {
    let (floor, storey) = (1 + up, 1 + up);
    format!(
        "[[contact]]\nleft_floor = {floor}\nright_floor = 1\ngap = 0.006\n{law}\n\
         [[contact]]\nleft_storey = {storey}\nleft_position = 0.6\nright_floor = 1\ngap = 0.004\n{law}\n\
         [[link]]\nleft_floor = {up}\nright_floor = 1\nstiffness = 3e6\ndashpot = 1e5\n"
    )
}

const LINEAR: &str = "law = \"kelvin_voigt\"\nstiffness = 5e7\nrestitution = 0.6";
const HERTZ: &str = "law = \"hertz_damped\"\nstiffness = 8e8\nrestitution = 0.6\ndamping_formula = \"exact\"";
const RIGID: &str = "law = \"stereomechanical\"\nrestitution = 0.5";

/// Outputs of the building on soil and of the taller one that must agree.
fn pairs() -> Vec<(Output, Output)> {
    let (left, right) = (BuildingId::LEFT, BuildingId::RIGHT);
    let mut pairs = vec![
        (Output::Foundation(left, F::Displacement), Output::Displacement(left, 0)),
        (Output::Foundation(left, F::Velocity), Output::Velocity(left, 0)),
        (Output::Foundation(left, F::Acceleration), Output::Acceleration(left, 0)),
        (Output::Foundation(left, F::PeakDisplacement), Output::Peak(PeakOf::Displacement(left, 0))),
        (Output::Foundation(left, F::Force), Output::BaseShear(left)),
        (Output::Foundation(left, F::PeakForce), Output::Peak(PeakOf::BaseShear(left))),
        (Output::Displacement(right, 0), Output::Displacement(right, 0)),
        (Output::Peak(PeakOf::BaseShear(right)), Output::Peak(PeakOf::BaseShear(right))),
        (Output::Peak(PeakOf::LinkForce(0)), Output::Peak(PeakOf::LinkForce(0))),
    ];
    for i in 0..2 {
        let peaks: [fn(BuildingId, usize) -> PeakOf; 3] = [PeakOf::Displacement, PeakOf::Drift, PeakOf::Acceleration];
        pairs.extend(peaks.map(|of| (Output::Peak(of(left, i)), Output::Peak(of(left, i + 1)))));
        pairs.push((Output::Acceleration(left, i), Output::Acceleration(left, i + 1)));
        pairs.push((Output::Velocity(left, i), Output::Velocity(left, i + 1)));
    }
    use EnergyOutput as E;
    pairs.extend(
        [E::Strain, E::Viscous, E::Gravity, E::Hysteretic, E::Impact]
            .map(|of| (Output::Energy(of), Output::Energy(of))),
    );
    pairs
}

#[test]
fn a_foundation_that_sways_is_one_more_storey() {
    for (law, tolerance) in [(LINEAR, 1e-11), (HERTZ, 1e-10), (RIGID, 1e-10)] {
        let scenes = [both(LEFT, &between(0, law)), both(TALLER, &between(1, law))];
        let mut runs = scenes.map(|scene| Run::new(&scene, Some(&shaking())));
        let mut rates = [PointRates::default(), PointRates::default()];
        let pairs = pairs();
        let mut seen = vec![[0.0_f64; 4]; pairs.len()];
        for k in 1..=100 {
            let time = 0.03 * f64::from(k);
            runs.iter_mut().for_each(|run| _ = run.to(time));
            runs.iter().zip(&mut rates).for_each(|(run, rates)| run.now().differentiate(rates));
            for ((one, other), [apart, largest, rates_apart, fastest]) in pairs.iter().zip(&mut seen) {
                let values = [runs[0].read(*one), runs[1].read(*other)];
                *apart = apart.max((values[0] - values[1]).abs());
                *largest = largest.max(values[1].abs());
                let of = [runs[0].now().rates(&rates[0], *one)[0], runs[1].now().rates(&rates[1], *other)[0]];
                *rates_apart = rates_apart.max((of[0] - of[1]).abs());
                *fastest = fastest.max(of[1].abs());
            }
        }
        for ((one, other), [apart, largest, rates_apart, fastest]) in pairs.iter().zip(&seen) {
            assert!(*apart <= tolerance * largest, "{law}: {one:?} and {other:?} differ by {:e}", apart / largest);
            assert!(*rates_apart <= 10.0 * tolerance * fastest, "{law}: rates of {one:?}: {:e}", rates_apart / fastest);
        }
        assert!(runs[0].episodes.len() > 2 && runs[0].episodes.len() == runs[1].episodes.len());
        assert!(runs[0].storey(BuildingId::LEFT, 0).cumulative > 0.0);
        assert!(runs[0].energy().residual.abs() < 1e-12, "{:?}", runs[0].energy());
    }
}

/// Both motions of the left foundation, the right building on a fixed base, which hits columns.
fn rocking() -> Scene {
    let left = LEFT
        .replace("mass = 3e4\nsway", "mass = 3e4\ninertia = 3e5\nrocking = { stiffness = 1.2e9, dashpot = 4e6 }\nsway");
    both(&left, &between(0, HERTZ))
}

#[test]
fn peaks_of_foundations_and_drifts_are_those_of_all_that_is_read() {
    let scene = rocking();
    let mut run = Run::new(&scene, Some(&shaking()));
    let (h, mut largest) = ([4.0, 3.0], [0.0_f64; 6]);
    for k in 1..=30_000 {
        run.to(1e-4 * f64::from(k));
        let at = |of| run.read(Output::Foundation(BuildingId::LEFT, of));
        let [u0, phi] = [F::Displacement, F::Rotation].map(at);
        let u = [0, 1].map(|i| run.displacement(BuildingId::LEFT, i));
        let now = [u0, phi, at(F::Force), at(F::Moment), u[0] - u0 - h[0] * phi, u[1] - u[0] - h[1] * phi];
        largest.iter_mut().zip(now).for_each(|(largest, now)| *largest = largest.max(now.abs()));
    }
    let at = |of| run.read(Output::Foundation(BuildingId::LEFT, of));
    let drifts = [0, 1].map(|i| run.peak(PeakOf::Drift(BuildingId::LEFT, i)));
    let peaks =
        [at(F::PeakDisplacement), at(F::PeakRotation), at(F::PeakForce), at(F::PeakMoment), drifts[0], drifts[1]];
    for (i, (peak, read)) in peaks.into_iter().zip(largest).enumerate() {
        assert!(peak >= read * (1.0 - 1e-13) && peak <= read * (1.0 + 3e-5), "{i}: {peak:e}, read {read:e}");
    }
}

#[test]
fn the_soil_dissipates_all_that_the_building_does_not() {
    let scene = frame(
        "damping = { ratio = 0.0 }\n",
        &foundation(
            "sway = { stiffness = 9e7, dashpot = 1.5e6 }\ninertia = 3e5\nrocking = { stiffness = 1.2e9, dashpot = 4e6 }\n",
        ),
    );
    let mut run = Run::new(&scene, Some(&shaking()));
    let mut rates = PointRates::default();
    for k in 1..=50 {
        run.to(0.1 * f64::from(k));
        let energy = run.energy();
        assert!((energy.soil - energy.viscous).abs() <= 1e-12 * energy.viscous, "{energy:?}");
        assert!(energy.residual.abs() < 1e-12, "{energy:?}");
        run.now().differentiate(&mut rates);
        let [soil, viscous] =
            [EnergyOutput::Soil, EnergyOutput::Viscous].map(|of| run.now().rates(&rates, Output::Energy(of)));
        let at = |of| run.read(Output::Foundation(BuildingId::LEFT, of));
        let power = 1.5e6 * at(F::Velocity).powi(2) + 4e6 * at(F::RotationRate).powi(2);
        assert!(
            (soil[0] - power).abs() <= 1e-12 * power && (viscous[0] - power).abs() <= 1e-11 * power,
            "{soil:?} {power:e}"
        );
    }
    assert!(run.energy().soil > 1e3);
}

#[test]
fn dashpots_so_heavy_that_modes_of_the_whole_are_overdamped() {
    for factor in [20.0, 400.0] {
        let (c, r) = (1.5e6 * factor, 4e6 * factor);
        let soil = format!(
            "sway = {{ stiffness = 9e7, dashpot = {c:?} }}\ninertia = 3e5\nrocking = {{ stiffness = 1.2e9, dashpot = {r:?} }}\n"
        );
        let scene = frame("damping = { dashpots = [2e5, 1e5] }\n", &foundation(&soil));
        let times: Vec<f64> = (1..=40).map(|k| 0.13 * f64::from(k)).collect();
        assert_same_motion(&scene, &shaking(), &times, 1e-12);
    }
}

/// A dashpot beyond any soil, 1e8 1/s times the inertia, keeps the foundation from rocking: the building is one whose foundation
/// sways only. Peaks and energies within steps, which are long for such a dashpot, take a moment for all that.
#[test]
fn a_dashpot_that_keeps_the_foundation_from_rocking() {
    let run = |rocking: &str| {
        let sway = "sway = { stiffness = 9e7, dashpot = 1.5e6 }\n";
        let scene = frame("damping = { dashpots = [2e5, 1e5] }\n", &foundation(&format!("{sway}{rocking}")));
        Run::new(&scene, Some(&shaking()))
    };
    let mut held = run("");
    let mut rocking = run("inertia = 3e5\nrocking = { stiffness = 1.2e9, dashpot = 3e13 }\n");
    let peaks = |run: &Run| {
        let of_floors = [0, 1]
            .map(|i| [PeakOf::Displacement, PeakOf::Drift, PeakOf::Acceleration].map(|of| of(BuildingId::LEFT, i)));
        of_floors.concat().into_iter().map(|of| run.peak(of)).collect::<Vec<_>>()
    };
    for k in 1..=10 {
        // Also within samples.
        for run in [&mut held, &mut rocking] {
            run.to(0.0703 * f64::from(k));
        }
        for (expected, peak) in peaks(&held).into_iter().zip(peaks(&rocking)) {
            assert!((peak - expected).abs() <= 1e-5 * expected, "{k}: {peak} instead of {expected}");
        }
        let [expected, energy] = [held.energy(), rocking.energy()];
        for (got, expected) in [(energy.viscous, expected.viscous), (energy.input, expected.input)] {
            // A moment M of 1 MN m loses M^2 / c, some hundredths of a watt.
            assert!((got - expected).abs() <= 1e-4 * expected.abs(), "{k}: {got} J instead of {expected}");
        }
        assert!(energy.residual.abs() < 1e-9, "{k}: {energy:?}");
    }
    assert!(rocking.state.counters().energy_steps < 1000, "{:?}", rocking.state.counters());
}

/// Floors that touch at rest, one contact under a power law and one rigid, move together at first but for rounding. What the
/// foundation's heavy dashpot leaves of their relative acceleration once said that they meet again after 4e-39 s.
#[test]
fn floors_that_touch_at_rest_part_although_rounding_says_that_they_meet_again() {
    let mut scene = scene(
        "name = \"Touching\"\noutputs = { energy = true }\n\
         [left]\nheight = [3, 3]\nmass = [1300, 1900]\nstiffness = [3.85e6, 4.8e6]\ndamping = { ratio = 0.0 }\n\
         [right]\nheight = [3, 3, 3]\nmass = [2695.8876058849983, 3990, 3283.976588546702]\n\
         stiffness = [17732121.88368963, 15840000, 21601094.82730284]\ndamping = { ratio = 0.0567 }\n\
         [right.foundation]\nmass = 14049.5\nsway = { stiffness = 1.7e9, dashpot = 1438 }\n\
         inertia = 42148.49689351252\nrocking = { stiffness = 2.64e9, dashpot = 1.633e7 }\n\
         [[contact]]\nleft_floor = 1\nright_floor = 1\ngap = 0\nlaw = \"jankowski\"\nstiffness = 9.7e7\n\
         restitution = 0.57\n\
         [[contact]]\nleft_floor = 2\nright_floor = 2\ngap = 0\nlaw = \"stereomechanical\"\nrestitution = 0.63\n",
    );
    scene.ground.record = Some("motion.csv".into());
    let t = |k: i32| f64::from(k) * 0.02;
    let ground: Vec<f64> = (0..=100).map(|k| 4.0 * (9.0 * t(k)).sin() + 2.0 * (31.0 * t(k)).sin()).collect();
    let mut run = Run::new(&scene, Some(&record(0.02, &ground)));
    run.to(2.0);
    assert!(run.energy().residual.abs() < 1e-12, "{:?}", run.energy());
    assert!(run.episodes.len() > 20, "{}", run.episodes.len());
}
