//! Power series of contact forces from those of the penetrations, term by term, while a step is expanded: [`PAIRS`]
//! pairs of one kind of law side by side.

use super::force::{Force, power};
use crate::polynomial::{COUNT, Coefficients, Powers, RECIPROCAL, ROOM, Reading};
use crate::quadrature::{TWELVE, TWELVE_ABREAST, gauss};

/// Pairs that are worked on together. With four abreast, which today's machines take in one instruction, scenes with few
/// contacts took 10 to 20 % longer for their larger blocks, and one with 20 contacts as long.
pub const PAIRS: usize = 2;

/// One number of each pair.
pub type Each = [f64; PAIRS];

/// A series of each pair.
type Rows = [Each; ROOM];

/// Where a series that is kept backwards begins.
const LAST: usize = ROOM - 1;

/// Share of its penetration that a pair has kept at the end of a step, below which the step is taken to end at a release.
const NEARLY_RELEASED: f64 = 0.1;

/// Which terms a force has.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Kind {
    /// No force.
    #[default]
    None,
    /// [`Force::Linear`].
    Linear,
    /// [`Force::Power`] without damping.
    Spring,
    /// [`Force::Power`] with damping.
    Power,
    /// [`Force::Root`].
    Root,
}

impl Kind {
    /// Of a force.
    pub fn of(force: &Force) -> Kind {
        match *force {
            Force::None => Kind::None,
            Force::Linear { .. } => Kind::Linear,
            Force::Power { damping: 0.0, .. } => Kind::Spring,
            Force::Power { .. } => Kind::Power,
            Force::Root { .. } => Kind::Root,
        }
    }
}

/// The scalar series of up to [`PAIRS`] contacts over a step, in powers of x = t / scale.
#[derive(Clone, Debug)]
pub struct PairBlock {
    kind: Kind,
    /// Pairs in it.
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
    /// n times term n of the penetration, backwards.
    slope: Rows,
    /// Force, N.
    pub force: Rows,
    /// d^n of a power law, d^1.5 of a root law.
    power: Rows,
    power_slope: Rows,
    /// d^1.25 of a root law.
    root: Rows,
    root_slope: Rows,
    /// Powers of the force that are filled, the last one; the penetration has two more.
    pub order: usize,
}

impl Default for PairBlock {
    fn default() -> Self {
        let (lane, rows) = ([0.0; PAIRS], [[0.0; PAIRS]; ROOM]);
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
            power: rows,
            power_slope: rows,
            root: rows,
            root_slope: rows,
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
    /// Starts a block of one kind, with no pair in it yet.
    pub fn start(&mut self, kind: Kind) {
        self.kind = kind;
        self.count = 0;
        self.stiffness = [0.0; PAIRS];
        self.damping = [0.0; PAIRS];
        self.exponent = [1.0; PAIRS];
        self.inverse = [1.0; PAIRS];
        // A lane without a pair is a spring without stiffness.
        self.set_penetration(0, [1.0; PAIRS]);
        self.set_penetration(1, [0.0; PAIRS]);
    }

    /// Adds a pair from its penetration and its rate per unit of x, both m; returns its lane.
    pub fn add(&mut self, force: &Force, scale: f64, penetration: f64, step_rate: f64) -> usize {
        let lane = self.count;
        self.count += 1;
        (self.stiffness[lane], self.exponent[lane], self.damping[lane]) = match *force {
            Force::None => (0.0, 1.0, 0.0),
            Force::Linear { stiffness, damping } => (stiffness, 1.0, damping / scale),
            Force::Power { stiffness, exponent, damping } => (stiffness, exponent, damping / scale),
            Force::Root { stiffness, damping } => (stiffness, 1.5, 0.8 * damping / scale),
        };
        self.inverse[lane] = 1.0 / penetration;
        for (n, value) in [penetration, step_rate].into_iter().enumerate() {
            let mut values = self.penetration[n];
            values[lane] = value;
            self.set_penetration(n, values);
        }
        lane
    }

    /// Whether there is room for another pair of a kind.
    pub fn takes(&self, kind: Kind) -> bool {
        self.kind == kind && self.count < PAIRS
    }

    /// Enters power n of the penetrations.
    #[inline(always)]
    pub fn set_penetration(&mut self, n: usize, values: Each) {
        if n < ROOM {
            self.penetration[n] = values;
            self.backwards[LAST - n] = values;
            self.slope[LAST - n] = each(|i| COUNT[n] * values[i]);
        }
    }

    /// Fills power n of the forces from the powers 0..=n + 1 of the penetrations, for n = 0, 1, 2, ... in turn.
    #[inline(always)]
    pub fn extend_force(&mut self, n: usize) {
        // Says once that no index below leaves its table.
        if n + 2 >= ROOM {
            return;
        }
        self.order = n;
        match self.kind {
            Kind::None => self.force[n] = [0.0; PAIRS],
            Kind::Linear => self.extend_linear(n),
            Kind::Spring => {
                self.extend_power(n);
                let power = self.power[n];
                self.force[n] = each(|i| self.stiffness[i] * power[i]);
            }
            Kind::Power => self.extend_damped_power(n),
            Kind::Root => self.extend_root(n),
        }
    }

    #[inline(always)]
    fn extend_linear(&mut self, n: usize) {
        let (d, slope) = (self.penetration[n], self.slope[LAST - (n + 1)]);
        self.force[n] = each(|i| self.stiffness[i] * d[i] + self.damping[i] * slope[i]);
    }

    #[inline(always)]
    fn extend_damped_power(&mut self, n: usize) {
        self.extend_power(n);
        let (power, product) = (self.power[n], product(&self.power, &self.slope, n));
        self.force[n] = each(|i| self.stiffness[i] * (power[i] + self.damping[i] * product[i]));
    }

    /// d^0.25 d' = (4/5) (d^1.25)': no product of series.
    #[inline(always)]
    fn extend_root(&mut self, n: usize) {
        if n == 0 {
            self.root[0] = each(|i| power(self.penetration[0][i], 1.25));
            self.root_slope[0] = [0.0; PAIRS];
            self.lead[1] = each(|i| 1.25 * self.root[0][i] * self.inverse[i]);
        }
        self.extend_power(n);
        let root = self.next_power(&self.root, &self.root_slope, [1.25; PAIRS], self.lead[1], n + 1);
        let (power, slope) = (self.power[n], each(|i| COUNT[n + 1] * root[i]));
        self.root[n + 1] = root;
        self.root_slope[n + 1] = slope;
        self.force[n] = each(|i| self.stiffness[i] * power[i] + self.damping[i] * slope[i]);
    }

    /// Term n of d^exponent.
    #[inline(always)]
    fn extend_power(&mut self, n: usize) {
        if n == 0 {
            for i in 0..PAIRS {
                self.power[0][i] = power(self.penetration[0][i], self.exponent[i]);
                self.lead[0][i] = self.exponent[i] * self.power[0][i] * self.inverse[i];
            }
            self.power_slope[0] = [0.0; PAIRS];
            return;
        }
        let next = self.next_power(&self.power, &self.power_slope, self.exponent, self.lead[0], n);
        self.power[n] = next;
        self.power_slope[n] = each(|i| COUNT[n] * next[i]);
    }

    /// Term n >= 1 of p = d^exponent, from d p' = exponent p d' (Miller's recurrence): n d_0 p_n is the sum over j < n of
    /// (exponent (n - j) - j) d_(n-j) p_j. What the newest terms d_n and p_(n-1) add comes last and by one product each,
    /// so that a processor can work on all the rest before these are known.
    #[inline(always)]
    fn next_power(&self, p: &Rows, p_slope: &Rows, exponent: Each, lead: Each, n: usize) -> Each {
        let (second, newest) = (&self.penetration[1], &self.penetration[n]);
        if n == 1 {
            return each(|i| lead[i] * newest[i]);
        }
        let (mut whole, mut weighted) = ([0.0; PAIRS], [0.0; PAIRS]);
        let older = self.backwards[LAST - (n - 1)..LAST - 1].iter().zip(&p[1..n - 1]).zip(&p_slope[1..n - 1]);
        for ((d, p), p_slope) in older {
            for i in 0..PAIRS {
                whole[i] += d[i] * p[i];
                weighted[i] += d[i] * p_slope[i];
            }
        }
        let reciprocal = RECIPROCAL[n - 1];
        each(|i| {
            let older = exponent[i] * whole[i] - ((exponent[i] + 1.0) * reciprocal) * weighted[i];
            let share = (exponent[i] + 1.0) * reciprocal - 1.0;
            let last = (self.inverse[i] * second[i]) * share * p[n - 1][i];
            (self.inverse[i] * older + last) + lead[i] * newest[i]
        })
    }

    /// Penetrations and their bounds at the x of the powers.
    pub fn read(&self, powers: &Powers) -> BlockReading {
        read(&self.penetration[..self.order + 3], powers)
    }

    /// Forces at the x of the powers, and their integral over 0..=x, N s per unit of x.
    pub fn read_force(&self, powers: &Powers) -> ForceReading {
        read_force(&self.force[..=self.order], powers)
    }

    /// J, work of the damping part of a pair's force over 0..=x: twelve points side by side.
    pub fn damping_work(&self, lane: usize, force: &Force, scale: f64, x: f64) -> f64 {
        if !force.is_damped() {
            return 0.0;
        }
        let terms = &self.penetration[..self.order + 3];
        if let Force::Linear { damping, .. } = *force {
            return damping / scale * squared_slope(terms, lane, x);
        }
        let end = terms.iter().rev().fold(0.0, |sum, term| sum * x + term[lane]);
        // A power law's damping force ends with a root of the time left: even in the square root of that time.
        let released = !force.is_regular() && end < NEARLY_RELEASED * terms[0][lane];
        let (mut at, mut weights) = ([0.0; 12], [0.0; 12]);
        for (i, (node, weight)) in gauss(TWELVE, if released { 1.0 } else { x }).enumerate().take(12) {
            let left = 1.0 - node;
            (at[i], weights[i]) =
                if released { (x * (1.0 - left * left), x * 2.0 * left * weight) } else { (node, weight) };
        }
        let (mut d, mut rate) = ([0.0; 12], [0.0; 12]);
        for term in terms.iter().rev() {
            for i in 0..12 {
                rate[i] = rate[i] * at[i] + d[i];
                d[i] = d[i] * at[i] + term[lane];
            }
        }
        let power = |i: usize| weights[i] * force.damping_power(d[i], rate[i] / scale);
        scale * (0..12).map(power).sum::<f64>()
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

/// See [`PairBlock::read_force`]. Wide instructions give the same bits.
#[multiversion::multiversion(targets("x86_64+avx2"))]
fn read_force(terms: &[Each], powers: &Powers) -> ForceReading {
    let (value, slope, fourth) = powers.all();
    let [mut values, mut slopes, mut fourths, mut integrals] = [[0.0; PAIRS]; 4];
    for (n, term) in terms.iter().enumerate() {
        let weight = RECIPROCAL[n] * value[n];
        for i in 0..PAIRS {
            values[i] += term[i] * value[n];
            slopes[i] += term[i] * slope[n];
            fourths[i] += term[i].abs() * fourth[n];
            integrals[i] += term[i] * weight;
        }
    }
    ForceReading { value: values, slope: slopes, fourth: fourths, impulse: each(|i| powers.x * integrals[i]) }
}

/// Integral over 0..=x of the square of the slope of one pair's series. Wide instructions give the same bits.
#[multiversion::multiversion(targets("x86_64+avx2"))]
fn squared_slope(terms: &[Each], lane: usize, x: f64) -> f64 {
    let (nodes, weights) = TWELVE_ABREAST;
    let half = 0.5 * x;
    let at = nodes.map(|node| half * (1.0 + node));
    let mut slope = [0.0; 12];
    for (term, count) in terms.iter().zip(&COUNT).skip(1).rev() {
        let own = count * term[lane];
        for i in 0..12 {
            slope[i] = slope[i] * at[i] + own;
        }
    }
    let mut sum = [0.0; 4];
    for k in 0..3 {
        for i in 0..4 {
            sum[i] += weights[4 * k + i] * (slope[4 * k + i] * slope[4 * k + i]);
        }
    }
    half * ((sum[0] + sum[2]) + (sum[1] + sum[3]))
}

/// A number for each pair: unlike `std::array::from_fn` it always becomes one wide instruction after the other.
#[inline(always)]
fn each(of: impl Fn(usize) -> f64) -> Each {
    let mut all = [0.0; PAIRS];
    for (i, one) in all.iter_mut().enumerate() {
        *one = of(i);
    }
    all
}

/// Sum over j <= n of a_j b_(n + 1 - j), with b backwards and the newest terms last.
#[inline(always)]
fn product(a: &Rows, backwards: &Rows, n: usize) -> Each {
    let mut sum = [0.0; PAIRS];
    for (a, b) in a[1..=n].iter().zip(&backwards[LAST - n..LAST]) {
        for i in 0..PAIRS {
            sum[i] += a[i] * b[i];
        }
    }
    let newest = &backwards[LAST - (n + 1)];
    each(|i| sum[i] + a[0][i] * newest[i])
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The terms of k d^n (1 + b d') for d = 1 + x, from the binomial series.
    #[test]
    fn a_damped_power_of_a_straight_line_is_the_binomial_series() {
        let force = Force::Power { stiffness: 3.0, exponent: 1.7, damping: 0.5 };
        let mut block = PairBlock::default();
        block.start(Kind::of(&force));
        block.add(&force, 1.0, 1.0, 1.0);
        let mut binomial = 1.0;
        for n in 0..12 {
            block.set_penetration(n + 2, [0.0; PAIRS]);
            block.extend_force(n);
            let expected: f64 = 3.0 * 1.5 * binomial;
            assert!((block.force[n][0] - expected).abs() <= 1e-14 * expected.abs(), "{n}: {}", block.force[n][0]);
            binomial *= (1.7 - n as f64) / (n + 1) as f64;
        }
    }

    #[test]
    fn lanes_do_not_disturb_each_other() {
        let forces = [(2.0, 0.3), (1.0, 0.7)];
        let series = |which: &[usize]| {
            let mut block = PairBlock::default();
            block.start(Kind::Root);
            for &i in which {
                let (stiffness, damping) = forces[i];
                block.add(&Force::Root { stiffness, damping }, 1.0, 0.5 + i as f64, -0.1);
            }
            for n in 0..8 {
                block.set_penetration(n + 2, [0.01 / (n + 1) as f64; PAIRS]);
                block.extend_force(n);
            }
            block.force.map(|row| row[which.len() - 1])
        };
        assert_eq!(series(&[1]), series(&[0, 1]));
        assert_ne!(series(&[0]), series(&[1]));
    }
}
