//! Gauss-Legendre quadrature, also with nodes graded towards the start of the interval.

/// Half of a symmetric rule: nodes on 0..1 and their weights [AbramowitzStegun1964, table 25.4].
pub(crate) type HalfRule = [(f64, f64)];

/// 8 points, exact up to degree 15: for the smooth motion in flight.
pub(crate) const EIGHT: &HalfRule = &[
    (0.183_434_642_495_649_8, 0.362_683_783_378_362),
    (0.525_532_409_916_329, 0.313_706_645_877_887_3),
    (0.796_666_477_413_626_7, 0.222_381_034_453_374_48),
    (0.960_289_856_497_536_3, 0.101_228_536_290_376_26),
];

/// 12 points, exact up to degree 23: for steps in contact, which are as long as their series allow.
pub(crate) const TWELVE: &HalfRule = &[
    (0.125_233_408_511_468_9, 0.249_147_045_813_402_8),
    (0.367_831_498_998_180_2, 0.233_492_536_538_354_8),
    (0.587_317_954_286_617_5, 0.203_167_426_723_065_9),
    (0.769_902_674_194_304_7, 0.160_078_328_543_346_2),
    (0.904_117_256_370_474_9, 0.106_939_325_995_318_4),
    (0.981_560_634_246_719_3, 0.047_175_336_386_511_83),
];

/// Points, in ascending order, and weights of [`TWELVE`] for the integral over 0..=1.
pub(crate) const TWELVE_POINTS: [(f64, f64); 12] = {
    let mut points = [(0.0, 0.0); 12];
    let mut i = 0;
    while i < 6 {
        let (node, weight) = TWELVE[i];
        points[5 - i] = (0.5 * (1.0 - node), 0.5 * weight);
        points[6 + i] = (0.5 * (1.0 + node), 0.5 * weight);
        i += 1;
    }
    points
};

/// Points, in ascending order, and weights for the integral over 0..=length.
pub(crate) fn gauss(rule: &HalfRule, length: f64) -> impl Iterator<Item = (f64, f64)> {
    let half = 0.5 * length;
    let below = rule.iter().rev().map(|(node, weight)| (-node, *weight));
    below.chain(rule.iter().copied()).map(move |(node, weight)| (half * (1.0 + node), half * weight))
}

/// Points and weights for the integral over 0..=length by quadrature in s with t = s^4. Accurate where the integrand is
/// a series in quarter powers of t, as after an entry under a law with d^(1/4), or in whole powers of t.
pub(crate) fn graded(rule: &HalfRule, length: f64) -> impl Iterator<Item = (f64, f64)> {
    gauss(rule, length.sqrt().sqrt()).map(|(s, weight)| {
        let cube = s * s * s;
        (cube * s, 4.0 * cube * weight)
    })
}

#[cfg(test)]
mod tests {
    use super::{EIGHT, TWELVE, TWELVE_POINTS, gauss, graded};

    #[test]
    fn quarter_powers_are_integrated_from_a_start_at_0() {
        for power in [0.0, 0.25, 1.0, 1.25, 2.5, 4.75] {
            let sum: f64 = graded(TWELVE, 0.3).map(|(t, weight)| weight * f64::powf(t, power)).sum();
            let exact = f64::powf(0.3, power + 1.0) / (power + 1.0);
            assert!((sum - exact).abs() <= 4e-15 * exact, "t^{power}: {sum} instead of {exact}");
        }
    }

    #[test]
    fn points_abreast_are_those_of_the_rule() {
        assert!(gauss(TWELVE, 1.0).eq(TWELVE_POINTS));
    }

    #[test]
    fn powers_are_integrated_to_rounding() {
        for (rule, highest) in [(EIGHT, 15), (TWELVE, 23)] {
            for power in 0..=highest {
                let sum: f64 = gauss(rule, 2.0).map(|(x, weight)| weight * f64::powi(x, power)).sum();
                let exact = f64::powi(2.0, power + 1) / f64::from(power + 1);
                assert!((sum - exact).abs() <= 4e-15 * exact, "x^{power}: {sum} instead of {exact}");
            }
        }
    }
}
