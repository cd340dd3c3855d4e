//! Random frames, from light to heavy and from soft to stiff, some without damping.
#![allow(dead_code)] // each test uses its share

use proptest::prelude::*;
use std::f64::consts::PI;

/// What building a frame takes.
#[derive(Clone, Debug)]
pub struct Frame {
    /// kg.
    pub mass: f64,
    /// Hz, of one storey by itself.
    pub frequency: f64,
    /// Factors on mass and stiffness, storey by storey.
    pub storeys: Vec<(f64, f64)>,
    ratio: f64,
}

/// Of one storey up to `most_storeys`. What is drawn, in which order, stays: seeds of failures that were found depend on it.
pub fn frame(most_storeys: usize) -> impl Strategy<Value = Frame> {
    let storeys = prop::collection::vec((0.7..1.3, 0.7..1.3), 1..=most_storeys);
    (0.0..6.0_f64, 0.3..30.0_f64, storeys, prop_oneof![Just(0.0), 0.0..0.1])
        .prop_map(|(mass, frequency, storeys, ratio)| Frame { mass: 10.0_f64.powf(mass), frequency, storeys, ratio })
}

impl Frame {
    /// Of the storeys, N/m.
    pub fn stiffness(&self) -> Vec<f64> {
        let w = 2.0 * PI * self.frequency;
        self.storeys.iter().map(|(_, k)| k * self.mass * w * w).collect()
    }

    /// The table of the building on one side.
    pub fn toml(&self, side: &str) -> String {
        let masses: Vec<f64> = self.storeys.iter().map(|(m, _)| m * self.mass).collect();
        let stiffness = self.stiffness();
        format!("[{side}]\nmass = {masses:?}\nstiffness = {stiffness:?}\ndamping = {{ ratio = {:?} }}\n", self.ratio)
    }
}
