//! How the documents of an FMU are written: indented XML in memory, numbers and texts as its attributes have them.

use quick_xml::Writer;
use std::borrow::Cow;
use std::io;

/// A document that is being written.
pub(super) type Xml = Writer<Vec<u8>>;

/// Writes an element that has nothing in it.
pub(super) fn leaf<'a>(
    xml: &mut Xml,
    name: &'static str,
    attributes: impl IntoIterator<Item = (&'a str, &'a str)>,
) -> io::Result<()> {
    xml.create_element(name).with_attributes(attributes).write_empty().map(|_| ())
}

/// Writes an element around others.
pub(super) fn branch<'a>(
    xml: &mut Xml,
    name: &'static str,
    attributes: impl IntoIterator<Item = (&'a str, &'a str)>,
    content: impl FnOnce(&mut Xml) -> io::Result<()>,
) -> io::Result<()> {
    xml.create_element(name).with_attributes(attributes).write_inner_content(content).map(|_| ())
}

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
