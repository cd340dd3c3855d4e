//! The keys of contacts: `[[contact]]`, with what meets and by which law, and `[facing]`.

use super::building_id::BuildingId;
use super::contact_pair::{ColumnShape, ContactPair, Face};
use super::document::{Item, KEY, Section};
use super::facing::{Facing, FacingKeys};
use super::law_key;
use super::levels::{Heights, LEVEL_TOLERANCE};
use super::problem::count;
use super::read_row::{Ends, Row};
use super::side::Side;
use super::units::Units;
use crate::contact::{DampingFormula, ImpactLaw, LawKind};
use crate::figures::six_decimals;

const FLOOR: &str = "a floor, counted from 1";

/// All contacts of a scene with these buildings, and what `[facing]` has made where the scene has it: its contacts come
/// first, and beside it a row may have contacts with walls.
pub(super) fn all(root: &mut Section<'_>, row: &Row, units: Units) -> (Vec<ContactPair>, Option<Facing>) {
    let tables = root.get("contact");
    let (mut contacts, mut facing) = (Vec::new(), None);
    if let Some(item) = root.get("facing") {
        let (made, by) = self::facing(root, &item, row, units);
        (contacts, facing) = (made, Some(by));
        if !row.is_named {
            tables.inspect(|item| item.refuse("either [[contact]] tables or [facing], not both"));
            return (contacts, facing);
        }
    }
    for mut section in tables.iter().flat_map(|item| item.tables("contact")) {
        if facing.is_some() && section.get("wall").is_none() {
            section.refuse("a wall: [facing] makes the contacts between neighbours");
            continue;
        }
        contacts.push(contact(section, row, units));
    }
    (contacts, facing)
}

/// The contacts of `[facing]`, gap by gap from the left.
fn facing(root: &Section<'_>, item: &Item<'_>, row: &Row, units: Units) -> (Vec<ContactPair>, Facing) {
    let mut section = item.section();
    let gap = section.require("gap", "the clear distance at rest in m");
    let level_tolerance = section.get("level_tolerance").map_or(LEVEL_TOLERANCE, |item| item.number());
    let column_shape = section.get("column_shape").and_then(|item| column_shape(&item)).unwrap_or_default();
    let keys = FacingKeys { level_tolerance, column_shape, law: law(section, units) };
    let has_gaps = row.is_named && gap.as_ref().is_some_and(Item::is_list);
    if row.is_named && row.buildings.len() == 1 {
        item.refuse_as("[facing]", "two buildings or more, which face each other");
    }
    let pairs = row.buildings.len().saturating_sub(1);
    let gaps = gap.map_or_else(|| vec![f64::NAN; pairs], |item| gaps(&item, has_gaps, pairs));
    let heights: Vec<Option<&Heights>> = (0..).zip(&row.buildings).map(|(b, _)| heights(root, row, b)).collect();
    let between = |(left, gap): (usize, &f64)| {
        let of = |b: usize| Some((BuildingId::new(b), heights.get(b).copied().flatten()?));
        Some(keys.contacts([of(left)?, of(left + 1)?], *gap))
    };
    let contacts: Vec<ContactPair> = gaps.iter().enumerate().filter_map(between).flatten().collect();
    let facing = Facing { level_tolerance, contacts: contacts.len(), has_gaps };
    (contacts, facing)
}

/// m, the gap of each pair of neighbours: one for all, or a list.
fn gaps(item: &Item<'_>, is_list: bool, pairs: usize) -> Vec<f64> {
    if !is_list {
        return vec![item.number(); pairs];
    }
    let gaps = item.numbers();
    if gaps.len() != pairs {
        item.refuse(format!("{}, one per pair of neighbours, not {}", count(pairs, "number"), gaps.len()));
    }
    gaps
}

/// The heights of a building, which `[facing]` needs; where they are wrong, that is told where they stand.
fn heights<'r>(root: &Section<'_>, row: &'r Row, place: usize) -> Option<&'r Heights> {
    let building = row.buildings.get(place)?;
    if building.heights.is_none() && !building.mass.is_empty() {
        let what = "the heights of the storeys in m, which [facing] needs (missing)";
        root.refuse_at(&format!("{}.height", building.path), "", what);
    }
    building.heights.as_ref().filter(|heights| heights.are_of(building.mass.len()))
}

fn contact(mut section: Section<'_>, row: &Row, units: Units) -> ContactPair {
    let Met { faces: [left, right], floor_key } = met(&mut section, row);
    let gap = gap(&mut section);
    let law = law(section, units);
    ContactPair { left, right, gap, law, floor_key }
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

/// What meets; an end of which something is wrong that has been said is as a wall, about which there is nothing to say.
struct Met {
    faces: [Face; 2],
    /// As in [`ContactPair`].
    floor_key: Option<Side>,
}

fn met(section: &mut Section<'_>, row: &Row) -> Met {
    let keys = Keys {
        floors: ["left_floor", "right_floor"].map(|key| section.get(key)),
        storeys: ["left_storey", "right_storey"].map(|key| section.get(key)),
        positions: ["left_position", "right_position"].map(|key| section.get(key)),
        shape: section.get("column_shape"),
        wall: section.get("wall"),
    };
    if let Some(wall) = &keys.wall {
        return at_wall(section, &keys, wall, row);
    }
    Met { faces: between_neighbours(section, &keys, row), floor_key: None }
}

fn between_neighbours(section: &mut Section<'_>, keys: &Keys<'_>, row: &Row) -> [Face; 2] {
    let ends = row.ends(section, None);
    for side in Side::BOTH {
        keys.refuse_what_belongs_to_columns(side);
    }
    if let [Some(_), Some(right)] = &keys.storeys {
        right.refuse("a floor on one side: the columns of two storeys do not reach each other");
        return [Face::Wall, Face::Wall];
    }
    let has_columns = |side: usize| keys.storeys[side].is_some() && keys.floors[side].is_none();
    let floors = Side::BOTH.map(|side| if has_columns(side as usize) { 0 } else { floor(section, keys, side) });
    Side::BOTH.map(|side| match &keys.storeys[side as usize] {
        Some(storey) if has_columns(side as usize) => {
            columns(section, keys, side, storey, floors[side.opposite() as usize], (row, ends))
        }
        storey => {
            storey.as_ref().inspect(|item| item.refuse(format!("either {side}_floor or {side}_storey, not both")));
            ends[side as usize].map_or(Face::Wall, |id| Face::Floor(id, floors[side as usize]))
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
fn at_wall(section: &mut Section<'_>, keys: &Keys<'_>, wall: &Item<'_>, row: &Row) -> Met {
    let side = if let [None, Some(_)] = &keys.floors { Side::Right } else { Side::Left };
    let end = row.ends(section, Some(side))[side as usize];
    let others = keys.storeys.iter().chain(&keys.positions).chain([&keys.shape]).flatten();
    others.for_each(|item| item.refuse("no such key: a wall is hit by a floor, left_floor or right_floor"));
    let floor = match &keys.floors {
        [Some(floor), None] | [None, Some(floor)] => {
            let number = floor.count();
            end.map_or(Face::Wall, |id| Face::Floor(id, number))
        }
        [Some(_), Some(right)] => {
            right.refuse("one floor only at a wall");
            Face::Wall
        }
        [None, None] => {
            section.missing("left_floor", "a floor, counted from 1, here or as right_floor");
            end.map_or(Face::Wall, |id| Face::Floor(id, 0))
        }
    };
    let name = wall.text();
    if name.is_some_and(|name| !["left", "right"].contains(&name)) {
        wall.refuse("\"left\" or \"right\": the side of the floor that the wall is on");
    }
    let faces = if name == Some("left") { [Face::Wall, floor] } else { [floor, Face::Wall] };
    Met { faces, floor_key: Some(side) }
}

/// The columns of a storey on one side, which a floor of the other building meets.
fn columns(
    section: &Section<'_>,
    keys: &Keys<'_>,
    side: Side,
    storey: &Item<'_>,
    floor: usize,
    (row, ends): (&Row, Ends),
) -> Face {
    let number = storey.count();
    let shape = keys.shape.as_ref().and_then(column_shape).unwrap_or_default();
    let both = [side, side.opposite()].map(|side| row.building(ends[side as usize]?));
    let heights = both.map(|building| Some((&*building?.name, building?.heights.as_ref()?)));
    let position = match (&keys.positions[side as usize], heights) {
        (Some(position), _) => Some(position.number()),
        (None, _) if ends.contains(&None) => None,
        (None, [Some(own), Some(other)]) => position_by_levels(storey, number, (side, floor), [own, other]),
        (None, _) => {
            let what = "where the columns are hit, 0 < s < 1 from the storey's lower end; only where both buildings have \
                        their height it may be left out";
            section.missing(&format!("{side}_position"), what);
            None
        }
    };
    // Where it is unknown, that has been said.
    let Some(building) = ends[side as usize] else { return Face::Wall };
    Face::Columns { building, storey: number, position: position.unwrap_or(0.5), shape }
}

fn column_shape(item: &Item<'_>) -> Option<ColumnShape> {
    let of_name = |name: &str| ColumnShape::ALL.into_iter().find(|shape| shape.name() == name);
    item.choice("a known shape", &ColumnShape::ALL.map(ColumnShape::name), of_name)
}

/// Where a storey on one side is hit by a floor of the other building, by the heights of both; refused where it is not.
fn position_by_levels(
    item: &Item<'_>,
    storey: usize,
    (side, floor): (Side, usize),
    [(name, own), (name_of_other, other)]: [(&str, &Heights); 2],
) -> Option<f64> {
    // Numbers out of range are refused where the others of their kind are.
    let level = (1..=other.storeys.len()).contains(&floor).then(|| other.level(floor))?;
    let position = own.position(storey, level)?;
    if own.is_inside(storey, level) || !position.is_finite() {
        return Some(position).filter(|position| position.is_finite());
    }
    let hits = match (own.storey_at(level), own.nearest_floor(level)) {
        (Some((storey, position)), _) => format!("is in storey {storey}, at {}", six_decimals(position)),
        (None, Some((floor, apart))) if apart <= LEVEL_TOLERANCE => format!("is that of {name} floor {floor}"),
        _ => format!("is not between {name} floors"),
    };
    item.refuse(format!(
        "a storey that {name_of_other} floor {floor} stands before, or {side}_position: its level, {} m, {hits}",
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
