//! A TOML text as a tree that is read value by value and reports everything that does not fit.
//!
//! A value that does not fit is reported once, where it stands, and a neutral value is handed on in its place.

use super::problem::{Problem, SceneError, count, excerpt};
use super::rule::Rule;
use super::syntax;
use super::units::Units;
use std::cell::RefCell;
use std::collections::HashMap;
use std::ops::Range;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// What is expected where a key is not known.
pub(super) const KEY: &str = "a known key";

/// The text and what was found wrong with it so far.
pub(super) struct Document<'t> {
    text: &'t str,
    problems: RefCell<Vec<Problem>>,
}

/// One table of the document; an absent one reads as empty and reports nothing as missing.
pub(super) struct Section<'t> {
    document: &'t Document<'t>,
    path: String,
    source: &'t str,
    table: Option<&'t DeTable<'t>>,
    known: Vec<&'static str>,
}

/// One value of the document.
pub(super) struct Item<'t> {
    document: &'t Document<'t>,
    path: String,
    value: &'t Spanned<DeValue<'t>>,
}

/// Parses the text; a text that is not TOML is one problem, with line and column.
pub(super) fn parse(text: &str) -> Result<DeTable<'_>, SceneError> {
    DeTable::parse(text).map(Spanned::into_inner).map_err(|error| {
        let before = text.get(..error.span().map_or(0, |span| span.start)).unwrap_or(text);
        let line = before.matches('\n').count() + 1;
        let column = before.chars().rev().take_while(|&c| c != '\n').count() + 1;
        let expected = syntax::expected(text.lines().nth(line - 1).unwrap_or_default(), error.message());
        Problem::new(format!("line {line}, column {column}"), "", expected).into()
    })
}

/// Where a value stands in the text, in bytes.
pub(super) struct TextSpan {
    /// Of its key, where it has one.
    pub start: usize,
    /// Of the value, where that is a number, a text or a list: tables may be spread over the file.
    pub value: Option<Range<usize>>,
}

/// Where everything stands, by its path.
pub(super) fn spans(table: &DeTable<'_>) -> HashMap<String, TextSpan> {
    fn of_table(path: &str, table: &DeTable<'_>, spans: &mut HashMap<String, TextSpan>) {
        for (key, value) in table.iter() {
            let path = join(path, key.get_ref());
            of_value(&path, value, spans);
            spans.insert(path, TextSpan { start: key.span().start, value: text_of(value) });
        }
    }
    fn of_value(path: &str, value: &Spanned<DeValue<'_>>, spans: &mut HashMap<String, TextSpan>) {
        match value.get_ref() {
            DeValue::Table(table) => of_table(path, table, spans),
            DeValue::Array(entries) => {
                for (i, entry) in entries.iter().enumerate() {
                    let path = format!("{path}[{}]", i + 1);
                    of_value(&path, entry, spans);
                    spans.insert(path, TextSpan { start: entry.span().start, value: text_of(entry) });
                }
            }
            _ => {}
        }
    }
    fn text_of(value: &Spanned<DeValue<'_>>) -> Option<Range<usize>> {
        (!matches!(value.get_ref(), DeValue::Table(_))).then(|| value.span())
    }
    let mut spans = HashMap::new();
    of_table("", table, &mut spans);
    spans
}

/// Where a path begins in the text, or the nearest table above it that there is.
pub(super) fn place(path: &str, spans: &HashMap<String, TextSpan>) -> Option<usize> {
    let ends = path.char_indices().rev().filter(|&(_, c)| matches!(c, '.' | '[')).map(|(end, _)| end);
    let mut from_whole_to_root = std::iter::once(path.len()).chain(ends).filter_map(|end| path.get(..end));
    from_whole_to_root.find_map(|part| Some(spans.get(part)?.start))
}

impl<'t> Document<'t> {
    pub(super) fn new(text: &'t str) -> Document<'t> {
        Document { text, problems: RefCell::default() }
    }

    pub(super) fn root(&'t self, table: &'t DeTable<'t>) -> Section<'t> {
        Section { document: self, path: String::new(), source: self.text, table: Some(table), known: Vec::new() }
    }

    pub(super) fn into_problems(self) -> Vec<Problem> {
        self.problems.into_inner()
    }

    fn report(&self, path: &str, found: &str, expected: impl Into<String>) {
        self.problems.borrow_mut().push(Problem::new(path, excerpt(found), expected));
    }

    fn source(&self, value: &Spanned<DeValue<'_>>) -> &'t str {
        self.text.get(value.span()).unwrap_or_default()
    }
}

impl<'t> Section<'t> {
    /// The value of a key, if it is there.
    pub(super) fn get(&mut self, key: &'static str) -> Option<Item<'t>> {
        if !self.known.contains(&key) {
            self.known.push(key);
        }
        let value = self.table?.get(key)?;
        Some(Item { document: self.document, path: join(&self.path, key), value })
    }

    /// Reports a key that belongs elsewhere, if it is there; `expected` says what instead.
    pub(super) fn refuse_key(&mut self, key: &'static str, expected: &str) {
        if self.table.is_some_and(|table| table.contains_key(key)) {
            self.get(key).inspect(|item| item.refuse(expected));
        }
    }

    /// The value of a key that must be there; `what` says what for.
    pub(super) fn require(&mut self, key: &'static str, what: &str) -> Option<Item<'t>> {
        let item = self.get(key);
        if item.is_none() {
            self.missing(key, what);
        }
        item
    }

    /// Reports that a key is missing; `what` says what for.
    pub(super) fn missing(&self, key: &str, what: &str) {
        if self.table.is_some() {
            self.document.report(&join(&self.path, key), "", format!("{what} (missing)"));
        }
    }

    /// Reports what is wrong at a path below this table, as it is written there.
    pub(super) fn refuse_at(&self, below: &str, found: &str, expected: impl Into<String>) {
        let path = if self.path.is_empty() { below.to_owned() } else { format!("{}.{below}", self.path) };
        self.document.report(&path, found, expected);
    }

    /// Where it stands.
    pub(super) fn path(&self) -> &str {
        &self.path
    }

    /// The table of a key; absent where the key is.
    pub(super) fn section(&mut self, key: &'static str) -> Section<'t> {
        let path = join(&self.path, key);
        self.get(key).map_or_else(|| self.absent(path), |item| item.section())
    }

    /// Reports that something is wrong with the table as a whole.
    pub(super) fn refuse(&self, expected: impl Into<String>) {
        if self.table.is_some() {
            self.document.report(&self.path, self.source, expected);
        }
    }

    /// Reports the keys that nobody has asked for; `what` says what kind of key is expected.
    pub(super) fn close(self, what: &str) {
        for (key, value) in self.table.into_iter().flat_map(DeTable::iter) {
            let key = key.get_ref();
            if !self.known.contains(&key.as_ref()) {
                let expected = one_of(what, &self.known, key);
                self.document.report(&join(&self.path, key), self.document.source(value), expected);
            }
        }
    }

    fn absent(&self, path: String) -> Section<'t> {
        Section { document: self.document, path, source: "", table: None, known: Vec::new() }
    }
}

impl<'t> Item<'t> {
    pub(super) fn refuse(&self, expected: impl Into<String>) {
        self.document.report(&self.path, self.document.source(self.value), expected);
    }

    /// The same of what shows as `found`.
    pub(super) fn refuse_as(&self, found: &str, expected: impl Into<String>) {
        self.document.report(&self.path, found, expected);
    }

    /// What has been made of the value; where that is nothing, it is refused.
    pub(super) fn found<T>(&self, value: Option<T>, expected: impl Into<String>) -> Option<T> {
        if value.is_none() {
            self.refuse(expected);
        }
        value
    }

    /// A number in a unit without mass and force. Neutral: NaN.
    pub(super) fn number(&self) -> f64 {
        self.quantity(Units::Si)
    }

    /// The SI number of one in a unit with a mass or a force. Neutral: NaN.
    pub(super) fn quantity(&self, units: Units) -> f64 {
        let value = match self.value.get_ref() {
            // What TOML calls a number but is too large for a double would read as infinite.
            DeValue::Float(float) => match units.read(float.as_str()) {
                Some(v) if v.is_finite() || float.as_str().contains(['n', 'N']) => Some(v),
                _ => {
                    self.refuse(format!("a number that double precision holds, up to {}", units.largest()));
                    return f64::NAN;
                }
            },
            DeValue::Integer(integer) if integer.radix() == 10 => units.read(integer.as_str()),
            DeValue::Integer(integer) => {
                let value = u64::from_str_radix(integer.as_str(), integer.radix()).ok();
                value.and_then(|value| units.read(&value.to_string()))
            }
            _ => None,
        };
        self.found(value, "a number").unwrap_or(f64::NAN)
    }

    /// Reports what is wrong with a number that has no place in the scene.
    pub(super) fn look_at(&self, rule: Rule, units: Units) {
        let known = self.document.problems.borrow().len();
        let value = self.quantity(rule.units(units));
        let is_readable = self.document.problems.borrow().len() == known;
        if is_readable && !rule.holds(value) {
            self.refuse(rule.expected(units));
        }
    }

    /// The same of a list of one number for each floor or storey, as `each` says, where it is known how many there are.
    pub(super) fn look_at_list(&self, rule: Rule, units: Units, floors: usize, each: &str) {
        let Some(entries) = self.list("a list of numbers") else { return };
        if floors > 0 && entries.len() != floors {
            self.refuse(format!("{}, one per {each}, not {}", count(floors, "number"), entries.len()));
        }
        entries.iter().for_each(|entry| entry.look_at(rule, units));
    }

    /// Neutral: 0.
    pub(super) fn count(&self) -> usize {
        self.whole().unwrap_or_default()
    }

    /// A whole number, 0 included, about which nothing has been said; `None` where that has been done.
    pub(super) fn whole(&self) -> Option<usize> {
        self.found(self.whole_number(), "a whole number from 1 on")
    }

    /// A whole number, 0 included; nothing is said where it is none.
    pub(super) fn whole_number(&self) -> Option<usize> {
        let integer = self.value.get_ref().as_integer()?;
        usize::from_str_radix(integer.as_str(), integer.radix()).ok()
    }

    /// Neutral: false.
    pub(super) fn boolean(&self) -> bool {
        self.found(self.value.get_ref().as_bool(), "true or false").unwrap_or_default()
    }

    pub(super) fn text(&self) -> Option<&'t str> {
        self.text_or("text in quotation marks")
    }

    /// A text; `expected` says what instead of another value.
    pub(super) fn text_or(&self, expected: &str) -> Option<&'t str> {
        self.found(self.value.get_ref().as_str(), expected)
    }

    /// What one of some names stands for; `what` says what kind of name is expected.
    pub(super) fn choice<T>(&self, what: &str, names: &[&str], meaning: impl Fn(&str) -> Option<T>) -> Option<T> {
        self.named(meaning, |name| one_of(what, names, name))
    }

    /// What a name stands for; `expected` says what instead of a name that there is not.
    pub(super) fn named<T>(&self, meaning: impl Fn(&str) -> Option<T>, expected: impl Fn(&str) -> String) -> Option<T> {
        let name = self.text()?;
        meaning(name).or_else(|| self.found(None, expected(name)))
    }

    /// `None` where it is no list; `what` says what kind of list is expected.
    pub(super) fn list(&self, what: &str) -> Option<Vec<Item<'t>>> {
        let entries = self.found(self.value.get_ref().as_array(), what)?;
        let item = |(i, value)| Item { document: self.document, path: format!("{}[{}]", self.path, i + 1), value };
        Some(entries.iter().enumerate().map(item).collect())
    }

    /// As [`Item::number`]. Neutral: empty.
    pub(super) fn numbers(&self) -> Vec<f64> {
        self.quantities(Units::Si)
    }

    /// As [`Item::quantity`]. Neutral: empty.
    pub(super) fn quantities(&self, units: Units) -> Vec<f64> {
        // One number is what it takes for one floor, and brackets; rows of matrices are another matter.
        let what = match self.value.get_ref() {
            DeValue::Float(_) | DeValue::Integer(_) if !self.path.ends_with(']') => {
                let number = excerpt(self.document.source(self.value));
                let one = self.what_an_entry_is_of();
                format!("a list of numbers, [{number}] for one {one}, [{number}, {number}] for two")
            }
            _ => "a list of numbers".to_owned(),
        };
        self.list(&what).iter().flatten().map(|entry| entry.quantity(units)).collect()
    }

    /// What a list in a building has one number for.
    fn what_an_entry_is_of(&self) -> &'static str {
        match self.path.rsplit('.').next() {
            Some("stiffness" | "height" | "yield_force" | "post_yield_ratio" | "dashpots") => "storey",
            Some("ratios") => "mode",
            _ => "floor",
        }
    }

    /// Whether it is a text.
    pub(super) fn is_text(&self) -> bool {
        self.value.get_ref().is_str()
    }

    /// Whether it is a table.
    pub(super) fn is_table(&self) -> bool {
        self.value.get_ref().is_table()
    }

    /// Whether it is a number.
    pub(super) fn is_number(&self) -> bool {
        matches!(self.value.get_ref(), DeValue::Float(_) | DeValue::Integer(_))
    }

    /// As it is written.
    pub(super) fn written(&self) -> String {
        excerpt(self.document.source(self.value))
    }

    /// Whether it is a list.
    pub(super) fn is_list(&self) -> bool {
        self.value.get_ref().as_array().is_some()
    }

    /// As [`Item::quantity`]. Neutral: empty.
    pub(super) fn rows(&self, units: Units) -> Vec<Vec<f64>> {
        let rows = self.list("a list of rows, each a list of numbers");
        rows.iter().flatten().map(|row| row.quantities(units)).collect()
    }

    /// The tables of a key that there may be many of, `[[key]]`. Neutral: none.
    pub(super) fn tables(&self, key: &str) -> Vec<Section<'t>> {
        if self.value.get_ref().is_table() {
            self.refuse(format!("[[{key}]], with two brackets on either side, above every {key}"));
            return Vec::new();
        }
        self.list(&format!("[[{key}]] tables")).iter().flatten().map(Item::section).collect()
    }

    /// Neutral: absent.
    pub(super) fn section(&self) -> Section<'t> {
        let table = self.found(self.value.get_ref().as_table(), "a table");
        let source = self.document.source(self.value);
        Section { document: self.document, path: self.path.clone(), source, table, known: Vec::new() }
    }
}

/// A choice among names, with the nearest one where the difference looks like a slip.
pub(super) fn one_of(what: &str, names: &[&str], found: &str) -> String {
    let suggestion = nearest(names, found).map(|name| format!("; did you mean {name}?")).unwrap_or_default();
    format!("{what} ({}){suggestion}", names.join(", "))
}

fn nearest<'n>(names: &[&'n str], found: &str) -> Option<&'n str> {
    let (distance, name) = names.iter().map(|&name| (edits(name, found), name)).min()?;
    (distance <= 1 + name.len() / 4).then_some(name)
}

/// Letters inserted, left out or changed between two words (Levenshtein's distance).
fn edits(from: &str, to: &str) -> usize {
    let mut row: Vec<usize> = (0..=to.chars().count()).collect();
    for (i, a) in from.chars().enumerate() {
        let mut diagonal = i;
        let mut left = i + 1;
        for (cell, b) in row.iter_mut().skip(1).zip(to.chars()) {
            let changed = diagonal + usize::from(a != b);
            diagonal = *cell;
            left = changed.min(left + 1).min(*cell + 1);
            *cell = left;
        }
    }
    row.last().copied().unwrap_or_default()
}

fn join(path: &str, key: &str) -> String {
    let bare = !key.is_empty() && key.chars().all(|c| c.is_ascii_alphanumeric() || c == '_' || c == '-');
    let key = if bare { key.to_owned() } else { format!("{key:?}") };
    if path.is_empty() { key } else { format!("{path}.{key}") }
}
