//! The largest magnitude at which a curve turns inside a piece, above a known one, or the proof that there is none. Ends of the
//! piece do not count: whoever searches has read them before.
//!
//! Both ends of a piece and a bound on the fourth derivative tell whether the curve may turn there above what is known. A piece
//! that bends one way turns at most once; any other is halved.

use super::hermite::{End, NARROWEST};
use super::terms::Terms;
use super::turning_point::{Knot, turning_point};

/// A curve that is searched.
pub(super) trait Curve {
    /// Pieces are not halved below this width.
    const NARROWEST: f64;
    /// What of the bound on the fourth derivative counts for whether a piece bends one way.
    const BENDING: f64;

    /// The halves of a piece, with a bound on the fourth derivative in each.
    fn halves(&mut self, piece: [End; 2]) -> [[End; 2]; 2];
    /// The x between two places at which the curve turns.
    fn turn(&mut self, piece: [Knot; 2]) -> f64;
    /// The value at such an x.
    fn value(&mut self, x: f64) -> f64;
}

/// A search for the largest magnitude.
pub(super) struct Search<C> {
    pub curve: C,
    /// (x, magnitude)
    pub best: (f64, f64),
    /// An excess below this is rounding.
    pub noise: f64,
    /// Up to which x turning points count. Pieces are the same whatever it is, and so are the bits of turning points.
    pub until: f64,
}

impl<C: Curve> Search<C> {
    /// Raises the best to what a piece holds.
    pub(super) fn raise(&mut self, [a, b]: [End; 2]) {
        let size = b.size_from(a);
        // An excess within rounding would be halved for ever.
        if a.x > self.until || size <= self.best.1 + self.noise || !size.is_finite() {
            return;
        }
        let (least, most) = b.slopes_from(a);
        if least > 0.0 || most < 0.0 {
            return;
        }
        let turns = a.slope > 0.0 && b.slope <= 0.0 || a.slope < 0.0 && b.slope >= 0.0;
        if b.x - a.x > C::NARROWEST && !(turns && b.bends_one_way_from(a, C::BENDING)) {
            return self.curve.halves([a, b]).into_iter().for_each(|half| self.raise(half));
        }
        if turns {
            let x = self.curve.turn([a.into(), b.into()]);
            let size = if x <= self.until { self.curve.value(x).abs() } else { 0.0 };
            if size > self.best.1 {
                self.best = (x, size);
            }
        }
    }
}

/// A polynomial, and what its value counts as where it turns: from the x and the value.
struct Polynomial<F> {
    terms: Terms,
    count_as: F,
}

impl<F: FnMut(f64, f64) -> f64> Curve for Polynomial<F> {
    const NARROWEST: f64 = NARROWEST;
    const BENDING: f64 = 1.0;

    fn halves(&mut self, [a, b]: [End; 2]) -> [[End; 2]; 2] {
        let middle = self.terms.at(0.5 * (a.x + b.x));
        [[a, middle], [middle, b]]
    }

    fn turn(&mut self, piece: [Knot; 2]) -> f64 {
        turn_of(&self.terms, piece)
    }

    fn value(&mut self, x: f64) -> f64 {
        let value = self.terms.value(roughly(x));
        (self.count_as)(x, value)
    }
}

/// (x, magnitude) of the largest magnitude at which a polynomial turns within 0..=end if it exceeds a `known` one; its value at x
/// counts as what a function makes of both.
pub(crate) fn highest_turn(
    terms: &[f64],
    end: f64,
    known: f64,
    count_as: impl FnMut(f64, f64) -> f64,
) -> Option<(f64, f64)> {
    let terms = Terms::of(terms);
    let (piece, noise) = ([0.0, end].map(|x| terms.at(x)), 4.0 * f64::EPSILON * terms.size(end));
    let mut search = Search { curve: Polynomial { terms, count_as }, best: (f64::NAN, known), noise, until: end };
    search.raise(piece);
    search.best.0.is_finite().then_some(search.best)
}

#[multiversion::multiversion(targets("x86_64+avx2"))]
fn turn_of(terms: &Terms, piece: [Knot; 2]) -> f64 {
    turning_point(piece, |x| terms.knot(x))
}

/// x rounded to eight digits. Near a maximum the value is flat, so that it keeps sixteen digits; and it is the same to
/// the last bit however much of the curve is searched, so that no peak ever falls by a rounding.
pub(crate) fn roughly(x: f64) -> f64 {
    const LEFT_OUT: u64 = (1 << 26) - 1;
    f64::from_bits((x.to_bits() + (LEFT_OUT >> 1)) & !LEFT_OUT)
}
