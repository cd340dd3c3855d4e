//! A polynomial in blocks of four terms: four polynomials in x^4, evaluated side by side by Horner's rule.

use super::hermite::End;
use super::turning_point::Knot;
use crate::numerics::polynomial::{Coefficients, FOURTH, MAX_TERMS, each};

/// Number of terms that are worked on side by side.
pub(super) const BLOCK: usize = 4;

/// The coefficients of a polynomial, filled up with zeros to whole blocks.
///
/// With y = x^[`BLOCK`] it is P0(y) + x P1(y) + x^2 P2(y) + x^3 P3(y); the four are evaluated side by side.
pub(super) struct Terms {
    pub all: Coefficients,
    /// Number of blocks in use.
    blocks: usize,
}

/// Values of P0, P1, P2 and P3, or four coefficients, one for each of them.
pub(super) type FourTerms = [f64; BLOCK];

/// The powers of x up to y = x^[`BLOCK`].
#[derive(Clone, Copy)]
pub(super) struct LowPowers {
    x: f64,
    x2: f64,
    x3: f64,
    y: f64,
}

impl LowPowers {
    #[inline(always)]
    pub(super) fn at(x: f64) -> LowPowers {
        let x2 = x * x;
        LowPowers { x, x2, x3: x * x2, y: x2 * x2 }
    }

    /// P0 + x P1 + x^2 P2 + x^3 P3, from the values of the four.
    #[inline(always)]
    pub(super) fn total(self, [a, b, c, d]: FourTerms) -> f64 {
        (a + c * self.x2) + (b * self.x + d * self.x3)
    }

    /// P1 + 2 x P2 + 3 x^2 P3: the slope at constant y, from the values of the four.
    #[inline(always)]
    pub(super) fn slope(self, [_, b, c, d]: FourTerms) -> f64 {
        (b + 3.0 * d * self.x2) + 2.0 * c * self.x
    }
}

impl Terms {
    /// A polynomial with these coefficients.
    pub(super) fn of(coefficients: &[f64]) -> Terms {
        let mut terms = Terms::empty();
        terms.all[..coefficients.len()].copy_from_slice(coefficients);
        terms.complete(coefficients.len());
        terms
    }

    /// No terms, to be filled and completed.
    pub(super) fn empty() -> Terms {
        Terms { all: [0.0; MAX_TERMS], blocks: 0 }
    }

    /// Fills up with zeros after the first `count` coefficients, which are in place.
    pub(super) fn complete(&mut self, count: usize) {
        self.blocks = count.div_ceil(BLOCK).min(MAX_TERMS / BLOCK);
        self.all[count..self.blocks * BLOCK].fill(0.0);
    }

    /// The coefficients in blocks.
    #[inline(always)]
    pub(super) fn blocks(&self) -> &[FourTerms] {
        &self.all.as_chunks::<BLOCK>().0[..self.blocks]
    }

    /// Value, slope and bound on the fourth derivative at x.
    pub(super) fn at(&self, x: f64) -> End {
        point(self.blocks(), x)
    }

    /// Value at x.
    #[inline(always)]
    pub(super) fn value(&self, x: f64) -> f64 {
        let at = LowPowers::at(x);
        let mut value = [0.0; BLOCK];
        for block in self.blocks().iter().rev() {
            value = each(|i| value[i] * at.y + block[i]);
        }
        at.total(value)
    }

    /// Value and slope at x.
    #[inline(always)]
    pub(super) fn value_and_slope(&self, x: f64) -> (f64, f64) {
        value_and_slope(self.blocks(), LowPowers::at(x))
    }

    /// Value and slope at x, with the x.
    #[inline(always)]
    pub(super) fn knot(&self, x: f64) -> Knot {
        let (value, slope) = self.value_and_slope(x);
        Knot { x, value, slope }
    }

    /// Sum of the magnitudes of all terms at x >= 0.
    pub(super) fn size(&self, x: f64) -> f64 {
        let at = LowPowers::at(x);
        let mut size = [0.0; BLOCK];
        for block in self.blocks().iter().rev() {
            size = each(|i| size[i] * at.y + block[i].abs());
        }
        at.total(size)
    }
}

/// Value and slope at a point, as [`Terms::value_and_slope`], from the blocks.
#[inline(always)]
pub(super) fn value_and_slope(blocks: &[FourTerms], at: LowPowers) -> (f64, f64) {
    let (mut value, mut by_y) = ([0.0; BLOCK], [0.0; BLOCK]);
    for block in blocks.iter().rev() {
        by_y = each(|i| by_y[i] * at.y + value[i]);
        value = each(|i| value[i] * at.y + block[i]);
    }
    (at.total(value), at.slope(value) + 4.0 * at.x3 * at.total(by_y))
}

/// See [`Terms::at`].
#[multiversion::multiversion(targets("x86_64+avx2"))]
pub fn point(blocks: &[FourTerms], x: f64) -> End {
    let at = LowPowers::at(x);
    let (value, slope) = value_and_slope(blocks, at);
    let mut fourth = [0.0; BLOCK];
    let factors = FOURTH.as_chunks::<BLOCK>().0;
    for (block, factor) in blocks.iter().zip(factors).skip(1).rev() {
        fourth = each(|i| fourth[i] * at.y + block[i].abs() * factor[i]);
    }
    End { x, value, slope, fourth: at.total(fourth) }
}
