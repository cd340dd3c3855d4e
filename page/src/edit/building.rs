//! The buildings in the text of a scene: `[left]` and `[right]`, or a row of `[[building]]` tables.

use super::path::tables;
use toml_edit::{DocumentMut, Item, TableLike};

pub const SIDES: [&str; 2] = ["left", "right"];

/// A building.
pub struct Building<'d> {
    pub name: String,
    /// Where it stands, such as `left` or `building[2]`.
    pub path: String,
    pub table: &'d mut dyn TableLike,
}

/// From left to right.
pub fn buildings(document: &mut DocumentMut) -> Vec<Building<'_>> {
    if document.contains_key("building") {
        return (1..).zip(tables(document.get_mut("building"))).map(|(number, table)| named(number, table)).collect();
    }
    let mut found: Vec<Building<'_>> = document.iter_mut().filter_map(|(key, item)| at_side(key.get(), item)).collect();
    found.sort_by(|one, other| one.name.cmp(&other.name));
    found
}

fn named(number: usize, table: &mut dyn TableLike) -> Building<'_> {
    let name = table.get("name").and_then(Item::as_str).map_or_else(|| format!("b{number}"), str::to_owned);
    Building { name, path: format!("building[{number}]"), table }
}

fn at_side<'d>(key: &str, item: &'d mut Item) -> Option<Building<'d>> {
    let side = SIDES.into_iter().find(|side| *side == key)?;
    Some(Building { name: side.to_owned(), path: side.to_owned(), table: item.as_table_like_mut()? })
}

/// The name of the building that a contact has on a side of its gap.
pub fn end<'c>(contact: &'c dyn TableLike, side: &'c str) -> &'c str {
    contact.get(side).and_then(Item::as_str).unwrap_or(side)
}
