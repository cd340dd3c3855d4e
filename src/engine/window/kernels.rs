//! Data of windows that stay constant during a run: kernels of the pairs, error allowance, lengths.

use crate::collocation::{Kernel, Map, POWERS, Tables};
use crate::contact::Force;
use crate::engine::base::Coordinates;
use crate::engine::base::kinds::Refusal;
use crate::engine::pairs::pair::Pair;
use crate::engine::system::System;
use crate::engine::window::spring::Spring;

/// Relative tolerance of a step at which windows have the lengths of [`longest_window`], and the exponent with which
/// their lengths depend on the tolerance.
const USUAL: (f64, f64) = (2e-11, 0.055);

/// Allowed error between the nodes of a window, relative to the power 2/3 of the tolerance of one step: a Gauss rule is
/// far more accurate at its end than between its nodes.
const BETWEEN_NODES: f64 = 10.0;

/// Largest number of pairs for which all kernels are stored: 64 kB.
const MOST_KNOWN: usize = 20;

/// Data of windows that stay constant during a run.
#[derive(Clone, Debug)]
pub struct Windows {
    /// Kernels G_pq of pairs p and q, by rows; empty where pairs are many.
    kernels: Vec<Kernel>,
    /// Allowed error between nodes, relative to the tolerance of one step.
    pub allowed: f64,
    /// Length of windows relative to that at the usual tolerance.
    pub length_factor: f64,
    /// For each pair, the spring of its law, where the law is a power law.
    pub springs: Vec<Option<Spring>>,
}

impl Windows {
    /// For a system, or why it has none.
    pub fn of(system: &System) -> Result<Windows, Refusal> {
        let System { impulse_response, pairs, tolerance, contact_coordinates, .. } = system;
        if cfg!(without = "windows") {
            return Err(Refusal::SwitchedOff);
        }
        if !pairs.iter().any(Pair::has_power_law) {
            return Err(Refusal::NoRoot);
        }
        let maps = maps(pairs).ok_or(Refusal::OddExponent)?;
        if *contact_coordinates != Coordinates::Modes {
            return Err(Refusal::ByFloors);
        }
        let response = impulse_response.as_ref().ok_or(Refusal::CoupledDamping)?;
        Tables::prepare(maps);
        let known = if pairs.len() <= MOST_KNOWN { &pairs[..] } else { &[] };
        let kernels =
            known.iter().flat_map(|p| known.iter().map(|q| response.kernel(&p.row.modes, &q.row.modes))).collect();
        let allowed = BETWEEN_NODES / libm::cbrt(tolerance.step);
        let springs = pairs.iter().map(Spring::of).collect();
        Ok(Windows { kernels, allowed, length_factor: length_factor(tolerance.step), springs })
    }

    /// The kernel G_pq of two pairs; it is worked out in `room` if it is not stored.
    pub fn kernel<'a>(&'a self, system: &System, p: usize, q: usize, room: &'a mut Option<Kernel>) -> &'a Kernel {
        let pairs = &system.pairs;
        match (self.kernels.get(p * pairs.len() + q), &system.impulse_response) {
            (Some(known), _) => known,
            (None, Some(response)) => room.insert(response.kernel(&pairs[p].row.modes, &pairs[q].row.modes)),
            (None, None) => room.insert([0.0; POWERS]),
        }
    }
}

/// Number of tables of windows that the process has computed so far: all models share them.
pub fn window_tables() -> usize {
    Tables::count()
}

/// Whether windows are for a force: whether the motion under it has square or fourth roots of time at most.
pub fn are_for(force: &Force) -> bool {
    match force {
        Force::Power { exponent, .. } => (2.0 * exponent).fract() == 0.0,
        Force::Root { .. } => true,
        Force::None | Force::Linear { .. } => false,
    }
}

/// The maps of windows for some pairs; `None` where windows are for none of them.
fn maps(pairs: &[Pair]) -> Option<&'static [Map]> {
    let forces = pairs.iter().map(Pair::force);
    let has_root = forces.filter(are_for).map(|force| matches!(force, Force::Root { .. })).reduce(|a, b| a || b)?;
    Some(if has_root { &Map::ALL } else { &Map::SQUARE })
}

/// Length of windows at a step tolerance, relative to that at the usual one.
pub fn length_factor(step_tolerance: f64) -> f64 {
    libm::pow(step_tolerance / USUAL.0, USUAL.1).clamp(0.4, 1.2)
}
