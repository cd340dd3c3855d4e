//! Levels of the floors, where buildings have heights: what meets by the scene and is not at one level.

use super::facts::Facts;
use super::found::Found;
use crate::figures::six_decimals;
use crate::scene::{ContactPair, Face, Heights, LEVEL_ROUNDING, LEVEL_TOLERANCE, Scene, Side};

/// Storeys beyond are in another unit, m.
const HIGHEST_STOREY: f64 = 30.0;

pub(super) fn look(facts: &Facts<'_>, found: &mut Found) {
    for side in [Side::Left, Side::Right] {
        look_at_heights(facts.scene, side, found);
    }
    if [Side::Left, Side::Right].iter().any(|side| found.has(&format!("{side}.height"))) {
        return;
    }
    if facts.scene.facing.is_some() {
        look_for_buried_floors(facts.scene, found);
    }
    let tolerance = facts.scene.facing.unwrap_or(LEVEL_TOLERANCE);
    for (index, pair) in facts.scene.contacts.iter().enumerate() {
        look_at_pair(facts.scene, (index, pair), tolerance, found);
    }
}

fn look_at_heights(scene: &Scene, side: Side, found: &mut Found) {
    let Some(heights) = &scene.building(side).heights else { return };
    if let Some((index, height)) = (1..).zip(&heights.storeys).find(|(_, height)| **height > HIGHEST_STOREY) {
        let meant = if *height >= 1000.0 { ("mm", height / 1e3) } else { ("cm", height / 1e2) };
        let text = format!(
            "storeys are 2 to 6 m high; heights are in m, was it given in {} ({} m)?",
            meant.0,
            six_decimals(meant.1)
        );
        found.number(format!("{side}.height[{index}]"), *height, text);
    }
}

/// Floors that `[facing]` leaves out, since the other building does not go down to them.
fn look_for_buried_floors(scene: &Scene, found: &mut Found) {
    let [Some(left), Some(right)] = [&scene.left.heights, &scene.right.heights] else { return };
    for (side, own, other) in [(Side::Left, left, right), (Side::Right, right, left)] {
        let base = other.base_level;
        let is_met = |floor: usize| scene.contacts.iter().any(|pair| has_floor(pair, side, floor));
        let buried =
            (1..=own.storeys.len()).find(|floor| own.level(*floor) <= base + LEVEL_ROUNDING && !is_met(*floor));
        if let Some(floor) = buried {
            let text = format!(
                "{side} floor {floor}, at {} m, is not above the ground floor of the other building, at {} m, and meets \
                 nothing; what stands before it there may need a contact with a wall",
                six_decimals(own.level(floor)),
                six_decimals(base)
            );
            found.number(format!("{}.base_level", side.opposite()), base, text);
        }
    }
}

fn has_floor(pair: &ContactPair, side: Side, floor: usize) -> bool {
    [pair.left, pair.right].contains(&Face::Floor(side, floor))
}

/// A pair whose faces are not at one level.
fn look_at_pair(scene: &Scene, (index, pair): (usize, &ContactPair), tolerance: f64, found: &mut Found) {
    let heights = |side: Side| scene.building(side).heights.as_ref();
    let path = |key: &str| format!("contact[{}].{key}", index + 1);
    match (pair.left, pair.right) {
        (Face::Floor(Side::Left, left), Face::Floor(Side::Right, right)) => {
            let (Some(of_left), Some(of_right)) = (heights(Side::Left), heights(Side::Right)) else { return };
            let levels = [of_left.level(left), of_right.level(right)];
            if (levels[0] - levels[1]).abs() <= tolerance + LEVEL_ROUNDING {
                return;
            }
            let text = format!(
                "level {} m, meets left floor {left} at {} m, where it is not; {}",
                six_decimals(levels[1]),
                six_decimals(levels[0]),
                meant(of_right, levels[0])
            );
            found.add(path("right_floor"), right.to_string(), text);
        }
        (Face::Floor(side, floor), columns @ Face::Columns { .. })
        | (columns @ Face::Columns { .. }, Face::Floor(side, floor)) => {
            let Face::Columns { side: struck, storey, position, .. } = columns else { return };
            let (Some(own), Some(other)) = (heights(struck), heights(side)) else { return };
            let (level, hit) = (other.level(floor), own.level(storey - 1) + position * own.storeys[storey - 1]);
            if (level - hit).abs() > tolerance {
                let text = format!(
                    "there the columns of {struck} storey {storey} are at {} m, and {side} floor {floor} is at {} m; {}",
                    six_decimals(hit),
                    six_decimals(level),
                    meant(own, level)
                );
                found.number(path(&format!("{struck}_position")), position, text);
            }
        }
        _ => {}
    }
}

/// What of a building is at a level.
fn meant(heights: &Heights, level: f64) -> String {
    let floor = heights.nearest_floor(level).filter(|(_, apart)| *apart <= LEVEL_TOLERANCE);
    match (floor, heights.storey_at(level)) {
        (Some((floor, _)), _) => format!("was floor {floor} meant?"),
        (None, Some((storey, position))) => {
            format!("was storey {storey} meant, whose columns it hits at {}?", six_decimals(position))
        }
        (None, None) => "no floor and no storey is there".to_owned(),
    }
}
