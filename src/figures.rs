//! Numbers in messages.

/// As a person writes it, without the hundreds of zeros of very large and small ones.
pub(crate) fn plain(value: f64) -> String {
    let is_long = value != 0.0 && value.is_finite() && !(1e-12..1e16).contains(&value.abs());
    if is_long { format!("{value:e}") } else { format!("{value}") }
}

/// To three digits: 0.0246, 40.7, 55700, 2.75e9.
pub fn short(value: f64) -> String {
    let rounded: f64 = format!("{value:.2e}").parse().unwrap_or(value);
    if rounded == 0.0 || (1e-3..1e6).contains(&rounded.abs()) { format!("{rounded}") } else { format!("{rounded:e}") }
}

/// A length, level or share to six decimals: without the rounding of the sums that it comes from.
pub fn six_decimals(value: f64) -> f64 {
    let millionths = (1e6 * value).round();
    if millionths.abs() < 1e15 { millionths / 1e6 } else { value }
}

#[cfg(test)]
mod tests {
    use super::{plain, short};

    #[test]
    fn no_number_is_longer_than_its_digits() {
        for (value, text) in [
            (0.0, "0"),
            (20.0, "20"),
            (-0.1, "-0.1"),
            (f64::MAX, "1.7976931348623157e308"),
            (5e-324, "5e-324"),
            (f64::INFINITY, "inf"),
        ] {
            assert_eq!(plain(value), text);
        }
    }

    #[test]
    fn three_digits_whatever_the_size() {
        for (value, text) in [
            (0.0, "0"),
            (0.024_57, "0.0246"),
            (40.71, "40.7"),
            (-55_724.0, "-55700"),
            (2.75e9, "2.75e9"),
            (9.996e-4, "0.001"),
            (1.234e-5, "1.23e-5"),
            (1.5e308, "1.5e308"),
        ] {
            assert_eq!(short(value), text);
        }
    }
}
