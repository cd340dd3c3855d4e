//! Which displacement of a building is meant.

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

impl Place {
    /// The floor, counted from 0, if it is one.
    pub const fn floor(self) -> Option<usize> {
        match self {
            Place::Floor(floor) => Some(floor),
            Place::Foundation | Place::Rotation => None,
        }
    }
}
