//! One free impact under each law: against an integration in 40 digits (tests/reference/free_impacts.py, whose table
//! holds for all masses, stiffnesses and speeds) and against closed forms.

use crate::common::{Run, assert_close, free_impact};
use pounding::contact::DampingFormula;
use pounding::engine::{BuildingId, Episode};
use std::f64::consts::PI;

/// kg, left and right.
const MASSES: [(f64, f64); 4] = [(5e4, 7.5e4), (3e5, 3e5), (20.0, 1.5), (1e3, 1e7)];

/// A free impact and the scales of its table row.
struct Impact {
    episode: Episode,
    speed: f64,
    /// m, L = (m V^2 / k)^(1 / (n + 1)).
    length: f64,
    /// N, k L^n.
    force: f64,
}

impl Impact {
    /// `stiffness` and `exponent` of what the law does; momentum and energy are looked at for every impact.
    fn new(law: &str, masses: (f64, f64), stiffness: f64, exponent: f64, speed: f64) -> Impact {
        let mut run = Run::new(&free_impact(masses, law, speed), None);
        let m = masses.0 * masses.1 / (masses.0 + masses.1);
        let length = (m * speed * speed / stiffness).powf(1.0 / (exponent + 1.0));
        // In pieces: one before the impact, some within it, the last well after it.
        let (entry, duration) = (0.001 / speed, 5.0 * length / speed);
        run.to(0.5 * entry).to(entry + 0.1 * duration).to(entry + 0.3 * duration).to(2.0 * entry + 20.0 * duration);
        let what = format!("{law}, {masses:?} kg, {speed} m/s");
        assert_eq!(run.episodes.len(), 1, "one impact under {what}");
        let episode = run.episodes[0];
        assert_close(episode.start, entry, 1e-14, "entry");
        assert_close(episode.approach_velocity, speed, 1e-14, "approach velocity");
        let exchanged = m * (speed + episode.separation_velocity);
        assert_close(episode.impulse, exchanged, 1e-12, &format!("impulse = momentum, {what}"));
        let (left, right) = (run.velocity(BuildingId::LEFT, 0), run.velocity(BuildingId::RIGHT, 0));
        assert_close(masses.0 * left + masses.1 * right, masses.0 * speed, 1e-14, &format!("momentum, {what}"));
        let energy = 0.5 * m * speed * speed;
        let lost = 0.5 * m * (speed * speed - episode.separation_velocity * episode.separation_velocity);
        let error = (episode.dissipated_energy - lost) / energy;
        assert!(error.abs() < 1e-12, "loss of {what}: {} and {lost}", episode.dissipated_energy);
        assert!(run.energy().residual.abs() < 2e-13, "{what}: {:?}", run.energy());
        Impact { episode, speed, length, force: stiffness * length.powf(exponent) }
    }

    /// All that the table says about the impact.
    fn assert_as(&self, row: &Row, what: &str) {
        let episode = &self.episode;
        assert_close(episode.separation_velocity / self.speed, row.restitution, 1e-12, &format!("restitution, {what}"));
        let deepest = episode.peak_penetration / self.length;
        assert_close(deepest, row.peak_penetration, 1e-12, &format!("peak penetration, {what}"));
        assert_close(episode.peak_force / self.force, row.peak_force, 1e-12, &format!("peak force, {what}"));
        // Times since t = 0 carry the rounding of the time of entry.
        let unit = self.length / self.speed;
        let rounding = 4.0 * f64::EPSILON * episode.start / unit;
        let duration = (episode.end.unwrap() - episode.start) / unit;
        assert_close(duration, row.duration, 1e-11 + rounding, &format!("duration, {what}"));
    }
}

/// One line of the table: restitution, largest penetration [L], largest force [k L^n], duration [L/V].
struct Row {
    law: &'static str,
    formula: &'static str,
    exponent: f64,
    e: f64,
    coefficient: f64,
    restitution: f64,
    peak_penetration: f64,
    peak_force: f64,
    duration: f64,
}

fn table(law: &str) -> Vec<Row> {
    let lines = include_str!("../reference/free_impacts.csv").lines().filter(|line| !line.starts_with('#')).skip(1);
    let rows = lines.map(|line| {
        let field: Vec<&str> = line.split(',').collect();
        let number = |i: usize| field[i].parse().unwrap();
        Row {
            law: field[0],
            formula: field[1],
            exponent: number(2),
            e: number(3),
            coefficient: number(4),
            restitution: number(5),
            peak_penetration: number(6),
            peak_force: number(7),
            duration: number(8),
        }
    });
    let rows: Vec<Row> = rows.filter(|row| row.law == law).collect();
    assert!(rows.len() >= 5, "{law}");
    rows
}

/// The impacts of one row of the table, `keys` being those of its law but for the stiffness.
fn compare(row: &Row, keys: &str, cases: &[(f64, f64)]) {
    for (i, &(stiffness, speed)) in cases.iter().enumerate() {
        let law = format!("law = \"{}\"\nstiffness = {stiffness:?}\n{keys}", row.law);
        // The spring of this formula is 3k/2 (eq. 14, reading A).
        let spring = if row.formula == "barros_khatami" { 1.5 * stiffness } else { stiffness };
        let masses = MASSES[(i + (100.0 * row.e) as usize) % MASSES.len()];
        let impact = Impact::new(&law, masses, spring, row.exponent, speed);
        impact.assert_as(row, &format!("{law}\n{masses:?} kg, {speed} m/s"));
    }
}

/// N/m^n and m/s: from soft to hard and from slow to fast, each with each.
const EVERY: [(f64, f64); 9] = [
    (3e7, 0.5),
    (1e5, 1e-4),
    (1e5, 0.1),
    (1e5, 10.0),
    (1e9, 1e-4),
    (1e9, 10.0),
    (1e12, 1e-4),
    (1e12, 0.02),
    (1e12, 10.0),
];

#[test]
fn linear_is_a_half_sine() {
    for (stiffness, speed) in EVERY {
        for masses in MASSES {
            let law = format!("law = \"linear\"\nstiffness = {stiffness:?}");
            let impact = Impact::new(&law, masses, stiffness, 1.0, speed);
            let half_sine = Row {
                law: "linear",
                formula: "",
                exponent: 1.0,
                e: 1.0,
                coefficient: 0.0,
                restitution: 1.0,
                peak_penetration: 1.0,
                peak_force: 1.0,
                duration: PI,
            };
            impact.assert_as(&half_sine, &law);
            let omega = impact.speed / impact.length;
            assert_close(
                (impact.episode.peak_time - impact.episode.start) * omega,
                PI / 2.0,
                1e-6,
                "peak in the middle",
            );
            assert_eq!(impact.episode.dissipated_energy, 0.0, "an elastic loop encloses nothing");
        }
    }
}

#[test]
fn kelvin_voigt_returns_exactly_e() {
    for row in table("kelvin_voigt") {
        assert_close(row.restitution, row.e, 1e-15, "the integration agrees with the closed form");
        compare(&row, &format!("restitution = {:?}", row.e), &EVERY);
    }
}

#[test]
fn kelvin_voigt_without_tension_returns_more_than_e() {
    for row in table("kelvin_voigt_no_tension") {
        // Released at F = 0: exp(-2 xi acos(xi) / sqrt(1 - xi^2)) (reading of the paper, section 1).
        let xi = row.coefficient;
        let closed = if row.e == 1.0 { 1.0 } else { (-2.0 * xi * xi.acos() / (1.0 - xi * xi).sqrt()).exp() };
        assert_close(row.restitution, closed, 1e-15, "the integration agrees with the closed form");
        compare(&row, &format!("restitution = {:?}", row.e), &EVERY);
    }
}

/// F(0+) = c V, F(end) = -c e V, and all between: k d + c v of the damped sine d = V / w_d exp(-xi w t) sin(w_d t).
#[test]
fn kelvin_voigt_force_from_the_jump_at_entry_to_the_pull_before_release() {
    let (m, stiffness, speed) = (3e4_f64, 3e7_f64, 0.5_f64);
    for e in [0.1, 0.5, 0.9] {
        let law = format!("law = \"kelvin_voigt\"\nstiffness = {stiffness:?}\nrestitution = {e:?}");
        let mut run = Run::new(&free_impact((5e4, 7.5e4), &law, speed), None);
        let xi: f64 = -f64::ln(e) / (PI * PI + f64::ln(e).powi(2)).sqrt();
        let omega = (stiffness / m).sqrt();
        let (damped, c) = (omega * (1.0 - xi * xi).sqrt(), 2.0 * xi * (stiffness * m).sqrt());
        let duration = PI / damped;
        for part in [1e-9, 1e-3, 0.2, 0.5, 0.9, 0.999, 1.0 - 1e-9] {
            let t = part * duration;
            run.to(0.002 + t);
            let decay = (-xi * omega * t).exp();
            let d = speed / damped * decay * (damped * t).sin();
            let v = speed * decay * ((damped * t).cos() - xi * omega / damped * (damped * t).sin());
            let force = run.contact(0).force;
            let error = (force - (stiffness * d + c * v)) / (c * speed);
            // The time of entry, 2 ms, is rounded; the force changes by about its size in a tenth of the contact.
            assert!(error.abs() < 1e-12, "e = {e}, {part} of the contact: {force}, off by {error:e}");
            let limit = if part < 1e-6 { c * speed } else { -c * e * speed };
            if !(1e-6..1.0 - 1e-6).contains(&part) {
                assert!((force - limit).abs() < 1e-7 * c * speed, "e = {e}: {force} instead of {limit}");
            }
        }
    }
}

#[test]
fn hertz_is_elastic_with_its_peak_where_energy_says() {
    for row in table("hertz") {
        let n = row.exponent;
        let deepest = (0.5 * (n + 1.0)).powf(1.0 / (n + 1.0));
        assert_close(row.peak_penetration, deepest, 1e-15, "the integration agrees with the closed form");
        compare(&row, &format!("exponent = {n:?}"), &EVERY);
        let law = format!("law = \"hertz\"\nstiffness = 3.0e7\nexponent = {n:?}");
        let impact = Impact::new(&law, MASSES[0], 3e7, n, 0.5);
        assert_eq!(impact.episode.dissipated_energy, 0.0, "an elastic loop encloses nothing");
    }
}

#[test]
fn hertz_damped_returns_what_its_coefficient_says_for_any_exponent_mass_stiffness_and_speed() {
    let rows = table("hertz_damped");
    for formula in DampingFormula::ALL {
        let rows: Vec<&Row> =
            rows.iter().filter(|row| DampingFormula::from_name(row.formula) == Some(*formula)).collect();
        assert_eq!(rows.len(), 8, "{formula:?}");
        for (i, row) in rows.into_iter().enumerate() {
            let error = formula.coefficient(row.e) - row.coefficient;
            assert!(error.abs() <= 1e-15 * row.coefficient.max(1.0), "{formula:?}, e = {}: off by {error:e}", row.e);
            let keys = format!(
                "restitution = {:?}\nexponent = {:?}\ndamping_formula = \"{}\"",
                row.e, row.exponent, row.formula
            );
            // The paper's impact, and two others of nine in turn.
            compare(row, &keys, &[EVERY[0], EVERY[1 + (2 * i) % 8], EVERY[1 + (2 * i + 5) % 8]]);
        }
    }
}

/// `exact` is what it says at every order of magnitude of stiffness and speed and for every exponent. What the table
/// has for a few exponents is a closed form for all: d_m = L [(n + 1) (a - ln(1 + a)) / a^2]^(1 / (n + 1)).
#[test]
fn the_exact_formula_returns_e() {
    let exponents = (0..=40).map(|k| 1.0 + 0.05 * f64::from(k)).chain([1.01, 1.99, 2.01, 2.99]);
    for (i, n) in exponents.enumerate() {
        for e in [0.1, 0.2, 0.5, 0.75, 0.99] {
            let (stiffness, speed) = EVERY[i % EVERY.len()];
            let law = format!(
                "law = \"hertz_damped\"\nstiffness = {stiffness:?}\nexponent = {n:?}\nrestitution = {e:?}
                damping_formula = \"exact\""
            );
            let impact = Impact::new(&law, MASSES[i % MASSES.len()], stiffness, n, speed);
            assert_close(impact.episode.separation_velocity / speed, e, 1e-12, &law);
            let a = DampingFormula::Exact.coefficient(e);
            // a - ln(1 + a) cancels for small a.
            let rest = if a < 0.02 {
                (0..12).rev().fold(0.0, |sum, k| 1.0 / f64::from(k + 2) - a * sum)
            } else {
                (a - a.ln_1p()) / (a * a)
            };
            let deepest = impact.length * ((n + 1.0) * rest).powf(1.0 / (n + 1.0));
            assert_close(impact.episode.peak_penetration, deepest, 1e-12, &law);
        }
    }
}

/// The strongest damping that a scene can ask for with a restitution that is still measurable: a is 50 here.
#[test]
fn little_restitution_is_exact_too() {
    for (e, n) in [(0.02, 1.0), (0.05, 1.5), (0.07, 2.0), (0.05, 3.0)] {
        let law = format!(
            "law = \"hertz_damped\"\nstiffness = 3.0e7\nexponent = {n:?}\nrestitution = {e:?}
            damping_formula = \"exact\""
        );
        let impact = Impact::new(&law, MASSES[0], 3e7, n, 0.5);
        assert_close(impact.episode.separation_velocity / 0.5, e, 1e-12, &law);
    }
}

/// hertz returns all of it for every exponent; d_m = L ((n + 1) / 2)^(1 / (n + 1)).
#[test]
fn hertz_is_elastic_for_every_exponent() {
    let exponents = (0..=40).map(|k| 1.0 + 0.05 * f64::from(k)).chain([1.01, 1.99, 2.01, 2.99]);
    for (i, n) in exponents.enumerate() {
        let (stiffness, speed) = EVERY[i % EVERY.len()];
        let law = format!("law = \"hertz\"\nstiffness = {stiffness:?}\nexponent = {n:?}");
        let impact = Impact::new(&law, MASSES[i % MASSES.len()], stiffness, n, speed);
        assert_close(impact.episode.separation_velocity, speed, 1e-12, &law);
        let deepest = impact.length * (0.5 * (n + 1.0)).powf(1.0 / (n + 1.0));
        assert_close(impact.episode.peak_penetration, deepest, 1e-12, &law);
    }
}

#[test]
fn the_approach_velocity_that_damping_divides_by_has_a_floor() {
    // At a tenth of the floor of 1e-4 m/s the damping is a tenth: a = 0.16 returns 0.903524866150439725 (`returned` of
    // tests/reference/free_impacts.py).
    let law = "law = \"hertz_damped\"\nstiffness = 3.0e7\nexponent = 1.5\nrestitution = 0.5\ndamping_formula = \"ye\"";
    let impact = Impact::new(law, MASSES[0], 3e7, 1.5, 1e-5);
    assert_close(impact.episode.separation_velocity / 1e-5, 0.903_524_866_150_439_7, 1e-12, "restitution");
    // A floor of the scene's own (a = 1.6, 1.6, 1.52, 0.4, 0.008; values from there, too): from it on nothing changes, below it a' = a V / floor.
    let own = format!("{law}\n[solver]\nmin_approach_velocity = 0.02");
    let returned = [
        0.470_444_779_326_739_5,
        0.470_444_779_326_739_5,
        0.484_195_168_178_922_5,
        0.788_539_125_907_065_1,
        0.994_694_945_281_961_2,
    ];
    for (speed, returned) in [0.5, 0.02, 0.019, 0.005, 1e-4].into_iter().zip(returned) {
        let impact = Impact::new(&own, MASSES[0], 3e7, 1.5, speed);
        assert_close(impact.episode.separation_velocity / speed, returned, 1e-12, "restitution");
    }
    // Laws that do not divide by V know no floor.
    for (law, exponent) in [("kelvin_voigt", 1.0), ("jankowski", 1.5)] {
        let law = format!("law = \"{law}\"\nstiffness = 3.0e7\nrestitution = 0.5");
        let own = format!("{law}\n[solver]\nmin_approach_velocity = 0.02");
        let [with, without] = [own, law].map(|law| Impact::new(&law, MASSES[0], 3e7, exponent, 0.005).episode);
        assert_eq!(with, without);
    }
}

#[test]
fn jankowski_is_scale_free_and_returns_what_an_integration_says() {
    for row in table("jankowski") {
        compare(&row, &format!("restitution = {:?}", row.e), &EVERY);
        let law = format!("law = \"jankowski\"\nstiffness = 3.0e7\nrestitution = {:?}", row.e);
        let loss = Impact::new(&law, MASSES[0], 3e7, 1.5, 0.5).episode.dissipated_energy;
        assert_eq!(loss == 0.0, row.e == 1.0, "only e = 1 loses nothing");
    }
    // The worst of its approximation from 0.05 to 0.95, at 0.23 (`jankowski` of tests/reference/free_impacts.py).
    let off = |e: f64| {
        let law = format!("law = \"jankowski\"\nstiffness = 3.0e7\nrestitution = {e:?}");
        (Impact::new(&law, MASSES[0], 3e7, 1.5, 0.5).episode.separation_velocity / 0.5 - e).abs()
    };
    let worst = (5..=95).map(|percent| off(f64::from(percent) / 100.0)).fold(0.0, f64::max);
    assert!((worst - 0.008_593_529_539_619_82).abs() < 1e-12, "{worst}");
}
