//! Working data of the search for an event in a flight.

use crate::engine::base::Base;
use crate::structure::{Motion, MotionMut};

/// The position of the search in the flight; its content means nothing between calls.
#[derive(Clone, Debug)]
pub struct Look {
    /// Time since the base, s.
    pub from: f64,
    /// Modal displacements at that time.
    pub q: Vec<f64>,
    /// Modal velocities at that time.
    pub v: Vec<f64>,
    /// Modal load at that time.
    pub load: Vec<f64>,
    /// The motion at the end of the present piece.
    pub end_q: Vec<f64>,
    pub end_v: Vec<f64>,
    /// Whether each pair is known not to meet in the whole flight, and then each storey that can yield not to.
    pub is_free: Vec<bool>,
}

impl Look {
    pub fn new(lanes: usize, limits: usize) -> Look {
        let vector = || vec![0.0; lanes];
        let (q, v, load) = (vector(), vector(), vector());
        Look { from: 0.0, q, v, load, end_q: vector(), end_v: vector(), is_free: vec![false; limits] }
    }

    pub fn motion(&self) -> Motion<'_> {
        Motion { q: &self.q, v: &self.v }
    }

    pub fn start(&mut self, base: &Base, load: &[f64]) {
        self.from = 0.0;
        MotionMut { q: &mut self.q, v: &mut self.v }.copy_from(base.motion());
        self.load.copy_from_slice(load);
    }

    pub fn move_on(&mut self, length: f64, slope: &[f64]) {
        self.from += length;
        std::mem::swap(&mut self.q, &mut self.end_q);
        std::mem::swap(&mut self.v, &mut self.end_v);
        for (load, slope) in self.load.iter_mut().zip(slope) {
            *load += slope * length;
        }
    }
}
