//! Which displacement of a building is meant, and how much of it counts.

use super::building_id::BuildingId;

/// A displacement of a building: of one of its floors, or of its foundation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Place {
    /// Of a floor, counted from 0.
    Floor(usize),
    /// Of the foundation, to the right.
    Foundation,
    /// The rotation of the foundation.
    Rotation,
}

/// How much a displacement of a building moves one side of a contact or a link, or the distance of both sides: its
/// weight in a row.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Share {
    /// Whose displacement.
    pub building: BuildingId,
    /// That of a floor, but where a building on soil has columns that are hit, or a link holds its foundation.
    pub place: Place,
    /// Positive on the left, negative on the right.
    pub weight: f64,
}

impl Place {
    /// The floor, counted from 0, if it is one.
    pub const fn floor(self) -> Option<usize> {
        match self {
            Place::Floor(floor) => Some(floor),
            Place::Foundation | Place::Rotation => None,
        }
    }
}
