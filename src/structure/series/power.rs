//! Powers of the ground and of damping at the nodes of a quadrature, from a series in time of modes, or of oscillators.

use super::MotionSeries;
use crate::numerics::polynomial::{COUNT, MAX_TERMS};
use crate::numerics::quadrature::TWELVE_POINTS;
use crate::structure::equations::Structure;
use crate::structure::flight_modes::FlightModes;

/// One number for each node.
pub(crate) type AtPoints = [f64; TWELVE_POINTS.len()];

/// Memory for motions at all nodes, and the powers of the dashpots of links, W.
#[derive(Clone, Debug)]
pub struct NodeRoom {
    q: Vec<AtPoints>,
    v: Vec<AtPoints>,
    of_modes: Vec<AtPoints>,
    pub dashpots: Vec<AtPoints>,
}

impl NodeRoom {
    /// For a structure; empty where damping couples no modes.
    pub fn new(structure: &Structure) -> NodeRoom {
        let lanes = if structure.is_classical() { 0 } else { structure.lanes };
        let [q, v, of_modes] = [(); 3].map(|()| vec![AtPoints::default(); lanes]);
        NodeRoom { q, v, of_modes, dashpots: vec![AtPoints::default(); structure.links.len()] }
    }
}

impl MotionSeries {
    /// Sums over modes of participation times velocity, kg m/s, and the power of damping, W, at the times `x`, in units of
    /// the scale; those of the dashpots of links are left in the room. The series has to be one in time, of these oscillators
    /// where they move.
    pub fn powers_at_nodes(
        &self,
        structure: &Structure,
        oscillators: Option<&FlightModes>,
        x: &AtPoints,
        room: &mut NodeRoom,
    ) -> [AtPoints; 2] {
        if structure.is_classical() {
            return powers_of_single_modes(self, structure, x);
        }
        let NodeRoom { q, v, of_modes, dashpots } = room;
        set_motions(self, x, oscillators.is_some(), (q, v));
        let v = match oscillators {
            Some(oscillators) => {
                oscillators.velocities_of_modes((q, v), of_modes);
                of_modes
            }
            None => v,
        };
        structure.powers_of(v, dashpots)
    }
}

#[multiversion::multiversion(targets("x86_64+avx2"))]
fn powers_of_single_modes(series: &MotionSeries, structure: &Structure, x: &AtPoints) -> [AtPoints; 2] {
    let (mut momentum, mut viscous) = (AtPoints::default(), AtPoints::default());
    let per_second = 1.0 / series.scale;
    let modes = structure.participation.iter().zip(&structure.damping).take(structure.modes_of_all());
    for (m, (participation, c)) in modes.enumerate() {
        let mut v = AtPoints::default();
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

/// Writes the velocities at all nodes, and, where they are asked for, the displacements.
#[multiversion::multiversion(targets("x86_64+avx2"))]
fn set_motions(
    series: &MotionSeries,
    x: &AtPoints,
    with_displacements: bool,
    (q, v): (&mut [AtPoints], &mut [AtPoints]),
) {
    let per_second = 1.0 / series.scale;
    let order = series.order.min(MAX_TERMS - 1);
    let term = |n: usize, m: usize| series.coefficients[n * series.lanes + m];
    for m in 0..series.lanes {
        let mut rate = AtPoints::default();
        for n in (1..=order).rev() {
            let slope = term(n, m) * COUNT[n];
            (0..x.len()).for_each(|i| rate[i] = rate[i] * x[i] + slope);
        }
        v[m] = rate.map(|rate| rate * per_second);
        if with_displacements {
            let mut value = AtPoints::default();
            for n in (0..=order).rev() {
                let term = term(n, m);
                (0..x.len()).for_each(|i| value[i] = value[i] * x[i] + term);
            }
            q[m] = value;
        }
    }
}
