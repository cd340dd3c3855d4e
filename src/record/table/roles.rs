//! Which column is the time and which the acceleration, or whether the numbers are one sequence.

use super::found::Table;
use super::layout::Layout;
use super::names::{self, Kind};
use crate::figures::plain;
use crate::record::components::{self, Component};
use crate::record::options::{Column, RecordOptions};
use crate::record::reading::{Reading, excerpt, on_line, other_interval};
use crate::record::said;

/// Rows from which on a first column that grows cannot be an acceleration.
const ROWS_OF_TIMES: usize = 4;
const LOOKED_AT: usize = 1000;

/// What the numbers are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Roles {
    /// Accelerations only, one after the other.
    Sequence { step: f64 },
    /// Time and acceleration in turn, several pairs in a line.
    Pairs,
    /// A row a sample: the column of the times, or the step; where there are both they are compared.
    Column { time: Option<usize>, step: Option<f64>, column: usize },
}

/// What the numbers are, by the names of the columns, by what the user says, and by the numbers themselves. What is missing or
/// contradicts is refused.
pub(super) fn find(table: &Table<'_>, options: &RecordOptions, reading: &mut Reading) -> Option<Roles> {
    let columns = table.layout.columns;
    let kinds: Vec<Kind> = table.names.iter().map(|name| names::kind(name)).collect();
    if refuses_names(table, &kinds, options, reading) {
        return None;
    }
    let step = step(table, options, reading);
    if options.column.is_none() && table.names.is_empty() && are_pairs(table) {
        return Some(Roles::Pairs);
    }
    let is_counter = kinds.first() == Some(&Kind::Counter);
    let first = first_column(table);
    let time = match kinds.first() {
        _ if columns == 1 => false,
        Some(Kind::Time) => true,
        Some(Kind::Counter) => false,
        _ => is_time(&first, step, columns),
    };
    match (time, step, columns) {
        (false, None, _) => {
            refuse(table, reading, without_step(table, columns, is_counter));
            None
        }
        (false, Some(step), 1) => Some(Roles::Sequence { step }),
        (false, Some(step), _) if options.column.is_none() && table.names.is_empty() && !is_counter => {
            Some(Roles::Sequence { step })
        }
        (true, step, _) => {
            column(table, &kinds, options, 1, reading).map(|column| Roles::Column { time: Some(0), step, column })
        }
        (false, step, _) => column(table, &kinds, options, usize::from(is_counter), reading)
            .map(|column| Roles::Column { time: None, step, column }),
    }
}

/// Names that are none of a ground motion over time.
fn refuses_names(table: &Table<'_>, kinds: &[Kind], options: &RecordOptions, reading: &mut Reading) -> bool {
    let Some(first) = kinds.first() else { return false };
    let is_spectral = kinds.contains(&Kind::Spectral)
        || table.names.iter().any(|name| names::is_amplitude(name)) && !matches!(first, Kind::Time | Kind::OtherTime);
    let later_time = kinds.iter().skip(1).any(|kind| matches!(kind, Kind::Time | Kind::OtherTime));
    let expected = match first {
        _ if *first == Kind::Period || is_spectral => "times and accelerations: this is a spectrum",
        Kind::OtherTime => "times in s",
        Kind::OtherMotion if kinds.len() == 1 => "an acceleration",
        _ if later_time => "the time first",
        Kind::Counter
            if options.step.or(table.announced.and_then(|said| said.step)).is_none()
                && step_in_header(table).is_none() =>
        {
            "times in s, not a count: say step = ..., in s"
        }
        _ => return false,
    };
    let line = table.lines.iter().find(|(line, _)| *line == table.names_line).map_or("", |(_, line)| line);
    reading.refuse(|| on_line(table.names_line, format!("{}: expected {expected}", excerpt(line))));
    true
}

fn step_in_header(table: &Table<'_>) -> Option<(usize, f64)> {
    table.lines.iter().rev().find_map(|(line, text)| Some((*line, said::step(text)?)))
}

/// s: what the user says, compared with what the header says.
fn step(table: &Table<'_>, options: &RecordOptions, reading: &mut Reading) -> Option<f64> {
    let said = table.announced.and_then(|said| Some((said.line, said.step?))).or_else(|| step_in_header(table));
    if let (Some(step), Some((line, said))) = (options.step, said)
        && (step - said).abs() > 1e-6 * said
    {
        let (step, said) = (plain(step), plain(said));
        reading
            .refuse(|| on_line(line, format!("the file says {said} s: expected step = {said}, not {step}, or none")));
    }
    options.step.or(said.map(|(_, step)| step))
}

/// The first numbers of the first rows.
fn first_column(table: &Table<'_>) -> Vec<f64> {
    let Layout { separators, columns, .. } = table.layout;
    let rows = table.layout.rows(table.text).filter_map(|(_, row)| separators.numbers(row));
    rows.filter(|values| values.len() == columns).take(LOOKED_AT).map(|values| values[0]).collect()
}

/// Whether every other number of rows of four and more is a time: they grow from row to row and within each.
fn are_pairs(table: &Table<'_>) -> bool {
    const ROWS: usize = 3;
    let Layout { separators, columns, .. } = table.layout;
    if columns < 4 || columns % 2 == 1 {
        return false;
    }
    let rows = table.layout.rows(table.text).filter_map(|(_, row)| separators.numbers(row)).take(LOOKED_AT);
    let times: Vec<f64> = rows.flat_map(|row| row.into_iter().step_by(2)).collect();
    times.len() >= ROWS * columns / 2 && times.windows(2).all(|pair| pair[1] > pair[0])
}

/// Whether a first column without a name is the time.
fn is_time(first: &[f64], step: Option<f64>, columns: usize) -> bool {
    let grows = first.windows(2).all(|pair| pair[1] > pair[0]);
    match step {
        // Two columns and nothing else: if they are wrong, that is said line by line.
        None => columns == 2 || grows && first.len() >= ROWS_OF_TIMES,
        Some(step) => {
            let fits = || other_interval(first, step).is_none();
            grows && (first.len() >= ROWS_OF_TIMES || first.len() > 1 && fits())
        }
    }
}

fn without_step(table: &Table<'_>, columns: usize, is_counter: bool) -> String {
    match columns {
        _ if is_counter => "counts, not times: expected step = ..., in s".to_owned(),
        1 => "1 column of numbers: expected 2, time and acceleration, or step = ... in s and unit = ...".to_owned(),
        _ => {
            let named = components_of(table, 0);
            let which = if table.names.is_empty() {
                "column = ... where they are not one sequence".to_owned()
            } else {
                format!("column = ..., one of {}", components::listed(&named))
            };
            format!(
                "{columns} columns of numbers, the first of which are no times: expected step = ..., in s, and {which}"
            )
        }
    }
}

fn components_of(table: &Table<'_>, from: usize) -> Vec<Component> {
    let name = |place: usize| table.names.get(place).cloned().unwrap_or_default();
    (from..table.layout.columns).map(|place| Component::new(place + 1, name(place))).collect()
}

/// The column that is wanted, else the only one that may be meant, of those from a place on.
fn column(
    table: &Table<'_>,
    kinds: &[Kind],
    options: &RecordOptions,
    from: usize,
    reading: &mut Reading,
) -> Option<usize> {
    let columns = components_of(table, from);
    let kind = |column: &Component| kinds.get(column.number - 1).copied().unwrap_or(Kind::Unknown);
    let wanted = match &options.column {
        // The first component of a file that has one.
        Some(Column::Number(1)) if columns.len() == 1 => from,
        Some(Column::Number(number)) if *number <= from && *number > 0 => {
            let what = if kinds.first() == Some(&Kind::Counter) { "the count" } else { "the time" };
            refuse(table, reading, format!("#{number} is {what}: expected one of {}", components::listed(&columns)));
            return None;
        }
        Some(wanted) => match components::named(&columns, wanted) {
            Some(place) => columns.get(place)?.number - 1,
            None => {
                refuse(table, reading, components::none_such(&columns, wanted));
                return None;
            }
        },
        None => only(table, &columns, kind, reading)?,
    };
    if kinds.get(wanted) == Some(&Kind::OtherMotion) {
        let name = table.names.get(wanted).map_or("", String::as_str);
        reading.refuse(|| on_line(table.names_line, format!("{}: expected an acceleration", excerpt(name))));
    }
    Some(wanted)
}

/// The only column, or the only one with the name of an acceleration.
fn only(
    table: &Table<'_>,
    columns: &[Component],
    kind: impl Fn(&Component) -> Kind,
    reading: &mut Reading,
) -> Option<usize> {
    if let [column] = columns {
        return Some(column.number - 1);
    }
    let accelerations: Vec<&Component> = columns.iter().filter(|column| kind(column) == Kind::Acceleration).collect();
    if let [column] = accelerations[..] {
        return Some(column.number - 1);
    }
    let (count, listed) = (table.layout.columns, components::listed(columns));
    let or_sequence = match kind(&Component::new(1, "")) {
        Kind::Time => String::new(),
        _ => format!(", or skip_lines = {} where they are one sequence", table.layout.first - 1),
    };
    refuse(
        table,
        reading,
        format!(
            "{count} columns of numbers: expected column = ... or # behind the file's name, one of {listed}{or_sequence}"
        ),
    );
    None
}

fn refuse(table: &Table<'_>, reading: &mut Reading, problem: String) {
    reading.refuse(|| on_line(table.layout.first, problem));
}

/// Compares times that were read with a step.
pub(super) fn check_step(step: f64, line: usize, reading: &mut Reading) {
    if let Some(between) = other_interval(&reading.record.times, step) {
        let problem = format!("times {} s apart: expected step = {} s, or none", plain(between), plain(step));
        reading.refuse(|| on_line(line, problem));
    }
}
