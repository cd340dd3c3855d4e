//! Polynomials of a step, c0 + c1 x + c2 x^2 + ..., evaluated by tables of powers: sums of products in a fixed order,
//! which vectorise, whereas each operation of Horner's rule waits for the one before.

/// Highest power of any Taylor series of the motion.
pub(crate) const MAX_ORDER: usize = 30;

/// Length of a coefficient array: the powers of a series and of its derivatives; a multiple of [`BLOCK`].
pub(crate) const MAX_TERMS: usize = 36;

/// Number of terms that are summed side by side, one per lane of a vector register.
pub(crate) const BLOCK: usize = 4;

/// The coefficients of a polynomial; 0 or at least finite beyond its highest power.
pub(crate) type Coefficients = [f64; MAX_TERMS];

/// 1 for each power.
pub(crate) const ALL: Coefficients = [1.0; MAX_TERMS];

/// A number for each power, from a constant formula in its whole number `n`.
macro_rules! of_powers {
    ($count:expr, |$n:ident| $number:expr) => {{
        let (mut table, mut power) = ([0.0; $count], 0);
        while power < $count {
            let $n = power as i64;
            table[power] = $number;
            power += 1;
        }
        table
    }};
}

/// n for each power n.
pub(crate) const COUNT: Coefficients = of_powers!(MAX_TERMS, |n| n as f64);

/// n (n-1) for each power n: factors of the second derivative.
pub(crate) const SECOND: Coefficients = of_powers!(MAX_TERMS, |n| (n * (n - 1)) as f64);

/// n (n-1) (n-2) (n-3) for each power n: factors of the fourth derivative.
pub(crate) const FOURTH: Coefficients = of_powers!(MAX_TERMS, |n| (n * (n - 1) * (n - 2) * (n - 3)) as f64);

/// 1/(n + 1) for each power n, and for one power more: factors of the integral.
pub(crate) const RECIPROCAL: [f64; MAX_TERMS + 1] = of_powers!(MAX_TERMS + 1, |n| 1.0 / (n + 1) as f64);

/// The numbers `of(0)`, `of(1)`, ... of one block: unlike `std::array::from_fn` it is always unrolled.
#[inline(always)]
pub(crate) fn each(of: impl Fn(usize) -> f64) -> [f64; BLOCK] {
    let mut all = [0.0; BLOCK];
    for (i, one) in all.iter_mut().enumerate() {
        *one = of(i);
    }
    all
}

/// The first numbers of each slice: of equal lengths, so that a loop needs no bounds checks. No closure, whose code might not be
/// compiled for the instructions of its caller.
#[inline(always)]
pub(crate) fn cut<const N: usize>(mut all: [&[f64]; N], count: usize) -> [&[f64]; N] {
    for one in &mut all {
        *one = &one[..count];
    }
    all
}

/// The larger of two numbers in one instruction, as `f64::max` is not; the first where either is not a number.
#[inline(always)]
pub(crate) fn larger(a: f64, b: f64) -> f64 {
    if b > a { b } else { a }
}

/// The smaller of two numbers in the same way.
#[inline(always)]
pub(crate) fn smaller(a: f64, b: f64) -> f64 {
    if b < a { b } else { a }
}

/// The largest of some numbers, or 0; a NaN is passed over.
#[inline(always)]
pub(crate) fn largest(all: &[f64]) -> f64 {
    let mut most = [0.0; BLOCK];
    let (blocks, rest) = all.as_chunks::<BLOCK>();
    for block in blocks {
        for i in 0..BLOCK {
            most[i] = larger(most[i], block[i]);
        }
    }
    rest.iter().chain(&most).fold(0.0, |most, one| larger(most, *one))
}

/// Value and slope of a polynomial at x.
pub(crate) fn value_and_slope(coefficients: &[f64], x: f64) -> (f64, f64) {
    coefficients.iter().rev().fold((0.0, 0.0), |(value, slope), c| (value * x + c, slope * x + value))
}

/// x^(1/n) for x > 0 within 1 %, for step lengths, which need no more.
pub(crate) fn rough_root(x: f64, n: usize) -> f64 {
    const MANTISSA: u64 = (1 << 52) - 1;
    let bits = x.to_bits();
    let exponent = (bits >> 52) as i64 - 1023;
    if !(-1022..1024).contains(&exponent) {
        return libm::pow(x, 1.0 / n as f64);
    }
    // log2 of the mantissa by a parabola that is exact at 1, sqrt 2 and 2; the power of two by a similar one.
    let m = f64::from_bits(bits & MANTISSA | 1.0_f64.to_bits()) - 1.0;
    let log = (exponent as f64 + m * (1.345_35 - 0.345_35 * m)) / n as f64;
    // The integer part, rounded down also for negative logarithms.
    let whole = log as i64 - i64::from(log < 0.0);
    let fraction = log - whole as f64;
    let power = f64::from_bits(((whole.clamp(-1022, 1023) + 1023) as u64) << 52);
    power * (1.0 + fraction * (0.656_85 + 0.343_15 * fraction))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rough_root_is_within_one_percent() {
        for n in [1, 2, 7, 16, 29] {
            for exponent in -300..300 {
                for mantissa in [1.0, 1.1, 1.25, 1.4, 1.7, 1.999_999] {
                    let x = mantissa * libm::exp2(f64::from(exponent));
                    let exact = libm::pow(x, 1.0 / n as f64);
                    let error = rough_root(x, n) / exact - 1.0;
                    assert!(error.abs() < 0.01, "{x:e}, root {n}: off by {error}");
                }
            }
            assert_eq!(rough_root(0.0, n), 0.0);
        }
    }
}
