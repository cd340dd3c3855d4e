//! Which powers a double series has, where its terms are, and which products make up a power of it.

use crate::contact::force::{Force, power};

/// Most terms of a double series.
pub(crate) const MOST_TERMS: usize = 64;
/// Most rows (powers of z).
const MOST_ROWS: usize = 12;

/// Which powers x^(i + beta j) a double series has: those up to `highest`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Grid {
    /// Second exponent.
    pub beta: f64,
    /// Number of rows j.
    pub rows: usize,
    /// First term of each row, and the end of the last.
    starts: [usize; MOST_ROWS + 1],
}

impl Grid {
    /// The grid of a force, with powers up to about `highest`; `None` for a force that has a Taylor series.
    pub(crate) fn of(force: &Force, highest: f64) -> Option<Grid> {
        let beta = match *force {
            Force::None | Force::Linear { .. } => return None,
            Force::Power { exponent, .. } => exponent + 1.0,
            Force::Root { .. } => 1.25,
        };
        let mut grid = Grid { beta, rows: 0, starts: [0; MOST_ROWS + 1] };
        while grid.rows < MOST_ROWS {
            let left = highest - beta * grid.rows as f64;
            let next = grid.starts[grid.rows] + left.max(0.0) as usize + 1;
            if left < 2.0 || next > MOST_TERMS {
                break;
            }
            grid.rows += 1;
            grid.starts[grid.rows] = next;
        }
        Some(grid)
    }

    /// Number of terms.
    pub(crate) fn terms(&self) -> usize {
        self.starts[self.rows]
    }

    /// Index of the term x^(i + beta j).
    pub(crate) fn index(&self, i: usize, j: usize) -> usize {
        self.starts[j] + i
    }

    /// Highest i in a row.
    pub(crate) fn last(&self, j: usize) -> usize {
        self.starts[j + 1] - self.starts[j] - 1
    }

    /// The exponent of a term.
    pub(crate) fn exponent(&self, i: usize, j: usize) -> f64 {
        i as f64 + self.beta * j as f64
    }

    /// Value at x of a double series.
    pub(crate) fn sum(&self, terms: &[f64], x: f64) -> f64 {
        let z = power(x, self.beta);
        let mut sum = 0.0;
        for j in (0..self.rows).rev() {
            let row = &terms[self.starts[j]..self.starts[j + 1]];
            sum = sum * z + row.iter().rev().fold(0.0, |sum, term| sum * x + term);
        }
        sum
    }

    /// Calls for each term with its index and exponent.
    pub(crate) fn each(&self, mut visit: impl FnMut(usize, f64)) {
        for j in 0..self.rows {
            for i in 0..=self.last(j) {
                visit(self.index(i, j), self.exponent(i, j));
            }
        }
    }
}

/// Most products of all terms of a power: up to x^8 they are some 270 for the smallest beta, 5/4.
const MOST_PRODUCTS: usize = 320;

/// For each term of a power b^n of b = e or d: the products of a term of b and a term of b^n that Miller's recurrence
/// sums, without those with b_0.
#[derive(Clone, Debug, Default)]
pub(crate) struct Products {
    /// Indices of both factors, for one term after the other.
    places: Vec<[u8; 2]>,
    /// Where each term's begin, and the end of the last.
    starts: Vec<usize>,
}

impl Products {
    /// Room for any grid.
    pub(crate) fn room() -> Products {
        Products { places: vec![[0; 2]; MOST_PRODUCTS], starts: vec![0; MOST_TERMS + 1] }
    }

    /// Those of a grid, for pairs that enter or that touch already.
    pub(crate) fn set(&mut self, grid: &Grid, enters: bool) {
        let mut count = 0;
        for j in 0..grid.rows {
            let last = if enters { grid.last(j) } else { grid.last(j) + 1 };
            for i in 0..last {
                self.starts[grid.index(i, j)] = count;
                for row in 0..=j {
                    // Only e and its powers have terms in x^(beta row) alone.
                    let first = usize::from(row == 0 || !enters);
                    let end = if enters || row == j { i + 1 } else { i };
                    for a in first..end {
                        let factor = grid.index(a, row) + usize::from(enters);
                        self.places[count] = [factor as u8, grid.index(i - a, j - row) as u8];
                        count += 1;
                    }
                }
            }
            self.starts[grid.index(last, j)] = count;
        }
    }

    /// Indices of the factors of the products for a term.
    #[inline(always)]
    pub(crate) fn of(&self, place: usize) -> impl Iterator<Item = (usize, usize)> {
        let places = &self.places[self.starts[place]..self.starts[place + 1]];
        // The remainder keeps indices in range without a check; it changes none.
        places.iter().map(|[factor, other]| (usize::from(*factor) % MOST_TERMS, usize::from(*other) % MOST_TERMS))
    }
}

/// A scalar double series.
pub(crate) type GridTerms = [f64; MOST_TERMS];

/// The powers of x of a grid, and what derivatives and integrals need.
#[derive(Clone, Debug)]
pub(crate) struct GridPowers {
    /// x > 0.
    pub x: f64,
    pub(super) terms: usize,
    /// x^e of each exponent e.
    pub(super) value: GridTerms,
    /// e x^(e-1).
    pub(super) slope: GridTerms,
    /// x^e / e; 0 for e = 0.
    pub(super) primitive: GridTerms,
}

impl Default for GridPowers {
    fn default() -> Self {
        let zeros = [0.0; MOST_TERMS];
        GridPowers { x: 0.0, terms: 0, value: zeros, slope: zeros, primitive: zeros }
    }
}

impl GridPowers {
    /// Tables for x > 0.
    pub(crate) fn at(grid: &Grid, x: f64) -> GridPowers {
        let mut powers = GridPowers::default();
        powers.set(grid, x);
        powers
    }

    /// The same in place.
    pub(crate) fn set(&mut self, grid: &Grid, x: f64) {
        (self.x, self.terms) = (x, grid.terms());
        let (z, inverse) = (power(x, grid.beta), 1.0 / x);
        let mut shift = 0.0;
        let mut first = 1.0;
        for j in 0..grid.rows {
            let mut value = first;
            for (i, place) in (grid.index(0, j)..=grid.index(grid.last(j), j)).enumerate() {
                let exponent = shift + i as f64;
                self.value[place] = value;
                self.slope[place] = exponent * (value * inverse);
                self.primitive[place] = if exponent > 0.0 { value / exponent } else { 0.0 };
                value *= x;
            }
            first *= z;
            shift += grid.beta;
        }
    }

    /// x^e and e x^(e-1) of each exponent e.
    pub(crate) fn all(&self) -> (&[f64], &[f64]) {
        (&self.value[..self.terms], &self.slope[..self.terms])
    }
}

/// A double series at some x > 0 side by side, and its first derivatives by x.
#[multiversion::multiversion(targets("x86_64+avx2"))]
pub fn derivatives<const N: usize, const K: usize>(grid: &Grid, terms: &[f64], x: &[f64; N]) -> [[f64; N]; K] {
    let z = x.map(|x| power(x, grid.beta));
    let (mut all, mut factor) = ([[0.0; N]; K], [1.0; N]);
    for j in 0..grid.rows {
        let row = &terms[grid.index(0, j)..=grid.index(grid.last(j), j)];
        let (shift, mut own) = (grid.beta * j as f64, [[0.0; N]; K]);
        for (i, term) in row.iter().enumerate().rev() {
            let mut term = *term;
            for (k, own) in own.iter_mut().enumerate() {
                *own = std::array::from_fn(|n| own[n] * x[n] + term);
                term *= i as f64 + shift - k as f64;
            }
        }
        for k in 0..K {
            all[k] = std::array::from_fn(|n| all[k][n] + factor[n] * own[k][n]);
        }
        factor = std::array::from_fn(|n| factor[n] * z[n]);
    }
    for (k, all) in all.iter_mut().enumerate().skip(1) {
        *all = std::array::from_fn(|n| all[n] / x[n].powi(k as i32));
    }
    all
}
