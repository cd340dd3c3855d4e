//! The distance of a pair of floors apart from contact, over some time, as a polynomial: one row over the modes for each
//! power, prepared once, instead of a series of all modes.

use super::equations::Structure;
use super::lanes::{LANES, Lane};
use super::mode_polynomials::{POLYNOMIAL_TERMS, PolynomialMaker};
use super::motion::{LinearGround, Motion};
use crate::numerics::polynomial::each;
use std::array::from_fn;

/// The rows of some pairs over a length of time.
#[derive(Clone, Debug)]
pub struct FreeRows {
    /// s: the unit of time of the powers, and the time up to which the polynomials are good.
    pub length: f64,
    pairs: Vec<PairRows>,
}

/// Blocks of powers.
const BLOCKS: usize = POLYNOMIAL_TERMS / LANES;

/// The rows of one pair; those of the first two powers, which are the distance and its rate, are empty.
#[derive(Clone, Debug)]
struct PairRows {
    /// All powers by the displacement of a mode and by its velocity, mode by mode.
    by_motion: Vec<[[Lane; BLOCKS]; 2]>,
    /// For the ground acceleration and its slope.
    by_ground: [[f64; POLYNOMIAL_TERMS]; 2],
}

impl FreeRows {
    /// Number of terms of a polynomial.
    pub const TERMS: usize = POLYNOMIAL_TERMS;

    /// For the rows of the modal Jacobian of some pairs, where damping couples no modes.
    pub fn new<'a>(structure: &Structure, pairs: impl Iterator<Item = &'a [f64]>, length: f64) -> FreeRows {
        let maker = PolynomialMaker::new(length);
        let mode = |m: usize| maker.mode(structure.omega2[m], structure.damping[m]).of;
        let modes: Vec<_> = (0..structure.lanes).map(mode).collect();
        let pair = |row: &[f64]| {
            let entry = |of: usize, n: usize, m: usize| if n < 2 { 0.0 } else { row[m] * modes[m][of][n] };
            let powers = |of: usize, m: usize| from_fn(|c| each(|i| entry(of, LANES * c + i, m)));
            let by_motion = (0..row.len()).map(|m| [powers(0, m), powers(1, m)]).collect();
            let share = |of: usize, n: usize| {
                structure.participation.iter().enumerate().map(|(m, share)| -entry(of, n, m) * share).sum()
            };
            let by_ground = [2, 3].map(|of| from_fn(|n| share(of, n)));
            PairRows { by_motion, by_ground }
        };
        FreeRows { length, pairs: pairs.map(pair).collect() }
    }

    /// Writes the terms of a pair's distance from power 2 on, m, from the motion at the start, the ground acceleration
    /// there, m/s2, and its slope.
    pub fn enter(&self, pair: usize, Motion { q, v }: Motion, ground: LinearGround, out: &mut [f64]) {
        let PairRows { by_motion, by_ground: [by_acceleration, by_slope] } = &self.pairs[pair];
        let mut terms = add_up(by_motion, q, v);
        let by_ground = by_acceleration.as_chunks::<LANES>().0.iter().zip(by_slope.as_chunks::<LANES>().0);
        for (terms, (by_acceleration, by_slope)) in terms.iter_mut().zip(by_ground) {
            *terms = each(|i| terms[i] + (by_acceleration[i] * ground.acceleration + by_slope[i] * ground.slope));
        }
        out[2..POLYNOMIAL_TERMS].copy_from_slice(&terms.as_flattened()[2..]);
    }
}

/// The sums over all modes.
#[multiversion::multiversion(targets("x86_64+avx2"))]
fn add_up(rows: &[[[Lane; BLOCKS]; 2]], q: &[f64], v: &[f64]) -> [Lane; BLOCKS] {
    let (mut moved, mut moving) = ([[0.0; LANES]; BLOCKS], [[0.0; LANES]; BLOCKS]);
    for (([by_q, by_v], q), v) in rows.iter().zip(q).zip(v) {
        for c in 0..BLOCKS {
            for i in 0..LANES {
                moved[c][i] += by_q[c][i] * q;
            }
        }
        for c in 0..BLOCKS {
            for i in 0..LANES {
                moving[c][i] += by_v[c][i] * v;
            }
        }
    }
    for c in 0..BLOCKS {
        for i in 0..LANES {
            moved[c][i] += moving[c][i];
        }
    }
    moved
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::scene::Scene;
    use crate::structure::{Interval, LinearLoad, MotionMut, Scratch, dot};

    /// Both buildings flown exactly to some times, against the polynomial of a distance between their floors.
    #[test]
    fn they_are_the_distance_of_buildings_that_fly() {
        let building = |n: usize, stiffness: f64| {
            let damping = "damping = { rayleigh = { ratio = 0.05, modes = [1, 2] } }";
            format!("mass = {:?}\nstiffness = {:?}\n{damping}", vec![2.0; n], vec![stiffness; n])
        };
        let text = format!("name = \"Two\"\n[left]\n{}\n[right]\n{}", building(14, 900.0), building(11, 500.0));
        let scene = Scene::from_toml(&text).unwrap();
        let structure = Structure::of(&scene).unwrap();
        let length = 6.0 / structure.fastest;
        let vector = |seed: f64| (0..structure.lanes).map(|m| (seed + 1.3 * m as f64).sin()).collect::<Vec<_>>();
        let (mut row, q, v) = (vector(0.1), vector(0.7), vector(1.9));
        // Lanes that are no modes stay at rest.
        row.iter_mut().zip(&structure.omega2).for_each(|(row, omega2)| *row *= f64::from(*omega2 > 0.0));
        let rows = FreeRows::new(&structure, [&row[..]].into_iter(), length);
        let (acceleration, slope) = (2.5, -40.0);
        let mut terms = [dot(&row, &q), dot(&row, &v) * length].to_vec();
        terms.resize(FreeRows::TERMS, f64::NAN);
        let motion = Motion { q: &q, v: &v };
        rows.enter(0, motion, LinearGround { acceleration, slope }, &mut terms);
        let [load, rate] =
            [acceleration, slope].map(|a| structure.participation.iter().map(|p| -p * a).collect::<Vec<_>>());
        let loads = LinearLoad { load: &load, slope: &rate };
        let (mut end_q, mut end_v) = (vector(0.0), vector(0.0));
        for i in 1..=20 {
            let x = f64::from(i) / 20.0;
            let interval = Interval::new(&structure, x * length);
            let end = MotionMut { q: &mut end_q, v: &mut end_v };
            interval.fly(motion, loads, end, &mut Scratch::new(structure.lanes));
            let value = terms.iter().rev().fold(0.0, |sum, term| sum * x + term);
            let exact = dot(&row, &end_q);
            assert!((value - exact).abs() < 2e-13, "{value} instead of {exact} at {x}");
        }
    }
}
