//! The buildings of a scene as a row, and where in its file something stands.

use super::building_id::BuildingId;
use super::data::{Building, Scene};
use super::facing::Facing;

impl Scene {
    /// Which buildings there are, from left to right.
    pub fn ids(&self) -> impl DoubleEndedIterator<Item = BuildingId> + Clone + use<> {
        BuildingId::row_of(self.buildings.len())
    }

    /// Whether the file has the buildings as `[[building]]`, not as `[left]` and `[right]`.
    pub fn is_row(&self) -> bool {
        self.buildings.first().is_some_and(|building| building.path.starts_with("building"))
    }

    /// Each building with the next one, from left to right.
    pub fn neighbours(&self) -> impl Iterator<Item = [BuildingId; 2]> + use<> {
        self.ids().zip(self.ids().skip(1)).map(|(left, right)| [left, right])
    }

    /// One of the buildings.
    pub fn building(&self, id: BuildingId) -> &Building {
        &self.buildings[id.index()]
    }

    /// The same, to be changed.
    pub fn building_mut(&mut self, id: BuildingId) -> &mut Building {
        &mut self.buildings[id.index()]
    }

    /// Where in the file something stands that has a path in the scene. What is wrong with a contact that `[facing]` has made
    /// is wrong with that; contacts of the file are counted without those.
    pub fn path_in_file(&self, path: &str) -> String {
        let in_contact = || {
            let (number, rest) = path.strip_prefix("contact[")?.split_once(']')?;
            Some((self.facing?, number.parse::<usize>().ok()?.checked_sub(1)?, rest))
        };
        match in_contact() {
            None => path.to_owned(),
            Some((facing, index, rest)) if index >= facing.contacts => {
                format!("contact[{}]{rest}", index + 1 - facing.contacts)
            }
            Some((Facing { has_gaps: true, .. }, index, ".gap")) => {
                let left = self.contacts.get(index).and_then(|pair| pair.left.building());
                format!("facing.gap[{}]", left.map_or(1, |left| left.index() + 1))
            }
            Some((.., rest)) => format!("facing{rest}"),
        }
    }
}
