//! How the numbers of a text stand: where they begin, what sets them apart, how many stand in a row.

use crate::record::numbers::{fortran_number, numbers_of};
use crate::record::reading::numbered;
use std::collections::BTreeMap;

/// Columns and words beyond these are not looked at.
const MOST_FIELDS: usize = 200;
/// Rows from which the layout is told.
const LOOKED_AT: usize = 1000;

/// What sets the columns apart, and what the decimals.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Separators {
    /// A blank for any number of them.
    pub column: char,
    pub has_decimal_comma: bool,
}

/// In the order in which they are preferred.
const KNOWN: [Separators; 5] = [
    Separators { column: ';', has_decimal_comma: false },
    Separators { column: ',', has_decimal_comma: false },
    Separators { column: ' ', has_decimal_comma: false },
    Separators { column: ';', has_decimal_comma: true },
    Separators { column: ' ', has_decimal_comma: true },
];

impl Separators {
    /// A separator at the end of a row sets nothing apart.
    pub(super) fn fields(self, row: &str) -> Vec<&str> {
        let row = row.trim();
        match self.column {
            ' ' => row.split_whitespace().take(MOST_FIELDS).collect(),
            mark => row.trim_end_matches(mark).split(mark).take(MOST_FIELDS).map(str::trim).collect(),
        }
    }

    pub(super) fn number(self, field: &str) -> Option<f64> {
        let field = field.trim_matches('"');
        if !self.has_decimal_comma {
            return fortran_number(field);
        }
        match field.split_once(',') {
            Some((_, decimals)) if !decimals.starts_with(|c: char| c.is_ascii_digit()) => None,
            Some(_) if field.contains('.') => None,
            _ => fortran_number(&field.replacen(',', ".", 1)),
        }
    }

    /// The numbers of a row, where it holds nothing else. Those of fixed columns may touch: `-.1E-01-.2E-01`.
    pub(super) fn numbers(self, row: &str) -> Option<Vec<f64>> {
        let may_touch = self.column == ' ' && !self.has_decimal_comma;
        let mut values = Vec::new();
        for field in self.fields(row) {
            match self.number(field) {
                Some(value) => values.push(value),
                None if may_touch && field.contains('.') => values.extend(numbers_of(field)?),
                None => return None,
            }
        }
        (!values.is_empty()).then_some(values)
    }
}

/// The numbers of a text.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Layout {
    pub separators: Separators,
    /// Line of the first row, counted from 1.
    pub first: usize,
    /// Numbers in most rows.
    pub columns: usize,
}

impl Layout {
    /// That under which most rows hold as many numbers; `None` where no row is one of numbers.
    pub(super) fn find(text: &str, skipped: usize) -> Option<Layout> {
        let mut best: Option<((usize, usize), Layout)> = None;
        for separators in KNOWN {
            let Some((rows, layout)) = Layout::under(separators, text, skipped) else { continue };
            if best.is_none_or(|(most, _)| rows > most) {
                best = Some((rows, layout));
            }
        }
        let (rows, found) = best?;
        let commas = Separators { column: ',', has_decimal_comma: false };
        if found.separators == commas && found.columns == 2 && has_decimals_behind_commas(text, &found) {
            let one = Separators { column: ';', has_decimal_comma: true };
            let single = Layout::under(one, text, skipped).filter(|(most, _)| *most == rows);
            return Some(single.map_or(found, |(_, layout)| layout));
        }
        Some(found)
    }

    /// The layout under some separators, how many rows are of numbers only, and how many of them have it.
    fn under(separators: Separators, text: &str, skipped: usize) -> Option<((usize, usize), Layout)> {
        let rows = rows(text, skipped).filter_map(|(line, row)| Some((line, separators.numbers(row)?.len())));
        let rows: Vec<(usize, usize)> = rows.take(LOOKED_AT).collect();
        let mut with = BTreeMap::new();
        rows.iter().for_each(|(_, count)| *with.entry(*count).or_insert(0) += 1);
        // Of as many rows of each the wider ones: the others are the ends of theirs.
        let (columns, most) = with.into_iter().max_by_key(|(count, rows)| (*rows, *count))?;
        let first = rows.iter().find(|(_, count)| *count == columns)?.0;
        Some(((rows.len(), most), Layout { separators, first, columns }))
    }

    /// The rows from the first one on, each with its line.
    pub(super) fn rows<'t>(&self, text: &'t str) -> impl Iterator<Item = (usize, &'t str)> + use<'t> {
        rows(text, self.first - 1)
    }
}

/// Lines that are neither blank nor comments, behind those that are skipped.
fn rows(text: &str, skipped: usize) -> impl Iterator<Item = (usize, &str)> {
    numbered(text).skip(skipped).filter(|(_, line)| !line.trim().is_empty() && !is_comment(line))
}

/// Whether what looks like two columns, `0,0030` below `0,0031`, is one with decimal commas: whole numbers only, and the first
/// ones are no times.
fn has_decimals_behind_commas(text: &str, found: &Layout) -> bool {
    let rows: Vec<&str> = found.rows(text).map(|(_, row)| row).take(LOOKED_AT).collect();
    let times = rows.iter().filter_map(|row| found.separators.number(found.separators.fields(row).first()?));
    let times: Vec<f64> = times.collect();
    rows.iter().all(|row| !row.contains(['.', '"', ' '])) && !times.windows(2).all(|pair| pair[1] > pair[0])
}

pub(super) fn is_comment(line: &str) -> bool {
    line.trim_start().starts_with(['#', '%', '!'])
}
