//! Bounds on value, slope and curvature of a function over a piece, from values and slopes at both ends (cubic Hermite
//! interpolation) and a bound on its fourth derivative.

use super::turning_point::Knot;

/// Pieces are not halved below this fraction of the step: two roots closer than this are one touch without duration.
pub(super) const NARROWEST: f64 = 1e-9;

/// The function at one end of a piece.
#[derive(Clone, Copy)]
pub(super) struct End {
    pub x: f64,
    pub value: f64,
    pub slope: f64,
    /// Bound on the fourth derivative over 0..=x, so that each piece has its own.
    pub fourth: f64,
}

impl From<End> for Knot {
    fn from(End { x, value, slope, .. }: End) -> Knot {
        Knot { x, value, slope }
    }
}

impl End {
    /// Upper bound of the function over the piece from `a` to here.
    pub(super) fn upper_bound_from(self, a: End) -> f64 {
        let w = self.x - a.x;
        upper_bound((a.value, a.slope), (self.value, self.slope), w, self.fourth)
    }

    /// Bounds on the slope over the piece from `a` to here (the interpolant's is off by at most sqrt(3)/216 w^3
    /// max|f''''|).
    pub(super) fn slopes_from(self, a: End) -> (f64, f64) {
        let w = self.x - a.x;
        // Bernstein control values of the interpolant's slope: a.slope, `middle`, b.slope.
        let middle = 3.0 * (self.value - a.value) / w - (a.slope + self.slope);
        let error = 0.00802 * w * w * w * self.fourth;
        (a.slope.min(middle).min(self.slope) - error, a.slope.max(middle).max(self.slope) + error)
    }

    /// Whether the curvature is negative over the piece (the interpolant's is off by at most w^2/12 max|f''''|).
    pub(super) fn is_concave_from(self, a: End) -> bool {
        let w = self.x - a.x;
        let secant = (self.value - a.value) / w;
        let at_a = (6.0 * secant - 4.0 * a.slope - 2.0 * self.slope) / w;
        let at_b = (-6.0 * secant + 2.0 * a.slope + 4.0 * self.slope) / w;
        at_a.max(at_b) < -w * w / 12.0 * self.fourth
    }
}

/// Upper bound over 0..=x of a function from its values and slopes at both ends and the bound on its fourth derivative.
pub(crate) fn upper_bound((value, slope): (f64, f64), (end, end_slope): (f64, f64), x: f64, fourth: f64) -> f64 {
    highest_of_cubic((value, slope), (end, end_slope), x) + deviation(x, fourth)
}

/// Bound on the distance of a function from its cubic over 0..=h, where its fourth derivative is at most `fourth`.
#[inline(always)]
pub(crate) fn deviation(h: f64, fourth: f64) -> f64 {
    (h * h) * (h * h) / 384.0 * fourth
}

/// Whether a function may have a local maximum above `known` in 0..=x, from its values and slopes at both ends and a
/// bound on its fourth derivative.
pub(crate) fn may_turn_above(
    (value, slope): (f64, f64),
    (end, end_slope): (f64, f64),
    (x, fourth): (f64, f64),
    known: f64,
) -> bool {
    let (a, b) = (End { x: 0.0, value, slope, fourth: 0.0 }, End { x, value: end, slope: end_slope, fourth });
    let (least, most) = b.slopes_from(a);
    // Written so that a NaN counts as "may".
    let (goes_one_way, is_below) = (least > 0.0 || most < 0.0, b.upper_bound_from(a) <= known);
    !goes_one_way && !is_below
}

/// The largest control value of the cubic Hermite interpolant through values and rates at both ends: an upper bound of
/// it.
pub(crate) fn highest_of_cubic((start, rate): (f64, f64), (end, end_rate): (f64, f64), h: f64) -> f64 {
    start.max(start + h / 3.0 * rate).max(end - h / 3.0 * end_rate).max(end)
}
