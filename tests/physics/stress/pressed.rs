//! Contacts that are held: pressed for thousands of oscillations, grazed and then pressed on, pressed from rest.

use crate::common::problems::two_masses::{Mass, TwoMasses};
use crate::common::{Run, assert_close, press, scene};
use pounding::engine::BuildingId;
use pounding::scene::Scene;
use std::f64::consts::PI;

/// kg, of both masses: a reduced mass of 500 kg.
const MASS: f64 = 1e3;

/// Two free masses with forces on their floors.
fn free_masses(speed: f64, gap: f64, law: &str) -> Scene {
    let masses = TwoMasses::new(Mass::free(MASS, speed), Mass::free(MASS, 0.0), gap, law);
    scene(&TwoMasses { floor_forces: true, ..masses }.toml())
}

/// An undamped spring of 5e8 N/m pressed with 1 MN from half of its equilibrium of 2 mm:
/// d = 2 mm - 1 mm cos(w t), w = sqrt(k / m) = 1000 rad/s, after 3000 oscillations still.
#[test]
fn a_linear_contact_swings_about_its_equilibrium_for_ever() {
    let mut run = Run::new(&free_masses(0.0, -1e-3, "law = \"linear\"\nstiffness = 5.0e8"), None);
    press(&mut run, 1e6);
    for k in 1..=20 {
        // A quarter past a whole number of oscillations and a bit, where position and velocity both count.
        let t = f64::from(k) + 0.000_3;
        run.to(t);
        let exact = 2e-3 - 1e-3 * (1000.0 * t).cos();
        // A phase of 2e4 rad has its rounding, and each of 1e5 steps may add a share of the tolerance.
        let error = (run.contact(0).penetration - exact).abs();
        assert!(error < 1e-3 * 1e-10, "t = {t}: {error:e}");
    }
    assert_eq!(run.point.impacts, 1);
    assert_close(run.model.open_episode(&run.state, 0).unwrap().peak_penetration, 3e-3, 1e-11, "peak");
    assert!(run.energy().residual.abs() < 1e-11, "{:?}", run.energy());
}

/// Pressed with F from the penetration d0 at rest, hertz swings between d0 and the d1 at which the spring has taken what
/// F has done: k (d1^(n+1) - d0^(n+1)) / (n + 1) = F (d1 - d0). Neither may move: an integrator that adds energy lets
/// the penetration grow, one that loses it settles.
#[test]
fn a_hertz_contact_swings_between_the_same_depths() {
    for n in [1.0, 1.3, 1.5, 1.7, 2.0, 3.0] {
        let force = 1e6;
        let equilibrium = 2e-3_f64;
        let k = force / equilibrium.powf(n);
        let d0 = 0.5 * equilibrium;
        let work = |d: f64| k * d.powf(n + 1.0) / (n + 1.0) - force * d;
        let (mut low, mut high) = (equilibrium, 4.0 * equilibrium);
        for _ in 0..200 {
            let middle = 0.5 * (low + high);
            if work(middle) < work(d0) { low = middle } else { high = middle }
        }
        let law = format!("law = \"hertz\"\nstiffness = {k:?}\nexponent = {n:?}");
        let mut run = Run::new(&free_masses(0.0, -d0, &law), None);
        press(&mut run, force);
        let mut peaks = Vec::new();
        for _ in 0..5 {
            run.to(run.state.time() + 1.0);
            peaks.push(run.model.open_episode(&run.state, 0).unwrap().peak_penetration);
        }
        assert_eq!(run.point.impacts, 1, "n = {n}: it never parts");
        let (first, last) = (peaks[0], peaks[4]);
        assert_close(first, low, 1e-11, &format!("n = {n}: the first second"));
        assert_close(last, low, 1e-11, &format!("n = {n}: 800 oscillations"));
        let energy = run.energy();
        assert!(energy.residual.abs() < 1e-11, "n = {n}: {energy:?}");
    }
}

/// A floor that arrives at 1 nm/s, or with no speed at all, and is then pressed on: with V as small as that
/// `hertz_damped` would have a dashpot without bound, but for `min_approach_velocity`; the other dashpots are stiff as
/// well. All must come to the equilibrium of the spring, k d^n = F, and pass on the whole impulse, in a bounded number
/// of steps.
#[test]
fn a_graze_that_is_pressed_on_comes_to_the_equilibrium_of_the_spring() {
    let (force, depth) = (500.0_f64, 1.9e-7_f64);
    let laws = [
        ("law = \"hertz_damped\"\nrestitution = 0.5\ndamping_formula = \"exact\"", 1.5),
        ("law = \"hertz_damped\"\nrestitution = 0.05\ndamping_formula = \"exact\"", 1.5),
        ("law = \"hertz_damped\"\nrestitution = 0.1\ndamping_formula = \"ye\"\nexponent = 2.0", 2.0),
        ("law = \"kelvin_voigt\"\nrestitution = 0.05", 1.0),
        ("law = \"kelvin_voigt_no_tension\"\nrestitution = 0.05", 1.0),
    ];
    for (law, n) in laws {
        let k = force / depth.powf(n);
        for speed in [0.0, 1e-12, 1e-9, 1e-5] {
            let mut run = Run::new(&free_masses(speed, 0.0, &format!("{law}\nstiffness = {k:?}")), None);
            press(&mut run, force);
            run.to(2.0);
            let what = format!("{law}, {speed:e} m/s");
            let contact = run.contact(0);
            assert!(contact.active, "{what}: {contact:?}");
            assert_close(contact.force, force, 1e-9, &format!("{what}: force"));
            assert_close(contact.penetration, depth, 1e-8, &format!("{what}: penetration"));
            // m (v_end - v_start) of the relative motion is what force and contact have done to it.
            let passed = force * 2.0 + 0.5 * MASS * speed;
            assert_close(contact.impulse, passed, 1e-9, &format!("{what}: impulse"));
            assert!(run.energy().residual.abs() < 1e-9, "{what}: {:?}", run.energy());
            let steps = run.state.counters().contact_steps();
            assert!(steps < 400_000, "{what}: {steps} steps");
        }
    }
}

/// Jankowski's dashpot acts on the way in only: pressed from rest the first approach is overdamped.
#[test]
fn jankowski_pressed_from_rest_settles() {
    let (force, k) = (500.0, 6e12);
    for e in [0.5, 0.1] {
        let law = format!("law = \"jankowski\"\nstiffness = {k:?}\nrestitution = {e:?}");
        let mut run = Run::new(&free_masses(0.0, 0.0, &law), None);
        press(&mut run, force);
        run.to(1.0);
        let contact = run.contact(0);
        assert_close(contact.force, force, 1e-6, &law);
        assert_close(contact.impulse, force, 1e-6, &law);
    }
}

/// Leaning: two frames whose floors overlap at rest by 2 cm. Under gravity-free rest nothing moves: the equilibrium is
/// that of three springs in a row, k_left u = F, k_right u = F, F = k (u_left - u_right - gap), and it stays so.
#[test]
fn leaning_frames_stay_where_the_springs_balance() {
    let (left, right, k, gap) = (3.46e6, 2.2e7, 1e8, -0.02_f64);
    let force: f64 = -gap / (1.0 / left + 1.0 / right + 1.0 / k);
    let (u_left, u_right) = (-force / left, force / right);
    let building = |mass: f64, stiffness: f64, u: f64| {
        format!(
            "mass = [{mass:?}]\nstiffness = [{stiffness:?}]\ndamping = {{ ratio = 0.0 }}\ninitial_displacement = [{u:?}]\n"
        )
    };
    for law in [
        format!("law = \"linear\"\nstiffness = {k:?}"),
        format!("law = \"kelvin_voigt\"\nstiffness = {k:?}\nrestitution = 0.3"),
        format!("law = \"hertz\"\nexponent = 1.5\nstiffness = {:?}", force / (force / k).powf(1.5)),
    ] {
        let mut run = Run::new(
            &scene(&format!(
                "name = \"Lean\"\n[left]\n{}[right]\n{}[outputs]\nenergy = true
                [[contact]]\nleft_floor = 1\nright_floor = 1\ngap = {gap:?}\n{law}",
                building(25e3, left, u_left),
                building(4e4, right, u_right)
            )),
            None,
        );
        for k in 1..=100 {
            run.to(10.0 * f64::from(k));
            let contact = run.contact(0);
            assert!(contact.active && contact.impacts == 1, "{law}: {contact:?}");
            assert!((contact.force / force - 1.0).abs() < 1e-12, "{law}: {} N instead of {force}", contact.force);
            let error = (run.displacement(BuildingId::LEFT, 0) / u_left - 1.0).abs();
            assert!(error < 1e-12, "{law}: {error:e} after {} s", 10 * k);
        }
        let period = 2.0 * PI / (left / 25e3_f64).sqrt();
        let steps = run.state.counters().contact_steps() as f64;
        assert!(steps < 60.0 * 1000.0 / period, "{law}: {steps} steps for {} periods", 1000.0 / period);
    }
}
