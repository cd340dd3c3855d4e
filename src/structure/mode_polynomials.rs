//! The motion of one mode over some time as polynomials of that time: where modes are too quick for a power series of a
//! few terms.

use crate::numerics::economization::Economization;

/// Terms of these polynomials, from t^0 on.
pub(super) const POLYNOMIAL_TERMS: usize = 20;

/// Terms of the power series that they come from.
const SERIES_TERMS: usize = 64;

/// Largest (rate) x (time). Beyond it the series converges too late and its terms cancel. At it the quickest modes, which
/// damping stops at once, are right to 1e-10 of what they do, which is next to nothing: the floors of the tallest buildings
/// were right to rounding (measured).
pub(super) const FURTHEST: f64 = 13.5;

/// The motions of a mode from q = 1, from v = 1, and from rest under a load of 1 and under a load t, in powers of
/// t / `length`.
pub(super) struct ModePolynomials {
    pub of: [[f64; POLYNOMIAL_TERMS]; 4],
}

/// Makes them for a length of time.
pub(super) struct PolynomialMaker {
    /// s.
    length: f64,
    economization: Economization,
}

impl PolynomialMaker {
    pub(super) fn new(length: f64) -> PolynomialMaker {
        PolynomialMaker { length, economization: Economization::new(SERIES_TERMS) }
    }

    /// Of a mode of squared frequency w^2, 1/s2, and damping, 1/s. The first two terms are exact: the accelerations are
    /// what is economized, so that errors are integrated twice.
    pub(super) fn mode(&self, omega2: f64, damping: f64) -> ModePolynomials {
        let h = self.length;
        let starts = [
            ([1.0, 0.0], [0.0, 0.0]),
            ([0.0, h], [0.0, 0.0]),
            ([0.0, 0.0], [h * h, 0.0]),
            ([0.0, 0.0], [0.0, h * h * h]),
        ];
        ModePolynomials { of: starts.map(|(start, load)| self.motion((omega2 * h * h, damping * h), start, load)) }
    }

    /// y'' = load - c y' - w^2 y, all in units of the length, from y and y' at the start.
    fn motion(&self, (omega2, damping): (f64, f64), start: [f64; 2], load: [f64; 2]) -> [f64; POLYNOMIAL_TERMS] {
        let mut accelerations = [0.0; SERIES_TERMS];
        let [mut before, mut last] = start;
        for (n, acceleration) in accelerations.iter_mut().enumerate() {
            let k = n as f64;
            let pushed = load.get(n).copied().unwrap_or(0.0);
            *acceleration = pushed - damping * (k + 1.0) * last - omega2 * before;
            (before, last) = (last, *acceleration / ((k + 1.0) * (k + 2.0)));
        }
        self.economization.shorten(&mut accelerations, POLYNOMIAL_TERMS - 2);
        let mut motion = [0.0; POLYNOMIAL_TERMS];
        motion[..2].copy_from_slice(&start);
        for (n, acceleration) in accelerations.iter().enumerate().take(POLYNOMIAL_TERMS - 2) {
            motion[n + 2] = acceleration / ((n + 1) * (n + 2)) as f64;
        }
        motion
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::structure::ModeIncrement;

    /// (w, c) with either up to 13 over the length: lightly damped, heavily damped, slow.
    const MODES: [(f64, f64, f64); 4] = [(4.0, 0.4, 1e-14), (4.1, 13.0, 1e-10), (0.3, 0.02, 1e-15), (5.0, 5.0, 1e-13)];

    #[test]
    fn they_are_the_exact_response() {
        let length = 0.01;
        for (w, c, allowed) in MODES {
            let (w, c) = (w / length, c / length);
            let polynomials = PolynomialMaker::new(length).mode(w * w, c);
            for i in 0..=50 {
                let x = f64::from(i) / 50.0;
                let t = x * length;
                let exact = ModeIncrement::new(w, c, t);
                let of = polynomials.of.map(|terms| terms.iter().rev().fold(0.0, |sum, term| sum * x + term));
                let exact = [1.0 + exact.dqq, exact.dqv, exact.rq0, exact.rq1];
                for ((got, exact), unit) in
                    of.iter().zip(exact).zip([1.0, length, length * length, length * length * length])
                {
                    assert!((got - exact).abs() <= allowed * unit, "{w} {c} at {x}: {got} instead of {exact}");
                }
            }
        }
    }
}
