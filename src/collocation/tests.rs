//! Windows against closed forms.

use super::*;
use crate::contact::Force;
use crate::numerics::roots::Knot;

/// A pair of a free reduced mass.
fn free_mass(mass: f64, force: Force, d: f64, v: f64, omega: f64, scale: f64) -> Equation {
    let mut equation = Equation { pairs: 1, closed: 1, terms: 3, powers: 2, scale, ..Equation::default() };
    equation.forces[0] = force;
    equation.kernels[0][0][1] = 1.0 / mass;
    (equation.free[0][0], equation.free[0][1]) = (d, v * scale);
    equation.omega[0] = omega;
    equation
}

fn solved(equation: &Equation, map: Map, length: f64, ending: Ending, tolerance: f64) -> SolvedWindow {
    solved_by(NodeCount::Sixteen, equation, map, length, ending, tolerance)
}

fn solved_by(
    rule: NodeCount,
    equation: &Equation,
    map: Map,
    length: f64,
    ending: Ending,
    tolerance: f64,
) -> SolvedWindow {
    let mut solution = SolvedWindow::default();
    assert!(
        solution.solve(equation, &mut WindowWorkspace::new(2), (Frame { map, rule, length, ending }, false), tolerance),
        "{map:?} {length} {ending:?}"
    );
    solution
}

/// [Goldsmith1960]: an elastic impact under k d^1.5 takes 2 (5/4)^(2/5) sqrt(pi) Gamma(7/5) / Gamma(9/10) times
/// (m^2 / (k^2 V))^(1/5), and gives the speed back.
#[test]
fn two_windows_take_a_hertz_impact_from_entry_to_release() {
    let (m, k, v) = (3e4, 3e10, 0.5);
    let unit = libm::pow(m * m / (k * k * v), 0.2);
    let exact = 2.0 * libm::pow(1.25, 0.4) * std::f64::consts::PI.sqrt() * libm::tgamma(1.4) / libm::tgamma(0.9);
    let force = Force::Power { stiffness: k, exponent: 1.5, damping: 0.0 };
    for first in [0.4, 1.0, 1.6] {
        let entry = free_mass(m, force, 0.0, v, 1.0 / unit, 2.0 * unit);
        let entry = solved(&entry, Map::SquareStart, first * unit, Ending::Given, 1e-16);
        let (d, rate) = entry.end[0];
        let middle = free_mass(m, force, d, rate, 1.0 / unit, 3.0 * unit);
        let middle = solved(&middle, Map::Plain, (1.8 - first) * unit, Ending::Given, 1e-16);
        let (d, rate) = middle.end[0];
        let last = free_mass(m, force, d, rate, 1.0 / unit, 3.0 * unit);
        let last = solved(&last, Map::SquareEnd, 1.3 * unit, Ending::Release(0), 1e-16);
        let duration = (entry.length + middle.length + last.length) / unit;
        assert!((duration / exact - 1.0).abs() < 1e-12, "{first}: {duration} instead of {exact}");
        assert!((last.end[0].1 / v + 1.0).abs() < 1e-12, "{first}: leaves at {}", last.end[0].1);
    }
}

/// A window that begins with the solution over a longer one is right after one sweep, whatever its nodes; one that begins
/// with a guess is not. What the mass has lost of its kinetic energy is in the spring.
#[test]
fn a_window_begins_with_the_solution_over_a_longer_one() {
    let (m, k, v) = (3e4, 3e10, 0.5);
    let unit = libm::pow(m * m / (k * k * v), 0.2);
    let force = Force::Power { stiffness: k, exponent: 1.5, damping: 0.0 };
    let equation = free_mass(m, force, 0.0, v, 1.0 / unit, 2.0 * unit);
    let whole = solved(&equation, Map::SquareStart, 1.4 * unit, Ending::Given, 1e-16);
    let error = |window: &SolvedWindow| {
        let (d, rate) = window.end[0];
        (0.5 * m * (v * v - rate * rate) / (0.4 * k * libm::pow(d, 2.5)) - 1.0).abs()
    };
    for (rule, length) in [(NodeCount::Sixteen, 1.4), (NodeCount::Sixteen, 1.1), (NodeCount::Twelve, 0.5)] {
        let frame = Frame { map: Map::SquareStart, rule, length: length * unit, ending: Ending::Given };
        let after_one_sweep = |is_known| {
            let mut window = whole;
            assert!(window.solve(&equation, &mut WindowWorkspace::new(1), (frame, is_known), f64::INFINITY));
            error(&window)
        };
        let (known, guessed) = (after_one_sweep(true), after_one_sweep(false));
        assert!(known < 1e-11 && guessed > 1e-7, "{length}: {known} and {guessed}");
    }
}

/// The same with fewer nodes, in more and shorter windows.
#[test]
fn windows_of_fewer_nodes_take_a_hertz_impact_in_more_steps() {
    let (m, k, v) = (3e4, 3e10, 0.5);
    let unit = libm::pow(m * m / (k * k * v), 0.2);
    let exact = 2.0 * libm::pow(1.25, 0.4) * std::f64::consts::PI.sqrt() * libm::tgamma(1.4) / libm::tgamma(0.9);
    let force = Force::Power { stiffness: k, exponent: 1.5, damping: 0.0 };
    for (rule, ends) in [
        (NodeCount::Eight, &[0.1, 0.2, 0.4, 0.7, 1.1, 1.6, 2.1, 2.5, 2.8, 3.0, 3.1][..]),
        (NodeCount::Twelve, &[0.5, 1.1, 1.8, 2.6]),
    ] {
        let entry = free_mass(m, force, 0.0, v, 1.0 / unit, 2.0 * unit);
        let mut window = solved_by(rule, &entry, Map::SquareStart, ends[0] * unit, Ending::Given, 1e-16);
        for (from, to) in ends.iter().zip(&ends[1..]) {
            let equation = free_mass(m, force, window.end[0].0, window.end[0].1, 1.0 / unit, 2.0 * unit);
            window = solved_by(rule, &equation, Map::Plain, (to - from) * unit, Ending::Given, 1e-16);
        }
        let last = free_mass(m, force, window.end[0].0, window.end[0].1, 1.0 / unit, 2.0 * unit);
        let rest = exact - ends[ends.len() - 1];
        let last = solved_by(rule, &last, Map::SquareEnd, 0.95 * rest * unit, Ending::Release(0), 1e-16);
        let late = last.length / (rest * unit) - 1.0;
        assert!(late.abs() * rest < 1e-11, "{rule:?}: released too late by {late}");
        assert!((last.end[0].1 / v + 1.0).abs() < 1e-11, "{rule:?}: leaves at {}", last.end[0].1);
    }
}

/// [Gonthier2004]: a (1 + e) = ln[(1 + a) / (1 - a e)], whatever the other numbers are.
#[test]
fn a_damped_impact_returns_what_its_closed_form_says() {
    let (m, k, v, e) = (3e4, 3e10, 0.5, 0.6);
    let mut a = 0.5;
    for _ in 0..200 {
        a = (1.0 - libm::exp(-a * (1.0 + e)) * (1.0 + a)) / e;
    }
    let unit = libm::pow(m * m / (k * k * v), 0.2);
    let force = Force::Power { stiffness: k, exponent: 1.5, damping: a / v };
    let entry = free_mass(m, force, 0.0, v, 1.0 / unit, 3.0 * unit);
    let turn = solved(&entry, Map::SquareStart, 1.2 * unit, Ending::Turn(0), 1e-16);
    assert!(turn.end[0].1.abs() < 1e-12 * v, "still goes at {}", turn.end[0].1);
    let rest = free_mass(m, force, turn.end[0].0, turn.end[0].1, 1.0 / unit, 3.0 * unit);
    let rest = solved(&rest, Map::SquareEnd, 1.8 * unit, Ending::Release(0), 1e-16);
    assert!((-rest.end[0].1 / v - e).abs() < 1e-10, "{} instead of {e}", -rest.end[0].1 / v);
}

/// A mass on a spring that meets another spring, from 0.1 m and 1.5 m/s on for 0.2 s: how far its position and its
/// speed are from those of one oscillator with both springs and dashpots, where the kernel may be off by `remainder`.
fn beside_both_springs(remainder: f64, dashpot: f64) -> (f64, f64) {
    let (m, w, z) = (2.0, 5.0, 0.04);
    let (k, c) = (m * 7.0 * 7.0, 2.0 * m * dashpot);
    let (d, v, t) = (0.1, 1.5, 0.2);
    let mut equation = free_mass(m, Force::Linear { stiffness: k, damping: c }, d, v, 8.0, t);
    let (damping, omega2) = (2.0 * z * w, w * w);
    equation.powers = POWERS;
    equation.remainder = remainder;
    equation.terms = 30;
    let kernel = &mut equation.kernels[0][0];
    for n in 2..POWERS {
        let k = n as f64;
        kernel[n] = -((k - 1.0) * damping * kernel[n - 1] + omega2 * kernel[n - 2]) / (k * (k - 1.0));
    }
    let free = &mut equation.free[0];
    for n in 2..30 {
        let k = n as f64;
        free[n] = -((k - 1.0) * damping * t * free[n - 1] + omega2 * t * t * free[n - 2]) / (k * (k - 1.0));
    }
    let (d1, v1) = solved(&equation, Map::Plain, t, Ending::Given, 1e-16).end[0];
    let (damping, omega2) = (damping + c / m, omega2 + k / m);
    let wd = (omega2 - 0.25 * damping * damping).sqrt();
    let (fall, sine, cosine) = (libm::exp(-0.5 * damping * t), libm::sin(wd * t), libm::cos(wd * t));
    let exact = fall * (d * cosine + (v + 0.5 * damping * d) / wd * sine);
    let rate = fall * (v * cosine - (0.5 * damping * v + omega2 * d) / wd * sine);
    ((d1 - exact).abs(), (v1 - rate).abs())
}

/// A spring and dashpot beside another: one oscillator of the sums.
#[test]
fn a_mass_on_a_spring_swings_as_with_both_springs() {
    for dashpot in [0.0, 0.3] {
        let (position, speed) = beside_both_springs(0.0, dashpot);
        assert!(position < 1e-14 && speed < 1e-13, "off by {position} and {speed}");
    }
}

/// What an impulse does may be known to fewer digits: the error follows, it is neither more nor nothing.
#[test]
fn a_window_is_as_exact_as_its_kernels() {
    for (remainder, dashpot) in [(1e-6, 0.0), (1e-6, 0.3), (1e-9, 0.0), (1e-9, 0.3)] {
        let (position, _) = beside_both_springs(remainder, dashpot);
        let scale = 0.1 + 1.5 * 0.2;
        assert!(position < remainder * scale, "{remainder}, {dashpot}: off by {position}");
        assert!(position > 1e-4 * remainder * scale, "{remainder}, {dashpot}: off by no more than {position}");
    }
}

/// A pair that no force reaches goes on as before: it touches when its gap is gone.
#[test]
fn a_watched_pair_ends_a_window_when_it_touches() {
    let force = Force::Power { stiffness: 3e10, exponent: 1.5, damping: 0.0 };
    let mut equation = free_mass(3e4, force, 1e-3, 0.1, 300.0, 6e-3);
    equation.pairs = 2;
    equation.kernels[1][1][1] = 1.0;
    (equation.free[1][0], equation.free[1][1]) = (-1e-3, 0.4 * equation.scale);
    let window = solved(&equation, Map::Plain, 2e-3, Ending::Touch(1), 1e-16);
    assert!((window.length - 2.5e-3).abs() < 1e-15, "{}", window.length);
    for (theta, d) in Tables::of(Map::Plain, NodeCount::Sixteen).theta.iter().zip(&window.depth[1]) {
        assert!((d - (0.4 * theta * window.length - 1e-3)).abs() < 1e-17, "{d}");
    }
}

/// Through 16 values goes every polynomial of degree 15.
#[test]
fn a_polynomial_comes_back_from_its_values() {
    let polynomial = |x: f64| (0..16).map(|n| libm::pow(x - 0.3, f64::from(n)) * f64::from(n - 7)).sum::<f64>();
    let slope = |x: f64| (1..16).map(|n| f64::from(n * (n - 7)) * libm::pow(x - 0.3, f64::from(n - 1))).sum::<f64>();
    let nodes = nodes(NodeCount::Sixteen);
    let interpolant = nodes.interpolant(&nodes.x.map(polynomial));
    for x in [0.0, 0.01, 0.37, 0.99, 1.0] {
        let ([value], Knot { value: same, slope: rate, .. }) = (interpolant.at(&[x]), interpolant.knot(x));
        // Derivatives at the ends of a polynomial of degree n lose up to n^2 of its rounding, twice.
        assert!((value - polynomial(x)).abs() < 1e-13 && (same - value).abs() < 1e-13, "{value} at {x}");
        assert!((rate - slope(x)).abs() < 1e-9, "{rate} instead of {} at {x}", slope(x));
    }
}
