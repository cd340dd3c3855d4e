//! Largest inter-storey drifts so far, at the engine's own steps.

use super::Side;
use super::model::Model;
use super::state::{Base, State};
use crate::structure::{LANES, Structure};
use nalgebra::DMatrix;

/// Drifts of all storeys from modal displacements: [`LANES`] storeys at a time, mode by mode.
#[derive(Debug)]
pub(super) struct DriftShapes {
    /// For each building.
    shapes: [Vec<[f64; LANES]>; 2],
    /// Storeys of each building, padded to a multiple of [`LANES`].
    storeys: [usize; 2],
}

impl DriftShapes {
    pub fn of(structure: &Structure) -> DriftShapes {
        let shapes = [Side::Left, Side::Right].map(|side| &structure.modes(side).shape);
        DriftShapes {
            storeys: shapes.map(|shape| shape.nrows().next_multiple_of(LANES)),
            shapes: shapes.map(blocks_of_storeys),
        }
    }

    /// Room for the largest drifts of all storeys.
    pub fn peaks(&self) -> Vec<f64> {
        vec![0.0; self.storeys[0] + self.storeys[1]]
    }
}

fn blocks_of_storeys(shape: &DMatrix<f64>) -> Vec<[f64; LANES]> {
    let drift = |storey: usize, mode: usize| match storey {
        _ if storey >= shape.nrows() => 0.0,
        0 => shape[(0, mode)],
        _ => shape[(storey, mode)] - shape[(storey - 1, mode)],
    };
    let blocks = (0..shape.nrows()).step_by(LANES);
    blocks
        .flat_map(|first| (0..shape.ncols()).map(move |mode| std::array::from_fn(|i| drift(first + i, mode))))
        .collect()
}

impl Model {
    /// Raises the peak drifts to those of the base.
    pub(super) fn update_peak_drift(&self, base: &mut Base) {
        let mut peaks = base.peak_drift.as_chunks_mut::<LANES>().0.iter_mut();
        for side in [Side::Left, Side::Right] {
            let modes = self.floors(side);
            let q = &base.q[self.structure.offset(side)..][..modes];
            for (block, peak) in self.drift.shapes[side as usize].chunks_exact(modes).zip(&mut peaks) {
                let mut drift = [0.0; LANES];
                for (shape, q) in block.iter().zip(q) {
                    for i in 0..LANES {
                        drift[i] += shape[i] * q;
                    }
                }
                for i in 0..LANES {
                    peak[i] = peak[i].max(drift[i].abs());
                }
            }
        }
    }

    /// m, largest drift of the storey below the floor so far, at the engine's own steps.
    pub fn peak_drift(&self, state: &State, side: Side, floor: usize) -> f64 {
        let first = match side {
            Side::Left => 0,
            Side::Right => self.drift.storeys[0],
        };
        state.base.peak_drift[first + floor]
    }
}
