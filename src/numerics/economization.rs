//! Fewer terms for a polynomial of any degree, by Chebyshev economization: done where a model is made, not in steps.

/// Chebyshev polynomials of 0..=1, each divided by the factor of its highest power.
pub(crate) struct Economization {
    /// Row n: factors of x^0 to x^n.
    rows: Vec<Vec<f64>>,
}

impl Economization {
    /// For polynomials of up to that many terms.
    pub(crate) fn new(most_terms: usize) -> Economization {
        let mut rows: Vec<Vec<f64>> = vec![vec![1.0]];
        for n in 1..most_terms {
            // T_n = 2 (2 x - 1) T_{n-1} - T_{n-2}, and T_n begins with 2^(2 n - 1) x^n.
            let before = match n {
                1 => 0.0,
                2 => 0.125,
                _ => 0.0625,
            };
            let earlier = |j: usize| rows.get(n.wrapping_sub(2)).and_then(|row| row.get(j)).copied().unwrap_or(0.0);
            let last = |j: usize| rows[n - 1].get(j).copied().unwrap_or(0.0);
            let raised = |j: usize| if j > 0 { last(j - 1) } else { 0.0 };
            rows.push((0..=n).map(|j| raised(j) - 0.5 * last(j) - before * earlier(j)).collect());
        }
        Economization { rows }
    }

    /// Replaces a polynomial by one of `keep` terms and sets its other terms to 0; returns a bound on the difference
    /// for x in 0..=1.
    pub(crate) fn shorten(&self, terms: &mut [f64], keep: usize) -> f64 {
        let mut error = 0.0;
        for n in (keep.max(1)..terms.len()).rev() {
            let top = terms[n];
            for (term, share) in terms.iter_mut().zip(&self.rows[n]) {
                *term -= top * share;
            }
            terms[n] = 0.0;
            error += libm::ldexp(top.abs(), 1 - 2 * n as i32);
        }
        error
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// exp(-5 x) to 1e-11 takes 31 terms of its power series, but 15 of these.
    #[test]
    fn fewer_terms_come_as_near_as_is_said() {
        let mut terms = [1.0; 40];
        for n in 1..terms.len() {
            terms[n] = -5.0 * terms[n - 1] / n as f64;
        }
        let bound = Economization::new(40).shorten(&mut terms, 15);
        assert!(bound < 1e-11 && terms[15..].iter().all(|term| *term == 0.0), "{bound}");
        let off = (0..=200).map(|i| f64::from(i) / 200.0).map(|x| {
            let value = terms.iter().rev().fold(0.0, |sum, term| sum * x + term);
            (value - libm::exp(-5.0 * x)).abs()
        });
        let worst = off.fold(0.0, f64::max);
        assert!(worst < bound + 1e-14 && worst > 0.3 * bound, "{worst} where {bound} is said");
    }
}
