//! The row of a contact: by how much displacements of buildings close its gap.

use super::building_id::BuildingId;
use super::contact_pair::{ContactPair, Face};
use super::data::Scene;
use super::place::{Place, Share};
use super::places::Places;

impl Face {
    /// What moves it. The weights of floors and foundation are positive and add up to 1 together with that of the ground;
    /// columns that are bent to N(s) of their drift have turned by s as they lean with their foundation.
    fn shares(self, scene: &Scene) -> Vec<Share> {
        let Some(id) = self.building() else { return Vec::new() };
        let places = Places::of(scene.building(id));
        let place = |floor: usize| floor.checked_sub(1).map_or(Place::Foundation, Place::Floor);
        let shares: Vec<(Place, f64)> = match self {
            Face::Wall => Vec::new(),
            Face::Floor(_, floor) => vec![(place(floor), 1.0)],
            Face::Columns { storey, position, shape, .. } => {
                let upper = shape.share_of_upper_floor(position);
                let height = storey.checked_sub(1).and_then(|storey| places.tilt(storey));
                let tilt = height.map(|height| (Place::Rotation, (position - upper) * height));
                let ends = [(place(storey.saturating_sub(1)), 1.0 - upper), (place(storey), upper)];
                ends.into_iter().chain(tilt).collect()
            }
        };
        // What does not move, such as the ground below columns, has no share.
        let moves = |(place, _): &(Place, f64)| places.number(*place).is_some();
        shares.into_iter().filter(moves).map(|(place, weight)| Share { building: id, place, weight }).collect()
    }
}

impl ContactPair {
    /// The row of the contact in its scene: its penetration is the sum of the weights times the displacements, less the gap.
    /// A contact force pushes each floor with its weight of it, against the weight's sign.
    pub fn row(&self, scene: &Scene) -> impl Iterator<Item = Share> {
        let right = self.right.shares(scene).into_iter().map(|share| Share { weight: -share.weight, ..share });
        self.left.shares(scene).into_iter().chain(right)
    }

    /// Whether the ground takes part: as a wall, or as the lower end of the columns of a first storey.
    pub fn has_ground(&self, scene: &Scene) -> bool {
        let sways = |id: BuildingId| scene.building(id).inertia(Place::Foundation).is_finite();
        let is_of_ground = |face: &Face| match face {
            Face::Columns { building: id, storey: 1, .. } => !sways(*id),
            face => matches!(face, Face::Wall),
        };
        is_of_ground(&self.left) || is_of_ground(&self.right)
    }
}
