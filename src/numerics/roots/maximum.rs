//! The largest value of a polynomial above a known one, or the proof that there is none.

use super::hermite::{End, NARROWEST};
use super::terms::Terms;
use crate::numerics::polynomial::Coefficients;
use crate::numerics::powers::Reading;

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
    if least <= 0.0 && most >= 0.0 && b.upper_bound_from(a) > best.1 {
        let mut terms = Terms::empty();
        let count = copy(&mut terms.all);
        terms.complete(count);
        let noise = 4.0 * f64::EPSILON * terms.size(end);
        raise_to_maximum(&terms, noise, (a, b), &mut best);
    }
    best.0.is_finite().then_some(best)
}

/// Raises `best` = (x, value) to the largest value over a piece. What exceeds it by less than `noise` is rounding.
fn raise_to_maximum(terms: &Terms, noise: f64, (a, b): (End, End), best: &mut (f64, f64)) {
    for end in [a, b] {
        if end.value > best.1 {
            *best = (end.x, end.value);
        }
    }
    let upper_bound = b.upper_bound_from(a);
    // What exceeds the best by rounding only is none, and would be searched for ever.
    if upper_bound <= best.1 + noise || !upper_bound.is_finite() || b.x - a.x < NARROWEST {
        return;
    }
    let (least, most) = b.slopes_from(a);
    if least > 0.0 || most < 0.0 {
        return;
    }
    if b.is_concave_from(a) {
        if a.slope > 0.0 && b.slope < 0.0 {
            let x = maximum_of_concave(terms, a, b);
            let value = terms.value(roughly(x));
            if value > best.1 {
                *best = (x, value);
            }
        }
        return;
    }
    let middle = terms.at(0.5 * (a.x + b.x));
    raise_to_maximum(terms, noise, (a, middle), best);
    raise_to_maximum(terms, noise, (middle, b), best);
}

/// Where the slope of a concave piece passes 0: Newton, kept inside a shrinking bracket. Wide
/// instructions give the same bits.
#[multiversion::multiversion(targets("x86_64+avx2"))]
fn maximum_of_concave(terms: &Terms, a: End, b: End) -> f64 {
    let (mut low, mut high) = (a.x, b.x);
    let mut x = maximum_of_cubic(a, b);
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

/// About where the cubic interpolant of a piece that rises first and falls then is highest, somewhere in the piece.
fn maximum_of_cubic(a: End, b: End) -> f64 {
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
