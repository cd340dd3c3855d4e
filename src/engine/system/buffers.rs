//! Vectors to work in: their content means nothing between calls.

use crate::numerics::complementarity::Complementarity;
use crate::numerics::polynomial::{Coefficients, MAX_ORDER, MAX_TERMS};
use crate::numerics::powers::Powers;
use crate::structure::{Interval, MotionSeries, Scratch, Structure};

/// Buffers; their content means nothing between calls.
#[derive(Clone, Debug)]
pub struct Buffers {
    pub load: Vec<f64>,
    pub slope: Vec<f64>,
    /// Rates of the floor forces, N/s (on modes, per kg^1/2); empty where all are held.
    pub force_slope: Vec<f64>,
    pub q: Vec<f64>,
    pub v: Vec<f64>,
    pub scratch: Scratch,
    pub series: MotionSeries,
    pub interval: Interval,
    /// Modal state at an integration node.
    pub node_q: Vec<f64>,
    pub node_v: Vec<f64>,
    pub scalar: Coefficients,
    pub powers: Powers,
    pub rigid: Complementarity,
}

impl Buffers {
    /// For a structure with so many rigid pairs.
    pub fn new(structure: &Structure, rigid: usize) -> Buffers {
        let lanes = structure.lanes;
        let vector = || vec![0.0; lanes];
        Buffers {
            load: vector(),
            slope: vector(),
            force_slope: Vec::with_capacity(lanes),
            q: vector(),
            v: vector(),
            scratch: Scratch::new(lanes),
            series: MotionSeries::new(lanes, MAX_ORDER + 2),
            interval: Interval::room(structure),
            node_q: vector(),
            node_v: vector(),
            scalar: [0.0; MAX_TERMS],
            powers: Powers::default(),
            rigid: Complementarity::new(rigid),
        }
    }
}
