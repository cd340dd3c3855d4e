//! More or fewer storeys of a building: its lists become longer, with copies of what is uppermost, or shorter; contacts of
//! floors that are gone go with them, and floors that now face each other get one.

use super::building::{Building, SIDES, buildings, end};
use super::path::NOT_THERE;
use serde_json::Value as Json;
use toml_edit::{Array, ArrayOfTables, DocumentMut, Item, Table, TableLike, Value, value};

/// More make a run slower than a page should be.
const MOST: usize = 100;
/// Lists of a building, one entry for each floor or storey.
const LISTS: [&str; 9] = [
    "mass",
    "stiffness",
    "height",
    "yield_force",
    "post_yield_ratio",
    "gravity_load",
    "p_delta",
    "initial_displacement",
    "initial_velocity",
];
const DAMPING_LISTS: [&str; 2] = ["ratios", "dashpots"];

/// Gives the building at a path so many storeys.
pub fn set(document: &mut DocumentMut, path: &str, wanted: &Json) -> Result<(), String> {
    let whole = wanted.as_f64().filter(|count| count.fract() == 0.0 && (1.0..=MOST as f64).contains(count));
    let count = whole.ok_or_else(|| format!("expected a whole number from 1 to {MOST}"))? as usize;
    let mut row = buildings(document);
    let at = row.iter().position(|building| building.path == path).ok_or(NOT_THERE)?;
    let before = floors(&row[at]).ok_or("expected masses in a list")?;
    if before == 0 {
        return Err("expected a building with a storey that can be copied".to_owned());
    }
    has_no_matrix(row[at].table)?;
    lists_of(row[at].table, count);
    let name = row[at].name.clone();
    // Names of two neighbours of which this is one, and the floors that both have.
    let pair = |pair: &[Building<'_>]| {
        let floors = pair.iter().map(|building| floors(building).unwrap_or(0)).min();
        (pair.iter().map(|building| building.name.clone()).collect(), floors.unwrap_or(0))
    };
    let nearby = &row[at.saturating_sub(1)..row.len().min(at + 2)];
    let pairs: Vec<(Vec<String>, usize)> = nearby.windows(2).map(pair).collect();
    let Some(Item::ArrayOfTables(contacts)) = document.get_mut("contact") else { return Ok(()) };
    contacts.retain(|contact| !is_above(contact, &name, count));
    for (names, facing) in pairs {
        add_facing(contacts, &names, before + 1..=facing);
    }
    Ok(())
}

fn has_no_matrix(building: &dyn TableLike) -> Result<(), String> {
    let damping = building.get("damping").and_then(Item::as_table_like);
    let has =
        building.get("stiffness_matrix").is_some() || damping.is_some_and(|damping| damping.get("matrix").is_some());
    if has { Err("the building is given by matrices, whose rows only a person can add".to_owned()) } else { Ok(()) }
}

fn lists_of(building: &mut dyn TableLike, count: usize) {
    for key in LISTS {
        if let Some(Item::Value(Value::Array(list))) = building.get_mut(key) {
            resize(list, count);
        }
    }
    let Some(damping) = building.get_mut("damping").and_then(Item::as_table_like_mut) else { return };
    for key in DAMPING_LISTS {
        if let Some(Item::Value(Value::Array(list))) = damping.get_mut(key) {
            resize(list, count);
        }
    }
}

fn resize(list: &mut Array, count: usize) {
    while list.len() > count {
        list.remove(list.len() - 1);
    }
    let Some(last) = list.iter().last().cloned() else { return };
    // Before an entry stand the comment of the one before it and the blanks of its own line.
    let before = last.decor().prefix().and_then(|prefix| prefix.as_str()).unwrap_or_default().to_owned();
    let blanks = before.rfind('\n').map_or(before.as_str(), |line| &before[line..]);
    let blanks = if list.len() == 1 && blanks.is_empty() { " " } else { blanks };
    for _ in list.len()..count {
        let mut copy = last.clone();
        copy.decor_mut().set_prefix(blanks);
        list.push_formatted(copy);
    }
}

fn number(table: &dyn TableLike, key: &str) -> Option<usize> {
    table.get(key).and_then(Item::as_integer).and_then(|number| usize::try_from(number).ok())
}

/// Whether a contact is with a floor or a storey of a building that is gone.
fn is_above(contact: &Table, building: &str, count: usize) -> bool {
    let is_gone =
        |side: &str, what: &str| number(contact, &format!("{side}_{what}")).is_some_and(|place| place > count);
    let mut sides = SIDES.into_iter().filter(|side| end(contact, side) == building);
    sides.any(|side| ["floor", "storey"].into_iter().any(|what| is_gone(side, what)))
}

fn floors(building: &Building<'_>) -> Option<usize> {
    building.table.get("mass").and_then(Item::as_array).map(Array::len)
}

/// A contact like the last one between two neighbours for each of these floors, where every contact between them is between
/// floors of the same number.
fn add_facing(contacts: &mut ArrayOfTables, names: &[String], new: std::ops::RangeInclusive<usize>) {
    let is_between = |contact: &&Table| SIDES.iter().zip(names).all(|(side, name)| end(*contact, side) == name);
    let level =
        |contact: &Table| number(contact, "left_floor").filter(|left| number(contact, "right_floor") == Some(*left));
    let levels: Option<Vec<usize>> = contacts.iter().filter(is_between).map(level).collect();
    let (Some(levels), Some(last)) = (levels, contacts.iter().filter(is_between).last().cloned()) else { return };
    for floor in new.filter(|floor| !levels.contains(floor)) {
        let mut contact = last.clone();
        contact.decor_mut().set_prefix("\n");
        for key in ["left_floor", "right_floor"] {
            contact.insert(key, value(floor as i64));
        }
        contacts.push(contact);
    }
}
