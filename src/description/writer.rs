//! How the documents of an FMU are written: indented XML in memory, numbers and texts as its attributes have them.

use std::borrow::Cow;
use std::fmt::Write;

/// A document that is being written.
pub(super) struct Xml {
    text: String,
    /// Elements that are open.
    depth: usize,
}

/// The start of an element, for its attributes.
pub(super) struct Element<'x> {
    xml: &'x mut Xml,
    name: &'static str,
}

impl Xml {
    pub fn new() -> Xml {
        Xml { text: String::from(r#"<?xml version="1.0" encoding="UTF-8"?>"#), depth: 0 }
    }

    pub fn element(&mut self, name: &'static str) -> Element<'_> {
        self.new_line();
        self.text.push('<');
        self.text.push_str(name);
        Element { xml: self, name }
    }

    /// The whole text.
    pub fn finish(mut self) -> String {
        self.text.push('\n');
        self.text
    }

    fn new_line(&mut self) {
        self.text.push('\n');
        (0..self.depth).for_each(|_| self.text.push_str("  "));
    }
}

impl Element<'_> {
    pub fn attribute(self, name: &str, value: &str) -> Self {
        self.attribute_of(name, |text| push_escaped(text, value))
    }

    pub fn count(self, name: &str, value: usize) -> Self {
        self.attribute_of(name, |text| _ = write!(text, "{value}"))
    }

    pub fn number(self, name: &str, value: f64) -> Self {
        self.attribute_of(name, |text| push_number(text, value))
    }

    /// Ends it, with nothing in it.
    pub fn empty(self) {
        self.xml.text.push_str("/>");
    }

    /// Ends it with what is written in it.
    pub fn content(self, write: impl FnOnce(&mut Xml)) {
        let Element { xml, name } = self;
        xml.text.push('>');
        xml.depth += 1;
        write(xml);
        xml.depth -= 1;
        xml.new_line();
        for part in ["</", name, ">"] {
            xml.text.push_str(part);
        }
    }

    fn attribute_of(self, name: &str, push: impl FnOnce(&mut String)) -> Self {
        let text = &mut self.xml.text;
        for part in [" ", name, "=\""] {
            text.push_str(part);
        }
        push(text);
        text.push('"');
        self
    }
}

/// The shortest decimal that reads back as the same number, whole numbers without a point.
fn push_number(text: &mut String, value: f64) {
    let start = text.len();
    // Writing to memory cannot fail.
    _ = write!(text, "{value:?}");
    if text.get(start..).is_some_and(|number| number.ends_with(".0")) {
        text.truncate(text.len() - 2);
    }
}

fn push_escaped(text: &mut String, mut rest: &str) {
    let is_special = |byte| matches!(byte, b'<' | b'>' | b'&' | b'\'' | b'"' | b'\t' | b'\n' | b'\r');
    while let Some((plain, special)) = rest.bytes().position(is_special).and_then(|i| rest.split_at_checked(i)) {
        text.push_str(plain);
        let (entity, after) = match special.split_at(1) {
            ("<", after) => ("&lt;", after),
            (">", after) => ("&gt;", after),
            ("&", after) => ("&amp;", after),
            ("'", after) => ("&apos;", after),
            ("\"", after) => ("&quot;", after),
            ("\t", after) => ("&#9;", after),
            ("\n", after) => ("&#10;", after),
            (_, after) => ("&#13;", after),
        };
        text.push_str(entity);
        rest = after;
    }
    text.push_str(rest);
}

/// XML 1.0 has no way to write most control characters: they become blanks.
pub(super) fn text(raw: &str) -> Cow<'_, str> {
    let forbidden = |c: char| matches!(c, '\0'..='\u{1f}' | '\u{7f}' | '\u{fffe}' | '\u{ffff}');
    if raw.contains(forbidden) { raw.replace(forbidden, " ").into() } else { raw.into() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_document_as_it_is_written() {
        let mut xml = Xml::new();
        xml.element("a").attribute("b", "1 < 2 > 'x' & \"y\"\t\r\n\u{e9}").content(|xml| {
            xml.element("c").number("whole", -20.0).number("long", 0.1).number("large", 1e300).empty();
            xml.element("d").count("e", 12).content(|_| ());
        });
        let expected = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n\
             <a b=\"1 &lt; 2 &gt; &apos;x&apos; &amp; &quot;y&quot;&#9;&#13;&#10;\u{e9}\">\n  \
             <c whole=\"-20\" long=\"0.1\" large=\"1e300\"/>\n  <d e=\"12\">\n  </d>\n</a>\n";
        assert_eq!(xml.finish(), expected);
    }
}
