//! The record of a scene: the name of its file, or a table that says what the file does not.

use super::document::{self, Document, Item, KEY};
use super::problem::SceneError;
use crate::record::{Column, RecordOptions, Unit};

/// Name of the file, where there is one, and what is said about it.
pub(super) fn source(item: &Item<'_>) -> (Option<String>, RecordOptions) {
    if !item.is_table() {
        let expected = "text in quotation marks, the name of a record file, or a table { file = \"...\", step = ..., unit = \"...\" }";
        return (item.text_or(expected).map(str::to_owned), RecordOptions::default());
    }
    let mut section = item.section();
    let file = section.require("file", "the name of a record file").and_then(|item| item.text());
    let step = section.get("step").and_then(|item| step(&item));
    let unit = section.get("unit").and_then(|item| {
        let text = item.text()?;
        item.found(Unit::read(text), format!("a unit of acceleration ({})", Unit::known()))
    });
    let column = section.get("column").and_then(|item| column(&item));
    let skip_lines = section.get("skip_lines").and_then(|item| {
        item.found(item.whole_number(), "how many lines above the numbers are not read, a whole number")
    });
    let remove_mean = section.get("remove_mean").is_some_and(|item| item.boolean());
    section.close(KEY);
    (file.map(str::to_owned), RecordOptions { step, unit, column, skip_lines, remove_mean })
}

/// s
fn step(item: &Item<'_>) -> Option<f64> {
    if !item.is_number() {
        item.refuse("the s from sample to sample, a number > 0");
        return None;
    }
    let step = item.number();
    let fits = step > 0.0 && step <= MOST_STEP;
    item.found(fits.then_some(step), format!("the s from sample to sample, a number > 0 and at most {MOST_STEP}"))
}

/// s
const MOST_STEP: f64 = 1e6;

fn column(item: &Item<'_>) -> Option<Column> {
    if item.is_text() {
        return item.text().map(|name| Column::Name(name.to_owned()));
    }
    let number = item.whole_number().filter(|number| *number > 0).map(Column::Number);
    item.found(number, "the number of a column, from 1 on, or its name in quotation marks")
}

/// A record as the parameter `ground.record` names it: the name of a file, or a table as a scene has it, in braces.
///
/// # Errors
/// All problems of such a table.
pub fn record_source(text: &str) -> Result<(String, RecordOptions), SceneError> {
    let trimmed = text.trim();
    if !(trimmed.starts_with('{') && trimmed.ends_with('}')) || std::path::Path::new(text).exists() {
        return Ok((text.to_owned(), RecordOptions::default()));
    }
    in_scene(&format!("ground.record = {trimmed}"))
}

/// The same of the keys of such a table as lines of TOML.
///
/// # Errors
/// All problems of them.
pub fn record_table(lines: &str) -> Result<(String, RecordOptions), SceneError> {
    in_scene(&format!("[ground.record]\n{lines}"))
}

fn in_scene(text: &str) -> Result<(String, RecordOptions), SceneError> {
    let table = document::parse(text)?;
    let document = Document::new(text);
    let mut ground = document.root(&table).section("ground");
    let (file, options) = ground.get("record").map(|item| source(&item)).unwrap_or_default();
    let problems = document.into_problems();
    if problems.is_empty() { Ok((file.unwrap_or_default(), options)) } else { Err(SceneError { problems }) }
}
