//! The first mode of one building, by inverse iteration: x -> K^-1 M x converges to its shape, in less work than all
//! modes take.

use super::modes::NotPositiveDefinite;
use crate::scene::{Building, Stiffness};
use nalgebra::{Cholesky, DMatrix, DVector, Dyn};

/// Each iteration multiplies the error by (w1/w2)^2, for most buildings 1/9.
const MOST_ITERATIONS: usize = 100;
const TOLERANCE: f64 = 1e-9;

/// The lowest natural frequency of a building alone, and how it moves in it.
#[derive(Clone, Debug)]
pub struct FirstMode {
    /// rad/s.
    pub omega: f64,
    /// One entry per floor, of any scale.
    pub shape: Vec<f64>,
}

impl FirstMode {
    /// Of a checked building.
    pub fn of(building: &Building) -> Result<FirstMode, NotPositiveDefinite> {
        let stiffness = building.net_stiffness();
        let flexibility = Flexibility::of(&stiffness)?;
        let mut shape = vec![1.0; building.mass.len()];
        let mut omega2 = f64::INFINITY;
        for _ in 0..MOST_ITERATIONS {
            let forces: Vec<f64> = shape.iter().zip(&building.mass).map(|(x, m)| x * m).collect();
            let deflection = flexibility.deflection(&forces);
            // Rayleigh's quotient of the deflection y: its strain energy is that of the forces, y' M x.
            let strain: f64 = deflection.iter().zip(&forces).map(|(y, force)| y * force).sum();
            let inertia: f64 = deflection.iter().zip(&building.mass).map(|(y, m)| m * y * y).sum();
            let (before, largest) = (omega2, deflection.iter().fold(0.0_f64, |most, y| most.max(y.abs())));
            omega2 = strain / inertia;
            shape = deflection.iter().map(|y| y / largest).collect();
            if (omega2 - before).abs() <= TOLERANCE * omega2 {
                break;
            }
        }
        if omega2 > 0.0 && omega2.is_finite() {
            Ok(FirstMode { omega: omega2.sqrt(), shape })
        } else {
            Err(NotPositiveDefinite)
        }
    }
}

/// What floors do under forces.
enum Flexibility<'a> {
    /// N/m of each storey: it carries the forces of all floors above it.
    Shear(&'a [f64]),
    Matrix(Cholesky<f64, Dyn>),
}

impl<'a> Flexibility<'a> {
    fn of(stiffness: &'a Stiffness) -> Result<Flexibility<'a>, NotPositiveDefinite> {
        match stiffness {
            Stiffness::Shear(storeys) => Ok(Flexibility::Shear(storeys)),
            Stiffness::Matrix(rows) => {
                let n = rows.len();
                let k = DMatrix::from_fn(n, n, |i, j| 0.5 * (rows[i][j] + rows[j][i]));
                Cholesky::new(k).map(Flexibility::Matrix).ok_or(NotPositiveDefinite)
            }
        }
    }

    fn deflection(&self, forces: &[f64]) -> Vec<f64> {
        match self {
            Flexibility::Shear(storeys) => {
                let mut shear: f64 = forces.iter().sum();
                let mut deflection = 0.0;
                let storey = |(k, force): (&f64, &f64)| {
                    deflection += shear / k;
                    shear -= force;
                    deflection
                };
                storeys.iter().zip(forces).map(storey).collect()
            }
            Flexibility::Matrix(factor) => factor.solve(&DVector::from_column_slice(forces)).as_slice().to_vec(),
        }
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use crate::scene::Damping;
    use std::f64::consts::PI;

    fn building(floors: usize, stiffness: Stiffness) -> Building {
        Building::new("left", vec![2.0; floors], stiffness, Damping::Ratio(0.0))
    }

    /// Equal storeys have w1 = 2 sqrt(k/m) sin(pi / (4 n + 2)), and w1^2 of [[2, -1], [-1, 2]] / 2 is 1/2.
    #[test]
    fn the_lowest_frequency_is_that_of_the_closed_form() {
        for n in [1_u32, 2, 5, 80] {
            let first = FirstMode::of(&building(n as usize, Stiffness::Shear(vec![50.0; n as usize]))).unwrap();
            let expected = 2.0 * 5.0 * (PI / f64::from(4 * n + 2)).sin();
            assert!((first.omega / expected - 1.0).abs() < 1e-6, "{n}: {} for {expected}", first.omega);
        }
        let matrix = Stiffness::Matrix(vec![vec![2.0, -1.0], vec![-1.0, 2.0]]);
        let first = FirstMode::of(&building(2, matrix)).unwrap();
        assert!((first.omega - 0.5_f64.sqrt()).abs() < 1e-9, "{}", first.omega);
        assert!((first.shape[0] / first.shape[1] - 1.0).abs() < 1e-6);
    }
}
