//! One free impact under each law, against its closed form.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod common;

use common::{FREE_MASS, Run, assert_close, free_impact};
use pounding::engine::{Episode, Side};
use std::f64::consts::PI;

fn impact(law: &str, speed: f64) -> Episode {
    let mut run = Run::new(&free_impact(law, speed), None);
    run.to(0.002 / speed).in_steps(0.05 / speed, 0.6 / speed + 3.0);
    assert_eq!(run.episodes.len(), 1, "one impact under {law} at {speed} m/s");
    let episode = run.episodes[0];
    assert_close(episode.start, 0.001 / speed, 1e-14, "entry");
    assert_close(episode.approach_velocity, speed, 1e-14, "approach velocity");
    assert_close(episode.impulse, FREE_MASS * (speed + episode.separation_velocity), 1e-12, "impulse = momentum");
    let momentum = 5e4 * run.velocity(Side::Left, 0) + 7.5e4 * run.velocity(Side::Right, 0);
    assert_close(momentum, 5e4 * speed, 1e-14, "momentum");
    let lost = 0.5 * FREE_MASS * (speed * speed - episode.separation_velocity * episode.separation_velocity);
    let energy = 0.5 * FREE_MASS * speed * speed;
    assert!((episode.dissipated_energy - lost).abs() < 1e-12 * energy, "{} and {lost}", episode.dissipated_energy);
    assert!(run.point.energy.unwrap().residual.abs() < 2e-13, "{:?}", run.point.energy);
    episode
}

#[test]
fn linear_is_a_half_sine() {
    for (stiffness, speed) in [(3e7, 0.5), (1e5, 10.0), (1e12, 1e-4), (1e12, 10.0)] {
        let e = impact(&format!("law = \"linear\"\nstiffness = {stiffness:?}"), speed);
        let omega = (stiffness / FREE_MASS).sqrt();
        assert_close(e.separation_velocity, speed, 1e-12, "restitution");
        assert_close(e.peak_force, speed * (stiffness * FREE_MASS).sqrt(), 1e-12, "peak force");
        assert_close(e.peak_penetration, speed / omega, 1e-12, "peak penetration");
        // Times since t = 0 carry the rounding of the time of entry.
        let rounding = 4.0 * f64::EPSILON * e.start * omega;
        assert_close((e.end.unwrap() - e.start) * omega, PI, 1e-12 + rounding, "half a period");
        assert_close((e.peak_time - e.start) * omega, PI / 2.0, 1e-6, "peak in the middle");
        assert_eq!(e.dissipated_energy, 0.0, "an elastic loop encloses nothing");
    }
}

#[test]
fn kelvin_voigt_returns_exactly_e() {
    for (e, stiffness, speed) in
        [(0.5, 3e7, 0.5), (0.1, 1e9, 2.0), (0.65, 1e12, 1e-3), (0.95, 1e6, 1e-4), (1.0, 3e7, 0.5)]
    {
        let episode = impact(&format!("law = \"kelvin_voigt\"\nstiffness = {stiffness:?}\nrestitution = {e:?}"), speed);
        assert_close(episode.separation_velocity / speed, e, 1e-12, "restitution");
        let xi = -e.ln() / (PI * PI + e.ln().powi(2)).sqrt();
        let rest = (1.0 - xi * xi).sqrt();
        // Largest at the entry itself for xi >= 1/2.
        let peak = if xi < 0.5 { (-xi / rest * (PI / 2.0 - 3.0 * xi.asin())).exp() } else { 2.0 * xi };
        assert_close(episode.peak_force, speed * (stiffness * FREE_MASS).sqrt() * peak, 1e-12, "peak force");
        let omega = (stiffness / FREE_MASS).sqrt() * rest;
        let deepest = speed / (stiffness / FREE_MASS).sqrt() * (-xi / rest * xi.acos()).exp();
        assert_close(episode.peak_penetration, deepest, 1e-12, "peak penetration");
        let rounding = 4.0 * f64::EPSILON * episode.start * omega;
        assert_close((episode.end.unwrap() - episode.start) * omega, PI, 1e-11 + rounding, "duration");
    }
}

#[test]
fn kelvin_voigt_without_tension_returns_more_than_e() {
    for (e, stiffness, speed) in [(0.5, 3e7, 0.5), (0.1, 1e9, 2.0), (0.65, 1e12, 1e-3), (0.95, 1e6, 1e-4)] {
        let law = format!("law = \"kelvin_voigt_no_tension\"\nstiffness = {stiffness:?}\nrestitution = {e:?}");
        let xi: f64 = -f64::ln(e) / (PI * PI + f64::ln(e).powi(2)).sqrt();
        let returned = (-2.0 * xi * xi.acos() / (1.0 - xi * xi).sqrt()).exp();
        assert_close(impact(&law, speed).separation_velocity / speed, returned, 1e-12, "restitution");
    }
    // The value of the paper's reading for e = 0.5, printed to 16 digits.
    let law = "law = \"kelvin_voigt_no_tension\"\nstiffness = 3.0e7\nrestitution = 0.5";
    assert_close(impact(law, 0.5).separation_velocity / 0.5, 0.550_283_169_627_115_7, 1e-12, "restitution");
}

#[test]
fn hertz_is_elastic_with_its_peak_where_energy_says() {
    for (n, stiffness, speed) in [
        (1.5, 3e7, 0.5),
        (1.5, 1e5, 10.0),
        (1.5, 1e12, 1e-4),
        (1.3, 3e7, 0.5),
        (2.0, 3e9, 0.5),
        (3.0, 1e12, 0.2),
        (1.0, 3e7, 0.5),
    ] {
        let e = impact(&format!("law = \"hertz\"\nstiffness = {stiffness:?}\nexponent = {n:?}"), speed);
        assert_close(e.separation_velocity, speed, 1e-12, "restitution");
        let deepest = (0.5 * (n + 1.0) * FREE_MASS * speed * speed / stiffness).powf(1.0 / (n + 1.0));
        assert_close(e.peak_penetration, deepest, 1e-12, "peak penetration");
        assert_close(e.peak_force, stiffness * deepest.powf(n), 1e-12, "peak force");
        assert_eq!(e.dissipated_energy, 0.0, "an elastic loop encloses nothing");
    }
    // k^0.4 (1.25 m V^2)^0.6: 236.609 kN in the paper's reference impact.
    let e = impact("law = \"hertz\"\nstiffness = 3.0e7\nexponent = 1.5", 0.5);
    assert!((e.peak_force - 236_609.0).abs() < 0.5, "{}", e.peak_force);
}

/// What F = k d^n (1 + a v / V) returns: a (1 + e) = ln[(1 + a) / (1 - a e)] (Gonthier 2004), solved by bisection.
fn returned(a: f64) -> f64 {
    let g = |e: f64| a * (1.0 + e) - ((1.0 + a) / (1.0 - a * e)).ln();
    let (mut low, mut high) = (0.0, 1.0_f64.min(1.0 / a));
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        // g is positive below the root: for e = 0 it is a - ln(1 + a).
        if g(middle) > 0.0 { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

/// Each formula for a with a(0.5) and the restitution that it achieves at 0.5, as printed in the paper's reading.
const FORMULAS: [(&str, f64, f64); 15] = [
    ("lankarani_nikravesh", 0.5625, 0.725_24),
    ("ye_printed", 0.5625, 0.725_24),
    ("ye", 1.6, 0.470_44),
    ("barros_khatami", 1.6, 0.470_44),
    ("barros_khatami_damper", 2.4, 0.362_87),
    ("exact", 1.432_750_533_271_38, 0.5),
    ("hunt_crossley", 0.75, 0.662_96),
    ("herbert_mcwhannell", 1.0, 0.593_62),
    ("lee_wang", 0.375, 0.799_20),
    ("gonthier", 1.5, 0.487_74),
    ("zhiying_qishao", 1.529, 0.482_61),
    ("gharib_hurmuzlu", 2.0, 0.410_72),
    ("hu_guo", 1.5, 0.487_74),
    ("safaeifar_farshidianfar", 1.25, 0.536_16),
    ("carvalho_martins", 1.431_82, 0.500_17),
];

#[test]
fn hertz_damped_returns_what_its_coefficient_says_for_any_exponent_stiffness_and_speed() {
    use pounding::contact::DampingFormula;
    assert_eq!(FORMULAS.len(), DampingFormula::ALL.len());
    for (name, a_at_half, achieved_at_half) in FORMULAS {
        let formula = DampingFormula::from_name(name).unwrap();
        assert!(
            (formula.coefficient(0.5) - a_at_half).abs() < 5e-4 * a_at_half,
            "{name}: {}",
            formula.coefficient(0.5)
        );
        assert!((returned(formula.coefficient(0.5)) - achieved_at_half).abs() < 6e-6, "{name}");
        for (e, n, stiffness, speed) in [
            (0.5, 1.5, 3e7, 0.5),
            (0.1, 1.0, 1e6, 0.1),
            (0.3, 1.3, 1e8, 2.0),
            (0.65, 1.5, 1e12, 1e-3),
            (0.8, 2.0, 3e9, 0.5),
            (0.9, 3.0, 1e12, 1.0),
            (1.0, 1.5, 3e7, 0.5),
        ] {
            let law = format!(
                "law = \"hertz_damped\"\nstiffness = {stiffness:?}\nexponent = {n:?}\nrestitution = {e:?}
                damping_formula = \"{name}\""
            );
            let a = formula.coefficient(e);
            let episode = impact(&law, speed);
            let achieved = if a == 0.0 { 1.0 } else { returned(a) };
            assert_close(episode.separation_velocity / speed, achieved, 1e-12, &format!("{law}\nrestitution"));
            let spring = stiffness * if name == "barros_khatami" { 1.5 } else { 1.0 };
            let lost = if a == 0.0 { 0.5 } else { (a - a.ln_1p()) / (a * a) };
            let deepest = ((n + 1.0) * FREE_MASS * speed * speed * lost / spring).powf(1.0 / (n + 1.0));
            assert_close(episode.peak_penetration, deepest, 1e-12, &format!("{law}\npeak penetration"));
            if name == "exact" {
                assert_close(episode.separation_velocity / speed, e, 1e-12, "exact is exact");
            }
        }
    }
}

#[test]
fn the_approach_velocity_that_damping_divides_by_has_a_floor() {
    // At a tenth of the floor of 1e-4 m/s the damping is a tenth: a' = a V / floor.
    let law = "law = \"hertz_damped\"\nstiffness = 3.0e7\nexponent = 1.5\nrestitution = 0.5\ndamping_formula = \"ye\"";
    assert_close(impact(law, 1e-5).separation_velocity / 1e-5, returned(0.16), 1e-12, "restitution");
    // A floor of the scene's own: from it on nothing changes, below it a' = a V / floor.
    let law = format!("{law}\n[solver]\nmin_approach_velocity = 0.02");
    for (speed, a) in [(0.5, 1.6), (0.02, 1.6), (0.019, 1.52), (0.005, 0.4), (1e-4, 0.008)] {
        assert_close(impact(&law, speed).separation_velocity / speed, returned(a), 1e-12, "restitution");
    }
    // Laws that do not divide by V know no floor.
    for law in ["kelvin_voigt", "jankowski"] {
        let law = format!("law = \"{law}\"\nstiffness = 3.0e7\nrestitution = 0.5");
        let with_floor = impact(&format!("{law}\n[solver]\nmin_approach_velocity = 0.02"), 0.005);
        assert_eq!(with_floor, impact(&law, 0.005));
    }
}

#[test]
fn jankowski_is_scale_free_and_returns_what_an_integration_says() {
    // Achieved restitution and reference impact, integrated with d = s^4 for the paper's reading.
    for (e, achieved) in
        [(0.1, 0.093_32), (0.3, 0.291_75), (0.5, 0.494_59), (0.65, 0.647_03), (0.8, 0.798_94), (0.9, 0.899_72)]
    {
        let law = |stiffness: f64| format!("law = \"jankowski\"\nstiffness = {stiffness:?}\nrestitution = {e:?}");
        let first = impact(&law(3e7), 0.5);
        assert!(
            (first.separation_velocity / 0.5 - achieved).abs() < 6e-6,
            "e = {e}: {}",
            first.separation_velocity / 0.5
        );
        for (stiffness, speed) in [(1e5, 1.0), (1e12, 1e-3), (1e10, 10.0)] {
            let other = impact(&law(stiffness), speed);
            assert_close(other.separation_velocity / speed, first.separation_velocity / 0.5, 1e-12, "scale");
        }
    }
    // The worst of its approximation from 0.05 to 0.95.
    let off = |e: f64| {
        let law = format!("law = \"jankowski\"\nstiffness = 3.0e7\nrestitution = {e:?}");
        (impact(&law, 0.5).separation_velocity / 0.5 - e).abs()
    };
    let worst = (5..=95).map(|percent| off(f64::from(percent) / 100.0)).fold(0.0, f64::max);
    assert!((worst - 0.0086).abs() < 0.5e-4, "{worst}");
    let e = impact("law = \"jankowski\"\nstiffness = 3.0e7\nrestitution = 0.5", 0.5);
    assert!((e.peak_force - 188_124.0).abs() < 0.6, "{}", e.peak_force);
    assert!((e.peak_penetration - 0.022_56).abs() < 0.6e-5, "{}", e.peak_penetration);
    let elastic = impact("law = \"jankowski\"\nstiffness = 3.0e7\nrestitution = 1.0", 0.5);
    assert_eq!(elastic.dissipated_energy, 0.0);
}
