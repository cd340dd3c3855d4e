//! Several components in one file, and which one is wanted.

use super::error::RecordError;
use super::options::Column;

/// Names of components that a message lists.
const SHOWN: usize = 20;

/// A component as its file calls it.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Component {
    /// Empty where the file says nothing.
    pub name: String,
    /// That the file gives it, else its place.
    pub number: usize,
}

impl Component {
    pub(super) fn new(number: usize, name: impl Into<String>) -> Component {
        Component { number, name: name.into() }
    }
}

/// Whether the name of a component says that it is vertical: `Up`, `U-D`, `Z`, `HNZ`, `vertical`.
pub(super) fn is_vertical(name: &str) -> bool {
    let words = name.split(|c: char| !c.is_alphanumeric() && c != '-').filter(|word| !word.is_empty());
    words.map(str::to_lowercase).any(|word| {
        let is_channel =
            word.len() == 3 && word.ends_with('z') && word.chars().nth(1).is_some_and(|c| "hngl".contains(c));
        is_channel
            || word.starts_with("vert")
            || ["up", "u", "ud", "u-d", "z", "v", "down", "dwn", "dn", "updo", "ver"].contains(&word.as_str())
    })
}

/// The place of the one that is wanted, or of the first horizontal one.
pub(super) fn choose(components: &[Component], wanted: Option<&Column>) -> Result<usize, RecordError> {
    let Some(wanted) = wanted else {
        return Ok(components.iter().position(|component| !is_vertical(&component.name)).unwrap_or(0));
    };
    named(components, wanted).ok_or_else(|| RecordError::new(none_such(components, wanted)))
}

/// The place of the one with that number, or with that name: all of it, what stands behind its colon, else its beginning.
pub(super) fn named(components: &[Component], wanted: &Column) -> Option<usize> {
    match wanted {
        Column::Number(number) => components.iter().position(|component| component.number == *number),
        Column::Name(name) => {
            let name = plain(name);
            let whole = components.iter().position(|component| plain(&component.name) == name);
            let behind = |name: &str| name.split_once(':').map(|(_, behind)| plain(behind));
            let direction = components.iter().position(|component| behind(&component.name).as_ref() == Some(&name));
            whole.or(direction).or_else(|| {
                let mut begin =
                    components.iter().enumerate().filter(|(_, found)| plain(&found.name).starts_with(&name));
                let first = begin.next().filter(|_| !name.is_empty())?;
                begin.next().is_none().then_some(first.0)
            })
        }
    }
}

/// A name without what is written in several ways.
fn plain(name: &str) -> String {
    name.chars().filter(|c| c.is_alphanumeric()).flat_map(char::to_lowercase).collect()
}

/// What to say where there is none of that number or name.
pub(super) fn none_such(components: &[Component], wanted: &Column) -> String {
    format!("#{wanted}: expected one of {}", listed(components))
}

/// The components, with what each can be asked for by.
pub(super) fn listed(components: &[Component]) -> String {
    let one = |component: &Component| match component.name.as_str() {
        "" => format!("#{}", component.number),
        name => format!("#{} {name}", component.number),
    };
    let shown: Vec<String> = components.iter().take(SHOWN).map(one).collect();
    let more = if components.len() > SHOWN { format!(", ... {} in all", components.len()) } else { String::new() };
    format!("{}{more}", shown.join(", "))
}
