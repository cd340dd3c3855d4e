//! Levels of the floors, where buildings have heights: what meets by the scene and is not at one level.

use super::facts::Facts;
use super::found::Found;
use super::order::{self, HIGHEST_STOREY};
use crate::figures::six_decimals;
use crate::scene::{Building, BuildingId, ContactPair, Face, Heights, LEVEL_ROUNDING, LEVEL_TOLERANCE, Scene, Side};

pub(super) fn look(facts: &Facts<'_>, found: &mut Found) {
    for building in &facts.scene.buildings {
        order::look_at_heights(building, found);
        look_at_unit_of_heights(building, found);
    }
    if facts.scene.buildings.iter().any(|building| found.has(&format!("{}.height", building.path))) {
        return;
    }
    if let Some(tolerance) = facts.scene.facing.map(|facing| facing.level_tolerance) {
        look_at_tolerance(facts.scene, tolerance, found);
        for [left, right] in facts.scene.neighbours() {
            match facts.scene.contacts.iter().any(|pair| pair.is_with(left) && pair.is_with(right)) {
                false => look_for_what_faces_nothing(facts.scene, [left, right], found),
                true => look_for_buried_floors(facts.scene, [left, right], found),
            }
        }
    }
    let tolerance = facts.scene.facing.map_or(LEVEL_TOLERANCE, |facing| facing.level_tolerance);
    for (index, pair) in facts.scene.contacts.iter().enumerate() {
        look_at_pair(facts.scene, index, pair, tolerance, found);
    }
}

fn look_at_unit_of_heights(Building { path, heights, .. }: &Building, found: &mut Found) {
    let known = found.has(&format!("{path}.height"));
    let Some(heights) = heights.as_ref().filter(|_| !known) else { return };
    if let Some((index, height)) = (1..).zip(&heights.storeys).find(|(_, height)| **height > HIGHEST_STOREY) {
        let meant = if *height >= 1000.0 { ("mm", height / 1e3) } else { ("cm", height / 1e2) };
        let text = format!(
            "storeys are 2 to 6 m high; heights are in m, was it given in {} ({} m)?",
            meant.0,
            six_decimals(meant.1)
        );
        found.number(format!("{path}.height[{index}]"), *height, text);
    }
}

/// A tolerance that takes any floor for level with another one.
fn look_at_tolerance(scene: &Scene, tolerance: f64, found: &mut Found) {
    let storeys = scene.buildings.iter().filter_map(|building| building.heights.as_ref());
    let lowest = storeys.flat_map(|heights| &heights.storeys).copied().reduce(f64::min);
    if let Some(height) = lowest.filter(|height| tolerance > LEVEL_TOLERANCE.max(0.5 * height)) {
        let text = format!(
            "more than half of a storey of {} m: floors meet floors however far from level, and no columns; it is in m, was \
             it given in cm or mm?",
            six_decimals(height)
        );
        found.number("facing.level_tolerance", tolerance, text);
    }
}

/// Buildings of which one begins above the roof of the other: `[facing]` finds no contact.
fn look_for_what_faces_nothing(scene: &Scene, pair: [BuildingId; 2], found: &mut Found) {
    let buildings = pair.map(|id| scene.building(id));
    let [Some(left), Some(right)] = buildings.map(|building| building.heights.as_ref()) else { return };
    let roof = |heights: &Heights| heights.level(heights.storeys.len());
    let is_left = left.base_level.abs() > right.base_level.abs();
    let (own, other) = if is_left { (left, right) } else { (right, left) };
    let building = buildings[usize::from(!is_left)];
    let meets = |base: f64| base < roof(other) && base + roof(own) - own.base_level > other.base_level;
    let base = own.base_level;
    let in_unit = |unit: &str, factor: f64| {
        format!(
            "is it from the zero of the other level, or was it given in {unit} ({} m)?",
            six_decimals(base * factor)
        )
    };
    let meant = match base.abs() {
        _ if meets(-base) => format!("is its sign right, was {} m meant?", six_decimals(-base)),
        500.0.. if meets(base / 1e3) => in_unit("mm", 1e-3),
        100.0.. if meets(base / 1e2) => in_unit("cm", 1e-2),
        _ => "are both levels from the same zero?".to_owned(),
    };
    let text = format!(
        "{} goes from {} m to {} m and the other one from {} m to {} m: no floor faces anything, so there \
         is no contact and they pass through each other; {meant}",
        building.called(),
        six_decimals(own.base_level),
        six_decimals(roof(own)),
        six_decimals(other.base_level),
        six_decimals(roof(other))
    );
    found.number(format!("{}.base_level", building.path), own.base_level, text);
}

/// Floors that `[facing]` leaves out, since the other building does not go down to them.
fn look_for_buried_floors(scene: &Scene, [left, right]: [BuildingId; 2], found: &mut Found) {
    for (id, beside) in [(left, right), (right, left)] {
        let [Building { name, heights: Some(own), .. }, Building { path: path_beside, heights: Some(other), .. }] =
            [id, beside].map(|id| scene.building(id))
        else {
            return;
        };
        let base = other.base_level;
        let has = |pair: &ContactPair, floor: usize| [pair.left, pair.right].contains(&Face::Floor(id, floor));
        let is_met = |floor: usize| scene.contacts.iter().any(|pair| has(pair, floor));
        let buried =
            (1..=own.storeys.len()).find(|floor| own.level(*floor) <= base + LEVEL_ROUNDING && !is_met(*floor));
        if let Some(floor) = buried {
            let text = format!(
                "{name} floor {floor}, at {} m, is not above the ground floor of the other building, at {} m, and meets \
                 nothing; what stands before it there may need a contact with a wall",
                six_decimals(own.level(floor)),
                six_decimals(base)
            );
            found.number(format!("{path_beside}.base_level"), base, text);
        }
    }
}

/// A pair whose faces are not at one level.
fn look_at_pair(scene: &Scene, index: usize, pair: &ContactPair, tolerance: f64, found: &mut Found) {
    let heights = |id: BuildingId| scene.building(id).heights.as_ref();
    let path = |key: &str| format!("contact[{}].{key}", index + 1);
    let name = |id: BuildingId| &scene.building(id).name;
    match (pair.left, pair.right) {
        (Face::Floor(on_left, left), Face::Floor(on_right, right)) => {
            let (Some(of_left), Some(of_right)) = (heights(on_left), heights(on_right)) else { return };
            let levels = [of_left.level(left), of_right.level(right)];
            if (levels[0] - levels[1]).abs() <= tolerance + LEVEL_ROUNDING {
                return;
            }
            let text = format!(
                "level {} m, meets {} floor {left} at {} m, where it is not; {}",
                six_decimals(levels[1]),
                name(on_left),
                six_decimals(levels[0]),
                meant(of_right, levels[0])
            );
            found.add(path("right_floor"), right.to_string(), text);
        }
        (Face::Floor(id, floor), columns @ Face::Columns { .. })
        | (columns @ Face::Columns { .. }, Face::Floor(id, floor)) => {
            let Face::Columns { building: struck, storey, position, .. } = columns else { return };
            let (Some(own), Some(other)) = (heights(struck), heights(id)) else { return };
            let (level, hit) = (other.level(floor), own.level(storey - 1) + position * own.storeys[storey - 1]);
            if (level - hit).abs() > tolerance {
                let text = format!(
                    "there the columns of {} storey {storey} are at {} m, and {} floor {floor} is at {} m; {}",
                    name(struck),
                    six_decimals(hit),
                    name(id),
                    six_decimals(level),
                    meant(own, level)
                );
                let side = if columns == pair.left { Side::Left } else { Side::Right };
                found.number(path(&format!("{side}_position")), position, text);
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
