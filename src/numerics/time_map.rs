//! The variable of a step's power series: time, or one in which the motion is smoother.
//!
//! Under a power law the force contains a root of the time since the entry, or of the time until the release, so that a
//! series in time converges only up to that singularity. In the root itself the motion is analytic there: with
//!
//! ```text
//! t = x + x^2 / (4 a),    1 + t/a = (1 + x / (2 a))^2
//! ```
//!
//! the entry at t = -a is no singularity in x, nor, with a < 0, is the release at t = -a. The first n terms of the
//! series in x follow from the first n in t alone ([`crate::numerics::substitution`]).

use crate::numerics::polynomial::{COUNT, Coefficients, MAX_TERMS, RECIPROCAL};

/// Series that are worked on side by side.
pub(crate) const LANES: usize = 4;

/// Time, in units of a series' scale, as a function of x: t = x + curvature x^2.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct TimeMap {
    /// 1 over four times the time since an entry, or minus that until a release; 0 where x is the time.
    pub curvature: f64,
}

/// The weights of terms m - j of a series in time, j = 0, 1, ..., in its term m in x; filled up to whole blocks of
/// lanes.
pub(crate) type Weights = [f64; (MAX_TERMS / 2 + 1).next_multiple_of(LANES)];

/// Row n: the binomials (n over j).
const CHOOSE: [Weights; MAX_TERMS] = {
    let mut table = [[0.0; (MAX_TERMS / 2 + 1).next_multiple_of(LANES)]; MAX_TERMS];
    let mut n = 0;
    while n < MAX_TERMS {
        table[n][0] = 1.0;
        let mut j = 1;
        while j <= n && j <= MAX_TERMS / 2 {
            table[n][j] = table[n - 1][j - 1] + table[n - 1][j];
            j += 1;
        }
        n += 1;
    }
    table
};

/// Row m: the binomials (m - j over j).
pub(crate) const BINOMIAL: [Weights; MAX_TERMS] = {
    let mut table = [[0.0; (MAX_TERMS / 2 + 1).next_multiple_of(LANES)]; MAX_TERMS];
    let mut m = 0;
    while m < MAX_TERMS {
        let mut j = 0;
        while 2 * j <= m {
            table[m][j] = CHOOSE[m - j][j];
            j += 1;
        }
        m += 1;
    }
    table
};

impl TimeMap {
    /// Whether x differs from the time.
    pub fn is_curved(&self) -> bool {
        self.curvature != 0.0
    }

    /// The time at x, in the series' unit.
    pub fn time(&self, x: f64) -> f64 {
        x + self.curvature * x * x
    }

    /// dt/dx at x.
    pub fn rate(&self, x: f64) -> f64 {
        1.0 + 2.0 * self.curvature * x
    }

    /// x at a time; for a time beyond the map's range, an x beyond all of its range.
    pub fn inverse(&self, time: f64) -> f64 {
        2.0 * time / (1.0 + (1.0 + 4.0 * self.curvature * time).max(0.0).sqrt())
    }

    /// Weights whose sums with the terms of a series in t give value, rate and integral over time at x of that series
    /// re-expanded in x and truncated after the power `highest` (the integral for a series with two terms less). The
    /// rate is not divided by dt/dx, which may be 0 at x.
    pub fn weights(&self, x: f64, highest: usize, [value, rate, integral]: [&mut Coefficients; 3]) {
        let (y, stretch) = (self.curvature * x, 1.0 + self.curvature * x);
        (value[0], rate[0]) = (1.0, 0.0);
        // x^n, and the factor (1 + y)^n by which t^n = x^n (1 + y)^n differs, truncated where the series in x ends.
        let (mut power, mut whole) = (1.0, 1.0);
        for n in 1..=highest {
            let left = highest - n;
            let mut sums = [whole * stretch, whole, whole * stretch];
            if n >= left {
                sums = truncated([&CHOOSE[n], &CHOOSE[n - 1]], y, left);
            }
            rate[n] = COUNT[n] * (power * sums[1]);
            power *= x;
            whole *= stretch;
            value[n] = power * sums[0];
            integral[n - 1] = RECIPROCAL[n - 1] * (power * sums[2]);
        }
    }

    /// Factors of the terms of a series in time whose sum is the term of that power in x of its rate, times dt/dx.
    pub fn rate_term_weights(&self, power: usize, factors: &mut Coefficients) {
        let mut bend = 1.0;
        factors[..=power + 1].fill(0.0);
        for (j, binomial) in BINOMIAL[power].iter().enumerate().take(power / 2 + 1) {
            let n = power - j + 1;
            factors[n] = n as f64 * (binomial * bend);
            bend *= self.curvature;
        }
    }
}

/// Values at y of two polynomials up to the power `last`, and of the first one up to `last` - 1.
#[inline(always)]
fn truncated([first, second]: [&Weights; 2], y: f64, last: usize) -> [f64; 3] {
    let mut sums = [first[last], second[last], 0.0];
    for (first, second) in first[..last].iter().zip(&second[..last]).rev() {
        sums = [sums[0] * y + first, sums[1] * y + second, sums[2] * y + first];
    }
    sums
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_and_rates_belong_to_the_time() {
        for time_map in [0.0, 0.25, -0.2].map(|curvature| TimeMap { curvature }) {
            for x in [0.0, 0.1, 0.5, 1.5] {
                let (t, h) = (time_map.time(x), 1e-6);
                assert!((time_map.inverse(t) - x).abs() <= 1e-15, "{time_map:?}: {x}");
                let slope = (time_map.time(x + h) - time_map.time(x - h)) / (2.0 * h);
                assert!(
                    (time_map.rate(x) - slope).abs() < 1e-9,
                    "{time_map:?}: {} and {slope} at {x}",
                    time_map.rate(x)
                );
            }
        }
        let plain = TimeMap::default();
        assert_eq!([plain.time(0.7), plain.inverse(0.7), plain.rate(0.7)], [0.7, 0.7, 1.0]);
        let past = TimeMap { curvature: -0.25 };
        assert!(past.inverse(1.1) > past.inverse(1.0), "a time_map that goes until 1");
    }

    /// Terms of (1 + sign t)^3.5 + t: a polynomial in the x of the time map whose singularity is where 1 + sign t = 0.
    fn root_terms(sign: f64) -> Coefficients {
        let (mut terms, mut term) = ([0.0; MAX_TERMS], 1.0);
        for (n, slot) in terms.iter_mut().enumerate() {
            *slot = term + f64::from(n == 1);
            term *= sign * (3.5 - n as f64) / (n + 1) as f64;
        }
        terms
    }

    #[test]
    fn terms_in_time_tell_value_rate_and_integral_by_a_time_map_even_where_it_stands_still() {
        const HIGHEST: usize = 17;
        for (sign, places) in [(1.0, [0.5, 2.0, 4.0]), (-1.0, [0.5, 1.7, 2.0])] {
            let (time_map, terms) = (TimeMap { curvature: 0.25 * sign }, root_terms(sign));
            for x in places {
                let mut factors = [[0.0; MAX_TERMS]; 3];
                time_map.weights(x, HIGHEST, factors.each_mut());
                let sum = |k: usize, last: usize| (0..=last).map(|n| terms[n] * factors[k][n]).sum::<f64>();
                let t = time_map.time(x);
                let root = (1.0 + sign * t).max(0.0);
                let value = libm::pow(root, 3.5) + t;
                let rate = sign * 3.5 * libm::pow(root, 2.5) + 1.0;
                let integral = sign * (libm::pow(root, 4.5) - 1.0) / 4.5 + 0.5 * t * t;
                for (got, exact) in [(sum(0, HIGHEST), value), (sum(1, HIGHEST), rate), (sum(2, HIGHEST - 2), integral)]
                {
                    assert!((got - exact).abs() < 1e-11 * exact.abs().max(1.0), "{sign} at {x}: {got}, not {exact}");
                }
            }
        }
    }

    /// 3.5 (1 + t)^2.5 is 3.5 (1 + x/2)^5.
    #[test]
    fn a_term_of_a_rate_follows_from_terms_in_time() {
        let (time_map, terms) = (TimeMap { curvature: 0.25 }, root_terms(1.0));
        for (power, exact) in
            [(0, 3.5 + 1.0), (1, 3.5 * 2.5), (4, 3.5 * 5.0 / 16.0), (5, 3.5 / 32.0), (6, 0.0), (15, 0.0)]
        {
            let mut factors = [0.0; MAX_TERMS];
            time_map.rate_term_weights(power, &mut factors);
            let term: f64 = terms.iter().zip(&factors).map(|(term, factor)| term * factor).sum();
            assert!((term - exact).abs() < 1e-12, "{power}: {term}, not {exact}");
        }
    }
}
