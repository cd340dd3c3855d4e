//! The work over a whole flight, found from velocities, against closed forms of other quantities: the energies at both
//! ends, and what the equation of motion integrates to.

use crate::common::scene;
use pounding::structure::{FlightWork, Interval, LANES, Lane, Structure};

/// Two single masses of `omega`, 1/s, and damping ratio.
fn structure([left, right]: [(f64, f64); 2]) -> Structure {
    let building = |side: &str, (omega, ratio): (f64, f64)| {
        format!("[{side}]\nmass = [2.0]\nstiffness = [{:e}]\ndamping = {{ ratio = {ratio} }}\n", 2.0 * omega * omega)
    };
    let scene = scene(&format!("name = \"Two\"\n{}{}", building("left", left), building("right", right)));
    Structure::of(&scene).ok().unwrap()
}

/// The motion at the end of a flight of `length` seconds.
fn end(structure: &Structure, (q, v): (Lane, Lane), load: (f64, f64), length: f64) -> (Lane, Lane) {
    let (mut end_q, mut end_v) = ([0.0; LANES], [0.0; LANES]);
    let participation = &structure.participation;
    Interval::new(structure, length).fly_on_ground((&q, &v), (participation, load), (&mut end_q, &mut end_v));
    (end_q, end_v)
}

const MODES: [[(f64, f64); 2]; 4] =
    [[(1.0, 0.05), (12.0, 0.0)], [(40.0, 0.02), (300.0, 0.5)], [(7.0, 1.0), (5.0, 3.0)], [(0.01, 0.3), (2000.0, 0.05)]];
const LENGTHS: [f64; 6] = [1e-5, 0.005, 0.02, 0.1, 1.0, 40.0];
const START: (Lane, Lane) = ([0.3, -0.02, 0.0, 0.0], [-0.5, 0.8, 0.0, 0.0]);

/// Allowed relative error: an oscillation cannot be better than the rounding of w h.
fn rounding(structure: &Structure, length: f64) -> f64 {
    16.0 * f64::EPSILON * (1.0 + structure.fastest * length)
}

/// The work of the ground less that of damping is what the energy of the motion rises by.
#[test]
fn work_of_the_ground_and_of_damping_balance_the_energy() {
    for (modes, length) in MODES.into_iter().flat_map(|modes| LENGTHS.map(|length| (modes, length))) {
        let structure = structure(modes);
        let work = FlightWork::of(&structure, length).unwrap();
        for load in [(0.0, 0.0), (2.0, 0.0), (0.0, -30.0), (-1.0, 5.0)] {
            let over = work.over((&[START.0], &[START.1]), load);
            let (q, v) = end(&structure, START, load, length);
            let (kinetic, strain) = structure.energies(&START.0, &START.1);
            let (end_kinetic, end_strain) = structure.energies(&q, &v);
            let largest = [kinetic, strain, end_kinetic, end_strain, over.input.abs()].into_iter().fold(0.0, f64::max);
            assert!((over.kinetic - kinetic).abs() <= 1e-15 * kinetic, "{} instead of {kinetic}", over.kinetic);
            assert!((over.strain - strain).abs() <= 1e-15 * strain, "{} instead of {strain}", over.strain);
            assert!(over.viscous >= 0.0, "{} J", over.viscous);
            let balance = kinetic + strain + over.input - over.viscous - end_kinetic - end_strain;
            assert!(
                balance.abs() <= rounding(&structure, length) * largest,
                "{modes:?} over {length} s under {load:?}: {balance} of {largest} J"
            );
        }
    }
}

/// The ground's work is -participation (a (change of q) + s (h q at the end - integral of q)) per mode, and the equation
/// of motion gives the integral of q.
#[test]
fn work_of_the_ground_is_that_of_the_equation_of_motion() {
    for (modes, length) in MODES.into_iter().flat_map(|modes| LENGTHS.map(|length| (modes, length))) {
        let structure = structure(modes);
        let work = FlightWork::of(&structure, length).unwrap();
        for (a, s) in [(2.0, 0.0), (0.0, -30.0), (-1.0, 5.0)] {
            let (q, v) = end(&structure, START, (a, s), length);
            let (mut exact, mut size) = (0.0, 0.0_f64);
            for m in 0..2 {
                let (w2, c, p) = (structure.omega2[m], structure.damping[m], structure.participation[m]);
                let moved = q[m] - START.0[m];
                let pushed = -p * (a * length + 0.5 * s * length * length);
                let terms = [pushed / w2, -c * moved / w2, -(v[m] - START.1[m]) / w2];
                exact -= p * (a * moved + s * (length * q[m] - terms.iter().sum::<f64>()));
                // Differences lose digits of what they are differences of.
                let lost = [length * q[m], pushed / w2, c * q[m] / w2, v[m] / w2, START.1[m] / w2];
                let lost = lost.iter().fold(0.0_f64, |size, term| size.max(term.abs()));
                size = size.max((p * a * q[m].abs().max(START.0[m].abs())).abs()).max((p * s * lost).abs());
            }
            let input = work.over((&[START.0], &[START.1]), (a, s)).input;
            assert!(
                (input - exact).abs() <= rounding(&structure, length) * size,
                "{modes:?} over {length} s: {input} instead of {exact}"
            );
        }
    }
}
