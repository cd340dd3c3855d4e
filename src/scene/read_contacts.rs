//! The keys of contacts: `[[contact]]`, with what meets and by which law, and `[facing]`.

use super::building_id::BuildingId;
use super::contact_pair::{ColumnShape, ContactPair, Face};
use super::data::Building;
use super::document::{Item, KEY, Section};
use super::facing::Facing;
use super::law_key;
use super::levels::{Heights, LEVEL_TOLERANCE};
use super::side::Side;
use super::units::Units;
use crate::contact::{DampingFormula, ImpactLaw, LawKind};
use crate::figures::six_decimals;

const FLOOR: &str = "a floor, counted from 1";

/// The buildings on the left and on the right of a gap.
pub(super) type Neighbours<'b> = [(BuildingId, &'b Building); 2];

/// All contacts of a scene with these buildings, and the tolerance of `[facing]` where that makes them.
pub(super) fn all(root: &mut Section<'_>, buildings: Neighbours<'_>, units: Units) -> (Vec<ContactPair>, Option<f64>) {
    let tables = root.get("contact");
    if let Some(facing) = root.get("facing") {
        tables.inspect(|item| item.refuse("either [[contact]] tables or [facing], not both"));
        let facing = self::facing(facing.section(), units);
        return (facing_contacts(root, &facing, buildings), Some(facing.level_tolerance));
    }
    let tables = tables.iter().flat_map(|item| item.tables("contact"));
    (tables.map(|section| contact(section, buildings, units)).collect(), None)
}

fn facing(mut section: Section<'_>, units: Units) -> Facing {
    Facing {
        level_tolerance: section.get("level_tolerance").map_or(LEVEL_TOLERANCE, |item| item.number()),
        column_shape: section.get("column_shape").and_then(|item| column_shape(&item)).unwrap_or_default(),
        gap: gap(&mut section),
        law: law(section, units),
    }
}

fn facing_contacts(root: &mut Section<'_>, facing: &Facing, buildings: Neighbours<'_>) -> Vec<ContactPair> {
    let heights = buildings.map(|(id, building)| {
        if building.heights.is_none() && !building.is_absent() {
            root.missing_in(&building.name, "height", "the heights of the storeys in m, which [facing] needs");
        }
        // Where heights are wrong, that is told where they stand.
        Some((id, building.heights.as_ref().filter(|heights| heights.are_of(building.mass.len()))?))
    });
    match heights {
        [Some(left), Some(right)] => facing.contacts([left, right]),
        _ => Vec::new(),
    }
}

fn contact(mut section: Section<'_>, buildings: Neighbours<'_>, units: Units) -> ContactPair {
    let [left, right] = faces(&mut section, buildings);
    let gap = gap(&mut section);
    let law = law(section, units);
    ContactPair { left, right, gap, law }
}

fn gap(section: &mut Section<'_>) -> f64 {
    section.require("gap", "the clear distance at rest in m").map_or(f64::NAN, |item| item.number())
}

/// The keys that say what meets.
struct Keys<'t> {
    /// `left_floor` and `right_floor`.
    floors: [Option<Item<'t>>; 2],
    /// `left_storey` and `right_storey`.
    storeys: [Option<Item<'t>>; 2],
    /// `left_position` and `right_position`.
    positions: [Option<Item<'t>>; 2],
    shape: Option<Item<'t>>,
    wall: Option<Item<'t>>,
}

fn faces<'t>(section: &mut Section<'t>, buildings: Neighbours<'_>) -> [Face; 2] {
    let keys = Keys {
        floors: ["left_floor", "right_floor"].map(|key| section.get(key)),
        storeys: ["left_storey", "right_storey"].map(|key| section.get(key)),
        positions: ["left_position", "right_position"].map(|key| section.get(key)),
        shape: section.get("column_shape"),
        wall: section.get("wall"),
    };
    if let Some(wall) = &keys.wall {
        return at_wall(section, &keys, wall, buildings);
    }
    for side in Side::BOTH {
        keys.refuse_what_belongs_to_columns(side);
    }
    if let [Some(_), Some(right)] = &keys.storeys {
        right.refuse("a floor on one side: the columns of two storeys do not reach each other");
        return [Face::Wall, Face::Wall];
    }
    let has_columns = |side: usize| keys.storeys[side].is_some() && keys.floors[side].is_none();
    let floors = Side::BOTH.map(|side| if has_columns(side as usize) { 0 } else { floor(section, &keys, side) });
    Side::BOTH.map(|side| match &keys.storeys[side as usize] {
        Some(storey) if has_columns(side as usize) => {
            columns(section, &keys, side, storey, floors[side.opposite() as usize], buildings)
        }
        storey => {
            storey.as_ref().inspect(|item| item.refuse(format!("either {side}_floor or {side}_storey, not both")));
            Face::Floor(buildings[side as usize].0, floors[side as usize])
        }
    })
}

impl Keys<'_> {
    /// Refuses a position where there is no storey, and a shape where there are no columns at all.
    fn refuse_what_belongs_to_columns(&self, side: Side) {
        let side_number = side as usize;
        if let (Some(position), None) = (&self.positions[side_number], &self.storeys[side_number]) {
            position.refuse(format!("{side}_storey, whose columns are hit there, instead of {side}_floor"));
        }
        if let (Some(shape), [None, None], Side::Left) = (&self.shape, &self.storeys, side) {
            shape.refuse("left_storey or right_storey, whose columns have a shape");
        }
    }
}

/// The number of a floor that must be there.
fn floor(section: &Section<'_>, keys: &Keys<'_>, side: Side) -> usize {
    match &keys.floors[side as usize] {
        Some(item) => item.count(),
        None => {
            section.missing(&format!("{side}_floor"), FLOOR);
            0
        }
    }
}

/// One floor, of either building, and a wall on one side of it.
fn at_wall(section: &Section<'_>, keys: &Keys<'_>, wall: &Item<'_>, buildings: Neighbours<'_>) -> [Face; 2] {
    let [left, right] = buildings.map(|(id, _)| id);
    let others = keys.storeys.iter().chain(&keys.positions).chain([&keys.shape]).flatten();
    others.for_each(|item| item.refuse("no such key: a wall is hit by a floor, left_floor or right_floor"));
    let floor = match &keys.floors {
        [Some(floor), None] => Face::Floor(left, floor.count()),
        [None, Some(floor)] => Face::Floor(right, floor.count()),
        [Some(_), Some(right)] => {
            right.refuse("one floor only at a wall");
            Face::Wall
        }
        [None, None] => {
            section.missing("left_floor", "a floor, counted from 1, here or as right_floor");
            Face::Floor(left, 0)
        }
    };
    match wall.text() {
        Some("left") => [Face::Wall, floor],
        Some("right") => [floor, Face::Wall],
        Some(_) => {
            wall.refuse("\"left\" or \"right\": the side of the floor that the wall is on");
            [floor, Face::Wall]
        }
        None => [floor, Face::Wall],
    }
}

/// The columns of a storey on one side, which a floor of the other building meets.
fn columns(
    section: &Section<'_>,
    keys: &Keys<'_>,
    side: Side,
    storey: &Item<'_>,
    floor: usize,
    buildings: Neighbours<'_>,
) -> Face {
    let number = storey.count();
    let shape = keys.shape.as_ref().and_then(column_shape).unwrap_or_default();
    let heights = [side, side.opposite()].map(|side| buildings[side as usize].1.heights.as_ref());
    let position = match (&keys.positions[side as usize], heights) {
        (Some(position), _) => Some(position.number()),
        (None, [Some(own), Some(other)]) => position_by_levels(storey, number, side, floor, [own, other]),
        (None, _) => {
            let what = "where the columns are hit, 0 < s < 1 from the storey's lower end; only where both buildings have \
                        their height it may be left out";
            section.missing(&format!("{side}_position"), what);
            None
        }
    };
    // Where it is unknown, that has been said.
    Face::Columns { building: buildings[side as usize].0, storey: number, position: position.unwrap_or(0.5), shape }
}

fn column_shape(item: &Item<'_>) -> Option<ColumnShape> {
    let of_name = |name: &str| ColumnShape::ALL.into_iter().find(|shape| shape.name() == name);
    item.choice("a known shape", &ColumnShape::ALL.map(ColumnShape::name), of_name)
}

/// Where a storey on one side is hit by a floor of the other building, by the heights of both; refused where it is not.
fn position_by_levels(
    item: &Item<'_>,
    storey: usize,
    side: Side,
    floor: usize,
    [own, other]: [&Heights; 2],
) -> Option<f64> {
    // Numbers out of range are refused where the others of their kind are.
    let level = (1..=other.storeys.len()).contains(&floor).then(|| other.level(floor))?;
    let position = own.position(storey, level)?;
    if own.is_inside(storey, level) || !position.is_finite() {
        return Some(position).filter(|position| position.is_finite());
    }
    let hits = match (own.storey_at(level), own.nearest_floor(level)) {
        (Some((storey, position)), _) => format!("is in storey {storey}, at {}", six_decimals(position)),
        (None, Some((floor, apart))) if apart <= LEVEL_TOLERANCE => format!("is that of {side} floor {floor}"),
        _ => format!("is not between {side} floors"),
    };
    item.refuse(format!(
        "a storey that {} floor {floor} stands before, or {side}_position: its level, {} m, {hits}",
        side.opposite(),
        six_decimals(level)
    ));
    None
}

fn law(mut section: Section<'_>, units: Units) -> ImpactLaw {
    let Some(kind) = law_kind(&mut section) else {
        // Which keys belong here is the law's business: only what no law allows them to be is refused.
        for key in law_key::widest() {
            section.get(key.name).inspect(|item| item.look_at(key.rule, units));
        }
        section.get("damping_formula").inspect(|item| _ = item.text());
        section.close(KEY);
        return ImpactLaw::new(LawKind::Linear);
    };
    let mut law = ImpactLaw::new(kind);
    for &key in kind.info().keys {
        let key = law_key::number(key);
        let item = match key.default {
            None => section.require(key.name, key.rule.expected(units)),
            Some(_) => section.get(key.name),
        };
        let value = item.map(|item| item.quantity(key.rule.units(units))).or(key.default);
        key.set(&mut law, value.unwrap_or(f64::NAN));
    }
    if kind.info().has_damping_formula {
        law.damping_formula = damping_formula(&mut section);
    }
    section.close(&format!("a key of law {}", kind.info().name));
    law
}

fn damping_formula(section: &mut Section<'_>) -> Option<DampingFormula> {
    let names: Vec<_> = DampingFormula::ALL.iter().map(|formula| formula.info().name).collect();
    let item = section.require("damping_formula", &format!("a damping formula ({})", names.join(", ")))?;
    item.choice("a known damping formula", &names, DampingFormula::from_name)
}

fn law_kind(section: &mut Section<'_>) -> Option<LawKind> {
    let names: Vec<_> = LawKind::ALL.iter().map(|kind| kind.info().name).collect();
    let item = section.require("law", &format!("a law ({})", names.join(", ")))?;
    item.choice("a known law", &names, LawKind::from_name)
}
