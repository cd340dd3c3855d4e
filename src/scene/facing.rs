//! `[facing]`: the contacts of two buildings by the levels of their floors.

use super::contact_pair::{ColumnShape, ContactPair, Face};
use super::levels::{Heights, ROUNDING};
use super::side::Side;
use crate::contact::ImpactLaw;

/// One contact for every floor of either building that faces the other one: with a floor whose level differs by no more
/// than the tolerance, else with the columns of the storey that it stands before. Floors above the other building's roof,
/// or not above its ground floor, face nothing. From the lowest level up.
pub(super) fn contacts(
    heights: [&Heights; 2],
    (level_tolerance, shape): (f64, ColumnShape),
    gap: f64,
    law: ImpactLaw,
) -> Vec<ContactPair> {
    let mut faces: Vec<(f64, [Face; 2])> = Vec::new();
    for (side, own, other) in [(Side::Left, heights[0], heights[1]), (Side::Right, heights[1], heights[0])] {
        for floor in 1..=own.storeys.len() {
            let level = own.level(floor);
            let Some((opposite, lower)) = opposite((side.opposite(), other), level, (level_tolerance, shape)) else {
                continue;
            };
            let floor = Face::Floor(side, floor);
            let pair = match side {
                Side::Left => [floor, opposite],
                Side::Right => [opposite, floor],
            };
            if !faces.iter().any(|(_, known)| *known == pair) {
                faces.push((lower, pair));
            }
        }
    }
    faces.sort_by(|(one, _), (other, _)| one.total_cmp(other));
    faces.into_iter().map(|(_, [left, right])| ContactPair { left, right, gap, law }).collect()
}

/// What of a building a floor of that level faces, and the lower one of both levels.
fn opposite(
    (side, building): (Side, &Heights),
    level: f64,
    (tolerance, shape): (f64, ColumnShape),
) -> Option<(Face, f64)> {
    if let Some((floor, apart)) = building.nearest_floor(level)
        && apart <= tolerance + ROUNDING
    {
        return Some((Face::Floor(side, floor), level.min(building.level(floor))));
    }
    let (storey, position) = building.storey_at(level)?;
    Some((Face::Columns { side, storey, position, shape }, level))
}
