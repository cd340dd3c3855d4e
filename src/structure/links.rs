//! Links as rows over the floors: springs and dashpots between floors, or between a floor and the ground.
//!
//! The row is 1 at the floor on the left and -1 at the one on the right, so that e = row u is positive when the ends have
//! come nearer. Spring and dashpot push them apart with k e + c e'.

use super::bodies::Body;
use super::floors::Floors;
use crate::scene::Link;

/// A link of a scene in the coordinates of the structure.
#[derive(Clone, Debug)]
pub struct LinkRow {
    /// The number of its body.
    pub body: usize,
    /// Its row over the modes, kg^-1/2.
    pub row: Vec<f64>,
    /// The lanes of its floors with their weights.
    pub floors: Vec<(usize, f64)>,
    /// N/m.
    pub stiffness: f64,
    /// N s/m.
    pub dashpot: f64,
}

impl LinkRow {
    /// Of a link between floors of one of the bodies.
    pub(super) fn of(link: &Link, bodies: &[Body], floors: &Floors) -> LinkRow {
        let is_of = |body: &Body| link.ends().any(|(side, ..)| body.buildings.iter().any(|part| part.side == side));
        let number = bodies.iter().position(is_of).unwrap_or(0);
        let body = &bodies[number];
        let mut row = vec![0.0; floors.mass().len()];
        for (side, floor, weight) in link.ends() {
            let shapes = body.modes.shape.row(body.row(side, floor));
            row[body.range.clone()].iter_mut().zip(shapes.iter()).for_each(|(row, shape)| *row += weight * shape);
        }
        LinkRow {
            body: number,
            row,
            floors: link.ends().map(|(side, floor, weight)| (floors.lane(side as usize, floor), weight)).collect(),
            stiffness: link.stiffness,
            dashpot: link.dashpot,
        }
    }
}
