//! The first upward crossing of 0 by a polynomial, or the proof that there is none.

use super::hermite::{End, NARROWEST};
use super::terms::Terms;
use crate::numerics::polynomial::FOURTH;
use std::cell::Cell;

/// Halvings of all pieces together after which a search takes what it finds for rounding: a genuine search needs some
/// dozens (a scene that reaches the limit: `stress/work_limits.rs`).
const MOST_HALVINGS: u32 = 20_000;

/// Newton's step relative to x below which the next iteration starts from x rounded to twelve digits.
const NEAR: f64 = 1e-8;

/// Newton's step relative to x, from a rounded start, below which the root is accurate to rounding.
const NEXT_TO: f64 = 1e-11;

/// Doublings of one rounding error by which a root may be moved up until the evaluated polynomial is not below 0.
const MOST_DOUBLINGS: u32 = 12;

/// The x in 0..=end at which a polynomial first crosses 0 upwards; it is below 0 just after x = 0, or starts exactly
/// there.
///
/// A start above 0 is rounding and counts as exactly 0. A crossing after which the polynomial stays below `noise`, the
/// rounding error of its coefficients, is none.
pub(crate) fn first_upcrossing(coefficients: &mut [f64], end: f64, noise: f64) -> Option<f64> {
    coefficients[0] = coefficients[0].min(0.0);
    if coefficients[0] == 0.0 {
        return first_upcrossing_from_zero(coefficients, end, noise);
    }
    Curve { terms: &Terms::of(coefficients), noise, left: None }.first_upcrossing_up_to(end)
}

/// As above for a start at exactly 0, by dividing out the root at x = 0: the first power with a non-zero coefficient
/// decides the sign just after it.
fn first_upcrossing_from_zero(coefficients: &[f64], end: f64, noise: f64) -> Option<f64> {
    if noise > 0.0 {
        let terms = Terms::of(coefficients);
        let whole = Curve { terms: &terms, noise, left: None };
        if terms.at(end).upper_bound_from(whole.start()) <= noise {
            return None;
        }
    }
    let leading = coefficients.iter().position(|c| *c != 0.0)?;
    let rest = &coefficients[leading..];
    if rest[0] > 0.0 {
        return Some(0.0);
    }
    Curve { terms: &Terms::of(rest), noise, left: None }.first_upcrossing_up_to(end)
}

/// A polynomial and the level below which its values are rounding.
struct Curve<'a> {
    terms: &'a Terms,
    /// Rounding error of the coefficients.
    noise: f64,
    /// Halvings left for all pieces together; absent where they are not limited.
    left: Option<&'a Cell<u32>>,
}

impl Curve<'_> {
    /// The first upward crossing in 0..=end. A curve within rounding of 0 crosses it everywhere, and following these
    /// crossings would take a billion pieces: when the halvings are used up, the search is repeated with the rounding
    /// error of the terms as the noise.
    fn first_upcrossing_up_to(&self, end: f64) -> Option<f64> {
        let left = Cell::new(MOST_HALVINGS);
        let counted = Curve { left: Some(&left), ..*self };
        let (start, end) = (self.start(), self.terms.at(end));
        let found = counted.first_upcrossing(start, end);
        if left.get() > 0 {
            return found;
        }
        left.set(MOST_HALVINGS);
        let noise = self.noise.max(4.0 * f64::EPSILON * self.terms.size(end.x));
        Curve { noise, ..counted }.first_upcrossing(start, end)
    }

    fn start(&self) -> End {
        End { x: 0.0, value: self.terms.all[0], slope: self.terms.all[1], fourth: FOURTH[4] * self.terms.all[4].abs() }
    }

    /// Counts a halving; returns whether it was still allowed.
    fn may_halve(&self) -> bool {
        let Some(left) = self.left else { return true };
        left.set(left.get().saturating_sub(1));
        left.get() > 0
    }

    /// The first x in the piece at which the curve crosses 0 upwards, given that it is below 0 before the piece.
    fn first_upcrossing(&self, a: End, b: End) -> Option<f64> {
        let upper_bound = b.upper_bound_from(a);
        // Overflowed numbers have no roots; the state that they lead to is refused.
        if upper_bound <= self.noise || !upper_bound.is_finite() {
            return None;
        }
        if a.value >= 0.0 && a.slope > 0.0 {
            return Some(a.x);
        }
        if b.value > 0.0 && b.slopes_from(a).0 > 0.0 {
            return Some(self.root(a, b));
        }
        if b.x - a.x < NARROWEST {
            return (b.value > self.noise).then(|| self.root(a, b));
        }
        if !self.may_halve() {
            return None;
        }
        let middle = self.terms.at(0.5 * (a.x + b.x));
        self.first_upcrossing(a, middle).or_else(|| self.first_upcrossing(middle, b))
    }

    /// The root between a point below 0 and one above, moved up by rounding errors until the curve is not below 0
    /// there: of two curves that agree to the last bit, both have then crossed at the root of either.
    fn root(&self, a: End, b: End) -> f64 {
        let root = newton(self.terms, a, b);
        let (mut x, mut further) = (root, f64::EPSILON * root);
        for _ in 0..MOST_DOUBLINGS {
            if self.terms.value(x) >= 0.0 {
                return x;
            }
            x = (root + further).min(b.x);
            further *= 2.0;
        }
        root
    }
}

/// Newton's method, kept inside a shrinking bracket. The last iteration starts from a rounded x, so that the root of a
/// steep curve hardly depends on the iterates before.
#[multiversion::multiversion(targets("x86_64+avx2"))]
fn newton(terms: &Terms, a: End, b: End) -> f64 {
    let (mut low, mut high) = (a.x, b.x);
    let mut x = root_of_cubic(a, b);
    let mut is_round = false;
    for _ in 0..100 {
        let (f, slope) = terms.value_and_slope(x);
        if f > 0.0 {
            high = x;
        } else {
            low = x;
        }
        let step = f / slope;
        if is_round && step.abs() <= NEXT_TO * x {
            return (x - step).clamp(a.x, b.x);
        }
        let newton = x - step;
        let mut next = if newton > low && newton < high { newton } else { 0.5 * (low + high) };
        if next == x || next <= low && low == x || high - low <= f64::EPSILON * high {
            return next;
        }
        if is_round && (next - x).abs() <= 0.25 * f64::EPSILON * x {
            return next;
        }
        if !is_round && step.abs() <= NEAR * x {
            is_round = true;
            next = round(next).clamp(a.x, b.x);
        }
        x = next;
    }
    x
}

/// The approximate zero of the cubic interpolant of a piece, inside the piece.
fn root_of_cubic(a: End, b: End) -> f64 {
    let w = b.x - a.x;
    let (first, rise, last) = (w * a.slope, b.value - a.value, w * b.slope);
    let (second, third) = (3.0 * rise - 2.0 * first - last, first + last - 2.0 * rise);
    let mut s = (-a.value / rise).clamp(0.0, 1.0);
    for _ in 0..3 {
        let value = a.value + s * (first + s * (second + s * third));
        let slope = first + s * (2.0 * second + s * (3.0 * third));
        let next = s - value / slope;
        if !(next > 0.0 && next < 1.0) {
            break;
        }
        s = next;
    }
    a.x + w * s
}

/// x rounded to twelve digits: neighbouring numbers become equal.
fn round(x: f64) -> f64 {
    const LEFT_OUT: u64 = (1 << 12) - 1;
    f64::from_bits((x.to_bits() + (LEFT_OUT >> 1)) & !LEFT_OUT)
}
