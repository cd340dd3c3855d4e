//! The first step after an entry under a power law, whose force has no Taylor series at d = 0.
//!
//! With d = V t + ... the force goes as t^n, the motion as t^(n+2), the force then as t^(2n+1), and so on: all powers
//! that occur are i + beta j with whole i, j >= 0 and one beta of the law. So the solution is an ordinary power
//! series in two variables, x = t / scale and z = x^beta. It converges where a Taylor series does not exist.
//!
//! Writing d = x e, with e = V + ..., every law is a power of x times an analytic function of e:
//!
//! ```text
//! k d^n (1 + b d')      = x^n e^n (...)              n    = -1 + beta,    beta = n + 1
//! k d^1.5               = x^1.5 e^1.5                1.5  = -1 + 2 beta,  beta = 5/4
//! b d^0.25 d'           = (4/5) b (x^1.25 e^1.25)'   0.25 = -1 + beta
//! ```

use super::force::{Force, power};

/// Most terms of a double series.
pub const MOST_TERMS: usize = 128;
/// Most rows (powers of z).
const MOST_ROWS: usize = 14;

/// Which powers x^(i + beta j) a double series has: those up to `highest`.
#[derive(Clone, Copy, Debug)]
pub struct Grid {
    /// Second exponent.
    pub beta: f64,
    /// Number of rows j.
    pub rows: usize,
    /// First term of each row, and the end of the last.
    starts: [usize; MOST_ROWS + 1],
}

impl Grid {
    /// The grid of a force, with powers up to about `highest`; `None` for a force that has a Taylor series.
    pub fn of(force: &Force, highest: f64) -> Option<Grid> {
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
    pub fn terms(&self) -> usize {
        self.starts[self.rows]
    }

    /// Index of the term x^(i + beta j).
    pub fn index(&self, i: usize, j: usize) -> usize {
        self.starts[j] + i
    }

    /// Highest i in a row.
    pub fn last(&self, j: usize) -> usize {
        self.starts[j + 1] - self.starts[j] - 1
    }

    /// The exponent of a term.
    pub fn exponent(&self, i: usize, j: usize) -> f64 {
        i as f64 + self.beta * j as f64
    }

    /// Value at x of a double series.
    pub fn sum(&self, terms: &[f64], x: f64) -> f64 {
        let z = power(x, self.beta);
        let mut sum = 0.0;
        for j in (0..self.rows).rev() {
            let row = &terms[self.starts[j]..self.starts[j + 1]];
            sum = sum * z + row.iter().rev().fold(0.0, |sum, term| sum * x + term);
        }
        sum
    }

    /// Calls for each term with its index and exponent.
    pub fn each(&self, mut visit: impl FnMut(usize, f64)) {
        for j in 0..self.rows {
            for i in 0..=self.last(j) {
                visit(self.index(i, j), self.exponent(i, j));
            }
        }
    }
}

/// A scalar double series.
type Terms = [f64; MOST_TERMS];

/// What is taken to a power: e of a pair that enters, or d of a pair that is in contact already.
#[derive(Clone, Copy, Debug)]
struct Base {
    terms: Terms,
    /// Each term times its exponent of x.
    slopes: Terms,
}

/// One contact over an onset step.
#[derive(Clone, Copy, Debug)]
pub struct OnsetPair {
    /// m, terms of the penetration.
    pub penetration: Terms,
    /// N, terms of the force times x: row j holds the powers i - 1 + beta j.
    pub force: Terms,
    base: Base,
    power: Terms,
    root: Terms,
    /// Whether the pair enters now: d = 0.
    enters: bool,
}

impl Default for OnsetPair {
    fn default() -> Self {
        let zeros = [0.0; MOST_TERMS];
        OnsetPair {
            penetration: zeros,
            force: zeros,
            base: Base { terms: zeros, slopes: zeros },
            power: zeros,
            root: zeros,
            enters: false,
        }
    }
}

impl OnsetPair {
    /// Starts from a penetration, m, and its rate times the scale, m.
    pub fn start(&mut self, grid: &Grid, penetration: f64, step_rate: f64, enters: bool) {
        self.penetration[..grid.terms()].fill(0.0);
        self.force[..grid.terms()].fill(0.0);
        self.base.terms[..grid.terms()].fill(0.0);
        self.base.slopes[..grid.terms()].fill(0.0);
        self.enters = enters;
        self.set_penetration(grid, 0, 0, penetration);
        self.set_penetration(grid, 1, 0, step_rate);
    }

    /// Enters a term of the penetration.
    pub fn set_penetration(&mut self, grid: &Grid, i: usize, j: usize, value: f64) {
        self.penetration[grid.index(i, j)] = value;
        // e is d a power of x down.
        let shift = usize::from(self.enters);
        if i >= shift {
            let here = grid.index(i - shift, j);
            self.base.terms[here] = value;
            self.base.slopes[here] = grid.exponent(i - shift, j) * value;
        }
    }

    /// The force terms of a row for a pair that enters; they follow from the rows before.
    pub fn extend_entering_row(&mut self, grid: &Grid, force: &Force, j: usize, scale: f64) {
        if j == 0 {
            return;
        }
        match *force {
            Force::None | Force::Linear { .. } => {}
            Force::Power { stiffness, exponent, damping } => {
                self.power_row(grid, exponent, j - 1);
                // x^n e^n (1 + b d') lands one row on, one power of x down: the same i in `force`, which is times x.
                for i in 0..=grid.last(j) {
                    let mut term = self.power[grid.index(i, j - 1)];
                    if damping != 0.0 {
                        term += damping / scale * self.times_rate(grid, i, j - 1);
                    }
                    self.force[grid.index(i, j)] = stiffness * term;
                }
            }
            Force::Root { stiffness, damping } => {
                self.root_row(grid, 1.25, j - 1);
                if j >= 2 {
                    self.power_row(grid, 1.5, j - 2);
                }
                for i in 0..=grid.last(j) {
                    let elastic = if j >= 2 { stiffness * self.power[grid.index(i, j - 2)] } else { 0.0 };
                    let rate = 0.8 * damping / scale * (1.25 + grid.exponent(i, j - 1));
                    self.force[grid.index(i, j)] = elastic + rate * self.root[grid.index(i, j - 1)];
                }
            }
        }
    }

    /// One force term, x^(i + beta j), of a pair that is in contact already.
    pub fn extend_touching(&mut self, grid: &Grid, force: &Force, i: usize, j: usize, scale: f64) {
        let here = grid.index(i, j);
        // The rate's terms: one power of x down from the penetration's.
        let rate = (grid.exponent(i, j) + 1.0) / scale * self.penetration[here + 1];
        let value = match *force {
            Force::None => 0.0,
            Force::Linear { stiffness, damping } => stiffness * self.penetration[here] + damping * rate,
            Force::Power { stiffness, exponent, damping } => {
                extend_power(&mut self.power, &self.base, grid, exponent, i, j);
                let mut term = self.power[here];
                if damping != 0.0 {
                    term += damping / scale * self.times_rate(grid, i, j);
                }
                stiffness * term
            }
            Force::Root { stiffness, damping } => {
                if i == 0 {
                    extend_power(&mut self.root, &self.base, grid, 1.25, 0, j);
                }
                extend_power(&mut self.power, &self.base, grid, 1.5, i, j);
                extend_power(&mut self.root, &self.base, grid, 1.25, i + 1, j);
                let root = (grid.exponent(i, j) + 1.0) / scale * self.root[here + 1];
                stiffness * self.power[here] + 0.8 * damping * root
            }
        };
        if i < grid.last(j) {
            self.force[here + 1] = value;
        }
    }

    fn power_row(&mut self, grid: &Grid, exponent: f64, j: usize) {
        for i in 0..grid.last(j) {
            extend_power(&mut self.power, &self.base, grid, exponent, i, j);
        }
    }

    fn root_row(&mut self, grid: &Grid, exponent: f64, j: usize) {
        for i in 0..grid.last(j) {
            extend_power(&mut self.root, &self.base, grid, exponent, i, j);
        }
    }

    /// Term (i, j) of power times d' (in units of the scale).
    fn times_rate(&self, grid: &Grid, i: usize, j: usize) -> f64 {
        let mut sum = 0.0;
        for row in 0..=j {
            for k in 0..=i {
                // d' has (exponent) times the penetration's term one power of x up.
                let rate = (grid.exponent(k, row) + 1.0) * self.penetration[grid.index(k + 1, row)];
                sum += rate * self.power[grid.index(i - k, j - row)];
            }
        }
        sum
    }
}

/// Term (i, j) of base^exponent (Miller's recurrence for x d/dx): with s the exponent of x in a term,
/// s p_c b_0 = sum over a > 0 of (exponent s_a - s_(c-a)) b_a p_(c-a), where s_(c-a) = s - s_a.
fn extend_power(power: &mut Terms, base: &Base, grid: &Grid, exponent: f64, i: usize, j: usize) {
    if i == 0 && j == 0 {
        power[0] = super::force::power(base.terms[0], exponent);
        return;
    }
    let (mut whole, mut weighted) = (0.0, 0.0);
    for row in 0..=j {
        let (from, against) = (grid.index(0, row), grid.index(0, j - row));
        let first = usize::from(row == 0);
        let (terms, slopes) = (&base.terms[from + first..=from + i], &base.slopes[from + first..=from + i]);
        let powers = &power[against..=against + i - first];
        for ((term, slope), power) in terms.iter().zip(slopes).zip(powers.iter().rev()) {
            whole += term * power;
            weighted += slope * power;
        }
    }
    let s = grid.exponent(i, j);
    power[grid.index(i, j)] = ((exponent + 1.0) / s * weighted - whole) / base.terms[0];
}

/// Value and slope at x of a double series.
pub fn value_and_slope(grid: &Grid, terms: &[f64], x: f64) -> (f64, f64) {
    let ([value], [slope]) = values_and_slopes(grid, terms, &[x]);
    (value, slope)
}

/// The same at some x side by side.
pub fn values_and_slopes<const N: usize>(grid: &Grid, terms: &[f64], x: &[f64; N]) -> ([f64; N], [f64; N]) {
    let z = x.map(|x| power(x, grid.beta));
    let (mut value, mut slope, mut factor) = ([0.0; N], [0.0; N], [1.0; N]);
    for j in 0..grid.rows {
        let row = &terms[grid.index(0, j)..=grid.index(grid.last(j), j)];
        let shift = grid.beta * j as f64;
        let (mut r, mut s) = ([0.0; N], [0.0; N]);
        for (i, term) in row.iter().enumerate().rev() {
            let rate = (i as f64 + shift) * term;
            for k in 0..N {
                r[k] = r[k] * x[k] + term;
                s[k] = s[k] * x[k] + rate;
            }
        }
        for k in 0..N {
            value[k] += factor[k] * r[k];
            slope[k] += factor[k] * s[k];
            factor[k] *= z[k];
        }
    }
    for k in 0..N {
        slope[k] /= x[k];
    }
    (value, slope)
}
