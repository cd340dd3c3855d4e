//! Gauss-Legendre quadrature.

/// Nodes on -1..1 and weights of the 12-point rule [AbramowitzStegun1964, table 25.4]; the rule is symmetric.
const HALF: [(f64, f64); 6] = [
    (0.125_233_408_511_468_9, 0.249_147_045_813_402_8),
    (0.367_831_498_998_180_2, 0.233_492_536_538_354_8),
    (0.587_317_954_286_617_5, 0.203_167_426_723_065_9),
    (0.769_902_674_194_304_7, 0.160_078_328_543_346_2),
    (0.904_117_256_370_474_9, 0.106_939_325_995_318_4),
    (0.981_560_634_246_719_3, 0.047_175_336_386_511_83),
];

/// Points and weights for the integral over 0..=length; exact for polynomials up to degree 23.
pub fn gauss(length: f64) -> impl Iterator<Item = (f64, f64)> {
    let half = 0.5 * length;
    HALF.iter()
        .flat_map(|(node, weight)| [(-node, *weight), (*node, *weight)])
        .map(move |(node, weight)| (half * (1.0 + node), half * weight))
}

#[cfg(test)]
mod tests {
    use super::gauss;

    #[test]
    fn powers_are_integrated_to_rounding() {
        for power in 0..=23 {
            let sum: f64 = gauss(2.0).map(|(x, weight)| weight * f64::powi(x, power)).sum();
            let exact = f64::powi(2.0, power + 1) / f64::from(power + 1);
            assert!((sum - exact).abs() <= 4e-15 * exact, "x^{power}: {sum} instead of {exact}");
        }
    }
}
