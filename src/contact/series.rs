//! Power series of the contact force from that of the penetration, term by term, while a step is expanded.

use super::force::{Force, Guard};
use crate::polynomial::{Coefficients, RECIPROCAL, ROOM, value};
use crate::quadrature::{TWELVE, gauss};

/// Terms of a product of series that are summed side by side.
const BLOCK: usize = 4;

/// Share of its penetration that a pair has kept at the end of a step, below which the step is taken to end at a release.
const NEARLY_RELEASED: f64 = 0.1;

/// The scalar series of one contact over a step, in powers of x = t / scale.
#[derive(Clone, Copy, Debug)]
pub struct PairSeries {
    /// Penetration, m.
    pub penetration: Coefficients,
    /// Force, N.
    pub force: Coefficients,
    /// d^n of a power law.
    power: Coefficients,
    /// d^1.25 of a root law.
    root: Coefficients,
    /// The penetration's terms backwards, the first at [`ROOM`] - 1: a product of series is then a plain sum.
    backwards: [f64; ROOM + BLOCK],
    /// 1/d_0, 1/m.
    inverse: f64,
    /// Powers of the penetration and force that are filled.
    pub order: usize,
}

impl Default for PairSeries {
    fn default() -> Self {
        let zeros = [0.0; ROOM];
        PairSeries {
            penetration: zeros,
            force: zeros,
            power: zeros,
            root: zeros,
            backwards: [0.0; ROOM + BLOCK],
            inverse: 0.0,
            order: 0,
        }
    }
}

impl PairSeries {
    /// Starts from a penetration and its rate per unit of x, both m.
    pub fn start(&mut self, penetration: f64, step_rate: f64) {
        // All others are written anew or stay 0.
        self.power.fill(0.0);
        self.root.fill(0.0);
        self.inverse = 1.0 / penetration;
        self.set_penetration(0, penetration);
        self.set_penetration(1, step_rate);
    }

    /// Enters power n of the penetration.
    pub fn set_penetration(&mut self, n: usize, value: f64) {
        self.penetration[n] = value;
        self.backwards[ROOM - 1 - n] = value;
    }

    /// Fills power n of the force from the powers 0..=n + 1 of the penetration, for n = 0, 1, 2, ... in turn.
    pub fn extend_force(&mut self, force: &Force, n: usize, scale: f64) {
        self.force[n] = match *force {
            Force::None => 0.0,
            Force::Linear { stiffness, damping } => {
                stiffness * self.penetration[n] + (damping / scale) * (n + 1) as f64 * self.penetration[n + 1]
            }
            Force::Power { stiffness, exponent, damping } => {
                let power = self.next_power(&self.power, exponent, n);
                self.power[n] = power;
                if damping == 0.0 {
                    stiffness * power
                } else {
                    let product = weighted_product(&self.power, &self.backwards, n + 1, (n + 1) as f64, 1.0);
                    stiffness * (power + damping / scale * product)
                }
            }
            // d^0.25 d' = (4/5) (d^1.25)': no product of series.
            Force::Root { stiffness, damping } => {
                if n == 0 {
                    self.root[0] = super::force::power(self.penetration[0], 1.25);
                }
                self.power[n] = self.next_power(&self.power, 1.5, n);
                self.root[n + 1] = self.next_power(&self.root, 1.25, n + 1);
                stiffness * self.power[n] + 0.8 * damping / scale * (n + 1) as f64 * self.root[n + 1]
            }
        };
        self.order = n;
    }

    /// The series of a guard times +1 or -1, up to the order of the force.
    pub fn guard(&self, guard: &Guard, scale: f64, sense: f64, out: &mut Coefficients) {
        let (stiffness, rate) = (sense * guard.stiffness, sense * guard.damping / scale);
        for (n, out) in out.iter_mut().enumerate().take(self.order + 1) {
            *out = stiffness * self.penetration[n] + rate * (n + 1) as f64 * self.penetration[n + 1];
        }
        out[self.order + 1..].fill(0.0);
        out[0] += sense * guard.constant;
    }

    /// J, work of the damping part of the force over 0..=x: twelve points side by side.
    pub fn damping_work(&self, force: &Force, scale: f64, x: f64) -> f64 {
        if !force.is_damped() {
            return 0.0;
        }
        let (mut at, mut weights) = ([0.0; 12], [0.0; 12]);
        // A power law's damping force ends with a root of the time left: even in the square root of that time.
        let released = !force.is_regular()
            && value(&self.penetration[..=self.order + 2], x) < NEARLY_RELEASED * self.penetration[0];
        let reach = if released { 1.0 } else { x };
        for (i, (node, weight)) in gauss(TWELVE, reach).enumerate().take(12) {
            let left = 1.0 - node;
            (at[i], weights[i]) =
                if released { (x * (1.0 - left * left), x * 2.0 * left * weight) } else { (node, weight) };
        }
        let (mut d, mut rate) = ([0.0; 12], [0.0; 12]);
        for n in (0..=self.order + 2).rev() {
            for i in 0..12 {
                rate[i] = rate[i] * at[i] + d[i];
                d[i] = d[i] * at[i] + self.penetration[n];
            }
        }
        let power = |i: usize| weights[i] * force.damping_power(d[i], rate[i] / scale);
        scale * (0..12).map(power).sum::<f64>()
    }

    /// Term n of p = d^exponent, from d p' = exponent p d' (Miller's recurrence): n d_0 p_n = sum over j < n of
    /// (exponent (n - j) - j) d_(n-j) p_j. Terms of p from n on must be 0.
    fn next_power(&self, power: &Coefficients, exponent: f64, n: usize) -> f64 {
        if n == 0 {
            return super::force::power(self.penetration[0], exponent);
        }
        let sum = weighted_product(power, &self.backwards, n, exponent * n as f64, exponent + 1.0);
        sum * (RECIPROCAL[n - 1] * self.inverse)
    }
}

/// Sum over j of (first - j step) d_(n-j) p_j, where p is 0 from some j <= n + 1 on.
fn weighted_product(power: &Coefficients, backwards: &[f64; ROOM + BLOCK], n: usize, first: f64, step: f64) -> f64 {
    let mut sum = [0.0; BLOCK];
    let mut weight: [f64; BLOCK] = std::array::from_fn(|i| first - i as f64 * step);
    let d = backwards[ROOM - 1 - n..].as_chunks::<BLOCK>().0;
    for (p, d) in power.as_chunks::<BLOCK>().0.iter().zip(d).take(n / BLOCK + 1) {
        for i in 0..BLOCK {
            sum[i] += weight[i] * d[i] * p[i];
            weight[i] -= BLOCK as f64 * step;
        }
    }
    (sum[0] + sum[2]) + (sum[1] + sum[3])
}
