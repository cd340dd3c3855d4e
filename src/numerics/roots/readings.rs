//! The largest magnitude at which a curve turns that can be read anywhere, but of which no bounds are known.
//!
//! How far the reading in the middle of a piece is from the cubic through both ends tells how large the fourth derivative is,
//! and so how far the curve may be from the cubics through the ends of both halves: what a bound is to a polynomial.

use super::hermite::End;
use super::maximum::{Curve, Search};
use super::turning_point::{Knot, turning_point};

/// What the fourth derivative may be, relative to the one that the middle tells.
const WIDER: f64 = 2.0;

/// Excess over what is known, relative to it, that may be rounding.
const ROUNDING: f64 = 1e-13;

/// A curve that can be read.
struct Readable<R>(R);

impl<R: FnMut(f64) -> Knot> Curve for Readable<R> {
    const NARROWEST: f64 = 1.0 / 5000.0;
    /// Half of what the middle tells: then no more is missed than a second turn beside the first.
    const BENDING: f64 = 0.5 / WIDER;

    fn halves(&mut self, [a, b]: [End; 2]) -> [[End; 2]; 2] {
        let w = b.x - a.x;
        let Knot { x, value, slope } = (self.0)(0.5 * (a.x + b.x));
        let cubic = 0.5 * (a.value + b.value) + 0.125 * w * (a.slope - b.slope);
        let fourth = WIDER * (384.0 * (value - cubic).abs() / ((w * w) * (w * w)));
        let middle = End { x, value, slope, fourth };
        [[a, middle], [middle, End { fourth, ..b }]]
    }

    fn turn(&mut self, piece: [Knot; 2]) -> f64 {
        turning_point(piece, &mut self.0)
    }

    fn value(&mut self, x: f64) -> f64 {
        (self.0)(x).value
    }
}

/// The largest magnitude at which a curve turns between two places, as far as that is not beyond `until`, or `known` if that is
/// larger.
pub(crate) fn highest_by_readings(
    (known, until): (f64, f64),
    ends: [f64; 2],
    mut read: impl FnMut(f64) -> Knot,
) -> f64 {
    let piece = ends.map(|x| End::from(read(x)));
    let mut search = Search { curve: Readable(read), best: (f64::NAN, known), noise: ROUNDING * known, until };
    for half in search.curve.halves(piece) {
        search.raise(half);
    }
    search.best.1
}
