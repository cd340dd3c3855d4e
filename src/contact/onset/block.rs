//! The double series of some pairs in contact: up to [`PAIRS`] pairs of one kind of law side by side.

use super::grid::{Grid, MOST_TERMS, Products};
use crate::contact::force::{Force, Kind, power};
use crate::contact::taylor::{Each, PAIRS, ROOT};
use crate::numerics::polynomial::each;

/// A double series of each pair.
type DoubleSeries = [Each; MOST_TERMS];

/// Up to [`PAIRS`] contacts of one kind over an onset step, all of which enter or all of which touch already.
#[derive(Clone, Debug)]
pub(crate) struct OnsetBlock {
    kind: Kind,
    /// Whether the pairs enter now: d = 0.
    pub enters: bool,
    /// Number of lanes up to the last one that holds a pair.
    pub count: usize,
    /// k of the law.
    stiffness: Each,
    /// Damping factor of the law divided by the scale.
    damping: Each,
    exponent: Each,
    /// 1/e_0 of pairs that enter, 1/d_0 of others.
    inverse: Each,
    /// m, terms of the penetration d; those of e stand one place further.
    pub(super) penetration: DoubleSeries,
    /// Terms of the base of the power, e or d, each times its exponent of x; at the indices of the penetration's terms.
    slopes: DoubleSeries,
    /// N, terms of the force times x: row j holds the powers i - 1 + beta j.
    pub force: DoubleSeries,
    power: DoubleSeries,
    root: DoubleSeries,
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

impl OnsetBlock {
    /// Empties the block for pairs of one kind. Lanes without a pair hold springs without stiffness, whose series are
    /// 0.
    pub(crate) fn start(&mut self, grid: &Grid, kind: Kind, enters: bool) {
        let zeros = [0.0; PAIRS];
        (self.kind, self.enters, self.count) = (kind, enters, 0);
        (self.stiffness, self.damping, self.exponent, self.inverse) = (zeros, zeros, zeros, zeros);
        for rows in [&mut self.penetration, &mut self.slopes, &mut self.force] {
            rows[..grid.terms()].fill(zeros);
        }
        (self.power[0], self.root[0]) = (zeros, zeros);
    }

    /// Whether its pairs are of a kind and enter or touch already.
    pub(crate) fn is_of(&self, kind: Kind, enters: bool) -> bool {
        self.kind == kind && self.enters == enters
    }

    /// Adds a pair in a lane from its penetration, m, and its rate times the scale, m.
    pub(crate) fn add(&mut self, lane: usize, force: &Force, scale: f64, penetration: f64, step_rate: f64) {
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
    pub(crate) fn set_penetration(&mut self, grid: &Grid, i: usize, j: usize, values: Each) {
        let here = grid.index(i, j);
        let exponent = grid.exponent(i, j) - f64::from(u8::from(self.enters));
        self.penetration[here] = values;
        self.slopes[here] = each(|k| exponent * values[k]);
    }

    /// The force terms of a row for pairs that enter; they follow from the rows before.
    #[inline(always)]
    pub(crate) fn extend_entering_row(&mut self, grid: &Grid, products: &Products, j: usize) {
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
        // x^n e^n (1 + b d') has the powers of the next row, one power of x lower; `force` holds the force times x, so
        // that i stays.
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
    pub(crate) fn extend_touching(&mut self, grid: &Grid, products: &Products, (i, j): (usize, usize)) {
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
        power: &DoubleSeries,
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
    /// up: of e, whose terms stand one place further, these are those of a power and the first; of d those of the next
    /// term.
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
}
