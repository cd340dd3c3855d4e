//! Links as rows over the floors: springs and dashpots between floors, or between a floor and the ground. The soil under a
//! foundation is a link of that kind as well, on the row of its sway or its rotation.
//!
//! The row is 1 at the floor on the left and -1 at the one on the right, so that e = row u is positive when the ends have
//! come nearer. Spring and dashpot push them apart with k e + c e'.

use super::bodies::Body;
use super::floors::Floors;
use crate::scene::Share;

/// A link of a scene, or what the soil resists one motion of a foundation with, in the coordinates of the structure.
#[derive(Clone, Debug)]
pub struct LinkRow {
    /// The number of its body.
    pub body: usize,
    /// Its row over the modes, kg^-1/2.
    pub row: Vec<f64>,
    /// The lanes of its floors with their weights.
    pub floors: Vec<(usize, f64)>,
    /// N/m; of soil that rocks, N m.
    pub stiffness: f64,
    /// N s/m; of soil that rocks, N m s.
    pub dashpot: f64,
}

impl LinkRow {
    /// Of a spring and a dashpot side by side between places of one of the bodies.
    pub(super) fn of(
        ends: impl Iterator<Item = Share> + Clone,
        (stiffness, dashpot): (f64, f64),
        bodies: &[Body],
        floors: &Floors,
    ) -> LinkRow {
        let is_of = |body: &Body| ends.clone().any(|end| body.has(end.building));
        let number = bodies.iter().position(is_of).unwrap_or(0);
        let body = &bodies[number];
        let mut row = vec![0.0; floors.mass().len()];
        for Share { building: id, place, weight } in ends.clone() {
            let Some(at) = body.row_of(id, place) else { continue };
            let shapes = body.modes.shape.row(at);
            row[body.range.clone()].iter_mut().zip(shapes.iter()).for_each(|(row, shape)| *row += weight * shape);
        }
        LinkRow {
            body: number,
            row,
            floors: ends.filter_map(|end| Some((floors.lane_of(end.building, end.place)?, end.weight))).collect(),
            stiffness,
            dashpot,
        }
    }
}
