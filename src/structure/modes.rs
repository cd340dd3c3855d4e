//! Natural frequencies and mode shapes of one building, to the last digits that double precision holds.

use crate::scene::{Building, Damping, Stiffness};
use nalgebra::{Cholesky, DMatrix, DVector, SymmetricEigen};

/// The modes of one building, mass-normalised: shape' M shape = I.
#[derive(Clone, Debug)]
pub struct Modes {
    /// rad/s, ascending.
    pub omega: Vec<f64>,
    /// Floors x modes, kg^-1/2.
    pub shape: DMatrix<f64>,
    /// kg^1/2: shape' M 1, what a unit ground acceleration pushes in each mode.
    pub participation: Vec<f64>,
    /// 1/s, shape' C shape.
    pub damping: ModalDamping,
}

/// Damping in modal coordinates, 1/s.
#[derive(Clone, Debug, PartialEq)]
pub enum ModalDamping {
    /// Classical: 2 zeta omega of each mode.
    Diagonal(Vec<f64>),
    /// The modes are coupled by damping.
    Coupled(DMatrix<f64>),
}

impl ModalDamping {
    /// As a full matrix.
    pub(super) fn matrix(&self) -> DMatrix<f64> {
        match self {
            ModalDamping::Diagonal(c) => DMatrix::from_diagonal(&DVector::from_column_slice(c)),
            ModalDamping::Coupled(c) => c.clone(),
        }
    }
}

/// A stiffness matrix is not positive definite.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NotPositiveDefinite;

impl Modes {
    /// Solves K shape = M shape omega^2.
    pub fn of(building: &Building) -> Result<Modes, NotPositiveDefinite> {
        let mass = DVector::from_column_slice(&building.mass);
        let (omega, shape) = solve(&mass, &stiffness_factor(&building.net_stiffness())?)?;
        let participation = shape.tr_mul(&mass).as_slice().to_vec();
        let damping = modal_damping(&building.damping, &omega, &shape);
        Ok(Modes { omega, shape, participation, damping })
    }
}

/// Frequencies and shapes of K = R'R from the factor R.
///
/// nalgebra's symmetric eigenvalue solver is accurate relative to the *largest* frequency. One step of the
/// refinement of Ogita and Aishima (2018), on a factor R of K = R'R instead of K itself, makes the lowest
/// frequencies as accurate: they carry the motion, and their error grows with time.
pub(super) fn solve(
    mass: &DVector<f64>,
    factor: &DMatrix<f64>,
) -> Result<(Vec<f64>, DMatrix<f64>), NotPositiveDefinite> {
    let root_mass = mass.map(f64::sqrt);
    let scaled = DMatrix::from_fn(factor.nrows(), factor.ncols(), |i, j| factor[(i, j)] / root_mass[j]);
    let eigen = SymmetricEigen::new(scaled.transpose() * &scaled);
    let mut order: Vec<usize> = (0..mass.len()).collect();
    order.sort_by(|&a, &b| eigen.eigenvalues[a].total_cmp(&eigen.eigenvalues[b]));
    let mut shape = DMatrix::from_fn(mass.len(), mass.len(), |i, j| eigen.eigenvectors[(i, order[j])] / root_mass[i]);
    let mut omega2 = vec![0.0; mass.len()];
    for _ in 0..2 {
        omega2 = refine(&mut shape, factor, mass);
    }
    if omega2.iter().any(|&w2| w2 <= 0.0 || !w2.is_finite()) {
        return Err(NotPositiveDefinite);
    }
    for mut column in shape.column_iter_mut() {
        // The sign of a shape is free: the top floor moves to the right.
        if column[column.len() - 1] < 0.0 {
            column.neg_mut();
        }
    }
    Ok((omega2.iter().map(|w2| w2.sqrt()).collect(), shape))
}

impl Modes {
    /// Whether no other mode has nearly the frequency of this one.
    pub fn is_single(&self, mode: usize) -> bool {
        let near = |w: f64| (w - self.omega[mode]).abs() <= 1e-6 * self.omega[mode];
        self.omega.iter().filter(|w| near(**w)).count() == 1
    }
}

/// R with K = R'R: sqrt(k) times the drifts of a shear building, else the Cholesky factor.
pub(super) fn stiffness_factor(stiffness: &Stiffness) -> Result<DMatrix<f64>, NotPositiveDefinite> {
    match stiffness {
        Stiffness::Shear(k) => {
            let mut factor = drifts(k.len());
            factor.row_iter_mut().zip(k).for_each(|(mut row, k)| row *= k.sqrt());
            Ok(factor)
        }
        Stiffness::Matrix(rows) => {
            let n = rows.len();
            let k = DMatrix::from_fn(n, n, |i, j| 0.5 * (rows[i][j] + rows[j][i]));
            Ok(Cholesky::new(k).ok_or(NotPositiveDefinite)?.l().transpose())
        }
    }
}

/// The drifts of all storeys from the displacements of all floors.
fn drifts(floors: usize) -> DMatrix<f64> {
    DMatrix::from_fn(floors, floors, |storey, floor| match storey {
        _ if storey == floor => 1.0,
        _ if storey == floor + 1 => -1.0,
        _ => 0.0,
    })
}

/// One step of refinement of all shapes at once; returns the squared frequencies.
fn refine(shape: &mut DMatrix<f64>, factor: &DMatrix<f64>, mass: &DVector<f64>) -> Vec<f64> {
    let n = mass.len();
    let strain = factor * &*shape;
    let stiffness = strain.tr_mul(&strain);
    let weighted = DMatrix::from_fn(n, n, |i, j| mass[i] * shape[(i, j)]);
    let inertia = shape.tr_mul(&weighted);
    let omega2: Vec<f64> = (0..n).map(|j| stiffness[(j, j)] / inertia[(j, j)]).collect();
    let correction = DMatrix::from_fn(n, n, |i, j| {
        let apart = omega2[j] - omega2[i];
        if i == j {
            0.5 * (1.0 - inertia[(j, j)])
        } else if apart.abs() > 1e-7 * omega2[j].max(omega2[i]) {
            (stiffness[(i, j)] - omega2[j] * inertia[(i, j)]) / apart
        } else {
            // Nearly equal frequencies: any orthonormal pair will do, so only restore orthogonality.
            -0.5 * inertia[(i, j)]
        }
    });
    *shape += &*shape * correction;
    omega2
}

/// Factors of mass, 1/s, and stiffness, s, for a ratio of critical damping in two modes, counted from 1:
/// alpha + beta w^2 = 2 ratio w at both frequencies (Chopra, Dynamics of Structures, sec. 11.4).
pub(super) fn rayleigh_factors(ratio: f64, [i, j]: [usize; 2], omega: &[f64]) -> (f64, f64) {
    let (wi, wj) = (omega[i - 1], omega[j - 1]);
    (2.0 * ratio * wi * wj / (wi + wj), 2.0 * ratio / (wi + wj))
}

fn modal_damping(damping: &Damping, omega: &[f64], shape: &DMatrix<f64>) -> ModalDamping {
    match damping {
        Damping::Ratio(ratio) => ModalDamping::Diagonal(omega.iter().map(|w| 2.0 * ratio * w).collect()),
        Damping::Ratios(ratios) => {
            ModalDamping::Diagonal(omega.iter().zip(ratios).map(|(w, ratio)| 2.0 * ratio * w).collect())
        }
        Damping::Rayleigh { ratio, modes } => {
            let (alpha, beta) = rayleigh_factors(*ratio, *modes, omega);
            ModalDamping::Diagonal(omega.iter().map(|w| alpha + beta * w * w).collect())
        }
        Damping::Dashpots(storeys) => {
            let drift = drifts(storeys.len()) * shape;
            let weighted =
                DMatrix::from_fn(drift.nrows(), drift.ncols(), |storey, m| storeys[storey] * drift[(storey, m)]);
            classical_or_coupled(drift.tr_mul(&weighted))
        }
        Damping::Matrix(rows) => {
            let n = rows.len();
            let c = DMatrix::from_fn(n, n, |i, j| 0.5 * (rows[i][j] + rows[j][i]));
            classical_or_coupled(shape.tr_mul(&(c * shape)))
        }
    }
}

/// Off-diagonal terms at the level of rounding are none.
fn classical_or_coupled(modal: DMatrix<f64>) -> ModalDamping {
    let n = modal.nrows();
    let coupled = (0..n)
        .any(|i| (0..n).any(|j| i != j && modal[(i, j)].abs() > 1e-13 * (modal[(i, i)] * modal[(j, j)]).abs().sqrt()));
    if coupled { ModalDamping::Coupled(modal) } else { ModalDamping::Diagonal(modal.diagonal().as_slice().to_vec()) }
}
