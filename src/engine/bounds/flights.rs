//! Flights that follow each other, on the ground's motion and under what a master pushes with.

use crate::structure::{LinearGround, LinearLoad, Motion, Structure};

/// The load of a flight.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Load {
    pub ground: LinearGround,
    /// Length, s; 0: a gap, as contact or yielding has changed the motion before the next flight.
    pub length: f64,
}

impl Load {
    /// That of a gap after it.
    pub fn gap(self) -> Load {
        Load { ground: LinearGround { slope: 0.0, ..self.ground.later(self.length) }, length: 0.0 }
    }
}

/// Flights that follow each other, or the first part of one: the motions at their starts, and at the end of the last one, if it is no gap.
#[derive(Clone, Copy)]
pub struct Flights<'a> {
    pub lanes: usize,
    pub q: &'a [f64],
    pub v: &'a [f64],
    pub loads: &'a [Load],
    pub end: Motion<'a>,
    /// The forces of a master, in scenes that have them.
    pub forces: Option<Forces<'a>>,
}

/// What a master pushes with, in the order of [`Inputs::pushes`](crate::engine::Inputs), linear in time over each
/// flight.
#[derive(Clone, Copy)]
pub struct Forces<'a> {
    /// E^2 = q'''^2 + w^2 q''^2 of all modes at the start of each flight, under the ground's load and the forces'.
    pub energies: &'a [f64],
    /// For each flight the number of the set that acts in it.
    pub of: &'a [usize],
    /// Sets of forces at the starts of flights, N, and of their rates, N/s, each of `width` numbers; those of the first set
    /// are 0.
    pub sets: &'a [f64],
    pub width: usize,
}

impl<'a> Forces<'a> {
    /// The forces at the start of flight `k`, and their rates; `None` where there are none.
    pub fn acting(&self, k: usize) -> Option<(&'a [f64], &'a [f64])> {
        let number = self.of.get(k).filter(|number| **number > 0)?;
        Some(self.sets[2 * self.width * number..][..2 * self.width].split_at(self.width))
    }
}

/// Writes E^2 of all modes for a motion and a load with its slope, where damping couples no modes.
#[multiversion::multiversion(targets("x86_64+avx2"))]
pub fn set_energies(
    Structure { omega2, damping, .. }: &Structure,
    Motion { q, v }: Motion,
    LinearLoad { load, slope }: LinearLoad,
    out: &mut [f64],
) {
    // Equal lengths: no bounds checks below.
    let count = out.len();
    let (omega2, damping, q, v) = (&omega2[..count], &damping[..count], &q[..count], &v[..count]);
    let (load, slope) = (&load[..count], &slope[..count]);
    for m in 0..count {
        let acceleration = load[m] - damping[m] * v[m] - omega2[m] * q[m];
        let jerk = slope[m] - damping[m] * acceleration - omega2[m] * v[m];
        out[m] = jerk * jerk + omega2[m] * acceleration * acceleration;
    }
}

impl<'a> Flights<'a> {
    /// Number of flights and of gaps between them.
    pub fn count(&self) -> usize {
        match self.loads.last() {
            Some(load) if load.length == 0.0 => self.loads.len() - 1,
            _ => self.loads.len(),
        }
    }

    /// The motion at the start of flight `k`, or at the end of the last one.
    pub fn motion(&self, k: usize) -> Motion<'a> {
        if k == self.loads.len() {
            return self.end;
        }
        let range = k * self.lanes..(k + 1) * self.lanes;
        Motion { q: &self.q[range.clone()], v: &self.v[range] }
    }

    /// The load by the ground's motion in flight `k`; at the end of the last one that of a gap.
    pub fn load(&self, k: usize) -> Load {
        self.loads.get(k).copied().unwrap_or_else(|| self.loads.last().copied().unwrap_or_default().gap())
    }
}
