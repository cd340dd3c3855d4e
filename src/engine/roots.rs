//! Certified roots and maxima of the polynomials that describe a step.
//!
//! On a piece of width w the cubic Hermite interpolant of a function from its end values and slopes is off by at most
//! w^4/384 max|f''''|, and a cubic in Bernstein form lies between its four control points. A piece on which the
//! control points and the bound stay on one side of 0 holds no root; a piece on which the slope keeps its sign holds
//! at most one; any other piece is halved. So the first root is found, or there is none: nothing is sampled.

use crate::polynomial::{Coefficients, FOURTH, ROOM, Reading, each};
use std::cell::Cell;

/// Pieces are not halved below this fraction of the step: two roots closer than this are one touch without duration.
const NARROWEST: f64 = 1e-9;

/// Pieces that a search for a rise may halve before what it finds is taken for rounding: one that means anything takes
/// some dozens (a scene that needs this: `stress/work_limits.rs`).
const MOST_HALVINGS: u32 = 20_000;

/// Newton steps relative to x below which the next one starts from a round number.
const NEAR: f64 = 1e-8;

/// Newton steps relative to x from a round number after which the root is right to rounding.
const NEXT_TO: f64 = 1e-11;

/// Doublings of one rounding by which a root may have to be put off to where rounding sees the curve above 0.
const MOST_DOUBLINGS: u32 = 12;

/// Terms that are worked on without a question in between.
const BLOCK: usize = 4;

/// The terms of a polynomial, filled up with zeros to whole blocks.
///
/// With y = x^[`BLOCK`] it is P0(y) + x P1(y) + x^2 P2(y) + ..., which are evaluated abreast, each by Horner's rule.
struct Terms {
    all: Coefficients,
    blocks: usize,
}

/// What a block of terms comes to.
type Block = [f64; BLOCK];

/// The powers of x up to y = x^[`BLOCK`].
#[derive(Clone, Copy)]
struct Place {
    x: f64,
    x2: f64,
    x3: f64,
    y: f64,
}

impl Place {
    #[inline(always)]
    fn at(x: f64) -> Place {
        let x2 = x * x;
        Place { x, x2, x3: x * x2, y: x2 * x2 }
    }

    /// P0 + x P1 + ...
    #[inline(always)]
    fn total(self, [a, b, c, d]: Block) -> f64 {
        (a + c * self.x2) + (b * self.x + d * self.x3)
    }

    /// P1 + 2 x P2 + ...: the slope as far as y stays as it is.
    #[inline(always)]
    fn slope(self, [_, b, c, d]: Block) -> f64 {
        (b + 3.0 * d * self.x2) + 2.0 * c * self.x
    }
}

impl Terms {
    fn of(coefficients: &[f64]) -> Terms {
        let mut terms = Terms::empty();
        terms.all[..coefficients.len()].copy_from_slice(coefficients);
        terms.complete(coefficients.len());
        terms
    }

    fn empty() -> Terms {
        Terms { all: [0.0; ROOM], blocks: 0 }
    }

    /// Fills up what follows on the coefficients, of which there are `count`.
    fn complete(&mut self, count: usize) {
        self.blocks = count.div_ceil(BLOCK).min(ROOM / BLOCK);
        self.all[count..self.blocks * BLOCK].fill(0.0);
    }

    #[inline(always)]
    fn blocks(&self) -> &[Block] {
        &self.all.as_chunks::<BLOCK>().0[..self.blocks]
    }

    /// A point of the curve.
    fn at(&self, x: f64) -> End {
        point(self.blocks(), x)
    }

    #[inline(always)]
    fn value(&self, x: f64) -> f64 {
        let at = Place::at(x);
        let mut value = [0.0; BLOCK];
        for block in self.blocks().iter().rev() {
            value = each(|i| value[i] * at.y + block[i]);
        }
        at.total(value)
    }

    #[inline(always)]
    fn value_and_slope(&self, x: f64) -> (f64, f64) {
        value_and_slope(self.blocks(), Place::at(x))
    }

    /// Slope and curvature.
    #[inline(always)]
    fn bend(&self, x: f64) -> (f64, f64) {
        let at = Place::at(x);
        let (mut value, mut by_y, mut half) = ([0.0; BLOCK], [0.0; BLOCK], [0.0; BLOCK]);
        for block in self.blocks().iter().rev() {
            half = each(|i| half[i] * at.y + by_y[i]);
            by_y = each(|i| by_y[i] * at.y + value[i]);
            value = each(|i| value[i] * at.y + block[i]);
        }
        // dy/dx = 4 x^3.
        let rate = 4.0 * at.x3;
        let bend_of_y = 12.0 * at.x2 * at.total(by_y) + 2.0 * (rate * rate) * at.total(half);
        let own = 2.0 * value[2] + 6.0 * (value[3] * at.x);
        let slope = at.slope(value) + rate * at.total(by_y);
        (slope, own + 2.0 * rate * at.slope(by_y) + bend_of_y)
    }

    /// Sum of the sizes of all terms at x.
    fn size(&self, x: f64) -> f64 {
        let at = Place::at(x);
        let mut size = [0.0; BLOCK];
        for block in self.blocks().iter().rev() {
            size = each(|i| size[i] * at.y + block[i].abs());
        }
        at.total(size)
    }
}

#[inline(always)]
fn value_and_slope(blocks: &[Block], at: Place) -> (f64, f64) {
    let (mut value, mut by_y) = ([0.0; BLOCK], [0.0; BLOCK]);
    for block in blocks.iter().rev() {
        by_y = each(|i| by_y[i] * at.y + value[i]);
        value = each(|i| value[i] * at.y + block[i]);
    }
    (at.total(value), at.slope(value) + 4.0 * at.x3 * at.total(by_y))
}

/// See [`Terms::at`]. Wide instructions give the same bits.
#[multiversion::multiversion(targets("x86_64+avx2"))]
fn point(blocks: &[Block], x: f64) -> End {
    let at = Place::at(x);
    let (value, slope) = value_and_slope(blocks, at);
    let mut fourth = [0.0; BLOCK];
    let factors = FOURTH.as_chunks::<BLOCK>().0;
    for (block, factor) in blocks.iter().zip(factors).skip(1).rev() {
        fourth = each(|i| fourth[i] * at.y + block[i].abs() * factor[i]);
    }
    End { x, value, slope, fourth: at.total(fourth) }
}

/// A polynomial with what is left out of account.
struct Curve<'a> {
    terms: &'a Terms,
    noise: f64,
    /// Halvings that are left for all pieces together, where they are counted.
    left: Option<&'a Cell<u32>>,
}

/// One end of a piece.
#[derive(Clone, Copy)]
struct End {
    x: f64,
    value: f64,
    slope: f64,
    /// Bound on the fourth derivative over 0..=x: what happens further out says nothing about the pieces before.
    fourth: f64,
}

impl Curve<'_> {
    /// The first rise in 0..=end. A curve that stays within rounding of 0 has passages everywhere, which the search would
    /// follow up to the last of a billion pieces: there what lies below rounding is none.
    fn first_rise_up_to(&self, end: f64) -> Option<f64> {
        let left = Cell::new(MOST_HALVINGS);
        let counted = Curve { left: Some(&left), ..*self };
        let (start, end) = (self.start(), self.terms.at(end));
        let found = counted.first_rise(start, end);
        if left.get() > 0 {
            return found;
        }
        left.set(MOST_HALVINGS);
        let noise = self.noise.max(4.0 * f64::EPSILON * self.terms.size(end.x));
        Curve { noise, ..counted }.first_rise(start, end)
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
    fn first_rise(&self, a: End, b: End) -> Option<f64> {
        let ceiling = b.ceiling_from(a);
        // Numbers that have overflowed have no roots; the state that they lead to is refused.
        if ceiling <= self.noise || !ceiling.is_finite() {
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
        self.first_rise(a, middle).or_else(|| self.first_rise(middle, b))
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

    /// Raises `best` = (x, value) to the largest value over a piece.
    fn maximum(&self, a: End, b: End, best: &mut (f64, f64)) {
        for end in [a, b] {
            if end.value > best.1 {
                *best = (end.x, end.value);
            }
        }
        let ceiling = b.ceiling_from(a);
        // What exceeds the best by rounding only is none, and would be searched for ever.
        if ceiling <= best.1 + self.noise || !ceiling.is_finite() || b.x - a.x < NARROWEST {
            return;
        }
        let (least, most) = b.slopes_from(a);
        if least > 0.0 || most < 0.0 {
            return;
        }
        if b.is_concave_from(a) {
            if a.slope > 0.0 && b.slope < 0.0 {
                let x = top(self.terms, a, b);
                let value = self.terms.value(roughly(x));
                if value > best.1 {
                    *best = (x, value);
                }
            }
            return;
        }
        let middle = self.terms.at(0.5 * (a.x + b.x));
        self.maximum(a, middle, best);
        self.maximum(middle, b, best);
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

/// Where the slope of a concave piece passes 0: Newton, kept inside a shrinking bracket. Wide
/// instructions give the same bits.
#[multiversion::multiversion(targets("x86_64+avx2"))]
fn top(terms: &Terms, a: End, b: End) -> f64 {
    let (mut low, mut high) = (a.x, b.x);
    let mut x = top_of_cubic(a, b);
    for _ in 0..60 {
        let (slope, curvature) = terms.bend(x);
        if slope > 0.0 {
            low = x;
        } else {
            high = x;
        }
        let step = slope / curvature;
        let newton = x - step;
        let next = if newton > low && newton < high { newton } else { 0.5 * (low + high) };
        // The next step would be its square, and the value at the top is flat.
        if step.abs() <= 1e-7 * (b.x - a.x) {
            return if newton >= a.x && newton <= b.x { newton } else { x };
        }
        x = next;
    }
    x
}

impl End {
    /// Upper bound over the piece that ends here.
    fn ceiling_from(self, a: End) -> f64 {
        let w = self.x - a.x;
        ceiling((a.value, a.slope), (self.value, self.slope), w, self.fourth)
    }

    /// Bounds on the slope over a piece (that of the interpolant is off by at most sqrt(3)/216 w^3 max|f''''|).
    fn slopes_from(self, a: End) -> (f64, f64) {
        let w = self.x - a.x;
        // Control values of the interpolant's slope: a.slope, this, b.slope.
        let middle = 3.0 * (self.value - a.value) / w - (a.slope + self.slope);
        let error = 0.00802 * w * w * w * self.fourth;
        (a.slope.min(middle).min(self.slope) - error, a.slope.max(middle).max(self.slope) + error)
    }

    /// Whether the curvature is negative over a piece (that of the interpolant is off by at most w^2/12 max|f''''|).
    fn is_concave_from(self, a: End) -> bool {
        let w = self.x - a.x;
        let secant = (self.value - a.value) / w;
        let at_a = (6.0 * secant - 4.0 * a.slope - 2.0 * self.slope) / w;
        let at_b = (-6.0 * secant + 2.0 * a.slope + 4.0 * self.slope) / w;
        at_a.max(at_b) < -w * w / 12.0 * self.fourth
    }
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

/// About where the cubic interpolant of a piece that rises first and falls then is highest, somewhere in the piece.
fn top_of_cubic(a: End, b: End) -> f64 {
    let w = b.x - a.x;
    let middle = 3.0 * (b.value - a.value) / w - (a.slope + b.slope);
    let (second, third) = (2.0 * (middle - a.slope), a.slope - 2.0 * middle + b.slope);
    let mut s = (a.slope / (a.slope - b.slope)).clamp(0.0, 1.0);
    for _ in 0..2 {
        let next = s - (a.slope + s * (second + s * third)) / (second + 2.0 * third * s);
        if !(next > 0.0 && next < 1.0) {
            break;
        }
        s = next;
    }
    a.x + w * s
}

/// x to eight digits. The value at a top is flat: there it is right to sixteen, and the same to the last bit however far a
/// curve is looked at, so that no peak falls by a rounding.
pub fn roughly(x: f64) -> f64 {
    const LEFT_OUT: u64 = (1 << 26) - 1;
    f64::from_bits((x.to_bits() + (LEFT_OUT >> 1)) & !LEFT_OUT)
}

/// x to twelve digits: neighbours become the same number.
fn round(x: f64) -> f64 {
    const LEFT_OUT: u64 = (1 << 12) - 1;
    f64::from_bits((x.to_bits() + (LEFT_OUT >> 1)) & !LEFT_OUT)
}

/// Upper bound over 0..=x of a polynomial from its values and slopes at both ends and the bound on its fourth derivative.
pub fn ceiling((value, slope): (f64, f64), (end, end_slope): (f64, f64), x: f64, fourth: f64) -> f64 {
    let [first, second] = [value + x * slope / 3.0, end - x * end_slope / 3.0];
    value.max(first).max(second).max(end) + (x * x) * (x * x) / 384.0 * fourth
}

/// Where a polynomial, taken as below 0 (or on its way up from exactly 0) at x = 0, first passes 0 upwards in 0..=end.
///
/// A start above 0 counts as exactly 0, which is what it is but for rounding. A rise that stays below `noise`, the
/// rounding error of the coefficients, is none.
pub fn first_rise(coefficients: &mut [f64], end: f64, noise: f64) -> Option<f64> {
    coefficients[0] = coefficients[0].min(0.0);
    if coefficients[0] == 0.0 {
        return first_rise_from_zero(coefficients, end, noise);
    }
    Curve { terms: &Terms::of(coefficients), noise, left: None }.first_rise_up_to(end)
}

/// As above with the root at x = 0 divided out: the sign just after it is that of the first power that is not 0.
fn first_rise_from_zero(coefficients: &[f64], end: f64, noise: f64) -> Option<f64> {
    if noise > 0.0 {
        let terms = Terms::of(coefficients);
        let whole = Curve { terms: &terms, noise, left: None };
        if terms.at(end).ceiling_from(whole.start()) <= noise {
            return None;
        }
    }
    let leading = coefficients.iter().position(|c| *c != 0.0)?;
    let rest = &coefficients[leading..];
    if rest[0] > 0.0 {
        return Some(0.0);
    }
    Curve { terms: &Terms::of(rest), noise, left: None }.first_rise_up_to(end)
}

/// Whether a function may turn from rising to falling above `known` in 0..=x, from its values and slopes at both ends and a
/// bound on its fourth derivative.
pub fn may_turn_above(
    (value, slope): (f64, f64),
    (end, end_slope): (f64, f64),
    (x, fourth): (f64, f64),
    known: f64,
) -> bool {
    let (a, b) = (End { x: 0.0, value, slope, fourth: 0.0 }, End { x, value: end, slope: end_slope, fourth });
    let (least, most) = b.slopes_from(a);
    // Written so that a NaN may be anywhere.
    let (goes_one_way, is_below) = (least > 0.0 || most < 0.0, b.ceiling_from(a) <= known);
    !goes_one_way && !is_below
}

/// Where a polynomial is largest in 0..=end, if it exceeds `known` there: (x, value), from its value and slope at 0 and
/// its reading at the end. `terms` copies its coefficients and tells their number; it is asked only where the maximum
/// may be in between.
pub fn maximum_above(
    (value, slope): (f64, f64),
    end: f64,
    reading: &Reading,
    known: f64,
    copy: impl FnOnce(&mut Coefficients) -> usize,
) -> Option<(f64, f64)> {
    let (a, b) = (
        End { x: 0.0, value, slope, fourth: 0.0 },
        End { x: end, value: reading.value, slope: reading.slope, fourth: reading.fourth },
    );
    let mut best = (f64::NAN, known);
    for end in [a, b] {
        if end.value > best.1 {
            best = (end.x, end.value);
        }
    }
    let (least, most) = b.slopes_from(a);
    if least <= 0.0 && most >= 0.0 && b.ceiling_from(a) > best.1 {
        let mut terms = Terms::empty();
        let count = copy(&mut terms.all);
        terms.complete(count);
        let curve = Curve { terms: &terms, noise: 4.0 * f64::EPSILON * terms.size(end), left: None };
        curve.maximum(a, b, &mut best);
    }
    best.0.is_finite().then_some(best)
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    /// Coefficients of factor * product of (x - root).
    fn polynomial(factor: f64, roots: &[f64]) -> Vec<f64> {
        let mut coefficients = vec![factor];
        for root in roots {
            let mut next = vec![0.0; coefficients.len() + 1];
            for (n, c) in coefficients.iter().enumerate() {
                next[n] -= root * c;
                next[n + 1] += c;
            }
            coefficients = next;
        }
        coefficients
    }

    fn highest(coefficients: &[f64], known: f64) -> Option<(f64, f64)> {
        highest_up_to(1.0, coefficients, known)
    }

    fn highest_up_to(end: f64, coefficients: &[f64], known: f64) -> Option<(f64, f64)> {
        let mut room = [0.0; crate::polynomial::ROOM];
        room[..coefficients.len()].copy_from_slice(coefficients);
        let mut powers = crate::polynomial::Powers::default();
        powers.set(end, coefficients.len() - 1);
        let terms = |out: &mut Coefficients| {
            *out = room;
            coefficients.len()
        };
        maximum_above((room[0], room[1]), end, &powers.read(&room), known, terms)
    }

    fn rise(factor: f64, roots: &[f64]) -> Option<f64> {
        first_rise(&mut polynomial(factor, roots), 1.0, 1e-16)
    }

    #[test]
    fn a_single_rise_is_found_to_rounding() {
        for root in [1e-9, 1e-3, 0.1, 0.5, 0.999_999, 1.0 - 1e-12] {
            let found = rise(1.0, &[root]).unwrap();
            assert!((found - root).abs() <= 2e-16, "{found} instead of {root}");
        }
    }

    #[test]
    fn a_curve_has_passed_at_its_root() {
        // So have others that are the same: what meets at one instant is not taken for two impacts.
        for k in 1..1000 {
            let mut curve = polynomial(1.0, &[1e-3 * f64::from(k), 1.1 + 1e-4 * f64::from(k), 1.7, -0.3]);
            let root = first_rise(&mut curve, 1.0, 0.0).unwrap();
            let value = Terms::of(&curve).value(root);
            assert!(value >= 0.0 && (root - 1e-3 * f64::from(k)).abs() < 1e-14, "{value} at {root}");
        }
    }

    #[test]
    fn two_passages_between_the_ends_are_seen() {
        // Below 0 at both ends, above 0 for a short while: what sampling misses.
        for width in [0.3, 1e-2, 1e-4, 1e-6] {
            let found = rise(-1.0, &[0.4, 0.4 + width]).unwrap();
            assert!((found - 0.4).abs() < 1e-16 / width + 1e-15, "{found}, width {width}");
        }
    }

    #[test]
    fn the_first_of_many_rises_is_the_one() {
        let found = rise(1.0, &[0.2, 0.3, 0.5, 0.6, 0.9]).unwrap();
        assert!((found - 0.2).abs() < 1e-14, "{found}");
    }

    #[test]
    fn what_stays_below_is_none() {
        assert_eq!(rise(1.0, &[1.5]), None);
        // Touches from below without passing.
        assert_eq!(first_rise(&mut [-0.25 - 1e-9, 1.0, -1.0], 1.0, 1e-16), None);
        assert_eq!(first_rise(&mut [-1.0, 0.0, 0.0, 0.0], 1.0, 1e-16), None);
        assert_eq!(first_rise(&mut [0.0; 8], 1.0, 0.0), None);
    }

    #[test]
    fn a_start_at_0_counts_by_where_it_goes() {
        assert_eq!(first_rise(&mut [0.0, 1.0], 1.0, 1e-16), Some(0.0));
        assert_eq!(first_rise(&mut [0.0, -1.0, -1.0], 1.0, 1e-16), None);
        // Leaves downwards and comes back at x = 0.5.
        let found = first_rise(&mut [0.0, -0.5, 1.0], 1.0, 1e-16).unwrap();
        assert!((found - 0.5).abs() < 1e-15, "{found}");
        // A start above 0 by rounding is a start at 0.
        assert_eq!(first_rise(&mut [1e-17, -1.0], 1.0, 1e-16), None);
        // However high it starts: it counts as 0, leaves downwards and comes back at x = 0.001.
        let found = first_rise(&mut [1e-3, -1e-3, 1.0], 1.0, 1e-16).unwrap();
        assert!((found - 1e-3).abs() < 1e-15, "{found}");
    }

    #[test]
    fn a_rise_within_noise_is_none() {
        assert_eq!(first_rise(&mut [-1e-18, 1e-17], 1.0, 1e-16), None);
        assert!(first_rise(&mut [-1e-18, 1e-15], 1.0, 1e-16).is_some());
    }

    #[test]
    fn what_rounding_hides_is_not_searched_for() {
        // (1 + x)^1.5 to the 17th power, far beyond where that means anything: at x = 150 it is 1e33 and so is the bound on
        // its derivative, and a billion pieces near the start could each hide something larger than 1.
        let (mut terms, mut binomial) = (vec![], 1.0);
        for n in 0..18 {
            terms.push(binomial);
            binomial *= (1.5 - f64::from(n)) / f64::from(n + 1);
        }
        // Each search in vain takes a second.
        for _ in 0..1000 {
            let (x, value) = highest_up_to(150.0, &terms, 0.0).unwrap();
            assert!((0.0..=150.0).contains(&x) && value >= 1.0, "{x}, {value}");
        }
    }

    #[test]
    fn the_maximum_inside_is_found() {
        // 1 - (x - 0.3)^2 (1 + x^3)
        let (x, value) = highest(&[0.91, 0.6, -1.0, -0.09, 0.6, -1.0], 0.0).unwrap();
        assert!((x - 0.3).abs() < 1e-9 && (value - 1.0).abs() < 1e-15, "{x}, {value}");
        assert_eq!(highest(&[0.91, 0.6, -1.0, -0.09, 0.6, -1.0], 1.0 + 1e-12), None);
        // The highest of several, not the first: x (x - 0.4)^2 has 0.009 at 0.13 and 0.36 at 1.
        let (x, value) = highest(&polynomial(1.0, &[0.0, 0.4, 0.4]), 0.0).unwrap();
        assert!(x == 1.0 && (value - 0.36).abs() < 1e-15, "{x}, {value}");
    }
}
