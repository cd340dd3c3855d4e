//! Magnitudes of the coupling between floors by stiffness and damping, for bounds on accelerations.

use crate::structure::{Body, BuildingId, ModalDamping, Structure};
use nalgebra::DMatrix;
use std::ops::Range;

/// Magnitudes of the coupling between floors.
#[derive(Debug)]
pub(crate) struct FloorResistance {
    /// Of each body.
    pub bodies: Vec<Resistance>,
    /// Column sums of K and C of each building, N/m and N s/m: the base shear is their product with displacements and
    /// velocities.
    shear: Vec<[Vec<f64>; 2]>,
}

/// The coupling between the floors of one body.
#[derive(Debug)]
pub(crate) struct Resistance {
    /// |M^-1 K| and |M^-1 C|, entry by entry, where a floor is coupled to more than its neighbours.
    pub dense: Option<[DMatrix<f64>; 2]>,
    /// Largest row sums of |M^-1 K| and |M^-1 C|, 1/s2 and 1/s.
    pub most: [f64; 2],
}

impl FloorResistance {
    /// For all bodies of a structure.
    pub(crate) fn of(structure: &Structure) -> FloorResistance {
        let mut of_structure =
            FloorResistance { bodies: Vec::new(), shear: vec![Default::default(); structure.ids().count()] };
        for body in &structure.bodies {
            let matrices = matrices(structure, body);
            for part in &body.buildings {
                of_structure.shear[part.building.index()] = match structure.shear_rows_of_floors(part.building) {
                    Some(rows) => rows.clone(),
                    None => shears(structure, body, &matrices),
                };
            }
            of_structure.bodies.push(Resistance::of(structure, &matrices));
        }
        of_structure
    }

    /// The rows of the base shear over the displacements and the velocities of the floors of one building.
    pub(crate) fn shear(&self, id: BuildingId) -> &[Vec<f64>; 2] {
        &self.shear[id.index()]
    }

    /// Writes the rows of the base shear over the displacements and the velocities of all floors; the building has the
    /// given `lanes` of them.
    pub(crate) fn set_shear_rows(&self, id: BuildingId, lanes: Range<usize>, row: &mut [f64], row_v: &mut [f64]) {
        let [on_u, on_v] = self.shear(id);
        row[lanes.clone()].copy_from_slice(on_u);
        row_v[lanes].copy_from_slice(on_v);
    }
}

impl Resistance {
    fn of(structure: &Structure, matrices: &[DMatrix<f64>; 2]) -> Resistance {
        let sizes = matrices.each_ref().map(|matrix| matrix.abs());
        let most = sizes.each_ref().map(|matrix| matrix.column_sum().max());
        Resistance { dense: (!structure.floors.is_sparse()).then_some(sizes), most }
    }
}

/// M^-1 K and M^-1 C of a body.
fn matrices(structure: &Structure, body: &Body) -> [DMatrix<f64>; 2] {
    let modes = &body.modes;
    let (shape, n) = (&modes.shape, modes.omega.len());
    let mass = &structure.floors.mass()[body.lanes.clone()];
    let stiffness = DMatrix::from_fn(n, n, |i, m| shape[(i, m)] * modes.omega[m] * modes.omega[m]);
    let damping = match &modes.damping {
        ModalDamping::Diagonal(c) => DMatrix::from_fn(n, n, |i, m| shape[(i, m)] * c[m]),
        ModalDamping::Coupled(c) => shape * c,
    };
    [stiffness, damping].map(|of_modes| {
        let back = DMatrix::from_fn(n, n, |m, j| shape[(j, m)] * mass[j]);
        of_modes * back
    })
}

/// Column sums of K and C of a building that is a body, from those over the masses.
fn shears(structure: &Structure, body: &Body, matrices: &[DMatrix<f64>; 2]) -> [Vec<f64>; 2] {
    let (mass, n) = (&structure.floors.mass()[body.lanes.clone()], body.lanes.len());
    matrices.each_ref().map(|matrix| (0..n).map(|j| (0..n).map(|i| mass[i] * matrix[(i, j)]).sum()).collect())
}
