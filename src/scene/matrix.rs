//! Rules about the matrices of a building.

use super::checker::Checker;
use super::problem::{count, matrix_text, number};
use super::rule;
use nalgebra::{DMatrix, SymmetricEigen};

/// Relative to the largest entry or eigenvalue: the digits that are lost when a program prints a computed matrix, and
/// no more.
const ROUNDING: f64 = 1e-12;

/// What a matrix must be besides symmetric.
pub(super) struct Definiteness {
    name: &'static str,
    unit: &'static str,
    /// Of the smallest and the largest eigenvalue.
    holds: fn(f64, f64) -> bool,
}

/// Of a stiffness matrix: no motion without a restoring force.
pub(super) const STIFFNESS: Definiteness = Definiteness { name: "positive definite", unit: "N/m", holds: is_positive };

/// Of a damping matrix: no motion that gains energy.
pub(super) const DAMPING: Definiteness = Definiteness {
    name: "positive semidefinite",
    unit: "N s/m",
    holds: |smallest, largest| smallest >= -ROUNDING * largest.abs(),
};

/// Whether a matrix with these eigenvalues is positive definite beyond rounding.
pub(super) fn is_positive(smallest: f64, largest: f64) -> bool {
    smallest > ROUNDING * largest
}

/// Whether rows are a finite symmetric matrix of that size.
pub(super) fn is_symmetric(rows: &[Vec<f64>], size: usize) -> bool {
    let allowed = ROUNDING * largest_entry(rows);
    let is_square = rows.len() == size && rows.iter().all(|row| row.len() == size);
    is_square && (0..size).all(|i| (0..=i).all(|j| (rows[i][j] - rows[j][i]).abs() <= allowed))
}

impl Checker {
    /// One row and column per floor, finite, symmetric and definite; each is looked at where the ones before hold.
    pub(super) fn matrix(&mut self, path: &str, rows: &[Vec<f64>], floors: usize, definiteness: Definiteness) {
        let sound = floors <= rule::MOST_FLOORS
            && self.shape(path, rows, floors)
            && self.entries(path, rows)
            && self.symmetry(path, rows);
        if !sound {
            return;
        }
        let [smallest, largest] = extreme_eigenvalues(rows);
        if !(definiteness.holds)(smallest, largest) {
            let Definiteness { name, unit, .. } = definiteness;
            let [smallest, largest] = [smallest, largest].map(|value| self.six_digits(value));
            let unit = self.units.unit(unit);
            let expected = format!("a {name} matrix, but its eigenvalues go from {smallest} to {largest} {unit}");
            self.refuse(path, self.text(rows), expected);
        }
    }

    fn shape(&mut self, path: &str, rows: &[Vec<f64>], floors: usize) -> bool {
        let size = if floors > 0 { floors } else { rows.len() };
        let mut square = rows.len() == size && size > 0;
        if rows.len() != size {
            self.refuse(path, self.text(rows), format!("{}, one per floor, not {}", count(size, "row"), rows.len()));
        }
        // The rows of a square matrix of another size are wrong as a whole, which has been said.
        let is_wrong = |row: &[f64]| row.len() != size && row.len() != rows.len();
        for (i, row) in rows.iter().enumerate().filter(|(_, row)| is_wrong(row)) {
            let expected = format!("{}, one per floor, not {}", count(size, "number"), row.len());
            self.refuse(format_args!("{path}[{}]", i + 1), self.written(row, rule::FORCE_ENTRY), expected);
            square = false;
        }
        square
    }

    fn entries(&mut self, path: &str, rows: &[Vec<f64>]) -> bool {
        for (i, row) in rows.iter().enumerate() {
            self.numbers(format_args!("{path}[{}]", i + 1), row, rule::FORCE_ENTRY);
        }
        rows.iter().flatten().all(|&entry| rule::FORCE_ENTRY.holds(entry))
    }

    fn text(&self, rows: &[Vec<f64>]) -> String {
        matrix_text(rows, self.units)
    }

    /// Every entry below the diagonal is compared with the one above.
    fn symmetry(&mut self, path: &str, rows: &[Vec<f64>]) -> bool {
        let allowed = ROUNDING * largest_entry(rows);
        let mut symmetric = true;
        for (i, row) in rows.iter().enumerate() {
            for (j, (&below, upper)) in row.iter().zip(rows).enumerate().take(i) {
                let above = upper.get(i).copied().unwrap_or(f64::NAN);
                if (below - above).abs() <= allowed {
                    continue;
                }
                let [above, below] = [above, below].map(|entry| number(self.units.written(entry)));
                let expected = format!("{above}, as in [{}][{}]: a symmetric matrix", j + 1, i + 1);
                self.refuse(format_args!("{path}[{}][{}]", i + 1, j + 1), below, expected);
                symmetric = false;
            }
        }
        symmetric
    }
}

fn largest_entry(rows: &[Vec<f64>]) -> f64 {
    rows.iter().flatten().fold(0.0, |largest: f64, entry| largest.max(entry.abs()))
}

/// The smallest and the largest eigenvalue of a symmetric matrix; NaN, which no rule allows, where they are not found.
pub(super) fn extreme_eigenvalues(rows: &[Vec<f64>]) -> [f64; 2] {
    const ITERATIONS_PER_ROW: usize = 100;
    let size = rows.len();
    let scale = largest_entry(rows);
    if scale == 0.0 {
        return [0.0, 0.0];
    }
    // Scaled, so that no square in the iteration leaves the range of numbers.
    let scaled = DMatrix::from_row_iterator(size, size, rows.iter().flatten().map(|entry| entry / scale));
    match SymmetricEigen::try_new(scaled, f64::EPSILON, ITERATIONS_PER_ROW * size) {
        Some(eigen) => [eigen.eigenvalues.min() * scale, eigen.eigenvalues.max() * scale],
        None => [f64::NAN, f64::NAN],
    }
}
