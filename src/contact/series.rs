//! Power series of the contact force from that of the penetration, term by term, while a step is expanded.

use super::force::{Force, Guard};
use crate::quadrature::{TWELVE, gauss};

/// Highest power of any series.
pub const MAX_ORDER: usize = 30;

/// The scalar series of one contact over a step, in powers of x = t / scale.
#[derive(Clone, Copy, Debug)]
pub struct PairSeries {
    /// Penetration, m.
    pub penetration: [f64; MAX_ORDER + 3],
    /// Force, N.
    pub force: [f64; MAX_ORDER + 3],
    /// d^n of a power law.
    power: [f64; MAX_ORDER + 3],
    /// d^1.25 of a root law.
    root: [f64; MAX_ORDER + 3],
    /// Powers of the penetration and force that are filled.
    pub order: usize,
}

impl Default for PairSeries {
    fn default() -> Self {
        let zeros = [0.0; MAX_ORDER + 3];
        PairSeries { penetration: zeros, force: zeros, power: zeros, root: zeros, order: 0 }
    }
}

impl PairSeries {
    /// Fills power n of the force from the powers 0..=n + 1 of the penetration, for n = 0, 1, 2, ... in turn.
    ///
    /// p = d^a follows from d p' = a p d' (Miller's recurrence): n d_0 p_n = sum over j < n of (a (n - j) - j) d_{n-j} p_j.
    pub fn extend_force(&mut self, force: &Force, n: usize, scale: f64) {
        self.force[n] = match *force {
            Force::None => 0.0,
            Force::Linear { stiffness, damping } => {
                stiffness * self.penetration[n] + (damping / scale) * (n + 1) as f64 * self.penetration[n + 1]
            }
            Force::Power { stiffness, exponent, damping } => {
                self.extend_power(exponent, n);
                let mut term = self.power[n];
                if damping != 0.0 {
                    let mut product = 0.0;
                    for j in 0..=n {
                        product += (j + 1) as f64 * self.penetration[j + 1] * self.power[n - j];
                    }
                    term += damping / scale * product;
                }
                stiffness * term
            }
            // d^0.25 d' = (4/5) (d^1.25)': no product of series.
            Force::Root { stiffness, damping } => {
                if n == 0 {
                    self.root[0] = super::force::power(self.penetration[0], 1.25);
                }
                self.extend_power(1.5, n);
                extend_power(&mut self.root, &self.penetration, 1.25, n + 1);
                stiffness * self.power[n] + 0.8 * damping / scale * (n + 1) as f64 * self.root[n + 1]
            }
        };
        self.order = n;
    }

    fn extend_power(&mut self, exponent: f64, n: usize) {
        if n == 0 {
            self.power[0] = super::force::power(self.penetration[0], exponent);
        } else {
            extend_power(&mut self.power, &self.penetration, exponent, n);
        }
    }

    /// The series of a guard, up to the order of the force.
    pub fn guard(&self, guard: &Guard, scale: f64, out: &mut [f64; MAX_ORDER + 3]) {
        let rate = guard.damping / scale;
        for (n, out) in out.iter_mut().enumerate().take(self.order + 1) {
            *out = guard.stiffness * self.penetration[n] + rate * (n + 1) as f64 * self.penetration[n + 1];
        }
        out[0] += guard.constant;
    }

    /// N s, integral of the force over 0..x.
    pub fn impulse(&self, x: f64, scale: f64) -> f64 {
        let mut sum = 0.0;
        for n in (0..=self.order).rev() {
            sum = sum * x + self.force[n] / (n + 1) as f64;
        }
        sum * x * scale
    }

    /// J, work of the damping part of the force over 0..=x.
    pub fn damping_work(&self, force: &Force, x: f64, scale: f64) -> f64 {
        if !force.is_damped() {
            return 0.0;
        }
        let power = |x| {
            let (d, rate) = value_and_slope(&self.penetration[..=self.order + 2], x);
            force.damping_power(d, rate / scale)
        };
        scale * gauss(TWELVE, x).map(|(x, weight)| weight * power(x)).sum::<f64>()
    }
}

/// Term n > 0 of the series of d^exponent.
fn extend_power(power: &mut [f64], d: &[f64], exponent: f64, n: usize) {
    let mut sum = 0.0;
    for j in 0..n {
        sum += (exponent * (n - j) as f64 - j as f64) * d[n - j] * power[j];
    }
    power[n] = sum / (n as f64 * d[0]);
}

/// Value of a polynomial at x.
pub fn value(coefficients: &[f64], x: f64) -> f64 {
    coefficients.iter().rev().fold(0.0, |sum, c| sum * x + c)
}

/// Value and slope of a polynomial at x.
pub fn value_and_slope(coefficients: &[f64], x: f64) -> (f64, f64) {
    coefficients.iter().rev().fold((0.0, 0.0), |(value, slope), c| (value * x + c, slope * x + value))
}
