//! Values of a scene's text, set by path; comments and layout stay.
//!
//! Paths are those of problems: `contact[1].gap`, entries counted from 1; `contact[*].gap` is that of every contact. Two
//! are more than a value: `left.storeys` or `building[2].storeys`, whose change makes lists longer or shorter (`storeys.rs`), and
//! `law`, with which the numbers go that the new law does not have (`law.rs`). `path.rs` finds and sets a value, `building.rs`
//! the buildings. A value of null takes its key away.

mod building;
mod law;
mod path;
mod storeys;

use crate::message::Refusal;
use path::{Step, in_table, steps};
use pounding::scene::Scene;
use serde_json::Value as Json;
use toml_edit::DocumentMut;

pub use path::table_of;

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
    if let Some(building) = path.strip_suffix(".storeys") {
        return storeys::set(document, building, value);
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

#[cfg(test)]
mod tests;
