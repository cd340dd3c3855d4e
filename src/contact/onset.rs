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
use super::series::{Each, Kind, PAIRS, ROOT};
use crate::numerics::polynomial::each;

/// Most terms of a double series.
pub const MOST_TERMS: usize = 64;
/// Most rows (powers of z).
const MOST_ROWS: usize = 12;

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

/// Most products of all terms of a power: up to x^8 they are some 270 for the smallest beta, 5/4.
const MOST_PRODUCTS: usize = 320;

/// Which products of a term of e or d and one of its power make up each term of that power, but those with b_0.
#[derive(Clone, Debug, Default)]
pub struct Products {
    /// Places of both, for one term after the other.
    places: Vec<[u8; 2]>,
    /// Where each term's begin, and the end of the last.
    starts: Vec<usize>,
}

impl Products {
    /// Room for any grid.
    pub fn room() -> Products {
        Products { places: vec![[0; 2]; MOST_PRODUCTS], starts: vec![0; MOST_TERMS + 1] }
    }

    /// Those of a grid, for pairs that enter or that touch already.
    pub fn set(&mut self, grid: &Grid, enters: bool) {
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

    /// Places of the factors of the products for a term.
    #[inline(always)]
    fn of(&self, place: usize) -> impl Iterator<Item = (usize, usize)> {
        let places = &self.places[self.starts[place]..self.starts[place + 1]];
        // Says that no place leaves its table.
        places.iter().map(|[factor, other]| (usize::from(*factor) % MOST_TERMS, usize::from(*other) % MOST_TERMS))
    }
}

/// A scalar double series.
pub type Terms = [f64; MOST_TERMS];

/// A double series of each pair.
type Rows = [Each; MOST_TERMS];

/// Up to [`PAIRS`] contacts of one kind over an onset step, all of which enter or all of which touch already.
#[derive(Clone, Debug)]
pub struct OnsetBlock {
    kind: Kind,
    /// Whether the pairs enter now: d = 0.
    pub enters: bool,
    /// Lanes up to the last one that holds a pair.
    pub count: usize,
    /// k of the law.
    stiffness: Each,
    /// Damping factor of the law divided by the scale.
    damping: Each,
    exponent: Each,
    /// 1/e_0 of pairs that enter, 1/d_0 of others.
    inverse: Each,
    /// m, terms of the penetration d; those of e stand one place further.
    penetration: Rows,
    /// Terms of what is taken to a power, e or d, each times its exponent of x; in the places of the penetration's.
    slopes: Rows,
    /// N, terms of the force times x: row j holds the powers i - 1 + beta j.
    pub force: Rows,
    power: Rows,
    root: Rows,
}

impl Default for OnsetBlock {
    fn default() -> Self {
        let (lane, rows) = ([0.0; PAIRS], [[0.0; PAIRS]; MOST_TERMS]);
        OnsetBlock {
            kind: Kind::None,
            enters: false,
            count: 0,
            stiffness: lane,
            damping: lane,
            exponent: lane,
            inverse: lane,
            penetration: rows,
            slopes: rows,
            force: rows,
            power: rows,
            root: rows,
        }
    }
}

/// The contacts of a block at some x.
#[derive(Clone, Copy, Debug, Default)]
pub struct OnsetReading {
    /// Penetration, m.
    pub penetration: Each,
    /// Its derivative by x.
    pub slope: Each,
    /// Force, N.
    pub force: Each,
    /// Its derivative by x.
    pub force_slope: Each,
    /// Its integral over x.
    pub impulse: Each,
}

impl OnsetBlock {
    /// Starts a block with no pair in it yet: springs without stiffness, whose powers vanish.
    pub fn start(&mut self, grid: &Grid, kind: Kind, enters: bool) {
        let zeros = [0.0; PAIRS];
        (self.kind, self.enters, self.count) = (kind, enters, 0);
        (self.stiffness, self.damping, self.exponent, self.inverse) = (zeros, zeros, zeros, zeros);
        for rows in [&mut self.penetration, &mut self.slopes, &mut self.force] {
            rows[..grid.terms()].fill(zeros);
        }
        (self.power[0], self.root[0]) = (zeros, zeros);
    }

    /// Whether its pairs are of a kind and enter or touch already.
    pub fn is_of(&self, kind: Kind, enters: bool) -> bool {
        self.kind == kind && self.enters == enters
    }

    /// Adds a pair in a lane from its penetration, m, and its rate times the scale, m.
    pub fn add(&mut self, lane: usize, force: &Force, scale: f64, penetration: f64, step_rate: f64) {
        self.count = self.count.max(lane + 1);
        (self.stiffness[lane], self.exponent[lane], self.damping[lane]) = force.in_units_of(scale);
        let first = if self.enters { step_rate } else { penetration };
        self.inverse[lane] = 1.0 / first;
        if !force.is_regular() {
            self.power[0][lane] = power(first, self.exponent[lane]);
            self.root[0][lane] = power(first, ROOT);
        }
        self.penetration[0][lane] = penetration;
        self.penetration[1][lane] = step_rate;
        // Of e, the first term has the exponent 0.
        self.slopes[1][lane] = if self.enters { 0.0 } else { step_rate };
    }

    /// Enters terms of the penetrations.
    #[inline(always)]
    pub fn set_penetration(&mut self, grid: &Grid, i: usize, j: usize, values: Each) {
        let here = grid.index(i, j);
        let exponent = grid.exponent(i, j) - f64::from(u8::from(self.enters));
        self.penetration[here] = values;
        self.slopes[here] = each(|k| exponent * values[k]);
    }

    /// The force terms of a row for pairs that enter; they follow from the rows before.
    #[inline(always)]
    pub fn extend_entering_row(&mut self, grid: &Grid, products: &Products, j: usize) {
        if j == 0 {
            return;
        }
        if self.kind == Kind::Root {
            self.extend_entering_root(grid, products, j);
            return;
        }
        for i in 0..grid.last(j - 1) {
            self.extend_power(grid, products, (i, j - 1));
        }
        // x^n e^n (1 + b d') lands one row on, one power of x down: the same i in `force`, which is times x.
        for i in 0..=grid.last(j) {
            let mut term = self.power[grid.index(i, j - 1)];
            if self.kind == Kind::Damped {
                let product = self.times_rate(grid, products, (i, j - 1));
                term = each(|k| term[k] + self.damping[k] * product[k]);
            }
            self.force[grid.index(i, j)] = each(|k| self.stiffness[k] * term[k]);
        }
    }

    #[inline(always)]
    fn extend_entering_root(&mut self, grid: &Grid, products: &Products, j: usize) {
        for i in 0..grid.last(j - 1) {
            self.extend_root(grid, products, (i, j - 1));
        }
        if j >= 2 {
            for i in 0..grid.last(j - 2) {
                self.extend_power(grid, products, (i, j - 2));
            }
        }
        for i in 0..=grid.last(j) {
            let rate = ROOT + grid.exponent(i, j - 1);
            let root = self.root[grid.index(i, j - 1)];
            let elastic = if j >= 2 { self.power[grid.index(i, j - 2)] } else { [0.0; PAIRS] };
            self.force[grid.index(i, j)] = each(|k| self.stiffness[k] * elastic[k] + rate * self.damping[k] * root[k]);
        }
    }

    /// One force term, x^(i + beta j), of pairs that are in contact already.
    #[inline(always)]
    pub fn extend_touching(&mut self, grid: &Grid, products: &Products, (i, j): (usize, usize)) {
        let here = grid.index(i, j);
        let (d, slope) = (self.penetration[here], self.slopes[here + 1]);
        self.force[here + 1] = match self.kind {
            Kind::None => [0.0; PAIRS],
            // The rate's terms: one power of x down from the penetration's.
            Kind::Linear => each(|k| self.stiffness[k] * d[k] + self.damping[k] * slope[k]),
            Kind::Spring => {
                let power = self.extend_power(grid, products, (i, j));
                each(|k| self.stiffness[k] * power[k])
            }
            Kind::Damped => {
                let power = self.extend_power(grid, products, (i, j));
                let product = self.times_rate(grid, products, (i, j));
                each(|k| self.stiffness[k] * (power[k] + self.damping[k] * product[k]))
            }
            Kind::Root => {
                if i == 0 {
                    self.extend_root(grid, products, (0, j));
                }
                let power = self.extend_power(grid, products, (i, j));
                let root = self.extend_root(grid, products, (i + 1, j));
                let rate = grid.exponent(i + 1, j);
                each(|k| self.stiffness[k] * power[k] + self.damping[k] * (rate * root[k]))
            }
        };
    }

    #[inline(always)]
    fn extend_power(&mut self, grid: &Grid, products: &Products, (i, j): (usize, usize)) -> Each {
        let here = grid.index(i, j);
        if here > 0 {
            self.power[here] = self.next_power(&self.power, self.exponent, grid, products, (i, j));
        }
        self.power[here]
    }

    #[inline(always)]
    fn extend_root(&mut self, grid: &Grid, products: &Products, (i, j): (usize, usize)) -> Each {
        let here = grid.index(i, j);
        if here > 0 {
            self.root[here] = self.next_power(&self.root, [ROOT; PAIRS], grid, products, (i, j));
        }
        self.root[here]
    }

    /// Term (i, j) of base^exponent (Miller's recurrence for x d/dx): with s the exponent of x in a term,
    /// s p_c b_0 = sum over a > 0 of (exponent s_a - s_(c-a)) b_a p_(c-a), where s_(c-a) = s - s_a.
    #[inline(always)]
    fn next_power(
        &self,
        power: &Rows,
        exponent: Each,
        grid: &Grid,
        products: &Products,
        (i, j): (usize, usize),
    ) -> Each {
        let (mut whole, mut weighted) = ([0.0; PAIRS], [0.0; PAIRS]);
        for (factor, other) in products.of(grid.index(i, j)) {
            let (term, slope, power) = (&self.penetration[factor], &self.slopes[factor], &power[other]);
            for k in 0..PAIRS {
                whole[k] += term[k] * power[k];
                weighted[k] += slope[k] * power[k];
            }
        }
        let reciprocal = 1.0 / grid.exponent(i, j);
        each(|k| ((exponent[k] + 1.0) * reciprocal * weighted[k] - whole[k]) * self.inverse[k])
    }

    /// Term (i, j) of power times d' (in units of the scale). d' has (exponent) times the penetration's term one power of x
    /// up: of e, whose terms stand one place further, these are those of a power and the first; of d those of the next term.
    #[inline(always)]
    fn times_rate(&self, grid: &Grid, products: &Products, (i, j): (usize, usize)) -> Each {
        let (mut sum, here) = ([0.0; PAIRS], grid.index(i, j));
        let (missing, place) = if self.enters { (1.0, here) } else { (0.0, here + 1) };
        for (factor, other) in products.of(place) {
            let (term, slope, power) = (&self.penetration[factor], &self.slopes[factor], &self.power[other]);
            for k in 0..PAIRS {
                sum[k] += (slope[k] + missing * term[k]) * power[k];
            }
        }
        let (first, power) = (&self.penetration[1], &self.power[here]);
        each(|k| sum[k] + missing * first[k] * power[k])
    }

    /// Penetrations, forces and their integrals at the x of the powers.
    pub fn read(&self, powers: &GridPowers) -> OnsetReading {
        read(&self.penetration[..powers.terms], &self.force[..powers.terms], powers)
    }

    /// Bounds, over 0..=x, on what the terms from x^2 on change the penetrations and their derivatives by x by.
    pub fn room(&self, powers: &GridPowers) -> [Each; 2] {
        room(&self.penetration[..powers.terms], powers)
    }

    /// The penetration of one pair, copied.
    pub fn copy_penetration(&self, grid: &Grid, lane: usize) -> Terms {
        copy(&self.penetration[..grid.terms()], lane)
    }

    /// The force of one pair times x, copied.
    pub fn copy_force(&self, grid: &Grid, lane: usize) -> Terms {
        copy(&self.force[..grid.terms()], lane)
    }
}

/// The powers of x of a grid, and what derivatives and integrals need.
#[derive(Clone, Debug)]
pub struct GridPowers {
    /// x > 0.
    pub x: f64,
    terms: usize,
    /// x^e of each exponent e.
    value: Terms,
    /// e x^(e-1).
    slope: Terms,
    /// x^e / e; 0 for e = 0.
    primitive: Terms,
}

impl Default for GridPowers {
    fn default() -> Self {
        let zeros = [0.0; MOST_TERMS];
        GridPowers { x: 0.0, terms: 0, value: zeros, slope: zeros, primitive: zeros }
    }
}

impl GridPowers {
    /// Tables for x > 0.
    pub fn at(grid: &Grid, x: f64) -> GridPowers {
        let mut powers = GridPowers::default();
        powers.set(grid, x);
        powers
    }

    /// The same in place.
    pub fn set(&mut self, grid: &Grid, x: f64) {
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
    pub fn all(&self) -> (&[f64], &[f64]) {
        (&self.value[..self.terms], &self.slope[..self.terms])
    }
}

fn copy(rows: &[Each], lane: usize) -> Terms {
    let mut terms = [0.0; MOST_TERMS];
    terms.iter_mut().zip(rows).for_each(|(term, row)| *term = row[lane]);
    terms
}

/// See [`OnsetBlock::read`]: from the smallest terms of each row to the largest. Wide instructions give the same bits.
#[multiversion::multiversion(targets("x86_64+avx2"))]
fn read(penetration: &[Each], force: &[Each], powers: &GridPowers) -> OnsetReading {
    let [mut value, mut slope, mut product, mut product_slope, mut impulse] = [[0.0; PAIRS]; 5];
    let tables = powers.value.iter().zip(&powers.slope).zip(&powers.primitive).take(powers.terms);
    for ((d, force), ((power, rate), primitive)) in penetration.iter().zip(force).zip(tables).rev() {
        for k in 0..PAIRS {
            value[k] += d[k] * power;
            slope[k] += d[k] * rate;
            product[k] += force[k] * power;
            product_slope[k] += force[k] * rate;
            impulse[k] += force[k] * primitive;
        }
    }
    // The stored force terms are those of F x.
    let inverse = 1.0 / powers.x;
    let force = each(|k| product[k] * inverse);
    let force_slope = each(|k| (product_slope[k] - force[k]) * inverse);
    OnsetReading { penetration: value, slope, force, force_slope, impulse }
}

/// See [`OnsetBlock::room`]. Wide instructions give the same bits.
#[multiversion::multiversion(targets("x86_64+avx2"))]
fn room(penetration: &[Each], powers: &GridPowers) -> [Each; 2] {
    let (mut moved, mut turned) = ([0.0; PAIRS], [0.0; PAIRS]);
    for (d, (power, rate)) in penetration.iter().zip(powers.value.iter().zip(&powers.slope)).skip(2) {
        for k in 0..PAIRS {
            moved[k] += d[k].abs() * power;
            turned[k] += d[k].abs() * rate;
        }
    }
    [moved, turned]
}

/// Value and slope at x of a double series.
pub fn value_and_slope(grid: &Grid, terms: &[f64], x: f64) -> (f64, f64) {
    let ([value], [slope]) = values_and_slopes(grid, terms, &[x]);
    (value, slope)
}

/// The same at some x side by side. Wide instructions give the same bits.
#[multiversion::multiversion(targets("x86_64+avx2"))]
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
