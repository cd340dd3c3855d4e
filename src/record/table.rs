//! Records as columns of text, with or without a header that says names, unit and step: time and acceleration, several
//! components beside a time, one column, or a sequence of many values a line. What the file does not say the user may
//! ([`RecordOptions`]).

mod layout;
mod names;
mod roles;
mod told;

use super::accelerogram::{Accelerogram, RecordError};
use super::components::Component;
use super::format::Format;
use super::options::RecordOptions;
use super::reading::{Reading, Said, excerpt, numbered, on_line};
use super::said::{self, SaidUnit};
use super::unit::Unit;
use layout::{Layout, is_comment};
use roles::Roles;

pub(super) use told::Told;

/// Lines of a header that are looked at for unit, step and names: the last ones.
const MOST_HEADER_LINES: usize = 200;
/// Bytes of one of them.
const LONGEST_LINE: usize = 2000;

/// The lines before the numbers, and how the numbers stand.
struct Table<'t> {
    text: &'t str,
    lines: Vec<(usize, &'t str)>,
    layout: Layout,
    /// Of the columns, where a line gives them as many.
    names: Vec<String>,
    /// Line of these.
    names_line: usize,
    /// Number of samples and step, with the line that says them.
    announced: Option<Announced>,
}

/// What a line above the samples says of them.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Announced {
    line: usize,
    count: usize,
    /// s
    step: Option<f64>,
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

/// `None` where the text holds no row of numbers.
pub(super) fn parse(text: &str, options: &RecordOptions) -> Option<Result<Accelerogram, RecordError>> {
    let table = Table::read(text, options)?;
    Some(table.accelerogram(options))
}

impl<'t> Table<'t> {
    fn read(text: &'t str, options: &RecordOptions) -> Option<Table<'t>> {
        let skipped = options.skip_lines;
        let mut layout = Layout::find(text, skipped.unwrap_or(0))?;
        let mut announced = None;
        if skipped.is_none()
            && let Some(found) = roles::announced_in_rows(text, &layout, options.step)
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

    fn accelerogram(&self, options: &RecordOptions) -> Result<Accelerogram, RecordError> {
        let mut reading = Reading::with_capacity(0);
        let roles = roles::find(self, options, &mut reading);
        let unit = self.unit(options, roles.as_ref(), &mut reading);
        let Some(roles) = roles else { return Err(reading.stop()) };
        let unit = unit.unwrap_or(Unit::Metres);
        match roles {
            Roles::Sequence { step } => self.sequence(step, unit, &mut reading),
            Roles::Pairs => self.pairs(unit, &mut reading),
            Roles::Column { time, step, column } => self.column(time, step, column, unit, &mut reading),
        }
        if let Some(Announced { line, count, .. }) = self.announced {
            reading.check_count(line, "number of samples", count);
        }
        let about = self.lines.first().map_or_else(String::new, |(_, line)| excerpt(line));
        let (components, chosen) = match roles {
            Roles::Sequence { .. } | Roles::Pairs => (Vec::new(), 0),
            Roles::Column { column, .. } => self.components(column),
        };
        reading.accelerogram(Said { format: Format::Columns, unit, about, components, chosen })
    }

    /// Number after number, as many a line as there are.
    fn sequence(&self, step: f64, unit: Unit, reading: &mut Reading) {
        let count = self.announced.map_or(usize::MAX, |said| said.count);
        for (number, line) in self.layout.rows(self.text) {
            match self.layout.separators.numbers(line) {
                Some(values) => {
                    for value in values {
                        let time = reading.samples as f64 * step;
                        reading.add(time, unit.in_si(value), |problem| on_line(number, problem));
                    }
                }
                None if reading.is_end(line, count) => {}
                None => reading.skip(|| on_line(number, format!("{}: expected numbers only", excerpt(line)))),
            }
        }
    }

    /// Several samples in a row, each with its time.
    fn pairs(&self, unit: Unit, reading: &mut Reading) {
        for (number, line) in self.layout.rows(self.text) {
            match self.layout.separators.numbers(line).filter(|values| values.len() % 2 == 0) {
                Some(values) => {
                    for pair in values.chunks_exact(2) {
                        reading.add(pair[0], unit.in_si(pair[1]), |problem| on_line(number, problem));
                    }
                }
                None => reading
                    .skip(|| on_line(number, format!("{}: expected pairs of time and acceleration", excerpt(line)))),
            }
        }
    }

    /// A row a sample.
    fn column(&self, time: Option<usize>, step: Option<f64>, column: usize, unit: Unit, reading: &mut Reading) {
        let (separators, columns) = (self.layout.separators, self.layout.columns);
        let count = self.announced.map_or(usize::MAX, |said| said.count);
        for (number, line) in self.layout.rows(self.text) {
            let values = separators.numbers(line).filter(|values| values.len() == columns);
            let Some(values) = values else {
                if !reading.is_end(line, count) {
                    reading.skip(|| on_line(number, format!("{}: expected {}", excerpt(line), self.expected(time))));
                }
                continue;
            };
            let at = match time {
                Some(place) => values[place],
                None => reading.samples as f64 * step.unwrap_or_default(),
            };
            reading.add(at, unit.in_si(values[column]), |problem| on_line(number, problem));
        }
        if let (Some(_), Some(step)) = (time, step) {
            roles::check_step(step, self.layout.first, reading);
        }
    }

    fn expected(&self, time: Option<usize>) -> String {
        match (self.layout.columns, time) {
            (1, _) => "1 number".to_owned(),
            (2, Some(_)) => "2 numbers, time and acceleration".to_owned(),
            (columns, _) => format!("{columns} numbers"),
        }
    }

    /// All columns of motion, and the place of the one that is read.
    fn components(&self, column: usize) -> (Vec<Component>, usize) {
        let named = |place: usize| self.names.get(place).map_or("", String::as_str);
        let others = (0..self.layout.columns).filter(|place| {
            *place == column
                || !matches!(names::kind(named(*place)), names::Kind::Time | names::Kind::Counter)
                    && (*place > 0 || !self.names.is_empty())
        });
        let places: Vec<usize> = others.collect();
        let chosen = places.iter().position(|place| *place == column).unwrap_or(0);
        (places.iter().map(|place| Component::new(place + 1, named(*place))).collect(), chosen)
    }

    /// The unit that the header names for the column, that of the user where it names none.
    fn unit(&self, options: &RecordOptions, roles: Option<&Roles>, reading: &mut Reading) -> Option<Unit> {
        let own = match roles {
            Some(Roles::Column { column, .. }) => {
                self.names.get(*column).map(|name| said::units(name)).unwrap_or_default()
            }
            _ => Vec::new(),
        };
        let mut found = own;
        if found.is_empty() {
            found = self.lines.iter().flat_map(|(_, line)| said::units(line)).collect();
        }
        found.dedup();
        let of_user = options.unit;
        match (&found[..], of_user) {
            ([SaidUnit::Known(unit)], None) => return Some(*unit),
            ([SaidUnit::Known(unit)], Some(said)) if *unit == said => return Some(said),
            ([SaidUnit::Known(unit)], Some(said)) => {
                let line = self
                    .lines
                    .iter()
                    .rev()
                    .find(|(_, line)| !said::units(line).is_empty())
                    .map_or(1, |(line, _)| *line);
                reading.refuse(|| {
                    on_line(line, format!("the file says {unit}: expected unit = \"{unit}\", not {said}, or none"))
                });
            }
            ([] | [SaidUnit::Scaled(_)], Some(said)) => return Some(said),
            (several, Some(said)) if several.contains(&SaidUnit::Known(said)) => return Some(said),
            ([SaidUnit::Scaled(text)], None) => {
                let expected = format!("expected one of {}, as unit = ...", Unit::known());
                reading.refuse(|| {
                    on_line(self.layout.first, format!("the unit {} has a factor: {expected}", excerpt(text)))
                });
            }
            (several, _) => self.refuse_unit(several.len(), reading),
        }
        None
    }

    fn refuse_unit(&self, count: usize, reading: &mut Reading) {
        let said = if count == 0 { "nothing says the unit of the accelerations" } else { "there are several units" };
        let between = if self.layout.separators.column == ' ' { ' ' } else { self.layout.separators.column };
        let expected = if self.layout.columns == 2 {
            format!(
                "expected unit = ... ({}), or one of these lines above the numbers: time_s{between}accel_m_s2 where they are in \
                 m/s2, time_s{between}accel_g where they are in g",
                Unit::known()
            )
        } else {
            format!("expected unit = ..., one of {}", Unit::known())
        };
        reading.refuse(|| on_line(self.layout.first, format!("{said}: {expected}")));
    }
}
