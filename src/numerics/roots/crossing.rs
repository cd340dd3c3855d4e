//! The first passage of a polynomial upwards through 0, or the proof that there is none.

use super::hermite::{End, NARROWEST};
use super::terms::Terms;
use crate::numerics::polynomial::FOURTH;
use std::cell::Cell;

/// Pieces that a search for a rise may halve before what it finds is taken for rounding: one that means anything takes
/// some dozens (a scene that needs this: `stress/work_limits.rs`).
const MOST_HALVINGS: u32 = 20_000;

/// Newton steps relative to x below which the next one starts from a round number.
const NEAR: f64 = 1e-8;

/// Newton steps relative to x from a round number after which the root is right to rounding.
const NEXT_TO: f64 = 1e-11;

/// Doublings of one rounding by which a root may have to be put off to where rounding sees the curve above 0.
const MOST_DOUBLINGS: u32 = 12;

/// Where a polynomial, taken as below 0 (or on its way up from exactly 0) at x = 0, first passes 0 upwards in 0..=end.
///
/// A start above 0 counts as exactly 0, which is what it is but for rounding. A rise that stays below `noise`, the
/// rounding error of the coefficients, is none.
pub fn first_upcrossing(coefficients: &mut [f64], end: f64, noise: f64) -> Option<f64> {
    coefficients[0] = coefficients[0].min(0.0);
    if coefficients[0] == 0.0 {
        return first_upcrossing_from_zero(coefficients, end, noise);
    }
    Curve { terms: &Terms::of(coefficients), noise, left: None }.first_upcrossing_up_to(end)
}

/// As above with the root at x = 0 divided out: the sign just after it is that of the first power that is not 0.
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

/// A polynomial with what is left out of account.
struct Curve<'a> {
    terms: &'a Terms,
    noise: f64,
    /// Halvings that are left for all pieces together, where they are counted.
    left: Option<&'a Cell<u32>>,
}

impl Curve<'_> {
    /// The first rise in 0..=end. A curve that stays within rounding of 0 has passages everywhere, which the search would
    /// follow up to the last of a billion pieces: there what lies below rounding is none.
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

    /// Whether a piece may be halved once more.
    fn may_halve(&self) -> bool {
        let Some(left) = self.left else { return true };
        left.set(left.get().saturating_sub(1));
        left.get() > 0
    }

    /// The first x in the piece at which the curve passes 0 upwards, given that it is below 0 before the piece.
    fn first_upcrossing(&self, a: End, b: End) -> Option<f64> {
        let upper_bound = b.upper_bound_from(a);
        // Numbers that have overflowed have no roots; the state that they lead to is refused.
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

    /// The root between a point below 0 and one above, or the number just behind it: the curve is not below 0 there, so
    /// that two curves that are the same to the last bit have both passed at the root of either.
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

/// Newton, kept inside a shrinking bracket. The last step starts from a round number: so the root of a curve that is
/// steep there hardly depends on the way to it. Wide instructions give the same bits.
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

/// About where the cubic interpolant of a piece passes 0, somewhere in the piece.
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

/// x to twelve digits: neighbours become the same number.
fn round(x: f64) -> f64 {
    const LEFT_OUT: u64 = (1 << 12) - 1;
    f64::from_bits((x.to_bits() + (LEFT_OUT >> 1)) & !LEFT_OUT)
}
