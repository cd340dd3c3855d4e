//! The exact flight over an interval, against a matrix exponential in 60 digits (tests/reference/propagator.py).

use crate::common::{Run, record, scene};
use nalgebra::{DMatrix, DVector};
use pounding::engine::BuildingId;
use pounding::structure::{CoupledIncrement, ModeIncrement};

struct Case {
    omega: f64,
    c: f64,
    h: f64,
    exact: [f64; 8],
}

fn cases() -> Vec<Case> {
    let text = include_str!("../reference/propagator.csv");
    text.lines()
        .filter(|line| !line.starts_with('#'))
        .map(|line| {
            let n: Vec<f64> = line.split(',').map(|field| field.parse().unwrap()).collect();
            Case { omega: n[0], c: n[1], h: n[2], exact: n[3..].try_into().unwrap() }
        })
        .collect()
}

fn numbers(i: &ModeIncrement) -> [f64; 8] {
    [i.dqq, i.dqv, i.dvq, i.dvv, i.rq0, i.rq1, i.rv0, i.rv1]
}

/// What each number is measured against: itself while the interval is short; for a long one, where the number
/// itself passes through 0, what it would be without its sine or cosine.
fn scale(case: &Case) -> [f64; 8] {
    let Case { omega: w, c, h, exact } = case;
    if w.max(*c) * h <= 0.5 {
        return exact.map(f64::abs);
    }
    let slowest = w.min(w * w / c.max(f64::MIN_POSITIVE)).max(1.0 / h);
    let natural =
        [1.0, 1.0 / w.max(*c), w * w / w.max(*c), 1.0, 1.0 / (w * w), h / (w * w), 1.0 / w.max(*c), 1.0 / (w * w)];
    let natural = if slowest < 0.3 * w { exact.map(f64::abs) } else { natural };
    std::array::from_fn(|i| natural[i].max(exact[i].abs()))
}

#[test]
fn every_number_of_a_mode_is_exact_to_rounding_from_wh_1e_8_to_1e4() {
    for case in cases() {
        let got = numbers(&ModeIncrement::new(case.omega, case.c, case.h));
        // The sine of w h cannot be better than the rounding of w h itself.
        let allowed = 4.0 * f64::EPSILON * (1.0 + (case.omega + case.c) * case.h);
        for (i, (got, scale)) in got.iter().zip(scale(&case)).enumerate() {
            let error = (got - case.exact[i]).abs() / scale;
            assert!(
                error <= allowed,
                "number {i} of w = {}, c = {}, h = {}: {got} instead of {}, {error:e} > {allowed:e}",
                case.omega,
                case.c,
                case.h,
                case.exact[i]
            );
        }
    }
}

#[test]
fn coupled_modes_without_coupling_are_single_modes() {
    for case in cases() {
        let c = DMatrix::from_diagonal(&DVector::from_vec(vec![case.c, 0.5 * case.c]));
        let coupled = CoupledIncrement::new(&[case.omega, 0.7 * case.omega], &c, case.h).matrix;
        let allowed = 30.0 * f64::EPSILON * (1.0 + (case.omega + case.c) * case.h);
        let block = [(0, 0), (0, 2), (2, 0), (2, 2), (0, 4), (0, 6), (2, 4), (2, 6)];
        for (i, ((row, column), scale)) in block.into_iter().zip(scale(&case)).enumerate() {
            let error = (coupled[(row, column)] - case.exact[i]).abs() / scale;
            assert!(error <= allowed, "number {i} of w = {}, c = {}: {error:e} > {allowed:e}", case.omega, case.c);
            assert_eq!(coupled[(row, column + 1)], 0.0, "the other mode has no part in it");
        }
    }
}

/// A rotation of a diagonal problem: damping couples the coordinates although the motion is that of single modes.
#[test]
fn coupled_modes_of_one_frequency_can_be_rotated() {
    let (omega, h) = (30.0, 0.02);
    let rotation = DMatrix::from_row_slice(2, 2, &[0.6, -0.8, 0.8, 0.6]);
    let damping = DVector::from_vec(vec![0.5, 20.0]);
    let c = &rotation * DMatrix::from_diagonal(&damping) * rotation.transpose();
    let coupled = CoupledIncrement::new(&[omega, omega], &c, h).matrix;
    let single = [numbers(&ModeIncrement::new(omega, 0.5, h)), numbers(&ModeIncrement::new(omega, 20.0, h))];
    for (i, (row, column)) in [(0, 0), (0, 2), (2, 0), (2, 2), (0, 4), (0, 6), (2, 4), (2, 6)].into_iter().enumerate() {
        let diagonal = DMatrix::from_diagonal(&DVector::from_vec(vec![single[0][i], single[1][i]]));
        let expected = &rotation * diagonal * rotation.transpose();
        let got = coupled.view((row, column), (2, 2));
        assert!((got - &expected).amax() <= 1e-14 * expected.amax(), "block {i}: {got} instead of {expected}");
    }
}

/// Between samples a flight with coupled damping goes in pieces, each by a series; over whole samples it has matrices. So a
/// record with more samples on the same lines is the same motion by the other way.
#[test]
fn a_flight_in_pieces_is_that_of_the_matrices() {
    let building = |mass: f64, stiffness: f64, dashpot: f64| {
        let row = |i: usize| (0..6).map(|j| if i == j && i % 2 == 1 { dashpot } else { 0.0 }).collect::<Vec<_>>();
        let damping = (0..6).map(row).collect::<Vec<_>>();
        format!(
            "mass = {:?}\nstiffness = {:?}\ndamping = {{ matrix = {damping:?} }}",
            vec![mass; 6],
            vec![stiffness; 6]
        )
    };
    // (Fastest rate) x (half a sample) of about 1, 10 and 70: one series, several, and matrices where these are too many.
    for dashpot in [1e7, 2e8, 1.5e9] {
        let (left, right) = (building(2e5, 2e8, dashpot), building(3e5, 4e8, 0.5 * dashpot));
        let mut scene = scene(&format!("name = \"C\"\n[left]\n{left}\n[right]\n{right}"));
        scene.ground.record = Some("r.csv".into());
        let samples: Vec<f64> = (0..200).map(|k| (0.7 * f64::from(k)).sin() * 3.0).collect();
        let middle = |pair: &[f64]| [pair[0], 0.5 * (pair[0] + pair[1])];
        let finer: Vec<f64> = samples.windows(2).flat_map(middle).collect();
        let step = 1.0 / 64.0;
        let mut run = Run::new(&scene, Some(&record(step, &samples)));
        let mut other = Run::new(&scene, Some(&record(0.5 * step, &finer)));
        let mut largest = 0.0_f64;
        for k in 0..190 {
            let time = (f64::from(k) + 0.5) * step;
            run.to(time);
            other.to(time);
            for (side, floor) in
                [(BuildingId::LEFT, 0), (BuildingId::LEFT, 5), (BuildingId::RIGHT, 2), (BuildingId::RIGHT, 5)]
            {
                let [got, exact] = [&run, &other].map(|run| run.displacement(side, floor));
                largest = largest.max(exact.abs());
                assert!((got - exact).abs() <= 1e-13 * largest, "{dashpot} at {time} s: {got} instead of {exact}");
                let [got, exact] = [&run, &other].map(|run| run.velocity(side, floor));
                assert!((got - exact).abs() <= 2e-12 * largest, "{dashpot} at {time} s: {got} instead of {exact} m/s");
            }
        }
        assert!(largest > 1e-3, "{largest} m");
    }
}
