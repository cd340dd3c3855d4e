//! Natural frequencies, and how they follow masses and stiffnesses.

use crate::engine::model::Model;
use crate::structure::Side;

impl Model {
    /// Hz, natural frequencies of one building alone, ascending.
    pub fn natural_frequencies(&self, side: Side) -> &[f64] {
        &self.frequencies[side as usize]
    }

    /// Hz per kg of a floor: how the natural frequency of a mode follows a mass. Modes and floors counted from 0.
    /// None where another mode has the same frequency to rounding, and with it the shape is not unique.
    pub fn frequency_by_mass(&self, side: Side, mode: usize, floor: usize) -> Option<f64> {
        let modes = self.system.structure.modes(side);
        let shape = modes.shape[(floor, mode)];
        modes.is_single(mode).then(|| -0.5 * self.frequencies[side as usize][mode] * shape * shape)
    }

    /// Hz per N/m of a storey of a shear building: how the natural frequency of a mode follows a stiffness.
    /// None as for the mass.
    pub fn frequency_by_stiffness(&self, side: Side, mode: usize, storey: usize) -> Option<f64> {
        let modes = self.system.structure.modes(side);
        let below = if storey == 0 { 0.0 } else { modes.shape[(storey - 1, mode)] };
        let share = (modes.shape[(storey, mode)] - below) / modes.omega[mode];
        modes.is_single(mode).then(|| 0.5 * self.frequencies[side as usize][mode] * share * share)
    }
}
