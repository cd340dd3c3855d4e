//! Energies of all buildings in modal coordinates, and the powers that change them.

use super::equations::Structure;
use super::form::{row_times, squares};
use super::lanes::LANES;

impl Structure {
    /// Kinetic and strain energy, J.
    pub fn energies(&self, q: &[f64], v: &[f64]) -> (f64, f64) {
        let kinetic: f64 = v.iter().map(|v| v * v).sum();
        let strain: f64 = q.iter().zip(&self.omega2).map(|(q, w2)| w2 * q * q).sum();
        (0.5 * kinetic, 0.5 * strain)
    }

    /// Power that structural damping takes, W.
    pub fn viscous_power(&self, v: &[f64]) -> f64 {
        let mut lanes = [0.0; LANES];
        for (v, c) in v.as_chunks::<LANES>().0.iter().zip(self.damping.as_chunks::<LANES>().0) {
            for i in 0..LANES {
                lanes[i] += c[i] * v[i] * v[i];
            }
        }
        let mut power: f64 = lanes.iter().sum();
        for coupling in &self.coupling {
            power += coupling.power.of_vectors(v.as_chunks::<1>().0)[0];
        }
        power
    }

    /// Sums over modes of participation times velocity, kg m/s, and the power of damping, W, of several motions side by side;
    /// writes those of the dashpots of links.
    pub(super) fn powers_of<const N: usize>(&self, v: &[[f64; N]], dashpots: &mut [[f64; N]]) -> [[f64; N]; 2] {
        let (momentum, mut viscous) = (row_times(&self.participation, v), squares(self.damping.iter().copied(), v));
        for coupling in &self.coupling {
            let of_body = coupling.power.of_vectors(v);
            viscous.iter_mut().zip(of_body).for_each(|(power, of_body)| *power += of_body);
        }
        for (link, power) in self.links.iter().zip(dashpots) {
            *power = row_times(&link.row, v).map(|rate| link.dashpot * (rate * rate));
        }
        [momentum, viscous]
    }
}
