//! What meets at a contact: a floor of one building with a floor or the columns of the other, or with a wall.

use super::building_id::BuildingId;
use super::side::Side;
use crate::contact::ImpactLaw;

/// Two faces with a gap between them.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct ContactPair {
    /// What is on the left of the gap.
    pub left: Face,
    /// What is on the right of the gap.
    pub right: Face,
    /// m, clear distance at rest; may be 0 or negative.
    pub gap: f64,
    /// Force of the contact.
    pub law: ImpactLaw,
    /// At a wall, whose key the one floor has in the file, `left_floor` or `right_floor`: the wall may be on either side.
    pub floor_key: Option<Side>,
}

/// One side of a contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Face {
    /// The edge of a floor, counted from 1.
    Floor(BuildingId, usize),
    /// The columns of a storey, counted from 1, between two floors.
    Columns {
        /// Whose columns.
        building: BuildingId,
        /// Storey `i` is below floor `i`.
        storey: usize,
        /// Where they are hit, as a share of the storey's height from its lower end: 0 < s < 1.
        position: f64,
        /// How they bend.
        shape: ColumnShape,
    },
    /// A rigid wall, which moves with the ground.
    Wall,
}

/// Deflection of columns between their floors: N(s) is the share of the upper floor's displacement in that of the
/// columns at the height s, 1 - N that of the lower floor's.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum ColumnShape {
    /// Ends that do not rotate, N(s) = 3 s^2 - 2 s^3: the cubic of Hermite, as for a beam between two rigid floors.
    #[default]
    Fixed,
    /// Hinged ends, N(s) = s.
    Straight,
}

impl ColumnShape {
    /// All that there are.
    pub const ALL: [ColumnShape; 2] = [ColumnShape::Fixed, ColumnShape::Straight];

    /// As scenes write it.
    pub const fn name(self) -> &'static str {
        match self {
            ColumnShape::Fixed => "fixed",
            ColumnShape::Straight => "straight",
        }
    }

    /// N(s): the share of the upper floor.
    pub fn share_of_upper_floor(self, s: f64) -> f64 {
        match self {
            ColumnShape::Fixed => s * s * (3.0 - 2.0 * s),
            ColumnShape::Straight => s,
        }
    }
}

impl Face {
    /// The building, if it belongs to one.
    pub const fn building(&self) -> Option<BuildingId> {
        match self {
            Face::Floor(id, _) | Face::Columns { building: id, .. } => Some(*id),
            Face::Wall => None,
        }
    }
}

impl ContactPair {
    /// Of two faces, the one on the left of the gap first.
    pub const fn new([left, right]: [Face; 2], gap: f64, law: ImpactLaw) -> ContactPair {
        ContactPair { left, right, gap, law, floor_key: None }
    }

    /// What is on a side of the gap.
    pub const fn face(&self, side: Side) -> Face {
        match side {
            Side::Left => self.left,
            Side::Right => self.right,
        }
    }

    /// Whose keys a scene has for what is on a side of the gap: those of that side, but at a wall.
    pub fn key_side(&self, side: Side) -> Side {
        self.floor_key.unwrap_or(side)
    }

    /// Where columns are hit, if they are.
    pub const fn position(&self) -> Option<f64> {
        match (self.left, self.right) {
            (Face::Columns { position, .. }, _) | (_, Face::Columns { position, .. }) => Some(position),
            _ => None,
        }
    }

    /// Whose columns of which storey, counted from 1, are hit, if any are.
    pub const fn columns(&self) -> Option<(BuildingId, usize)> {
        match (self.left, self.right) {
            (Face::Columns { building: id, storey, .. }, _) | (_, Face::Columns { building: id, storey, .. }) => {
                Some((id, storey))
            }
            _ => None,
        }
    }

    /// Whether a building takes part.
    pub fn is_with(&self, id: BuildingId) -> bool {
        self.left.building() == Some(id) || self.right.building() == Some(id)
    }

    /// Both floors, counted from 1, where a floor meets a floor.
    pub const fn floors(&self) -> Option<[usize; 2]> {
        match (self.left, self.right) {
            (Face::Floor(_, left), Face::Floor(_, right)) => Some([left, right]),
            _ => None,
        }
    }
}
