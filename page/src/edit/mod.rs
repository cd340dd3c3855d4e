//! Values of a scene's text, set by path; comments and layout stay.
//!
//! Paths are those of problems: `contact[1].gap`, entries counted from 1; `contact[*].gap` is that of every contact. Two
//! are more than a value: `left.storeys`, whose change makes lists longer or shorter (`storeys.rs`), and `law`, with which
//! the numbers go that the new law does not have (`law.rs`). A value of null takes its key away.

mod law;
mod storeys;

use crate::message::Refusal;
use pounding::scene::Scene;
use serde_json::Value as Json;
use toml_edit::{Array, DocumentMut, Item, Table, TableLike, Value};

/// A step of a path.
enum Step<'p> {
    Key(&'p str),
    /// Counted from 0.
    Entry(usize),
    Each,
}

/// The text with these changes, one after the other.
pub fn edited(scene: &[u8], changes: &[(String, Json)]) -> Result<String, Refusal> {
    let text = std::str::from_utf8(scene).map_err(|_| Refusal::value("the scene is not UTF-8 text"))?;
    let mut document: DocumentMut = text.parse().map_err(|_| no_toml(text))?;
    for (path, value) in changes {
        change(&mut document, path, value).map_err(|problem| Refusal::value(format!("{path} = {value}: {problem}")))?;
    }
    Ok(document.to_string())
}

/// What is wrong with a text that is not TOML, in the words of the scene.
fn no_toml(text: &str) -> Refusal {
    Scene::from_toml(text).err().map_or_else(|| Refusal::value("the scene is not valid TOML"), Refusal::from)
}

fn change(document: &mut DocumentMut, path: &str, value: &Json) -> Result<(), String> {
    if let Some(side) = path.strip_suffix(".storeys") {
        return storeys::set(document, side, value);
    }
    let steps = steps(path).ok_or("expected a path such as contact[1].gap")?;
    if let ([Step::Key("contact"), which, Step::Key("law")], Some(name)) = (&steps[..], value.as_str()) {
        return law::set(document, Some(which), name);
    }
    if let ([Step::Key("facing"), Step::Key("law")], Some(name)) = (&steps[..], value.as_str()) {
        return law::set(document, None, name);
    }
    in_table(document.as_table_mut(), &steps, value)
}

fn steps(path: &str) -> Option<Vec<Step<'_>>> {
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

const NOT_THERE: &str = "expected the path of something that the scene has";

fn in_table(table: &mut dyn TableLike, steps: &[Step<'_>], value: &Json) -> Result<(), String> {
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
        Json::Null | Json::Object(_) => Err("expected a number, a text, true, false or a list".to_owned()),
    }
}

/// The shortest text that reads back as the same number: 1e6 or 0.005.
fn shortest(number: f64) -> Result<Value, String> {
    let (plain, scientific) = (format!("{number:?}"), format!("{number:e}"));
    let is_long = number.abs() >= 1e5 && scientific.len() < plain.len();
    if is_long { scientific } else { plain }.parse().map_err(|_| "expected a finite number".to_owned())
}

#[cfg(test)]
mod tests;
