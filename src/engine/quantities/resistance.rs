//! Magnitudes of the coupling between floors by stiffness and damping, for bounds on accelerations.

use crate::structure::{ModalDamping, Side, Structure};
use nalgebra::DMatrix;
use std::ops::Range;

/// Magnitudes of the coupling between floors, for both buildings.
#[derive(Debug)]
pub(crate) struct FloorResistance {
    pub buildings: [Resistance; 2],
}

/// The coupling between the floors of one building.
#[derive(Debug)]
pub(crate) struct Resistance {
    /// |M^-1 K| and |M^-1 C|, entry by entry, where a floor is coupled to more than its neighbours.
    pub dense: Option<[DMatrix<f64>; 2]>,
    /// Largest row sums of |M^-1 K| and |M^-1 C|, 1/s2 and 1/s.
    pub most: [f64; 2],
    /// Column sums of K and C, N/m and N s/m: the base shear is their product with displacements and velocities.
    pub shear: [Vec<f64>; 2],
}

impl FloorResistance {
    /// For both buildings of a structure.
    pub(crate) fn of(structure: &Structure) -> FloorResistance {
        FloorResistance { buildings: [Side::Left, Side::Right].map(|side| Resistance::of(structure, side)) }
    }

    /// Writes the rows of the base shear over the displacements and the velocities of all floors; the building has the
    /// given `lanes` of them.
    pub(crate) fn set_shear_rows(&self, side: usize, lanes: Range<usize>, row: &mut [f64], row_v: &mut [f64]) {
        let [on_u, on_v] = &self.buildings[side].shear;
        row[lanes.clone()].copy_from_slice(on_u);
        row_v[lanes].copy_from_slice(on_v);
    }
}

impl Resistance {
    fn of(structure: &Structure, side: Side) -> Resistance {
        let modes = structure.modes(side);
        let (shape, n) = (&modes.shape, modes.omega.len());
        let mass = structure.floors.of_building(side as usize, structure.floors.mass());
        let stiffness = DMatrix::from_fn(n, n, |i, m| shape[(i, m)] * modes.omega[m] * modes.omega[m]);
        let damping = match &modes.damping {
            ModalDamping::Diagonal(c) => DMatrix::from_fn(n, n, |i, m| shape[(i, m)] * c[m]),
            ModalDamping::Coupled(c) => shape * c,
        };
        let [stiffness, damping] = [stiffness, damping].map(|of_modes| {
            let back = DMatrix::from_fn(n, n, |m, j| shape[(j, m)] * mass[j]);
            of_modes * back
        });
        let shear = [&stiffness, &damping]
            .map(|matrix| (0..n).map(|j| (0..n).map(|i| mass[i] * matrix[(i, j)]).sum()).collect());
        let sizes = [stiffness.abs(), damping.abs()];
        let most = sizes.each_ref().map(|matrix| matrix.column_sum().max());
        Resistance { dense: (!structure.floors.is_sparse()).then_some(sizes), most, shear }
    }
}
