//! `[facing]`: the contacts of all neighbours by the levels of their floors.

use super::building_id::BuildingId;
use super::contact_pair::{ColumnShape, ContactPair, Face};
use super::levels::{Heights, ROUNDING};
use super::side::Side;
use crate::contact::ImpactLaw;

/// What `[facing]` has made of a scene.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Facing {
    /// m, by which floors that meet may differ in level.
    pub level_tolerance: f64,
    /// How many of the scene's contacts, from the first on, are made by it; further ones are with walls.
    pub contacts: usize,
    /// Whether the file has a list with one gap for each pair of neighbours.
    pub has_gaps: bool,
}

/// The keys of `[facing]`: what all contacts of two neighbours have.
pub(super) struct FacingKeys {
    /// m, by which floors that meet may differ in level.
    pub level_tolerance: f64,
    pub column_shape: ColumnShape,
    pub law: ImpactLaw,
}

/// What a floor faces.
struct Faced {
    face: Face,
    /// m, the lower one of both levels.
    level: f64,
}

impl FacingKeys {
    /// One contact for every floor of either building that faces the other one: with a floor whose level differs by no
    /// more than the tolerance, else with the columns of the storey that it stands before. Floors above the other
    /// building's roof, or not above its ground floor, face nothing. From the lowest level up.
    pub(super) fn contacts(&self, [left, right]: [(BuildingId, &Heights); 2], gap: f64) -> Vec<ContactPair> {
        let mut faces: Vec<(f64, [Face; 2])> = Vec::new();
        for (side, (id, own), other) in [(Side::Left, left, right), (Side::Right, right, left)] {
            for floor in 1..=own.storeys.len() {
                let Some(opposite) = self.opposite(own.level(floor), other) else { continue };
                let floor = Face::Floor(id, floor);
                let pair = match side {
                    Side::Left => [floor, opposite.face],
                    Side::Right => [opposite.face, floor],
                };
                if !faces.iter().any(|(_, known)| *known == pair) {
                    faces.push((opposite.level, pair));
                }
            }
        }
        faces.sort_by(|(one, _), (other, _)| one.total_cmp(other));
        faces.into_iter().map(|(_, faces)| ContactPair::new(faces, gap, self.law)).collect()
    }

    /// What of the other building a floor of that level faces.
    fn opposite(&self, level: f64, (building, other): (BuildingId, &Heights)) -> Option<Faced> {
        if let Some((floor, apart)) = other.nearest_floor(level)
            && apart <= self.level_tolerance + ROUNDING
        {
            return Some(Faced { face: Face::Floor(building, floor), level: level.min(other.level(floor)) });
        }
        let (storey, position) = other.storey_at(level)?;
        Some(Faced { face: Face::Columns { building, storey, position, shape: self.column_shape }, level })
    }
}
