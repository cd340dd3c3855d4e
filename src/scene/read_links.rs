//! The keys of links: `[[link]]`, with its two ends, its spring and its dashpot.

use super::building_id::BuildingId;
use super::document::{Item, KEY, Section};
use super::link::{Link, Slip};
use super::place::Place;
use super::read_row::Row;
use super::side::Side;
use super::units::Units;

/// By side.
const FLOORS: [&str; 2] = ["left_floor", "right_floor"];
const FLOOR: &str = "a floor, counted from 1";

/// All links of a scene.
pub(super) fn all(root: &mut Section<'_>, row: &Row, units: Units) -> Vec<Link> {
    root.get("link").iter().flat_map(|item| item.tables("link")).map(|section| link(section, row, units)).collect()
}

fn link(mut section: Section<'_>, row: &Row, units: Units) -> Link {
    let [left, right] = ends(&mut section, row);
    for key in ["left_storey", "right_storey", "left_position", "right_position", "column_shape"] {
        section.refuse_key(key, "left_floor and right_floor: devices are anchored at floors, not at columns");
    }
    let (stiffness, dashpot) = (section.get("stiffness"), section.get("dashpot"));
    let (force, ratio) = (section.get("slip_force"), section.get("post_yield_ratio"));
    let unit = units.unit("N/m");
    match (&stiffness, &dashpot, &force) {
        (None, _, Some(_)) => section.missing("stiffness", &format!("that of the spring that slips, in {unit}")),
        (None, None, None) => {
            let what = format!("a stiffness in {unit}, or a dashpot in {}, or both", units.unit("N s/m"));
            section.missing("stiffness", &what);
        }
        _ => {}
    }
    let ratio = match (&force, ratio) {
        (None, Some(item)) => {
            item.refuse("slip_force as well, at which the spring yields");
            0.0
        }
        (_, ratio) => ratio.map_or(0.0, |item| item.number()),
    };
    section.close(KEY);
    let quantity = |item: &Option<Item<'_>>| item.as_ref().map(|item| item.quantity(units));
    let link = Link {
        left,
        right,
        stiffness: quantity(&stiffness).unwrap_or_default(),
        dashpot: quantity(&dashpot).unwrap_or_default(),
        slip: quantity(&force).map(|force| Slip { force, ratio }),
    };
    let is_nothing = link.slip.is_none() && link.stiffness == 0.0 && link.dashpot == 0.0;
    if let Some(item) = stiffness.or(dashpot).filter(|_| is_nothing) {
        item.refuse("a stiffness > 0, or a dashpot > 0: nothing would be there");
    }
    link
}

/// The ends on the left and on the right; `None` is the ground, as a wall opposite of a floor.
fn ends(section: &mut Section<'_>, row: &Row) -> [Option<(BuildingId, Place)>; 2] {
    let (floors, wall) = (FLOORS.map(|key| section.get(key)), section.get("wall"));
    let one = if floors[0].is_some() { Side::Left } else { Side::Right };
    let ends = row.ends(section, wall.is_some().then_some(one));
    match (&floors, &wall) {
        ([None, None], _) => {
            section.missing(FLOORS[0], &format!("{FLOOR}, and right_floor, or one of them and a wall"));
            return [ends[0].map(|id| (id, Place::Floor(0))), None];
        }
        ([Some(_), Some(_)], Some(wall)) => wall.refuse("no wall beside left_floor and right_floor: two ends only"),
        ([Some(_), Some(_)], None) => {}
        ([None, _], None) => section.missing(FLOORS[0], &format!("{FLOOR}, or wall = \"left\"")),
        ([_, None], None) => section.missing(FLOORS[1], &format!("{FLOOR}, or wall = \"right\"")),
        ([left, _], Some(wall)) => {
            let (floor, opposite) = if left.is_some() { (FLOORS[0], Side::Right) } else { (FLOORS[1], Side::Left) };
            if wall.text().is_some_and(|name| name != opposite.name()) {
                wall.refuse(format!("\"{opposite}\", the side of {floor} on which the device is"));
            }
        }
    }
    let end = |side: Side| {
        let place = place(floors[side as usize].as_ref()?);
        Some((ends[side as usize]?, place))
    };
    Side::BOTH.map(end)
}

/// From the number of a floor, counted from 1; 0 is the foundation.
fn place(item: &Item<'_>) -> Place {
    let number = item.whole().unwrap_or(1);
    number.checked_sub(1).map_or(Place::Foundation, Place::Floor)
}
