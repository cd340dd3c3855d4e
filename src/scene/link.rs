//! A device between two floors, or between a floor and the ground.

use super::building_id::BuildingId;
use super::place::{Place, Share};

/// A link as a scene has it: a spring and a dashpot side by side. Its ends are floors or foundations. A scene's file has
/// something in each; set to 0 later, as by a parameter of the FMU, there is no device.
#[derive(Clone, Debug, PartialEq)]
pub struct Link {
    /// Where it is held on the building on its left; `None`: on the ground.
    pub left: Option<(BuildingId, Place)>,
    /// Where it is held on the building on its right; `None`: on the ground.
    pub right: Option<(BuildingId, Place)>,
    /// N/m.
    pub stiffness: f64,
    /// N s/m.
    pub dashpot: f64,
    /// Where the spring slips.
    pub slip: Option<Slip>,
}

/// A spring that slips.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slip {
    /// N, at which it does.
    pub force: f64,
    /// Stiffness while it does over that before.
    pub ratio: f64,
}

impl Link {
    /// Its ends on buildings, with their weights in e = u_left - u_right, which is positive when the ends have come
    /// nearer.
    pub fn ends(&self) -> impl Iterator<Item = Share> + Clone + use<> {
        let left = self.left.map(|(building, place)| Share { building, place, weight: 1.0 });
        left.into_iter().chain(self.right.map(|(building, place)| Share { building, place, weight: -1.0 }))
    }

    /// Whether one of its ends is on a building.
    pub fn is_with(&self, id: BuildingId) -> bool {
        self.ends().any(|end| end.building == id)
    }

    /// Whether it is between two buildings.
    pub fn joins_buildings(&self) -> bool {
        self.left.is_some() && self.right.is_some()
    }
}
