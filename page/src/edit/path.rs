//! Paths such as `contact[1].gap`, and values set there.

use serde_json::Value as Json;
use toml_edit::{Array, InlineTable, Item, Table, TableLike, Value};

/// A step of a path.
pub enum Step<'p> {
    /// Of a table.
    Key(&'p str),
    /// One of a list, counted from 0.
    Entry(usize),
    /// All entries.
    Each,
}

/// The steps of a path; none where it is no path.
pub fn steps(path: &str) -> Option<Vec<Step<'_>>> {
    let mut steps = Vec::new();
    for part in path.split('.') {
        let (key, mut entries) = part.split_at(part.find('[').unwrap_or(part.len()));
        if key.is_empty() {
            return None;
        }
        steps.push(Step::Key(key));
        while let Some((entry, rest)) = entries.strip_prefix('[').and_then(|inside| inside.split_once(']')) {
            steps.push(match entry {
                "*" => Step::Each,
                number => Step::Entry(number.parse::<usize>().ok()?.checked_sub(1)?),
            });
            entries = rest;
        }
        if !entries.is_empty() {
            return None;
        }
    }
    Some(steps)
}

/// The tables of a list, each under its heading or in braces.
pub fn tables(list: Option<&mut Item>) -> Vec<&mut dyn TableLike> {
    match list {
        Some(Item::ArrayOfTables(tables)) => tables.iter_mut().map(|table| table as &mut dyn TableLike).collect(),
        Some(Item::Value(Value::Array(array))) => {
            let inline = array.iter_mut().filter_map(Value::as_inline_table_mut);
            inline.map(|table| table as &mut dyn TableLike).collect()
        }
        _ => Vec::new(),
    }
}

/// What is said of a path that leads nowhere.
pub const NOT_THERE: &str = "expected the path of something that the scene has";

/// Sets the value at a path from a table on; null takes it away, and what is not there is added.
pub fn in_table(table: &mut dyn TableLike, steps: &[Step<'_>], value: &Json) -> Result<(), String> {
    match steps {
        [Step::Key(key)] if value.is_null() => drop(table.remove(key)),
        [Step::Key(key)] => match table.get_mut(key) {
            Some(item) => put(item, value)?,
            None => drop(table.insert(key, Item::Value(written(value, None)?))),
        },
        [Step::Key(key), rest @ ..] => {
            if table.get(key).is_none() {
                table.insert(key, Item::Table(Table::new()));
            }
            in_item(table.get_mut(key).ok_or(NOT_THERE)?, rest, value)?;
        }
        _ => return Err(NOT_THERE.to_owned()),
    }
    Ok(())
}

fn in_item(item: &mut Item, steps: &[Step<'_>], value: &Json) -> Result<(), String> {
    match (item, steps) {
        (Item::ArrayOfTables(tables), [Step::Each, rest @ ..]) => {
            tables.iter_mut().try_for_each(|table| in_table(table, rest, value))
        }
        (Item::ArrayOfTables(tables), [Step::Entry(entry), rest @ ..]) => {
            in_table(tables.get_mut(*entry).ok_or(NOT_THERE)?, rest, value)
        }
        (Item::Value(Value::Array(array)), [step @ (Step::Each | Step::Entry(_)), rest @ ..]) => {
            in_array(array, step, rest, value)
        }
        (item, [Step::Key(_), ..]) => in_table(item.as_table_like_mut().ok_or(NOT_THERE)?, steps, value),
        _ => Err(NOT_THERE.to_owned()),
    }
}

fn in_array(array: &mut Array, step: &Step<'_>, rest: &[Step<'_>], value: &Json) -> Result<(), String> {
    let in_entry = |entry: &mut Value| match (entry, rest) {
        (entry, []) => replace(entry, value),
        (Value::InlineTable(table), rest) => in_table(table, rest, value),
        (Value::Array(array), [step, rest @ ..]) => in_array(array, step, rest, value),
        _ => Err(NOT_THERE.to_owned()),
    };
    match step {
        Step::Entry(entry) => in_entry(array.get_mut(*entry).ok_or(NOT_THERE)?),
        _ => array.iter_mut().try_for_each(in_entry),
    }
}

fn put(item: &mut Item, value: &Json) -> Result<(), String> {
    match item {
        Item::Value(old) => replace(old, value),
        _ => Err("expected a value there, not a table".to_owned()),
    }
}

/// Another value in the place of one; comments and blanks around it stay.
fn replace(old: &mut Value, value: &Json) -> Result<(), String> {
    let decor = old.decor().clone();
    *old = written(value, Some(old))?;
    *old.decor_mut() = decor;
    Ok(())
}

/// A value as a scene writes it: a whole number stays one where there was one.
fn written(value: &Json, old: Option<&Value>) -> Result<Value, String> {
    let was_whole = matches!(old, Some(Value::Integer(_)));
    match value {
        Json::Bool(flag) => Ok((*flag).into()),
        Json::String(text) => Ok(text.as_str().into()),
        Json::Number(number) => {
            let number = number.as_f64().ok_or("expected a number")?;
            if was_whole && number.fract() == 0.0 && number.abs() < 1e15 {
                return Ok((number as i64).into());
            }
            shortest(number)
        }
        Json::Array(entries) => {
            let entry = |entry| written(entry, old.and_then(Value::as_array).and_then(|array| array.get(0)));
            Ok(Value::Array(entries.iter().map(entry).collect::<Result<Array, _>>()?))
        }
        Json::Object(entries) => Ok(Value::InlineTable(table_of(entries)?)),
        Json::Null => Err("expected a number, a text, true, false or a list".to_owned()),
    }
}

/// A table in braces, in whose entries whole numbers stay such; `file` comes first.
pub fn table_of(entries: &serde_json::Map<String, Json>) -> Result<InlineTable, String> {
    let mut table = InlineTable::new();
    let (first, others): (Vec<_>, Vec<_>) = entries.iter().partition(|(key, _)| *key == "file");
    for (key, value) in first.into_iter().chain(others) {
        let value = match value.as_i64() {
            Some(whole) => whole.into(),
            None => written(value, None)?,
        };
        table.insert(key, value);
    }
    Ok(table)
}

/// The shortest text that reads back as the same number: 1e6 or 0.005.
pub fn shortest(number: f64) -> Result<Value, String> {
    let (plain, scientific) = (format!("{number:?}"), format!("{number:e}"));
    let is_long = number.abs() >= 1e5 && scientific.len() < plain.len();
    if is_long { scientific } else { plain }.parse().map_err(|_| "expected a finite number".to_owned())
}
