//! Crossings and maxima of polynomials with known roots, near double roots, and at the edge of rounding.

#![allow(clippy::unwrap_used)]

use super::terms::Terms;
use super::{Knot, first_upcrossing, highest_between, maximum_above, turning_point};
use crate::numerics::polynomial::{Coefficients, MAX_TERMS};
use crate::numerics::powers::Powers;
use std::f64::consts::PI;

/// Coefficients of factor * product of (x - root).
fn polynomial(factor: f64, roots: &[f64]) -> Vec<f64> {
    let mut coefficients = vec![factor];
    for root in roots {
        let mut next = vec![0.0; coefficients.len() + 1];
        for (n, c) in coefficients.iter().enumerate() {
            next[n] -= root * c;
            next[n + 1] += c;
        }
        coefficients = next;
    }
    coefficients
}

fn highest(coefficients: &[f64], known: f64) -> Option<(f64, f64)> {
    highest_up_to(1.0, coefficients, known)
}

fn highest_up_to(end: f64, coefficients: &[f64], known: f64) -> Option<(f64, f64)> {
    let mut room = [0.0; MAX_TERMS];
    room[..coefficients.len()].copy_from_slice(coefficients);
    let mut powers = Powers::default();
    powers.set(end, coefficients.len() - 1);
    let terms = |out: &mut Coefficients| {
        *out = room;
        coefficients.len()
    };
    maximum_above((room[0], room[1]), end, &powers.read(&room), known, terms)
}

fn rise(factor: f64, roots: &[f64]) -> Option<f64> {
    first_upcrossing(&mut polynomial(factor, roots), 1.0, 1e-16)
}

#[test]
fn a_single_rise_is_found_to_rounding() {
    for root in [1e-9, 1e-3, 0.1, 0.5, 0.999_999, 1.0 - 1e-12] {
        let found = rise(1.0, &[root]).unwrap();
        assert!((found - root).abs() <= 2e-16, "{found} instead of {root}");
    }
}

#[test]
fn a_curve_has_passed_at_its_root() {
    // So does every other curve that agrees with it: contacts that meet at one instant are not taken for two impacts.
    for k in 1..1000 {
        let mut curve = polynomial(1.0, &[1e-3 * f64::from(k), 1.1 + 1e-4 * f64::from(k), 1.7, -0.3]);
        let root = first_upcrossing(&mut curve, 1.0, 0.0).unwrap();
        let value = Terms::of(&curve).value(root);
        assert!(value >= 0.0 && (root - 1e-3 * f64::from(k)).abs() < 1e-14, "{value} at {root}");
    }
}

#[test]
fn two_passages_between_the_ends_are_seen() {
    // Below 0 at both ends, above 0 for a short while: a crossing that sampling misses.
    for width in [0.3, 1e-2, 1e-4, 1e-6] {
        let found = rise(-1.0, &[0.4, 0.4 + width]).unwrap();
        assert!((found - 0.4).abs() < 1e-16 / width + 1e-15, "{found}, width {width}");
    }
}

#[test]
fn the_first_of_many_rises_is_the_one() {
    let found = rise(1.0, &[0.2, 0.3, 0.5, 0.6, 0.9]).unwrap();
    assert!((found - 0.2).abs() < 1e-14, "{found}");
}

#[test]
fn what_stays_below_is_none() {
    assert_eq!(rise(1.0, &[1.5]), None);
    // Touches from below without passing.
    assert_eq!(first_upcrossing(&mut [-0.25 - 1e-9, 1.0, -1.0], 1.0, 1e-16), None);
    assert_eq!(first_upcrossing(&mut [-1.0, 0.0, 0.0, 0.0], 1.0, 1e-16), None);
    assert_eq!(first_upcrossing(&mut [0.0; 8], 1.0, 0.0), None);
}

#[test]
fn a_start_at_0_counts_by_where_it_goes() {
    assert_eq!(first_upcrossing(&mut [0.0, 1.0], 1.0, 1e-16), Some(0.0));
    assert_eq!(first_upcrossing(&mut [0.0, -1.0, -1.0], 1.0, 1e-16), None);
    // Leaves downwards and comes back at x = 0.5.
    let found = first_upcrossing(&mut [0.0, -0.5, 1.0], 1.0, 1e-16).unwrap();
    assert!((found - 0.5).abs() < 1e-15, "{found}");
    // A start above 0 by rounding is a start at 0.
    assert_eq!(first_upcrossing(&mut [1e-17, -1.0], 1.0, 1e-16), None);
    // However high it starts: it counts as 0, leaves downwards and comes back at x = 0.001.
    let found = first_upcrossing(&mut [1e-3, -1e-3, 1.0], 1.0, 1e-16).unwrap();
    assert!((found - 1e-3).abs() < 1e-15, "{found}");
}

#[test]
fn a_rise_within_noise_is_none() {
    assert_eq!(first_upcrossing(&mut [-1e-18, 1e-17], 1.0, 1e-16), None);
    assert!(first_upcrossing(&mut [-1e-18, 1e-15], 1.0, 1e-16).is_some());
}

#[test]
fn what_rounding_hides_is_not_searched_for() {
    // (1 + x)^1.5 to the 17th power, far beyond where that means anything: at x = 150 it is 1e33 and so is the bound on
    // its derivative, and a billion pieces near the start could each hide something larger than 1.
    let (mut terms, mut binomial) = (vec![], 1.0);
    for n in 0..18 {
        terms.push(binomial);
        binomial *= (1.5 - f64::from(n)) / f64::from(n + 1);
    }
    // Each search in vain takes a second.
    for _ in 0..1000 {
        let (x, value) = highest_up_to(150.0, &terms, 0.0).unwrap();
        assert!((0.0..=150.0).contains(&x) && value >= 1.0, "{x}, {value}");
    }
}

#[test]
fn the_maximum_inside_is_found() {
    // 1 - (x - 0.3)^2 (1 + x^3)
    let (x, value) = highest(&[0.91, 0.6, -1.0, -0.09, 0.6, -1.0], 0.0).unwrap();
    assert!((x - 0.3).abs() < 1e-9 && (value - 1.0).abs() < 1e-15, "{x}, {value}");
    assert_eq!(highest(&[0.91, 0.6, -1.0, -0.09, 0.6, -1.0], 1.0 + 1e-12), None);
    // The highest of several, not the first: x (x - 0.4)^2 has 0.009 at 0.13 and 0.36 at 1.
    let (x, value) = highest(&polynomial(1.0, &[0.0, 0.4, 0.4]), 0.0).unwrap();
    assert!(x == 1.0 && (value - 0.36).abs() < 1e-15, "{x}, {value}");
}

/// A curve (value and slope by x), between which x it turns, where, and the largest number of readings.
type Turning = (fn(f64) -> (f64, f64), [f64; 2], f64, usize);

#[test]
fn a_turning_point_takes_few_readings() {
    let curves: [Turning; 5] = [
        (|x| (x.sin(), x.cos()), [0.1, 3.0], std::f64::consts::FRAC_PI_2, 4),
        // The first reading is the point itself.
        (|x| (x * (1.0 - x), 1.0 - 2.0 * x), [0.0, 1.0], 0.5, 1),
        // A force of Hertz that a fourth power ends, from where its curvature is unbounded.
        (|x| (x.powf(1.5) - x.powi(4), 1.5 * x.sqrt() - 4.0 * x.powi(3)), [1e-12, 1.0], 0.375_f64.powf(0.4), 6),
        // At one end of the piece, and a peak that no cubic resembles.
        (|x| (x * (-20.0 * x).exp(), (1.0 - 20.0 * x) * (-20.0 * x).exp()), [0.0, 1.0], 0.05, 10),
        (
            |x| {
                let (off, width) = (x - 0.7, 1.0 + 1e4 * (x - 0.7) * (x - 0.7));
                (1.0 / width, -2e4 * off / (width * width))
            },
            [0.0, 1.0],
            0.7,
            20,
        ),
    ];
    for (k, (curve, ends, point, most)) in curves.into_iter().enumerate() {
        let mut readings = 0;
        let knot = |x: f64| {
            let (value, slope) = curve(x);
            Knot { x, value, slope }
        };
        let found = turning_point(ends.map(knot), |x| {
            readings += 1;
            knot(x)
        });
        assert!((found - point).abs() < 1e-10, "curve {k}: {found} instead of {point}");
        assert!(readings <= most, "curve {k}: {readings} readings");
    }
}

/// The first 28 terms of size cos(rate (x - point)).
fn oscillation(rate: f64, size: f64, point: f64) -> impl Iterator<Item = f64> {
    let (sin, cos) = (rate * point).sin_cos();
    let mut factor = size;
    (0..28).map(move |n| {
        factor *= if n == 0 { 1.0 } else { rate / n as f64 };
        factor * [cos, sin, -cos, -sin][n % 4]
    })
}

/// However much of a curve is searched, its maximum is the same to the last bit: read in the midst of a step, a peak must not
/// be above that of the whole step.
#[test]
fn a_maximum_does_not_depend_on_what_follows() {
    let shares =
        |k: usize| [0.618_033_988_749_895, 0.754_877_666_246_693, 0.569_840_290_998_053].map(|g| k as f64 * g % 1.0);
    for k in 0..3000 {
        let [first, second, third] = shares(k);
        let (point, rate) = (0.05 + 0.6 * first, 0.05 + 1.5 * second);
        let both = oscillation(rate, 1.0, point).zip(oscillation(3.0 * rate, 0.1 * third, point));
        let curve: Vec<f64> = both.map(|(slow, quick)| slow + quick).collect();
        let (at, value) = highest(&curve, 0.0).unwrap();
        let truth = 1.0 + 0.1 * third;
        assert!((at - point).abs() < 1e-7 && (value - truth).abs() < 2e-15, "case {k}: {value} at {at}");
        for share in shares(k + 1).into_iter().chain(shares(k + 2)) {
            let end = at + (1.0 - at) * share;
            let (again, part) = highest_up_to(end, &curve, 0.0).unwrap();
            assert_eq!(part.to_bits(), value.to_bits(), "case {k} up to {end}: at {again} instead of {at}");
        }
    }
}

/// A slow oscillation with a quick, small one on it, known at sixteen nodes: the largest value is the one among thousands, and
/// the same to the last bit whatever is known before.
#[test]
fn the_largest_value_is_found_between_places() {
    // Closer together near the ends, as the nodes of a Gauss rule are.
    let nodes: [f64; 16] = std::array::from_fn(|i| 0.5 - 0.5 * (PI * (i as f64 + 0.5) / 16.0).cos());
    let mut turned = 0;
    for k in 0..2000 {
        let [first, second, third, fourth] =
            [0.618_033_988, 0.754_877_666, 0.569_840_291, 0.819_172_513].map(|golden: f64| f64::from(k) * golden % 1.0);
        let (slow, quick, share, phase) = (4.0 * first, 4.0 + 6.0 * second, 0.2 * third, 7.0 * fourth);
        let curve = |x: f64| {
            let ((sin, cos), (quick_sin, quick_cos)) = ((slow * x + phase).sin_cos(), (quick * x - phase).sin_cos());
            Knot { x, value: 2.0 + sin + share * quick_sin, slope: slow * cos + share * quick * quick_cos }
        };
        let highest = |known: f64| {
            let ends = [0.0, 1.0].map(|x| (x, curve(x).value));
            let places: Vec<_> =
                [ends[0]].into_iter().chain(nodes.map(|x| (x, curve(x).value))).chain([ends[1]]).collect();
            let found = highest_between(&places, (known, 0.9), curve, |x, _| Some(curve(x).value));
            found.map_or(known, |(_, value)| value)
        };
        let ends = curve(0.0).value.max(curve(1.0).value);
        let (found, dense) =
            (highest(ends), (0..=5000).map(|i| curve(f64::from(i) / 5000.0).value).fold(0.0, f64::max));
        assert!((dense - 1e-12..dense + 2e-6).contains(&found), "case {k}: {found} instead of {dense}");
        if found > ends {
            turned += 1;
            let known = ends.max(0.99 * found);
            assert_eq!(highest(known).to_bits(), found.to_bits(), "case {k} after {known} was known");
        }
    }
    assert!(turned > 500, "only {turned} turn inside");
}
