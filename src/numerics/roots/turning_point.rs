//! Where a smooth curve turns from rising to falling: what every search for a largest value ends with.

/// A curve at one place.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Knot {
    pub x: f64,
    pub value: f64,
    pub slope: f64,
}

/// Distance from the turning point, relative to the piece, that may be left: so little that whatever piece is searched, the
/// point is the same to far more digits than are kept of it.
const CLOSE: f64 = 1e-14;

/// Largest number of readings: a smooth curve takes some four.
const MOST_READINGS: usize = 60;

impl Knot {
    /// The same of the curve times a factor.
    #[inline(always)]
    pub(crate) fn times(self, factor: f64) -> Knot {
        Knot { value: factor * self.value, slope: factor * self.slope, ..self }
    }

    /// The maximum of the cubic through two knots between which it turns, (x, value).
    #[inline(always)]
    pub(crate) fn summit(self, other: Knot) -> (f64, f64) {
        let w = other.x - self.x;
        let (first, rise, last) = (w * self.slope, other.value - self.value, w * other.slope);
        let (second, third) = (3.0 * rise - 2.0 * first - last, first + last - 2.0 * rise);
        // Below 0 by rounding alone, where it turns at a knot and is straight there.
        let root = (second * second - 3.0 * third * first).max(0.0).sqrt();
        let s = first / (root - second);
        (self.x + w * s, self.value + s * (first + s * (second + s * third)))
    }
}

/// The x between two knots at which a curve turns that rises at the first and falls at the second: first where the cubic through
/// both does, then by inverse quadratic interpolation of the three latest slopes \[Brent1973, chapter 4\]. Values tell no more
/// there, where a curve is flat. Kept inside a shrinking bracket, which is halved where the interpolation leads out of it.
#[inline(always)]
pub(crate) fn turning_point([from, to]: [Knot; 2], mut read: impl FnMut(f64) -> Knot) -> f64 {
    let (mut low, mut high) = (from.x, to.x);
    let inside = |x: f64, low: f64, high: f64| if x >= low && x <= high { x } else { 0.5 * (low + high) };
    let mut x = inside(from.summit(to).0, low, high);
    let (mut last, mut before) = if x - from.x < to.x - x { (from, to) } else { (to, from) };
    for _ in 0..MOST_READINGS {
        let here = read(x);
        if here.slope > 0.0 {
            low = x;
        } else {
            high = x;
        }
        let knots = [here, last, before];
        let zero = zero_of_slope(knots);
        let next = inside(zero, low, high);
        // The interpolation is off by about the product of the distances from its knots.
        let left = knots.iter().map(|knot| (next - knot.x) / (to.x - from.x)).product::<f64>().abs();
        if next == zero && left <= CLOSE {
            return next;
        }
        (x, last, before) = (next, here, last);
    }
    x
}

/// Where the slope is 0 by inverse quadratic interpolation, near the first of three knots.
#[inline(always)]
fn zero_of_slope([a, b, c]: [Knot; 3]) -> f64 {
    let to_b = a.slope * c.slope / ((b.slope - a.slope) * (b.slope - c.slope));
    let to_c = a.slope * b.slope / ((c.slope - a.slope) * (c.slope - b.slope));
    a.x + to_b * (b.x - a.x) + to_c * (c.x - a.x)
}
