//! Natural frequencies, and their derivatives with respect to masses and stiffnesses.

use crate::engine::model::Model;
use crate::structure::{BuildingId, Modes};

impl Model {
    /// Natural frequencies of one building alone, ascending, Hz.
    pub fn natural_frequencies(&self, id: BuildingId) -> &[f64] {
        &self.frequencies[id.index()]
    }

    /// Natural frequencies of all that links join, without damping, ascending, Hz; those of each building alone where there
    /// are no links.
    pub fn system_frequencies(&self) -> &[f64] {
        &self.system_frequencies
    }

    /// Derivative of a mode's natural frequency with respect to the mass of a floor, Hz/kg, which weighs
    /// on the storeys below it where the scene gives no other load. Modes and floors count from
    /// 0. `None` where another mode has the same frequency within rounding, as its shape is not unique then.
    pub fn frequency_by_mass(&self, id: BuildingId, mode: usize, floor: usize) -> Option<f64> {
        let modes = self.system.structure.modes(id);
        let shape = modes.shape[(floor, mode)];
        let leaning = self.storeys.weights[id.index()].iter().enumerate().take(floor + 1);
        let by_weight: f64 = leaning.map(|(storey, weight)| weight * share_of(modes, mode, storey).powi(2)).sum();
        modes.is_single(mode).then(|| -0.5 * self.frequencies[id.index()][mode] * (shape * shape + by_weight))
    }

    /// Derivative of a mode's natural frequency with respect to the stiffness of a storey of a shear building, Hz per
    /// N/m. `None` as for the mass.
    pub fn frequency_by_stiffness(&self, id: BuildingId, mode: usize, storey: usize) -> Option<f64> {
        let modes = self.system.structure.modes(id);
        let share = share_of(modes, mode, storey);
        modes.is_single(mode).then(|| 0.5 * self.frequencies[id.index()][mode] * share * share)
    }
}

/// The drift of a storey in the shape of a mode, over its frequency.
fn share_of(modes: &Modes, mode: usize, storey: usize) -> f64 {
    let below = if storey == 0 { 0.0 } else { modes.shape[(storey - 1, mode)] };
    (modes.shape[(storey, mode)] - below) / modes.omega[mode]
}
