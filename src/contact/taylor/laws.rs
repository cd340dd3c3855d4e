//! The powers of forces from those of the penetrations, for each kind of law.

use super::block::{Each, LAST, PAIRS, PairBlock, ROOT, Sloped};
use crate::contact::force::Kind;
use crate::numerics::polynomial::{COUNT, MAX_TERMS, RECIPROCAL, each};

/// Power n of the forces of a block.
#[inline(always)]
fn force(block: &mut PairBlock, n: usize) -> Each {
    match block.kind {
        Kind::None => [0.0; PAIRS],
        Kind::Linear => linear(block, n),
        Kind::Spring => spring(block, n),
        Kind::Damped => damped(block, n),
        Kind::Root => root(block, n),
    }
}

/// [`Kind::Linear`].
#[inline(always)]
fn linear(block: &mut PairBlock, n: usize) -> Each {
    let (d, next) = (&block.penetration[n], &block.penetration[n + 1]);
    each(|i| block.stiffness[i] * d[i] + block.damping[i] * (COUNT[n + 1] * next[i]))
}
/// [`Kind::Spring`].
#[inline(always)]
fn spring(block: &mut PairBlock, n: usize) -> Each {
    let mut sums = [[0.0; PAIRS]; 2];
    if n >= 2 {
        add_all_products(&mut sums, &block.backwards[LAST - (n - 1)..LAST - 1], &block.power[1..n - 1]);
    }
    let power = block.extend_power(n, &sums);
    each(|i| block.stiffness[i] * power[i])
}
/// [`Kind::Damped`]: d^n (1 + b d'), the product with the newest terms last.
#[inline(always)]
fn damped(block: &mut PairBlock, n: usize) -> Each {
    let (mut sums, mut product) = ([[0.0; PAIRS]; 2], [0.0; PAIRS]);
    if n >= 2 {
        let depths = &block.backwards[LAST - (n - 1)..LAST - 1];
        let slopes = &block.slope[LAST - n..LAST - 2];
        for ((d, slope), p) in depths.iter().zip(slopes).zip(&block.power[1..n - 1]) {
            add_products(&mut sums, d, p);
            add_product(&mut product, &p[0], slope);
        }
        add_product(&mut product, &block.power[n - 1][0], &block.slope[LAST - 2]);
    }
    let power = block.extend_power(n, &sums);
    if n > 0 {
        add_product(&mut product, &power, &block.slope[LAST - 1]);
    }
    add_product(&mut product, &block.power[0][0], &block.slope[LAST - (n + 1)]);
    each(|i| block.stiffness[i] * (power[i] + block.damping[i] * product[i]))
}

/// [`Kind::Root`]: d^0.25 d' = (4/5) (d^1.25)', no product of series, but a root that is one power ahead.
#[inline(always)]
fn root(block: &mut PairBlock, n: usize) -> Each {
    let (mut sums, mut roots) = ([[0.0; PAIRS]; 2], [[0.0; PAIRS]; 2]);
    if n >= 2 {
        add_products(&mut roots, &block.backwards[LAST - n], &block.root[1]);
        let depths = &block.backwards[LAST - (n - 1)..LAST - 1];
        for ((d, p), root) in depths.iter().zip(&block.power[1..n - 1]).zip(&block.root[2..n]) {
            add_products(&mut sums, d, p);
            add_products(&mut roots, d, root);
        }
    }
    let power = block.extend_power(n, &sums);
    let root = block.next_power(&block.root, [ROOT; PAIRS], block.lead[1], &roots, n + 1);
    let slope = each(|i| COUNT[n + 1] * root[i]);
    block.root[n + 1] = [root, slope];
    each(|i| block.stiffness[i] * power[i] + block.damping[i] * slope[i])
}
impl PairBlock {
    /// Enters power n of the penetrations, of pairs under a law.
    #[inline(always)]
    pub(crate) fn set_penetration(&mut self, n: usize, values: Each) {
        if n < MAX_TERMS {
            self.penetration[n] = values;
            self.backwards[LAST - n] = values;
            if self.kind == Kind::Damped {
                self.slope[LAST - n] = each(|i| COUNT[n] * values[i]);
            }
        }
    }

    /// Fills power n of the forces, from the powers 0..=n + 1 of the penetrations, for n = 0, 1,
    /// 2, ... in turn, and returns it.
    #[inline(always)]
    pub(crate) fn extend_force(&mut self, n: usize) -> Each {
        // Equal lengths: no bounds checks below.
        if n + 2 >= MAX_TERMS {
            return [0.0; PAIRS];
        }
        self.order = n;
        self.force[n] = force(self, n);
        self.force[n]
    }

    /// Enters term n of d^exponent.
    #[inline(always)]
    fn extend_power(&mut self, n: usize, sums: &[Each; 2]) -> Each {
        if n == 0 {
            return self.power[0][0];
        }
        let next = self.next_power(&self.power, self.exponent, self.lead[0], sums, n);
        self.power[n] = [next, each(|i| COUNT[n] * next[i])];
        next
    }

    /// Term n >= 1 of p = d^exponent, from d p' = exponent p d' (Miller's recurrence): n d_0 p_n is the sum over j < n of
    /// (exponent (n - j) - j) d_(n-j) p_j. `sums` are those of d_(n-j) p_j and of d_(n-j) j p_j over 0 < j < n - 1. What
    /// the newest terms d_n and p_(n-1) add comes last and by one product each, so that a processor can work on all the
    /// rest before these are known.
    #[inline(always)]
    fn next_power(&self, p: &Sloped, exponent: Each, lead: Each, [whole, weighted]: &[Each; 2], n: usize) -> Each {
        let (second, newest) = (&self.penetration[1], &self.penetration[n]);
        if n == 1 {
            return each(|i| lead[i] * newest[i]);
        }
        let reciprocal = RECIPROCAL[n - 1];
        each(|i| {
            let older = exponent[i] * whole[i] - ((exponent[i] + 1.0) * reciprocal) * weighted[i];
            let share = (exponent[i] + 1.0) * reciprocal - 1.0;
            let last = (self.inverse[i] * second[i]) * share * p[n - 1][0][i];
            (self.inverse[i] * older + last) + lead[i] * newest[i]
        })
    }
}

/// sum += a b.
#[inline(always)]
fn add_product(sum: &mut Each, a: &Each, b: &Each) {
    for i in 0..PAIRS {
        sum[i] += a[i] * b[i];
    }
}

/// The same for a term and for n times it.
#[inline(always)]
fn add_products(sums: &mut [Each; 2], d: &Each, term: &[Each; 2]) {
    for (sum, term) in sums.iter_mut().zip(term) {
        add_product(sum, d, term);
    }
}

/// The same for as many terms as there are, two in a row.
#[inline(always)]
fn add_all_products(sums: &mut [Each; 2], d: &[Each], terms: &[[Each; 2]]) {
    let ((d, last), (terms, last_term)) = (d.as_chunks::<2>(), terms.as_chunks::<2>());
    for (d, terms) in d.iter().zip(terms) {
        add_products(sums, &d[0], &terms[0]);
        add_products(sums, &d[1], &terms[1]);
    }
    if let ([d], [term]) = (last, last_term) {
        add_products(sums, d, term);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::force::Force;

    /// The terms of a force for d = (1 + x)^2 and d' = 2 (1 + x): those of a sum of powers (factor, exponent) of 1 + x.
    fn compare(force: Force, powers: &[(f64, f64)]) {
        let mut block = PairBlock::default();
        block.start(Kind::of(&force));
        block.add(0, &force, 1.0, 1.0, 2.0);
        for n in 0..12 {
            block.set_penetration(n + 2, [if n == 0 { 1.0 } else { 0.0 }; PAIRS]);
            block.extend_force(n);
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
                block.set_penetration(n + 2, [0.01 / (n + 1) as f64; PAIRS]);
                block.extend_force(n);
            }
            block.force.map(|row| row[which.len() - 1])
        };
        assert_eq!(series(&[1]), series(&[0, 1]));
        assert_ne!(series(&[0]), series(&[1]));
    }
}
