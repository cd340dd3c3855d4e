//! What a master sets: the ground acceleration where there is no record, and forces on the floors.

use crate::engine::excitation::linear_input::LinearInput;
use crate::structure::Side;
use serde::{Deserialize, Serialize};

/// What a master sets, held or linear until it sets it again.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct Inputs {
    /// m/s2, where there is no record.
    pub ground_acceleration: LinearInput,
    /// N, left floors then right floors; empty without floor forces.
    pub floor_forces: Vec<LinearInput>,
    pub left_floors: usize,
}

impl Inputs {
    /// Where the force of a floor is.
    pub fn place(&self, side: Side, floor: usize) -> usize {
        if side == Side::Left { floor } else { self.left_floors + floor }
    }
}
