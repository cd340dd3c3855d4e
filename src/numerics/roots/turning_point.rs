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

    /// The maximum of the cubic through two knots, (x, value); NaN where it has none.
    #[inline(always)]
    pub(crate) fn summit(self, other: Knot) -> (f64, f64) {
        let w = other.x - self.x;
        let (first, rise, last) = (w * self.slope, other.value - self.value, w * other.slope);
        let (second, third) = (3.0 * rise - 2.0 * first - last, first + last - 2.0 * rise);
        let root = (second * second - 3.0 * third * first).sqrt();
        let s = first / (root - second);
        (self.x + w * s, self.value + s * (first + s * (second + s * third)))
    }
}

/// The x between two knots at which a curve turns that rises at the first and falls at the second, by the cubics through the
/// two knots that were read last: the distance shrinks as the product of that of the last and the square of that of the one
/// before. Kept inside a shrinking bracket, which is halved where a cubic leads out of it.
#[inline(always)]
pub(crate) fn turning_point([from, to]: [Knot; 2], mut read: impl FnMut(f64) -> Knot) -> f64 {
    let (mut low, mut high) = (from.x, to.x);
    let inside = |x: f64, low: f64, high: f64| if x >= low && x <= high { x } else { 0.5 * (low + high) };
    let mut x = inside(from.summit(to).0, low, high);
    let mut last = if x - from.x < to.x - x { from } else { to };
    for _ in 0..MOST_READINGS {
        let here = read(x);
        if here.slope > 0.0 {
            low = x;
        } else {
            high = x;
        }
        let next = inside(here.summit(last).0, low, high);
        let [step, moved] = [next - x, x - last.x].map(|distance| (distance / (to.x - from.x)).abs());
        // The slope of a curve is off by about this from that of a cubic through two of its knots.
        if step * (step + moved) * (step + moved) <= CLOSE {
            return next;
        }
        (x, last) = (next, here);
    }
    x
}
