//! How the documents of an FMU are written: indented XML in memory, numbers and texts as its attributes have them.

use quick_xml::Writer;
use std::borrow::Cow;

/// A document that is being written.
pub(super) type Xml = Writer<Vec<u8>>;

/// The shortest decimal that reads back as the same number, whole numbers without a point.
pub(super) fn number(value: f64) -> String {
    let text = format!("{value:?}");
    text.strip_suffix(".0").unwrap_or(&text).to_owned()
}

/// XML 1.0 has no way to write most control characters: they become blanks.
pub(super) fn text(raw: &str) -> Cow<'_, str> {
    let forbidden = |c: char| matches!(c, '\0'..='\u{1f}' | '\u{7f}' | '\u{fffe}' | '\u{ffff}');
    if raw.contains(forbidden) { raw.replace(forbidden, " ").into() } else { raw.into() }
}
