//! The numbers of a text and what stands above them: how they stand, the names of columns, how many there are.

use super::layout::{Layout, is_comment};
use super::names;
use crate::record::options::RecordOptions;
use crate::record::reading::numbered;
use crate::record::said;

/// Lines of a header that are looked at for unit, step and names: the last ones.
const MOST_HEADER_LINES: usize = 200;
/// Bytes of one of them.
const LONGEST_LINE: usize = 2000;

/// The lines before the numbers, and how the numbers stand.
pub(super) struct Table<'t> {
    pub text: &'t str,
    pub lines: Vec<(usize, &'t str)>,
    pub layout: Layout,
    /// Of the columns, where a line gives them as many.
    pub names: Vec<String>,
    /// Line of these.
    pub names_line: usize,
    /// Number of samples and step, with the line that says them.
    pub announced: Option<Announced>,
}

/// What a line above the samples says of them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Announced {
    pub line: usize,
    pub count: usize,
    /// s
    pub step: Option<f64>,
}

impl<'t> Table<'t> {
    /// `None` where the text holds no row of numbers.
    pub(super) fn read(text: &'t str, options: &RecordOptions) -> Option<Table<'t>> {
        let skipped = options.skip_lines;
        let mut layout = Layout::find(text, skipped.unwrap_or(0))?;
        let mut announced = None;
        if skipped.is_none()
            && let Some(found) = announced_in_rows(text, &layout, options.step)
        {
            announced = Some(found);
            layout.first = layout.rows(text).nth(1)?.0;
        }
        let above = numbered(text).take(layout.first - 1);
        let above = above.filter(|(_, line)| !line.trim().is_empty() && line.len() <= LONGEST_LINE);
        let lines: Vec<(usize, &str)> = if skipped.is_some() { Vec::new() } else { above.collect() };
        let last: Vec<(usize, &str)> = lines.iter().rev().take(MOST_HEADER_LINES).rev().copied().collect();
        let said = last.iter().rev().find_map(|(line, text)| {
            let (count, step) = said::count_and_step(text)?;
            Some(Announced { line: *line, count, step: Some(step) })
        });
        let (names_line, names) = names_above(&last, &layout).unwrap_or_default();
        Some(Table { text, lines: last, layout, names, names_line, announced: announced.or(said) })
    }
}

/// The names of the columns, with their line: the line above the numbers, of which units and the number of samples may stand below,
/// else a comment that speaks of times.
fn names_above(lines: &[(usize, &str)], layout: &Layout) -> Option<(usize, Vec<String>)> {
    const COMMENTS: usize = 3;
    let names = |(line, text): &(usize, &str)| Some((*line, names::split(text, layout.separators, layout.columns)?));
    let speaks = |(_, names): &(usize, Vec<String>)| names.first().is_some_and(|name| names::kind(name).is_along());
    let (comments, others): (Vec<_>, Vec<_>) = lines.iter().rev().partition(|(_, line)| is_comment(line));
    let below = |(_, line): &&&(usize, &str)| names::are_units(line) || said::count_and_step(line).is_some();
    let above = others.iter().find(|line| !below(line)).and_then(|line| names(line));
    if layout.columns == 1 {
        // A title is no name; that of a velocity is worth knowing.
        return above.filter(|(_, names)| {
            names::kind(&names[0]).is_of_other() && names[0].split_whitespace().count() <= COMMENTS
        });
    }
    above.or_else(|| comments.into_iter().take(COMMENTS).filter_map(names).find(speaks))
}

/// What a first row says that is none of the samples: `400 0.01` above times that begin before 400, above a sequence of 400, or
/// with the step that the user says; where there is one column the number of the rows below.
fn announced_in_rows(text: &str, layout: &Layout, step_of_user: Option<f64>) -> Option<Announced> {
    let mut rows = layout.rows(text);
    let (line, first) = rows.next()?;
    if layout.columns == 1 {
        let count = first.trim().parse().ok()?;
        return (count > 1 && rows.count() == count).then_some(Announced { line, count, step: None });
    }
    let (count, step) = said::count_and_step(first).filter(|_| layout.columns == 2)?;
    let values = || layout.rows(text).skip(1).filter_map(|(_, row)| layout.separators.numbers(row));
    let begins_before = *values().next()?.first()? < count as f64;
    let (rows, numbers) = values().fold((0, 0), |(rows, numbers), row| (rows + 1, numbers + row.len()));
    let fits = rows == count || numbers == count || step_of_user == Some(step);
    (begins_before && fits).then_some(Announced { line, count, step: Some(step) })
}
