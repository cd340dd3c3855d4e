//! Powers of the ground and of damping at the nodes of a quadrature, from a series in time of uncoupled modes.

use super::MotionSeries;
use crate::numerics::polynomial::{COUNT, MAX_TERMS};
use crate::numerics::quadrature::TWELVE_POINTS;
use crate::structure::equations::Structure;

/// One number for each node.
type Nodes = [f64; TWELVE_POINTS.len()];

impl MotionSeries {
    /// Sums over modes of participation times velocity, kg m/s, and of damping times velocity squared, W, at the times
    /// `x`, in units of the scale. The series has to be one in time, and damping must not couple its modes.
    pub fn powers_at_nodes(&self, structure: &Structure, x: &Nodes) -> [Nodes; 2] {
        powers_at_nodes(self, structure, x)
    }
}

#[multiversion::multiversion(targets("x86_64+avx2"))]
fn powers_at_nodes(series: &MotionSeries, structure: &Structure, x: &Nodes) -> [Nodes; 2] {
    let (mut momentum, mut viscous) = (Nodes::default(), Nodes::default());
    let per_second = 1.0 / series.scale;
    let modes = structure.participation.iter().zip(&structure.damping).take(structure.modes_of_both());
    for (m, (participation, c)) in modes.enumerate() {
        let mut v = Nodes::default();
        for n in (1..=series.order.min(MAX_TERMS - 1)).rev() {
            let term = series.coefficients[n * series.lanes + m] * COUNT[n];
            for (v, x) in v.iter_mut().zip(x) {
                *v = *v * x + term;
            }
        }
        for i in 0..v.len() {
            let v = v[i] * per_second;
            momentum[i] += participation * v;
            viscous[i] += c * v * v;
        }
    }
    [momentum, viscous]
}
