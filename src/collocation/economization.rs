//! Fewer terms for a polynomial: Chebyshev economization.
//!
//! Of all polynomials x^n + ... the Chebyshev polynomial of 0..=1, divided by its first factor, is the smallest there:
//! 2^(1 - 2 n). So a small term of degree n is taken away together with so much of the lower ones [Lanczos1956].

use super::tables::POWERS;
use crate::numerics::polynomial::each;

/// Row n: factors of x^0 to x^n of the Chebyshev polynomial of degree n on 0..=1 that begins with x^n.
const SMALLEST: [[f64; POWERS]; POWERS] = {
    let mut rows = [[0.0; POWERS]; POWERS];
    rows[0][0] = 1.0;
    let mut n = 1;
    while n < POWERS {
        let before = match n {
            1 => 0.0,
            2 => 0.125,
            _ => 0.0625,
        };
        let mut j = 0;
        while j <= n {
            let raised = if j > 0 { rows[n - 1][j - 1] } else { 0.0 };
            let earlier = if n > 1 { before * rows[n - 2][j] } else { 0.0 };
            rows[n][j] = raised - 0.5 * rows[n - 1][j] - earlier;
            j += 1;
        }
        n += 1;
    }
    rows
};

/// The largest magnitude of each of them on 0..=1.
const SIZE: [f64; POWERS] = {
    let (mut sizes, mut n) = ([1.0; POWERS], 1);
    while n < POWERS {
        sizes[n] = if n == 1 { 0.5 } else { 0.25 * sizes[n - 1] };
        n += 1;
    }
    sizes
};

/// Replaces a polynomial of `count` terms by one of fewer terms that differs from it by at most `bound` for x in 0..=1;
/// returns how many terms are left.
#[inline(always)]
pub(super) fn economize(terms: &mut [f64; POWERS], mut count: usize, bound: f64) -> usize {
    let mut left = bound;
    while count > 1 {
        let top = terms[count - 1];
        let error = SIZE[count - 1] * top.abs();
        if error.is_nan() || error > left {
            break;
        }
        left -= error;
        // All of the row, of which the rest is 0: wide instructions take it faster than they find its end.
        let shares = SMALLEST[count - 1].as_chunks::<4>().0;
        for (terms, shares) in terms.as_chunks_mut::<4>().0.iter_mut().zip(shares) {
            *terms = each(|i| terms[i] - top * shares[i]);
        }
        count -= 1;
    }
    count
}

#[cfg(test)]
mod tests {
    use super::*;

    /// T_n(2 x - 1) = cos(n arccos(2 x - 1)), with 2^(2 n - 1) x^n as its first term.
    #[test]
    fn rows_are_chebyshev_polynomials() {
        for n in 1..POWERS {
            for x in [0.0, 0.1, 0.37, 0.8, 1.0_f64] {
                let value = SMALLEST[n].iter().rev().fold(0.0, |sum, c| sum * x + c);
                let exact = SIZE[n] * libm::cos(n as f64 * libm::acos(2.0 * x - 1.0));
                let rounding = 1e-15 * SMALLEST[n].iter().map(|c| c.abs()).sum::<f64>();
                assert!((value - exact).abs() < rounding, "{n} at {x}: {value} instead of {exact}");
            }
            assert_eq!(SMALLEST[n][n], 1.0);
        }
    }

    /// exp(x) to 1e-12 takes 15 terms of its power series, but 10 of these.
    #[test]
    fn fewer_terms_come_as_near_as_is_said() {
        let mut terms = [1.0; POWERS];
        for n in 1..POWERS {
            terms[n] = terms[n - 1] / n as f64;
        }
        let all = terms;
        assert_eq!(economize(&mut terms, POWERS, 0.0), POWERS);
        assert_eq!(terms, all);
        let count = economize(&mut terms, POWERS, 1e-12);
        assert_eq!(count, 10);
        for i in 0..=100 {
            let x = f64::from(i) / 100.0;
            let value = terms[..count].iter().rev().fold(0.0, |sum, c| sum * x + c);
            assert!((value - libm::exp(x)).abs() < 1.001e-12, "{value} at {x}");
        }
    }
}
