//! Which buildings a scene has: `[left]` and `[right]`, or a row of `[[building]]` tables with names.

use super::building_id::BuildingId;
use super::data::{Building, Damping, Stiffness};
use super::document::{Item, Section};
use super::identifier;
use super::read_building::building;
use super::side::Side;
use super::units::Units;
use std::collections::HashMap;

/// More would be a mistake: no street block is as long.
pub(super) const MOST_BUILDINGS: usize = 100;

/// What variables begin with that are not of a building.
const OF_THE_FMU: [&str; 8] = ["contact", "energy", "ground", "impacts", "link", "solver", "system", "time"];

/// What the columns of a study say after the name of a building, before what others have: `a` and `a_residual` would have
/// the same.
const RESIDUAL: &str = "_residual";

/// The buildings of a scene, from left to right.
pub(super) struct Row {
    pub buildings: Vec<Building>,
    /// Whether they are `[[building]]` tables, so that contacts and links name them.
    pub is_named: bool,
}

/// Which building is on the left of a gap and which on the right, where that is known.
pub(super) type Ends = [Option<BuildingId>; 2];

impl Row {
    /// Reads all buildings of a scene.
    pub(super) fn read(root: &mut Section<'_>, units: Units) -> Row {
        let tables = root.get("building");
        let others = ["left", "right"].map(|key| root.get(key));
        let Some(tables) = tables else {
            if others[0].is_none() {
                root.missing("left", "the building on the left");
            }
            let [left, right] = others;
            let left = left.map_or_else(|| absent("left"), |item| building("left", item.section(), units));
            let right = right.map(|item| building("right", item.section(), units));
            return Row { buildings: std::iter::once(left).chain(right).collect(), is_named: false };
        };
        if others.iter().any(Option::is_some) {
            tables.refuse_as("[[building]]", "either [[building]] tables or [left] and [right], not both");
        }
        let of_table = |(place, mut section): (usize, Section<'_>)| {
            let given = section.get("name");
            let name = given.as_ref().and_then(Item::text).map_or_else(|| format!("b{}", place + 1), str::to_owned);
            given.iter().for_each(|item| look_at_name(item, &name));
            building(&name, section, units)
        };
        let sections = tables.tables("building");
        if sections.is_empty() && tables.is_list() {
            tables.refuse("at least one [[building]] table");
        }
        if sections.len() > MOST_BUILDINGS {
            tables.refuse_as("", format!("at most {MOST_BUILDINGS} buildings, not {}", sections.len()));
        }
        // Further ones are no more than counted.
        let buildings = sections.into_iter().take(MOST_BUILDINGS).enumerate().map(of_table).collect();
        let row = Row { buildings, is_named: true };
        row.look_at_names_together(root);
        row
    }

    /// A name that two buildings have, or whose columns in a study would be those of another one.
    fn look_at_names_together(&self, root: &Section<'_>) {
        let names = || self.buildings.iter().map(|building| building.name.as_str());
        let mut first: HashMap<&str, usize> = HashMap::new();
        for (place, name) in names().enumerate() {
            first.entry(name).or_insert(place);
        }
        for (place, name) in names().enumerate() {
            let refuse = |expected: String| {
                root.refuse_at(&format!("building[{}].name", place + 1), &format!("{name:?}"), expected);
            };
            let known = first.get(name).copied().unwrap_or(place);
            if known != place {
                refuse(format!("a name other than that of building[{}]", known + 1));
            } else if let Some(other) = names().position(|other| begins_as_columns_of(name, other)) {
                refuse(format!("a name that does not begin with that of building[{}] and {RESIDUAL:?}", other + 1));
            }
        }
    }

    /// One of the buildings, if it is there.
    pub(super) fn building(&self, id: BuildingId) -> Option<&Building> {
        self.buildings.get(id.index())
    }

    /// Which buildings a contact or a link is with, by its keys `left` and `right`; of a scene with `[left]` and `[right]`,
    /// which has no such keys, those two. Where there is a wall, `floor` says on which side the key of the one floor is.
    pub(super) fn ends(&self, section: &mut Section<'_>, floor: Option<Side>) -> Ends {
        if !self.is_named {
            return [Some(BuildingId::LEFT), Some(BuildingId::RIGHT)];
        }
        let items = Side::BOTH.map(|side| section.get(side.name()));
        match floor {
            Some(side) => self.end_at_wall(section, &items, side),
            None => self.neighbours(section, &items),
        }
    }

    fn end_at_wall(&self, section: &Section<'_>, items: &[Option<Item<'_>>; 2], side: Side) -> Ends {
        let other = &items[side.opposite() as usize];
        other.iter().for_each(|item| item.refuse_as("", "no such key: at a wall there is one building"));
        let item = &items[side as usize];
        if item.is_none() {
            section.missing(side.name(), "the name of the building at the wall");
        }
        let mut ends = [None, None];
        ends[side as usize] = item.as_ref().and_then(|item| self.named(item));
        ends
    }

    fn neighbours(&self, section: &Section<'_>, items: &[Option<Item<'_>>; 2]) -> Ends {
        for (side, item) in Side::BOTH.into_iter().zip(items) {
            if item.is_none() {
                section.missing(side.name(), &format!("the name of the building on the {side} of the gap"));
            }
        }
        let [left, right] = items.each_ref().map(|item| item.as_ref().and_then(|item| Some((item, self.named(item)?))));
        let beside = |id: BuildingId| self.buildings.get(id.index() + 1);
        match (left, right) {
            (Some((item, left)), _) if beside(left).is_none() => {
                item.refuse("a building that has a right neighbour");
                [None, None]
            }
            (Some((_, left)), Some((item, right))) if right.index() != left.index() + 1 => {
                let [own, next] = [self.building(left), beside(left)].map(|of| of.map_or("", |of| &of.name));
                item.refuse(format!("{next:?}, the right neighbour of {own:?}"));
                [Some(left), None]
            }
            (left, right) => [left, right].map(|end| end.map(|(_, id)| id)),
        }
    }

    /// The building of a name.
    fn named(&self, item: &Item<'_>) -> Option<BuildingId> {
        let names: Vec<&str> = self.buildings.iter().map(|building| building.name.as_str()).collect();
        let place = |name: &str| names.iter().position(|known| *known == name);
        item.choice("the name of a building", &names, place).map(BuildingId::new)
    }
}

/// What stands for a building that is missing, of which that has been said.
pub(super) fn absent(name: &str) -> Building {
    Building::new(name, Vec::new(), Stiffness::Shear(Vec::new()), Damping::Ratio(0.0))
}

fn look_at_name(item: &Item<'_>, name: &str) {
    if OF_THE_FMU.contains(&name) {
        item.refuse(format!("a name that the FMU does not use itself ({})", OF_THE_FMU.join(", ")));
    } else if item.is_text()
        && let Err(expected) = identifier::check(name)
    {
        item.refuse(expected);
    }
}

fn begins_as_columns_of(name: &str, other: &str) -> bool {
    name.strip_prefix(other).is_some_and(|rest| rest.starts_with(RESIDUAL))
}
