//! Bodies: floors whose modes are solved together. Each building is a body by itself.

use super::modes::{ModalDamping, Modes};
use crate::scene::Side;
use nalgebra::DMatrix;
use std::ops::Range;

/// Floors whose modes are solved together.
#[derive(Clone, Debug)]
pub struct Body {
    /// The modes; rows of the shapes are the floors, building by building.
    pub modes: Modes,
    /// Its modes in a modal vector.
    pub range: Range<usize>,
    /// Its floors in a vector of all floors.
    pub lanes: Range<usize>,
    /// Its buildings.
    pub buildings: Vec<Part>,
}

/// A building in its body.
#[derive(Clone, Debug)]
pub struct Part {
    pub side: Side,
    /// Its floors among those of the body.
    pub floors: Range<usize>,
}

impl Body {
    /// Off-diagonal damping between its modes, 1/s, where there is any.
    pub(super) fn coupling(&self) -> Option<DMatrix<f64>> {
        match &self.modes.damping {
            ModalDamping::Diagonal(_) => None,
            ModalDamping::Coupled(c) => {
                let mut coupling = c.clone();
                coupling.fill_diagonal(0.0);
                Some(coupling)
            }
        }
    }

    /// Whether damping couples its modes.
    pub fn is_coupled(&self) -> bool {
        matches!(self.modes.damping, ModalDamping::Coupled(_))
    }

    /// The building to which one of its floors belongs, and its number there.
    pub fn floor(&self, row: usize) -> Option<(Side, usize)> {
        let part = self.buildings.iter().find(|part| part.floors.contains(&row))?;
        Some((part.side, row - part.floors.start))
    }

    /// The row of a floor of one of its buildings.
    pub fn row(&self, side: Side, floor: usize) -> usize {
        self.buildings.iter().find(|part| part.side == side).map_or(0, |part| part.floors.start) + floor
    }

    /// The drifts of the storeys below all floors over the modes: the row of a floor less that of the one below it.
    pub fn drift(&self, row: usize, mode: usize) -> f64 {
        let shape = &self.modes.shape;
        match self.buildings.iter().any(|part| part.floors.start == row) {
            true => shape[(row, mode)],
            false => shape[(row, mode)] - shape[(row - 1, mode)],
        }
    }
}
