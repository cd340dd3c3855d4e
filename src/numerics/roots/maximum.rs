//! The largest value of a polynomial above a known one, or the proof that there is none.

use super::hermite::{End, NARROWEST};
use super::terms::Terms;
use super::turning_point::turning_point;
use crate::numerics::polynomial::Coefficients;
use crate::numerics::powers::Evaluation;

/// (x, value) of the maximum of a polynomial over 0..=end if it exceeds `known`, from its value and slope at 0 and its
/// `reading` at the end. Where the maximum may lie inside, `copy` is called for the coefficients: it writes them and
/// returns their number.
pub(crate) fn maximum_above(
    (value, slope): (f64, f64),
    end: f64,
    reading: &Evaluation,
    known: f64,
    copy: impl FnOnce(&mut Coefficients) -> usize,
) -> Option<(f64, f64)> {
    let (a, b) = (
        End { x: 0.0, value, slope, fourth: 0.0 },
        End { x: end, value: reading.value, slope: reading.slope, fourth: reading.fourth },
    );
    let mut best = (f64::NAN, known);
    raise_to_ends([a, b], &mut best);
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

/// Raises `best` = (x, value) to the values at both ends of a piece.
fn raise_to_ends(ends: [End; 2], best: &mut (f64, f64)) {
    for end in ends {
        if end.value > best.1 {
            *best = (end.x, end.value);
        }
    }
}

/// Raises `best` = (x, value) to the maximum over a piece; an excess below `noise` is rounding.
fn raise_to_maximum(terms: &Terms, noise: f64, (a, b): (End, End), best: &mut (f64, f64)) {
    raise_to_ends([a, b], best);
    let upper_bound = b.upper_bound_from(a);
    // An excess within rounding would be halved for ever.
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

/// Where a concave piece turns.
#[multiversion::multiversion(targets("x86_64+avx2"))]
fn maximum_of_concave(terms: &Terms, a: End, b: End) -> f64 {
    turning_point([a.into(), b.into()], |x| terms.knot(x))
}

/// x rounded to eight digits. Near a maximum the value is flat, so that it keeps sixteen digits; and it is the same to
/// the last bit however much of the curve is searched, so that no peak ever falls by a rounding.
pub(crate) fn roughly(x: f64) -> f64 {
    const LEFT_OUT: u64 = (1 << 26) - 1;
    f64::from_bits((x.to_bits() + (LEFT_OUT >> 1)) & !LEFT_OUT)
}
