//! What windows need to know of a scene.

use crate::collocation::{Kernel, POWERS, Tables};
use crate::engine::system::System;
use crate::engine::window::spring::Spring;

/// Relative accuracy of a step for which windows are as long as [`longest_window`] says, and how their length goes with it.
const USUAL: (f64, f64) = (2e-11, 0.055);

/// Error between the nodes of a window, relative to the power 2/3 of what one step may leave: at its end a Gauss rule is
/// far better than between its nodes.
const BETWEEN_NODES: f64 = 10.0;

/// Pairs of which all kernels are kept: 64 kB.
const MOST_KNOWN: usize = 20;

/// What windows need to know of a scene.
#[derive(Clone, Debug)]
pub struct Windows {
    /// G_pq of pairs p and q, one row after the other, where they are few.
    kernels: Vec<Kernel>,
    /// Error between nodes that a window may have, relative to what one step may.
    pub allowed: f64,
    /// Length of windows relative to the usual.
    pub length_factor: f64,
    /// Of each pair whose law has a root.
    pub springs: Vec<Option<Spring>>,
}

impl Windows {
    /// `None` where no law needs them, or damping couples the modes.
    pub fn of(System { impulse_response, pairs, tolerance, .. }: &System) -> Option<Windows> {
        let response = impulse_response.as_ref().filter(|_| !cfg!(without = "windows"))?;
        Tables::prepare();
        let known = if pairs.len() <= MOST_KNOWN { &pairs[..] } else { &[] };
        let kernels = known.iter().flat_map(|p| known.iter().map(|q| response.kernel(&p.row, &q.row))).collect();
        let allowed = BETWEEN_NODES / libm::cbrt(tolerance.step);
        let springs = pairs.iter().map(Spring::of).collect();
        Some(Windows { kernels, allowed, length_factor: length_factor(tolerance.step), springs })
    }

    /// G_pq of two pairs, for which there is `room` where it is not kept.
    pub fn kernel<'a>(&'a self, system: &System, p: usize, q: usize, room: &'a mut Option<Kernel>) -> &'a Kernel {
        let pairs = &system.pairs;
        match (self.kernels.get(p * pairs.len() + q), &system.impulse_response) {
            (Some(known), _) => known,
            (None, Some(response)) => room.insert(response.kernel(&pairs[p].row, &pairs[q].row)),
            (None, None) => room.insert([0.0; POWERS]),
        }
    }
}

/// How long windows are for an accuracy of steps, relative to the usual.
pub fn length_factor(step_tolerance: f64) -> f64 {
    libm::pow(step_tolerance / USUAL.0, USUAL.1).clamp(0.4, 1.2)
}
