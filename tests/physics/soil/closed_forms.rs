//! Frequencies, static displacements and positions of rest on soil, in closed form; the balance of moments at any time.

use super::{foundation, frame, run_for};
use crate::common::{Run, assert_close, press, scene};
use pounding::engine::{BuildingId, EnergyOutput, FoundationOutput as F, Model, Output, PeakOf, PointRates};
use pounding::scene::Scene;
use std::f64::consts::PI;

/// kg, N/m, m, and of the foundation kg and N/m.
pub const ONE: (f64, f64, f64, f64, f64) = (1.8e5, 4e7, 6.0, 6e4, 1.2e8);

pub fn one_storey(mass: f64, inertia: f64, rocking: Option<f64>) -> Scene {
    let (m, k, h, _, kh) = ONE;
    let rocking =
        rocking.map_or(String::new(), |kr| format!("inertia = {inertia:?}\nrocking = {{ stiffness = {kr:?} }}\n"));
    scene(&format!(
        "name = \"One\"\n[left]\nmass = [{m:?}]\nheight = [{h:?}]\nstiffness = [{k:?}]\ndamping = {{ ratio = 0.0 }}\n\
         [left.foundation]\nmass = {mass:?}\nsway = {{ stiffness = {kh:?} }}\n{rocking}"
    ))
}

/// Up to the stiffest soil that a scene may have.
#[test]
fn frequencies_of_one_storey_that_sways() {
    let (m, k, _, m0, usual) = ONE;
    for kh in [usual, 1e12 * k] {
        let mut scene = one_storey(m0, 0.0, None);
        scene.buildings[0].foundation.as_mut().unwrap().sway.as_mut().unwrap().stiffness = kh;
        assert!(scene.check().is_ok());
        let model = Model::new(&scene, None).unwrap();
        let a = k / m + (k + kh) / m0;
        let root = (a * a - 4.0 * k * kh / (m * m0)).sqrt();
        let exact = [2.0 * k * kh / (m * m0) / (a + root), 0.5 * (a + root)].map(|w2| w2.sqrt() / (2.0 * PI));
        for (got, exact) in model.system_frequencies().iter().zip(exact) {
            assert!((got / exact - 1.0).abs() < 1e-15, "{got} Hz not {exact}");
        }
        // The building alone is that on a fixed base.
        assert!((model.natural_frequencies(BuildingId::LEFT)[0] / ((k / m).sqrt() / (2.0 * PI)) - 1.0).abs() < 1e-15);
    }
}

#[test]
fn light_foundations_lengthen_the_period_as_springs_in_a_row_do() {
    let (_, k, h, _, kh) = ONE;
    let kr = 2.4e9;
    let exact = (1.0 + k / kh + k * h * h / kr).sqrt();
    for share in [1e-6, 1e-9] {
        let scene = one_storey(ONE.0 * share, ONE.0 * 36.0 * share, Some(kr));
        let ratio = pounding::structure::period_ratio(&scene.buildings[0]);
        // A limit: the difference is that of the foundation's mass.
        assert!((ratio / exact - 1.0).abs() < 0.5 * share + 1e-14, "{ratio} not {exact}");
        assert!(share < 1e-7 || (ratio / exact - 1.0).abs() > 0.01 * share);
    }
}

#[test]
fn a_force_that_stays_bends_storey_and_soil() {
    let (_, k, h, _, kh) = ONE;
    let kr = 2.4e9;
    let mut scene = one_storey(6e4, 9e5, Some(kr));
    let soil = scene.buildings[0].foundation.as_mut().unwrap();
    soil.sway.as_mut().unwrap().dashpot = 3e6;
    soil.rocking.as_mut().unwrap().dashpot = 6e7;
    scene.floor_forces = true;
    let mut run = Run::new(&scene, None);
    let force = 1e5;
    run.state.set_floor_force(BuildingId::LEFT, 0, force);
    run.to(200.0);
    let exact = force * (1.0 / k + 1.0 / kh + h * h / kr);
    let near = |got: f64, exact: f64| assert!((got / exact - 1.0).abs() < 1e-12, "{got:e} not {exact:e}");
    near(run.displacement(BuildingId::LEFT, 0), exact);
    for (of, exact) in
        [(F::Displacement, force / kh), (F::Rotation, force * h / kr), (F::Force, force), (F::Moment, force * h)]
    {
        near(run.read(Output::Foundation(BuildingId::LEFT, of)), exact);
    }
    near(run.read(Output::BaseShear(BuildingId::LEFT)), force);
}

#[test]
fn soil_as_stiff_as_rock_is_a_fixed_base() {
    let fixed = run_for(&frame("damping = { ratio = 0.0 }\n", ""), 5.0);
    let rock = foundation("sway = { stiffness = 9e16 }\ninertia = 3e5\nrocking = { stiffness = 1.2e18 }\n");
    let stiff = run_for(&frame("damping = { ratio = 0.0 }\n", &rock), 5.0);
    let peak = fixed.peak(PeakOf::Displacement(BuildingId::LEFT, 1));
    for floor in 0..2 {
        let [fixed, stiff] = [&fixed, &stiff].map(|run| run.displacement(BuildingId::LEFT, floor));
        assert!((fixed - stiff).abs() < 1e-8 * peak, "{fixed:e} and {stiff:e}");
    }
}

const SOIL: &str = "sway = { stiffness = 9e7, dashpot = 1.5e6 }\ninertia = 3e5\n\
                    rocking = { stiffness = 1.2e9, dashpot = 4e6 }\n";
const YIELDING: &str =
    "yield_force = [9e4, 6e4]\npost_yield_ratio = [0.05, 0.0]\ndamping = { dashpots = [2e5, 1e5] }\n";

#[test]
fn storeys_that_have_yielded_rest_where_soil_and_gravity_hold_them() {
    for gravity in [false, true] {
        let keys = if gravity { YIELDING.to_owned() + "p_delta = true\n" } else { YIELDING.to_owned() };
        let scene = frame(&keys, &foundation(SOIL));
        let run = run_for(&scene, 200.0);
        let (heights, g) = ([4.0, 3.0], scene.buildings[0].gravity_stiffness());
        let of = |i: usize| {
            let k = scene.buildings[0].stiffness.of_storey(i).unwrap();
            let (theta, p) = (g[i] / k, run.storey(BuildingId::LEFT, i).plastic);
            (theta, g[i] * heights[i], (1.0 - [0.05, 0.0][i]) / (1.0 - theta) * p)
        };
        let sums =
            (0..2).map(|i| (of(i), heights[i])).fold((0.0, 0.0), |(lost, moment), ((theta, weight, kept), h)| {
                (lost + weight * h / (1.0 - theta), moment + weight * kept)
            });
        let rotation = sums.1 / (1.2e9 - sums.0);
        assert!(gravity == (rotation != 0.0));
        let at = |of| run.read(Output::Foundation(BuildingId::LEFT, of));
        let size = of(0).2.abs().max(of(1).2.abs());
        assert!(size > 1e-3, "{size} m");
        assert!((at(F::Rotation) - rotation).abs() < 1e-12 * size && at(F::Displacement).abs() < 1e-12 * size);
        for (i, height) in heights.into_iter().enumerate() {
            let (theta, _, kept) = of(i);
            let exact = kept + theta / (1.0 - theta) * height * rotation;
            let residual = run.storey(BuildingId::LEFT, i).residual;
            assert!((residual - exact).abs() < 1e-13 * size, "{residual:e} not {exact:e}");
            let below = if i == 0 { at(F::Displacement) } else { run.displacement(BuildingId::LEFT, i - 1) };
            let drift = run.displacement(BuildingId::LEFT, i) - below - height * at(F::Rotation);
            assert!((drift - exact).abs() < 1e-12 * size, "{drift:e} not {exact:e}");
        }
    }
}

/// Energy of the weights, -1/2 sum of g lean^2, and its rate.
fn rates_of_gravity(scene: &Scene, run: &Run) -> [f64; 2] {
    let at = |of| run.read(Output::Foundation(BuildingId::LEFT, of));
    let u = [at(F::Displacement), run.displacement(BuildingId::LEFT, 0), run.displacement(BuildingId::LEFT, 1)];
    let v = [at(F::Velocity), run.velocity(BuildingId::LEFT, 0), run.velocity(BuildingId::LEFT, 1)];
    scene.buildings[0].gravity_stiffness().iter().enumerate().fold([0.0; 2], |[energy, rate], (i, g)| {
        let (lean, speed) = (u[i + 1] - u[i], v[i + 1] - v[i]);
        [energy - 0.5 * g * lean * lean, rate - g * lean * speed]
    })
}

#[test]
fn the_soil_carries_the_overturning_moment_and_the_base_shear_at_any_time() {
    let keys = YIELDING.to_owned() + "p_delta = true\n";
    let scene = frame(&keys, &foundation(SOIL));
    let mut run = Run::new(&scene, Some(&super::shaking()));
    let (mut worst, mut largest) = ([0.0_f64; 4], [0.0_f64; 4]);
    let mut rates = PointRates::default();
    for k in 1..400 {
        run.to(0.0123 * f64::from(k));
        run.now().differentiate(&mut rates);
        let at = |of| run.read(Output::Foundation(BuildingId::LEFT, of));
        let rate = |of| run.now().rates(&rates, Output::Foundation(BuildingId::LEFT, of))[0];
        let (spin, below) = (at(F::RotationRate), [at(F::Velocity), run.velocity(BuildingId::LEFT, 0)]);
        let shear = |i: usize| {
            let drift_rate = run.velocity(BuildingId::LEFT, i) - below[i] - [4.0, 3.0][i] * spin;
            run.storey(BuildingId::LEFT, i).shear + [2e5, 1e5][i] * drift_rate
        };
        let overturning = 4.0 * shear(0) + 3.0 * shear(1);
        let moment = at(F::Moment) + 3e5 * rate(F::RotationRate);
        let force = at(F::Force) + 3e4 * at(F::Acceleration);
        let base = run.read(Output::BaseShear(BuildingId::LEFT));
        let gravity = rates_of_gravity(&scene, &run);
        let of_gravity = Output::Energy(EnergyOutput::Gravity);
        let power = run.now().rates(&rates, of_gravity)[0];
        let all = [(moment, overturning), (force, base), (run.read(of_gravity), gravity[0]), (power, gravity[1])];
        for (i, (one, other)) in all.into_iter().enumerate() {
            worst[i] = worst[i].max((one - other).abs());
            largest[i] = largest[i].max(one.abs());
        }
    }
    assert!(worst.iter().zip(largest).all(|(worst, largest)| *worst < 1e-12 * largest), "{worst:?} of {largest:?}");
    assert!(run.storey(BuildingId::LEFT, 0).plastic != 0.0);
}

/// Damping of storey and soil in proportion to their stiffness, so that the first mode is critically damped: both of its rates
/// are one, and no complex modes tell them apart.
#[test]
fn critical_damping_exactly() {
    let (m, k, _, m0, kh) = ONE;
    let a = k / m + (k + kh) / m0;
    let root = (a * a - 4.0 * k * kh / (m * m0)).sqrt();
    let w = [2.0 * k * kh / (m * m0) / (a + root), 0.5 * (a + root)].map(f64::sqrt);
    let share = 2.0 / w[0];
    let scene = scene(&format!(
        "name = \"Critical\"\n[left]\nmass = [{m:?}]\nheight = [6.0]\nstiffness = [{k:?}]\n\
         initial_displacement = [0.02]\ndamping = {{ dashpots = [{:?}] }}\n\
         [left.foundation]\nmass = {m0:?}\nsway = {{ stiffness = {kh:?}, dashpot = {:?} }}\n",
        share * k,
        share * kh
    ));
    let mut run = Run::new(&scene, None);
    for i in 1..100 {
        let t = 0.01 * f64::from(i);
        run.to(t);
        let mut exact = [0.0; 2];
        for (j, w) in w.into_iter().enumerate() {
            // Over (u_0, u_1), from k u_0 = (k - m w^2) u_1.
            let shape = [1.0 - m * w * w / k, 1.0];
            let start = 0.02 * m / (m0 * shape[0] * shape[0] + m);
            let course = match j {
                0 => (1.0 + w * t) * (-w * t).exp(),
                _ => {
                    let c = 0.5 * share * w * w;
                    let s = (c * c - w * w).sqrt();
                    ((c + s) * (-(c - s) * t).exp() - (c - s) * (-(c + s) * t).exp()) / (2.0 * s)
                }
            };
            (0..2).for_each(|i| exact[i] += shape[i] * start * course);
        }
        let got =
            [run.read(Output::Foundation(BuildingId::LEFT, F::Displacement)), run.displacement(BuildingId::LEFT, 0)];
        for (got, exact) in got.into_iter().zip(exact) {
            assert!((got - exact).abs() < 1e-14, "{got:e} m instead of {exact:e} at {t} s");
        }
    }
}

/// Two buildings on soil pressed together: rigid floors stay together while both rock, and at last the contact carries what
/// springs in a row leave to it.
#[test]
fn floors_that_are_held_together_while_both_rock() {
    let side = |name: &str, stiffness: f64, sway: f64, rocking: f64| {
        format!(
            "[{name}]\nmass = [2e5]\nheight = [5.0]\nstiffness = [{stiffness:?}]\ndamping = {{ ratio = 0.05 }}\n\
             [{name}.foundation]\nmass = 8e4\ninertia = 2e6\nsway = {{ stiffness = {sway:?}, dashpot = 2e6 }}\n\
             rocking = {{ stiffness = {rocking:?}, dashpot = 1e8 }}\n"
        )
    };
    let (left, right) = ((3e7, 2e8, 2e9), (5e7, 1e8, 3e9));
    let contact =
        "[[contact]]\nleft_floor = 1\nright_floor = 1\ngap = 0.01\nlaw = \"stereomechanical\"\nrestitution = 0.4\n";
    let mut held = scene(&format!(
        "name = \"Held\"\n{}{}{contact}",
        side("left", left.0, left.1, left.2),
        side("right", right.0, right.1, right.2)
    ));
    held.floor_forces = true;
    let mut run = Run::new(&held, None);
    press(&mut run, 4e5);
    let mut rotations = [0.0_f64; 2];
    for k in 1..200 {
        run.to(0.02 * f64::from(k));
        if run.contact(0).active {
            let apart = run.displacement(BuildingId::LEFT, 0) - run.displacement(BuildingId::RIGHT, 0) - 0.01;
            assert!(apart.abs() < 1e-15, "{apart:e} m");
            let rates =
                [BuildingId::LEFT, BuildingId::RIGHT].map(|side| run.read(Output::Foundation(side, F::RotationRate)));
            rotations.iter_mut().zip(rates).for_each(|(most, rate)| *most = most.max(rate.abs()));
        }
    }
    assert!(rotations.iter().all(|rate| *rate > 1e-5), "{rotations:?} rad/s while held");
    run.to(120.0);
    let [one, other] = [left, right].map(|(k, kh, kr)| 1.0 / k + 1.0 / kh + 25.0 / kr);
    assert_close(run.contact(0).force, 4e5 - 0.01 / (one + other), 1e-12, "reaction");
}
