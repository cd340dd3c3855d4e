//! The largest magnitude of a curve that can be read anywhere, but of which no bounds are known.
//!
//! How far the reading in the middle of a piece is from the cubic through both ends tells how large the fourth derivative is,
//! and so how far the curve may be from the cubics through the ends of both halves: what a bound would be to a polynomial
//! (`maximum.rs`). A half that may hold more than is known, and neither goes one way nor bends one way, is halved again.

use super::hermite::End;
use super::turning_point::{Knot, turning_point};
use crate::numerics::polynomial::larger;

/// What the fourth derivative may be, relative to the one that the middle tells, where nothing turns from end to end.
const WIDER: f64 = 2.0;
/// The same where it does: then no more is missed than a second turn beside the first.
const NARROWER: f64 = 0.5;

/// How often a piece is halved.
const MOST_HALVINGS: u32 = 12;

/// Excess over what is known, relative to it, that may be rounding.
const ROUNDING: f64 = 1e-13;

/// The largest magnitude between two places, as far as they are not beyond `until`, or `known` if that is larger. The curve is
/// searched in the same pieces whatever is known and asked for, so that a turning point has the same bits.
pub(crate) fn highest_by_readings(
    (known, until): (f64, f64),
    [from, to]: [f64; 2],
    mut read: impl FnMut(f64) -> Knot,
) -> f64 {
    let ends = [from, 0.5 * (from + to), to].map(&mut read);
    let mut peak = larger(known, ends[0].value.abs());
    for sign in [1.0, -1.0] {
        let read = |x: f64| read(x).times(sign);
        let mut search = HighestSearch { peak, until, read };
        search.raise(ends.map(|end| end.times(sign)), MOST_HALVINGS);
        peak = search.peak;
    }
    peak
}

/// A search for the largest value.
struct HighestSearch<R> {
    peak: f64,
    until: f64,
    read: R,
}

impl<R: FnMut(f64) -> Knot> HighestSearch<R> {
    /// Raises the peak over a piece of which the middle has been read.
    fn raise(&mut self, [a, middle, b]: [Knot; 3], halvings: u32) {
        let w = b.x - a.x;
        let cubic = 0.5 * (a.value + b.value) + 0.125 * w * (a.slope - b.slope);
        let fourth = 384.0 * (middle.value - cubic).abs() / ((w * w) * (w * w));
        self.raise_over([a, middle], fourth, halvings);
        self.raise_over([middle, b], fourth, halvings);
    }

    fn raise_over(&mut self, ends: [Knot; 2], fourth: f64, halvings: u32) {
        let [from, to] = ends;
        if from.x > self.until {
            return;
        }
        let of = |factor: f64| ends.map(|Knot { x, value, slope }| End { x, value, slope, fourth: factor * fourth });
        let [a, b] = of(WIDER);
        let (upper, (least, most)) = (b.upper_bound_from(a), b.slopes_from(a));
        if upper <= (1.0 + ROUNDING) * self.peak || !upper.is_finite() {
            return;
        }
        let (goes_on, turns) = (least > 0.0 || most < 0.0, from.slope > 0.0 && to.slope < 0.0);
        let [a, b] = of(NARROWER);
        if !goes_on && halvings > 0 && !(turns && b.is_concave_from(a)) {
            let middle = (self.read)(0.5 * (from.x + to.x));
            return self.raise([from, middle, to], halvings - 1);
        }
        if turns {
            let x = turning_point(ends, &mut self.read);
            let value = if x <= self.until { (self.read)(x).value } else { 0.0 };
            self.peak = larger(self.peak, value);
        }
        self.peak = if to.x <= self.until { larger(self.peak, to.value) } else { self.peak };
    }
}
