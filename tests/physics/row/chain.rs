//! Masses that lean on each other and on a wall for ever: power laws in series.

use crate::common::{Run, record, scene};
use nalgebra::{DMatrix, DVector};
use pounding::engine::BuildingId;

const MASS: [f64; 3] = [3e4, 2e4, 5e4];
const STIFFNESS: [f64; 3] = [4e6, 7e6, 5e6];
const GAPS: [f64; 3] = [0.002, 0.001, 0.003];
const HERTZ: f64 = 2e9;
/// m/s2, of the ground: to the left, so that all are pressed to the right, against the wall.
const PULL: f64 = -4.0;

/// Where they rest: k u + F - F of the left neighbour = m a with F = K d^1.5, by Newton's method.
fn at_rest() -> DVector<f64> {
    let mut u = DVector::from_iterator(3, MASS.iter().zip(STIFFNESS).map(|(m, k)| -m * PULL / k));
    for _ in 0..60 {
        let penetration = |i: usize| (u[i] - u.get(i + 1).copied().unwrap_or(0.0) - GAPS[i]).max(0.0);
        let force = |i: usize| HERTZ * penetration(i).powf(1.5);
        let slope = |i: usize| 1.5 * HERTZ * penetration(i).sqrt();
        let left = |i: usize, of: &dyn Fn(usize) -> f64| i.checked_sub(1).map_or(0.0, of);
        let residual = DVector::from_fn(3, |i, _| STIFFNESS[i] * u[i] + force(i) - left(i, &force) + MASS[i] * PULL);
        let tangent = DMatrix::from_fn(3, 3, |i, j| match () {
            () if i == j => STIFFNESS[i] + slope(i) + left(i, &slope),
            () if j == i + 1 => -slope(i),
            () if i == j + 1 => -slope(j),
            () => 0.0,
        });
        u -= tangent.lu().solve(&residual).unwrap();
    }
    u
}

#[test]
fn three_lean_on_each_other_and_on_a_wall() {
    let building = |i: usize| {
        format!("[[building]]\nmass = [{:?}]\nstiffness = [{:?}]\ndamping = {{ ratio = 0.1 }}\n", MASS[i], STIFFNESS[i])
    };
    let law = format!("law = \"hertz\"\nstiffness = {HERTZ:?}\n");
    let wall = format!("[[contact]]\nleft = \"b3\"\nleft_floor = 1\nwall = \"right\"\ngap = {:?}\n{law}", GAPS[2]);
    let contacts = [0, 1].map(|pair| super::contact(pair, 1, GAPS[pair], &law)).concat() + &wall;
    let buildings = [0, 1, 2].map(building).concat();
    let text = format!("name = \"Chain\"\nground = {{ record = \"r.csv\" }}\n{buildings}{contacts}");
    // The ground is pulled away slowly, and for ever.
    let pull: Vec<f64> = (0..=400).map(|k| PULL * f64::min(f64::from(k) / 100.0, 1.0)).collect();
    let mut run = Run::new(&scene(&text), Some(&record(0.2, &pull)));
    run.to(75.0);
    let expected = at_rest();
    assert!(expected[0] - expected[1] > GAPS[0] && expected[2] > GAPS[2], "all are pressed");
    for (place, expected) in expected.iter().enumerate() {
        let got = run.displacement(BuildingId::new(place), 0);
        assert!((got / expected - 1.0).abs() < 1e-12, "building {place}: {got:e} instead of {expected:e}");
    }
}
