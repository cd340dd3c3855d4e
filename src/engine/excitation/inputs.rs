//! The inputs of a master: the ground acceleration where there is no record, and forces on the floors.

use crate::engine::excitation::linear_input::LinearInput;
use crate::structure::Side;
use serde::{Deserialize, Serialize};

/// The inputs of a master, each constant or linear in time until it is set again.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct Inputs {
    /// Ground acceleration, m/s2; used where there is no record.
    pub ground_acceleration: LinearInput,
    /// Forces on the floors, N, positive to the right: left floors, then right floors; empty without floor forces.
    pub floor_forces: Vec<LinearInput>,
    /// Number of floors of the left building.
    pub left_floors: usize,
}

impl Inputs {
    /// Index of a floor's force.
    pub fn place(&self, side: Side, floor: usize) -> usize {
        if side == Side::Left { floor } else { self.left_floors + floor }
    }
}
