//! Forces on floors as loads on the modes.

use super::bodies::Body;
use super::equations::Structure;
use crate::scene::{BuildingId, Place};

/// Number of floor forces that are projected on the modes at a time.
const AT_ONCE: usize = 8;

impl Structure {
    /// Adds the modal load of a force, N, on one floor.
    pub fn add_floor_force(&self, id: BuildingId, floor: usize, force: f64, load: &mut [f64]) {
        let body = self.body(id);
        let (Body { modes, range, .. }, row) = (body, body.row(id, floor));
        let shapes = self.floor_shapes.get(row * self.lanes..).and_then(|row| row.get(range.clone()));
        match shapes {
            Some(row) => add_multiple(row, force, &mut load[range.clone()]),
            None => {
                for (shape, load) in modes.shape.row(row).iter().zip(&mut load[range.clone()]) {
                    *load += shape * force;
                }
            }
        }
    }

    /// Adds the modal load of a force, N, or a moment, N m, on one displacement of a building, if it has that.
    pub fn add_force(&self, id: BuildingId, place: Place, force: f64, load: &mut [f64]) {
        match (place, self.body(id).row_of(id, place)) {
            (Place::Floor(floor), _) => self.add_floor_force(id, floor, force, load),
            (_, Some(row)) => {
                let Body { modes, range, .. } = self.body(id);
                for (shape, load) in modes.shape.row(row).iter().zip(&mut load[range.clone()]) {
                    *load += shape * force;
                }
            }
            (_, None) => {}
        }
    }

    /// Adds the modal load of forces, N, on some floors of a building: to the same bits as one after the other.
    pub fn add_floor_forces(&self, id: BuildingId, forces: impl Iterator<Item = (usize, f64)>, load: &mut [f64]) {
        let (range, first) = (self.body(id).range.clone(), self.body(id).row(id, 0));
        let (mut group, mut count) = ([(0, 0.0); AT_ONCE], 0);
        for force in forces {
            group[count] = force;
            count += 1;
            if count == AT_ONCE {
                match self.floor_shapes.is_empty() {
                    true => group.iter().for_each(|&(floor, force)| self.add_floor_force(id, floor, force, load)),
                    false => {
                        let rows = group.map(|(floor, force)| (first + floor, force));
                        add_multiples(&self.floor_shapes, (self.lanes, range.start), &rows, &mut load[range.clone()])
                    }
                }
                count = 0;
            }
        }
        group[..count].iter().for_each(|&(floor, force)| self.add_floor_force(id, floor, force, load));
    }

    /// Lays out the shapes floor by floor: for forces on all floors, which are projected on the modes again and again.
    pub fn prepare_floor_forces(&mut self) {
        let highest = self.bodies.iter().map(|body| body.modes.shape.nrows()).max();
        self.floor_shapes = vec![0.0; highest.unwrap_or(0) * self.lanes];
        for body in &self.bodies {
            for (floor, row) in body.modes.shape.row_iter().enumerate() {
                let out = &mut self.floor_shapes[floor * self.lanes..][body.range.clone()];
                out.iter_mut().zip(row.iter()).for_each(|(out, shape)| *out = *shape);
            }
        }
    }
}

/// `out` += the sum of some rows, which begin at `first` in each `width` numbers of `all`, times factors, in their order: so
/// many at a time, since `out` is read and written faster once than once for each.
#[multiversion::multiversion(targets("x86_64+avx2"))]
fn add_multiples(all: &[f64], (width, first): (usize, usize), group: &[(usize, f64); AT_ONCE], out: &mut [f64]) {
    // Equal lengths: no bounds checks below.
    let (count, mut rows) = (out.len(), [&[][..]; AT_ONCE]);
    for k in 0..AT_ONCE {
        rows[k] = &all[group[k].0 * width + first..][..count];
    }
    for (m, out) in out.iter_mut().enumerate() {
        let mut sum = *out;
        for k in 0..AT_ONCE {
            sum += rows[k][m] * group[k].1;
        }
        *out = sum;
    }
}

/// `out` += factor * row.
#[multiversion::multiversion(targets("x86_64+avx2"))]
fn add_multiple(row: &[f64], factor: f64, out: &mut [f64]) {
    for (out, row) in out.iter_mut().zip(row) {
        *out += row * factor;
    }
}
