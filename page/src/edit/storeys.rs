//! More or fewer storeys of a building: its lists become longer, with copies of what is uppermost, or shorter; contacts of
//! floors that are gone go with them, and floors that now face each other get one.

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

/// Gives the building on a side so many storeys.
pub fn set(document: &mut DocumentMut, side: &str, wanted: &Json) -> Result<(), String> {
    let whole = wanted.as_f64().filter(|count| count.fract() == 0.0 && (1.0..=MOST as f64).contains(count));
    let count = whole.ok_or_else(|| format!("expected a whole number from 1 to {MOST}"))? as usize;
    let building = document.get_mut(side).and_then(Item::as_table_like_mut).ok_or(NOT_THERE)?;
    let before = building.get("mass").and_then(Item::as_array).map(Array::len).ok_or("expected masses in a list")?;
    if before == 0 {
        return Err("expected a building with a storey that can be copied".to_owned());
    }
    has_no_matrix(building)?;
    lists_of(building, count);
    if let Some(Item::ArrayOfTables(contacts)) = document.get_mut("contact") {
        contacts.retain(|contact| !is_above(contact, side, count));
    }
    let other = if side == "left" { "right" } else { "left" };
    let facing = floors(document, other).min(count);
    if let Some(Item::ArrayOfTables(contacts)) = document.get_mut("contact") {
        add_facing(contacts, before + 1..=facing);
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

/// Whether a contact is with a floor or a storey that is gone.
fn is_above(contact: &Table, side: &str, count: usize) -> bool {
    ["floor", "storey"].iter().any(|what| number(contact, &format!("{side}_{what}")).is_some_and(|place| place > count))
}

fn floors(document: &DocumentMut, side: &str) -> usize {
    document.get(side).and_then(|building| building.get("mass")).and_then(Item::as_array).map_or(0, Array::len)
}

/// A contact like the last one for each of these floors, where every contact is between floors of the same number.
fn add_facing(contacts: &mut ArrayOfTables, new: std::ops::RangeInclusive<usize>) {
    let level =
        |contact: &Table| number(contact, "left_floor").filter(|left| number(contact, "right_floor") == Some(*left));
    let levels: Option<Vec<usize>> = contacts.iter().map(level).collect();
    let (Some(levels), Some(last)) = (levels, contacts.iter().last().cloned()) else { return };
    for floor in new.filter(|floor| !levels.contains(floor)) {
        let mut contact = last.clone();
        contact.decor_mut().set_prefix("\n");
        for key in ["left_floor", "right_floor"] {
            contact.insert(key, value(floor as i64));
        }
        contacts.push(contact);
    }
}
