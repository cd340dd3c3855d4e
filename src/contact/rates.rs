//! How fast a contact force changes, from how its floors move.

use super::force::{Force, power};

impl Force {
    /// N/s and N/s2: the first two derivatives of the force with respect to time, from the penetration and its first
    /// three derivatives. None where d = 0 is a branch point of the force.
    pub fn rates(&self, [d, v, a, j]: [f64; 4]) -> Option<[f64; 2]> {
        if d <= 0.0 && !self.is_regular() {
            return None;
        }
        Some(match *self {
            Force::None => [0.0; 2],
            Force::Linear { stiffness, damping } => [stiffness * v + damping * a, stiffness * a + damping * j],
            Force::Power { stiffness, exponent, damping } => {
                let spring = power_rates(exponent, [d, v, a]).map(|rate| stiffness * rate);
                product_rates(spring, [1.0 + damping * v, damping * a, damping * j])
            }
            Force::Root { stiffness, damping } => {
                let [_, first, second] = power_rates(1.5, [d, v, a]).map(|rate| stiffness * rate);
                let damper = power_rates(0.25, [d, v, a]).map(|rate| damping * rate);
                let [damper_first, damper_second] = product_rates(damper, [v, a, j]);
                [first + damper_first, second + damper_second]
            }
        })
    }
}

/// d^n and its first two derivatives, for d > 0.
fn power_rates(n: f64, [d, v, a]: [f64; 3]) -> [f64; 3] {
    let value = power(d, n);
    let (log_rate, bend) = (v / d, a / d);
    [value, n * value * log_rate, n * value * ((n - 1.0) * log_rate * log_rate + bend)]
}

/// The first two derivatives of a product, from both factors with theirs.
fn product_rates([f0, f1, f2]: [f64; 3], [g0, g1, g2]: [f64; 3]) -> [f64; 2] {
    [f1 * g0 + f0 * g1, f2 * g0 + 2.0 * f1 * g1 + f0 * g2]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Central differences of the force along d(t) = 2 + 0.3 t - 0.4 t^2 + 0.5 t^3.
    #[test]
    fn they_are_those_of_the_force() {
        let motion =
            |t: f64| [2.0 + 0.3 * t - 0.4 * t * t + 0.5 * t * t * t, 0.3 - 0.8 * t + 1.5 * t * t, -0.8 + 3.0 * t, 3.0];
        let h = 1e-4;
        for force in [
            Force::None,
            Force::Linear { stiffness: 5.0, damping: 0.7 },
            Force::Power { stiffness: 5.0, exponent: 1.5, damping: 0.2 },
            Force::Power { stiffness: 5.0, exponent: 2.3, damping: 0.0 },
            Force::Root { stiffness: 5.0, damping: 0.7 },
        ] {
            let value = |t: f64| force.value(motion(t)[0], motion(t)[1]);
            let first = (value(h) - value(-h)) / (2.0 * h);
            let second = (value(h) - 2.0 * value(0.0) + value(-h)) / (h * h);
            let [got_first, got_second] = force.rates(motion(0.0)).unwrap_or([f64::NAN; 2]);
            assert!((got_first - first).abs() < 1e-6, "{force:?}: {got_first} instead of {first}");
            assert!((got_second - second).abs() < 1e-5, "{force:?}: {got_second} instead of {second}");
        }
    }

    #[test]
    fn a_power_has_none_where_it_begins() {
        let rates = |force: Force| force.rates([0.0, 0.3, 0.0, 0.0]);
        assert_eq!(rates(Force::Root { stiffness: 5.0, damping: 0.7 }), None);
        assert_eq!(rates(Force::Linear { stiffness: 5.0, damping: 0.0 }), Some([1.5, 0.0]));
    }
}
