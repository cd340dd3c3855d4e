//! Power series of contact forces from those of the penetrations, term by term, while a step is expanded: [`PAIRS`]
//! pairs of one kind of law side by side.

use super::force::{Force, power};
use crate::numerics::polynomial::{COUNT, Coefficients, RECIPROCAL, ROOM, each};
use crate::numerics::powers::{Powers, Reading};
use crate::numerics::quadrature::TWELVE_POINTS;
use crate::numerics::substitution::Bend;
use crate::numerics::time_map::Clock;

mod laws;

pub use laws::{Any, Damped, Kind, Linear, PairLaw, Root, Spring};

/// Pairs that are worked on together: as many as today's machines take in one instruction.
pub const PAIRS: usize = 4;

/// One number of each pair.
pub type Each = [f64; PAIRS];

/// A series of each pair.
type Rows = [Each; ROOM];

/// A series of each pair with n times its term n beside it.
type Sloped = [[Each; 2]; ROOM];

/// Exponent of the power whose rate damps in a root law.
pub(super) const ROOT: f64 = 1.25;

/// Where a series that is kept backwards begins.
const LAST: usize = ROOM - 1;

/// Share of its penetration that a pair has kept at the end of a step, below which the step is taken to end at a release.
const NEARLY_RELEASED: f64 = 0.1;

/// The scalar series of up to [`PAIRS`] contacts over a step, in powers of x = t / scale or as a clock has it.
#[derive(Clone, Debug)]
pub struct PairBlock {
    kind: Kind,
    /// Lanes up to the last one that holds a pair.
    pub count: usize,
    /// k of the law.
    stiffness: Each,
    /// Damping factor of the law divided by the scale.
    damping: Each,
    exponent: Each,
    /// 1/d_0, 1/m.
    inverse: Each,
    /// exponent d_0^(exponent - 1) of the power and of the root.
    lead: [Each; 2],
    /// Penetration, m.
    pub penetration: Rows,
    /// The same backwards, term 0 at [`LAST`]: a product of series then goes through memory in one direction.
    backwards: Rows,
    /// n times term n of the penetration, backwards; of [`Kind::Damped`] only.
    slope: Rows,
    /// Force, N.
    pub force: Rows,
    /// d^n of a power law, d^1.5 of a root law.
    power: Sloped,
    /// d^1.25 of a root law.
    root: Sloped,
    /// Powers of the force that are filled, the last one; the penetration has two more.
    pub order: usize,
}

impl Default for PairBlock {
    fn default() -> Self {
        let (lane, rows, sloped) = ([0.0; PAIRS], [[0.0; PAIRS]; ROOM], [[[0.0; PAIRS]; 2]; ROOM]);
        PairBlock {
            kind: Kind::None,
            count: 0,
            stiffness: lane,
            damping: lane,
            exponent: lane,
            inverse: lane,
            lead: [lane; 2],
            penetration: rows,
            backwards: rows,
            slope: rows,
            force: rows,
            power: sloped,
            root: sloped,
            order: 0,
        }
    }
}

/// The penetrations of a block at the end of a step.
#[derive(Clone, Copy, Debug, Default)]
pub struct BlockReading {
    /// Penetration, m.
    pub penetration: Each,
    /// Its derivative by x.
    pub slope: Each,
    /// Bound on its fourth derivative.
    pub fourth: Each,
    /// Bound on how far the slope gets from where it starts.
    pub turn: Each,
}

/// The forces of a block at the end of a step.
#[derive(Clone, Copy, Debug, Default)]
pub struct ForceReading {
    /// N.
    pub value: Each,
    /// Its derivative by x.
    pub slope: Each,
    /// Bound on its fourth derivative.
    pub fourth: Each,
    /// Its integral over x.
    pub impulse: Each,
}

impl ForceReading {
    /// Of one pair.
    pub fn of(&self, lane: usize) -> Reading {
        Reading { value: self.value[lane], slope: self.slope[lane], fourth: self.fourth[lane] }
    }
}

impl PairBlock {
    /// Starts a block of one kind, with no pair in it yet: springs without stiffness, whose powers vanish.
    pub fn start(&mut self, kind: Kind) {
        let zeros = [0.0; PAIRS];
        self.kind = kind;
        self.count = 0;
        (self.stiffness, self.damping, self.exponent) = (zeros, zeros, zeros);
        (self.inverse, self.lead) = (zeros, [zeros; 2]);
        (self.power[0], self.root[0]) = ([zeros; 2], [zeros; 2]);
        self.set_penetration::<Any>(0, zeros);
        self.set_penetration::<Any>(1, zeros);
    }

    /// Adds a pair in a lane from its penetration and its rate per unit of x, both m.
    pub fn add(&mut self, lane: usize, force: &Force, scale: f64, penetration: f64, step_rate: f64) {
        self.count = self.count.max(lane + 1);
        (self.stiffness[lane], self.exponent[lane], self.damping[lane]) = force.in_units_of(scale);
        let inverse = 1.0 / penetration;
        self.inverse[lane] = inverse;
        if !force.is_regular() {
            let (exponent, value) = (self.exponent[lane], power(penetration, self.exponent[lane]));
            (self.power[0][0][lane], self.lead[0][lane]) = (value, exponent * value * inverse);
        }
        if self.kind == Kind::Root {
            let value = power(penetration, ROOT);
            (self.root[0][0][lane], self.lead[1][lane]) = (value, ROOT * value * inverse);
        }
        self.ride(lane, penetration, step_rate);
    }

    /// Adds a pair that has no force, whose penetration is followed along with the others'.
    pub fn ride(&mut self, lane: usize, penetration: f64, step_rate: f64) {
        for (n, value) in [penetration, step_rate].into_iter().enumerate() {
            self.penetration[n][lane] = value;
            self.backwards[LAST - n][lane] = value;
            self.slope[LAST - n][lane] = COUNT[n] * value;
        }
    }

    /// Whether its forces follow from the penetrations alone.
    pub fn is_elastic(&self) -> bool {
        match self.kind {
            Kind::None | Kind::Spring => true,
            Kind::Linear => self.damping == [0.0; PAIRS],
            Kind::Damped | Kind::Root => false,
        }
    }

    /// Whether its forces may have a damping part.
    pub fn is_damped(&self) -> bool {
        !matches!(self.kind, Kind::None | Kind::Spring)
    }

    /// What its pairs are of.
    pub fn kind(&self) -> Kind {
        self.kind
    }

    /// Enters power n of the penetrations, of pairs under a law.
    #[inline(always)]
    pub fn set_penetration<L: PairLaw>(&mut self, n: usize, values: Each) {
        if n < ROOM {
            self.penetration[n] = values;
            self.backwards[LAST - n] = values;
            if L::needs_slopes(self) {
                self.slope[LAST - n] = each(|i| COUNT[n] * values[i]);
            }
        }
    }

    /// Fills power n of the forces, of pairs under a law, from the powers 0..=n + 1 of the penetrations, for n = 0, 1, 2, ...
    /// in turn, and returns it.
    #[inline(always)]
    pub fn extend_force<L: PairLaw>(&mut self, n: usize) -> Each {
        // Says once that no index below leaves its table.
        if n + 2 >= ROOM {
            return [0.0; PAIRS];
        }
        self.order = n;
        self.force[n] = L::force(self, n);
        self.force[n]
    }

    /// Stiffness and damping of linear forces.
    pub fn linear_factors(&self) -> [&Each; 2] {
        [&self.stiffness, &self.damping]
    }

    /// Enters power n of the first linear forces and the power n + 2 of the penetrations that follows from it.
    #[inline(always)]
    pub fn enter_linear(&mut self, n: usize, force: &[f64], penetration: &[f64]) {
        if n + 2 < ROOM {
            self.force[n][..force.len()].copy_from_slice(force);
            self.penetration[n + 2][..penetration.len()].copy_from_slice(penetration);
            self.order = n;
        }
    }

    /// Whether all forces are linear.
    pub fn is_linear(&self) -> bool {
        self.kind == Kind::Linear
    }

    /// Whether its forces have a root at d = 0.
    pub fn has_roots(&self) -> bool {
        matches!(self.kind, Kind::Spring | Kind::Damped | Kind::Root)
    }

    /// About where each pair is released, if that is before `limit`; else infinite.
    pub fn releases(&self, limit: f64) -> Each {
        releases(&self.penetration[..self.order + 3], limit)
    }

    /// Makes the series of penetrations such in the x of a clock, and those of forces, unless they are elastic.
    pub fn bend(&mut self, bend: &Bend) {
        let terms = self.order + 3;
        match self.is_elastic() {
            true => bend.apply(&mut self.penetration[..terms], 1),
            false => bend.apply_to_both([&mut self.penetration, &mut self.force], terms),
        }
    }

    /// The same for two blocks of elastic forces.
    pub fn bend_with(&mut self, other: &mut PairBlock, bend: &Bend) {
        bend.apply_to_both([&mut self.penetration, &mut other.penetration], self.order + 3);
    }

    /// Penetrations and their bounds at the x of the powers.
    pub fn read(&self, powers: &Powers) -> BlockReading {
        read(&self.penetration[..self.order + 3], powers)
    }

    /// Forces at the x of the powers, and their integral over 0..=x, N s per unit of the scale.
    pub fn read_force(&self, powers: &Powers) -> ForceReading {
        read_force(&self.force[..=self.order], powers)
    }

    /// Integrals of elastic forces over time up to that of the powers, N s per unit of the scale.
    pub fn elastic_impulses(&self, powers: &Powers) -> Each {
        elastic_impulses(&self.force[..=self.order], powers.integral_in_time())
    }

    /// J, work of the damping part of a pair's force over 0..=x, where the penetration is `end`.
    pub fn damping_work(&self, lane: usize, force: &Force, (clock, scale): (&Clock, f64), x: f64, end: f64) -> f64 {
        if !force.is_damped() {
            return 0.0;
        }
        let terms = &self.penetration[..self.order + 3];
        if let Force::Linear { damping, .. } = *force {
            return damping / scale * squared_slope(terms, lane, clock, x);
        }
        // A power law's damping force ends with a root of the time left: even in the square root of that time.
        let released = !force.is_regular() && end < NEARLY_RELEASED * terms[0][lane];
        let (mut at, mut weights) = ([0.0; 12], [0.0; 12]);
        for (i, &(node, weight)) in TWELVE_POINTS.iter().enumerate() {
            let left = 1.0 - node;
            (at[i], weights[i]) = match released {
                true => (x * (1.0 - left * left), x * 2.0 * left * weight),
                false => (x * node, x * weight),
            };
        }
        // All go with the square of the rate, whose time passes at the clock's rate, as that of the integral does.
        if clock.is_bent() {
            weights.iter_mut().zip(&at).for_each(|(weight, at)| *weight /= clock.rate(*at));
        }
        let powers = damping_powers(terms, lane, force, scale, &at);
        scale * (0..12).map(|i| weights[i] * powers[i]).sum::<f64>()
    }

    /// The penetration of one pair, copied; returns the number of its terms.
    pub fn copy_penetration(&self, lane: usize, out: &mut Coefficients) -> usize {
        copy(&self.penetration[..self.order + 3], lane, out)
    }

    /// The force of one pair, copied; returns the number of its terms.
    pub fn copy_force(&self, lane: usize, out: &mut Coefficients) -> usize {
        copy(&self.force[..=self.order], lane, out)
    }
}

fn copy(rows: &[Each], lane: usize, out: &mut Coefficients) -> usize {
    for (out, row) in out.iter_mut().zip(rows) {
        *out = row[lane];
    }
    rows.len()
}

/// Power of the damping part of a pair's force at twelve x. Wide instructions give the same bits.
#[multiversion::multiversion(targets("x86_64+avx2"))]
fn damping_powers(terms: &[Each], lane: usize, force: &Force, scale: f64, x: &[f64; 12]) -> [f64; 12] {
    let (mut d, mut rate) = ([0.0; 12], [0.0; 12]);
    for term in terms.iter().rev() {
        let term = term[lane];
        for i in 0..12 {
            rate[i] = rate[i] * x[i] + d[i];
            d[i] = d[i] * x[i] + term;
        }
    }
    force.damping_powers(&d, &rate.map(|rate| rate / scale))
}

/// See [`PairBlock::read`]. Wide instructions give the same bits.
#[multiversion::multiversion(targets("x86_64+avx2"))]
fn read(terms: &[Each], powers: &Powers) -> BlockReading {
    let (value, slope, fourth) = powers.all();
    let [mut values, mut slopes, mut fourths, mut turns] = [[0.0; PAIRS]; 4];
    for (n, term) in terms.iter().enumerate().skip(2) {
        for i in 0..PAIRS {
            values[i] += term[i] * value[n];
            slopes[i] += term[i] * slope[n];
            turns[i] += term[i].abs() * slope[n];
            fourths[i] += term[i].abs() * fourth[n];
        }
    }
    let (first, second) = (&terms[0], &terms[1]);
    let penetration = each(|i| first[i] + (second[i] * powers.x + values[i]));
    BlockReading { penetration, slope: each(|i| second[i] + slopes[i]), fourth: fourths, turn: turns }
}

/// See [`PairBlock::releases`]: from where the parabola of the first terms has its root. Wide instructions give the same bits.
#[multiversion::multiversion(targets("x86_64+avx2"))]
fn releases(terms: &[Each], limit: f64) -> Each {
    let [start, first, half] = [0, 1, 2].map(|n| terms[n]);
    let square = each(|i| first[i] * first[i] - 4.0 * start[i] * half[i]);
    let guess = each(|i| 2.0 * start[i] / (square[i].sqrt() - first[i]));
    let is_near = |i: usize| guess[i] > 0.0 && guess[i] < 1.5 * limit;
    if !(0..PAIRS).any(is_near) {
        return [f64::INFINITY; PAIRS];
    }
    let mut x = guess;
    for _ in 0..3 {
        let (mut value, mut slope) = ([0.0; PAIRS], [0.0; PAIRS]);
        for term in terms.iter().rev() {
            slope = each(|i| slope[i] * x[i] + value[i]);
            value = each(|i| value[i] * x[i] + term[i]);
        }
        x = each(|i| x[i] - value[i] / slope[i]);
    }
    let is_one = |i: usize| is_near(i) && x[i] > 0.0 && x[i] < limit;
    each(|i| if is_one(i) { x[i] } else { f64::INFINITY })
}

/// See [`PairBlock::read_force`]. Wide instructions give the same bits.
#[multiversion::multiversion(targets("x86_64+avx2"))]
fn read_force(terms: &[Each], powers: &Powers) -> ForceReading {
    let ((value, slope, fourth), stretch) = (powers.all(), powers.stretch());
    let [mut values, mut slopes, mut fourths, mut integrals] = [[0.0; PAIRS]; 4];
    for (n, term) in terms.iter().enumerate() {
        // Of the integral over time: dt = (1 + stretch for the whole x) dx.
        let weight = (RECIPROCAL[n] + stretch * RECIPROCAL[n + 1]) * value[n];
        for i in 0..PAIRS {
            values[i] += term[i] * value[n];
            slopes[i] += term[i] * slope[n];
            fourths[i] += term[i].abs() * fourth[n];
            integrals[i] += term[i] * weight;
        }
    }
    ForceReading { value: values, slope: slopes, fourth: fourths, impulse: each(|i| powers.x * integrals[i]) }
}

/// See [`PairBlock::elastic_impulses`]. Wide instructions give the same bits.
#[multiversion::multiversion(targets("x86_64+avx2"))]
fn elastic_impulses(terms: &[Each], factors: &Coefficients) -> Each {
    let mut impulses = [0.0; PAIRS];
    for (term, factor) in terms.iter().zip(factors) {
        for i in 0..PAIRS {
            impulses[i] += term[i] * factor;
        }
    }
    impulses
}

/// Integral over 0..=x of the square of the slope of one pair's series, by the time of a clock. Wide instructions give the
/// same bits.
#[multiversion::multiversion(targets("x86_64+avx2"))]
fn squared_slope(terms: &[Each], lane: usize, clock: &Clock, x: f64) -> f64 {
    let (at, weights) = (TWELVE_POINTS.map(|(node, _)| x * node), TWELVE_POINTS.map(|(_, weight)| weight));
    let mut slope = [0.0; 12];
    for (term, count) in terms.iter().zip(&COUNT).skip(1).rev() {
        let own = count * term[lane];
        for i in 0..12 {
            slope[i] = slope[i] * at[i] + own;
        }
    }
    if clock.is_bent() {
        slope.iter_mut().zip(&at).for_each(|(slope, at)| *slope /= clock.rate(*at).sqrt());
    }
    let mut sum = [0.0; 4];
    for k in 0..3 {
        for i in 0..4 {
            sum[i] += weights[4 * k + i] * (slope[4 * k + i] * slope[4 * k + i]);
        }
    }
    x * ((sum[0] + sum[2]) + (sum[1] + sum[3]))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The terms of a force for d = (1 + x)^2 and d' = 2 (1 + x): those of a sum of powers (factor, exponent) of 1 + x.
    fn compare(force: Force, powers: &[(f64, f64)]) {
        let mut block = PairBlock::default();
        block.start(Kind::of(&force));
        block.add(0, &force, 1.0, 1.0, 2.0);
        for n in 0..12 {
            block.set_penetration::<Any>(n + 2, [if n == 0 { 1.0 } else { 0.0 }; PAIRS]);
            block.extend_force::<Any>(n);
            let term = |(factor, exponent): &(f64, f64)| {
                factor * (0..n).map(|k| (exponent - k as f64) / (k + 1) as f64).product::<f64>()
            };
            let expected: f64 = powers.iter().map(term).sum();
            let got = block.force[n][0];
            assert!((got - expected).abs() <= 1e-13 * expected.abs().max(0.1), "{force:?} {n}: {got} not {expected}");
        }
    }

    #[test]
    fn forces_of_a_square_are_binomial_series() {
        compare(Force::Linear { stiffness: 3.0, damping: 0.5 }, &[(3.0, 2.0), (1.0, 1.0)]);
        compare(Force::Power { stiffness: 3.0, exponent: 1.7, damping: 0.0 }, &[(3.0, 3.4)]);
        compare(Force::Power { stiffness: 3.0, exponent: 1.7, damping: 0.5 }, &[(3.0, 3.4), (3.0, 4.4)]);
        compare(Force::Root { stiffness: 3.0, damping: 0.4 }, &[(3.0, 3.0), (0.8, 1.5)]);
    }

    #[test]
    fn lanes_do_not_disturb_each_other() {
        let forces = [(2.0, 0.3), (1.0, 0.7)];
        let series = |which: &[usize]| {
            let mut block = PairBlock::default();
            block.start(Kind::Root);
            for (lane, &i) in which.iter().enumerate() {
                let (stiffness, damping) = forces[i];
                block.add(lane, &Force::Root { stiffness, damping }, 1.0, 0.5 + i as f64, -0.1);
            }
            for n in 0..8 {
                block.set_penetration::<Any>(n + 2, [0.01 / (n + 1) as f64; PAIRS]);
                block.extend_force::<Any>(n);
            }
            block.force.map(|row| row[which.len() - 1])
        };
        assert_eq!(series(&[1]), series(&[0, 1]));
        assert_ne!(series(&[0]), series(&[1]));
    }
}
