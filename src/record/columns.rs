//! Records as two columns of text, time and acceleration, with or without a header that says the unit.

use super::accelerogram::{Accelerogram, RecordError};
use super::format::Format;
use super::numbers::fortran_number;
use super::reading::{Reading, excerpt, numbered, on_line};
use super::unit::Unit;

/// Lines before the numbers, at most.
const MOST_HEADER_LINES: usize = 100;

/// What sets the two columns apart, and what the decimals.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Separators {
    /// A blank for any number of them.
    column: char,
    has_decimal_comma: bool,
}

/// In the order in which they are tried: a decimal comma only where no comma can set columns apart.
const KNOWN: [Separators; 5] = [
    Separators { column: ';', has_decimal_comma: false },
    Separators { column: ';', has_decimal_comma: true },
    Separators { column: ',', has_decimal_comma: false },
    Separators { column: ' ', has_decimal_comma: false },
    Separators { column: ' ', has_decimal_comma: true },
];

impl Separators {
    /// A separator at the end of a row sets nothing apart.
    fn fields(self, row: &str) -> Vec<&str> {
        let row = row.trim();
        match self.column {
            ' ' => row.split_whitespace().take(MOST_FIELDS).collect(),
            mark => row.trim_end_matches(mark).split(mark).take(MOST_FIELDS).map(str::trim).collect(),
        }
    }

    fn number(self, field: &str) -> Option<f64> {
        let field = field.trim_matches('"');
        match self.has_decimal_comma {
            true if !field.contains('.') => fortran_number(&field.replace(',', ".")),
            _ => fortran_number(field),
        }
    }

    /// The numbers of a row, where it holds nothing else.
    fn numbers(self, row: &str) -> Option<Vec<f64>> {
        let values: Option<Vec<f64>> = self.fields(row).into_iter().map(|field| self.number(field)).collect();
        values.filter(|values| !values.is_empty())
    }
}

/// Columns and words beyond these are not looked at.
const MOST_FIELDS: usize = 100;
/// No name of a column is as long, in bytes.
const LONGEST_WORD: usize = 100;

/// The lines before the numbers, and how the numbers are set apart.
struct Head<'t> {
    lines: Vec<(usize, &'t str)>,
    /// That of the first row of numbers.
    first: usize,
    separators: Separators,
}

impl<'t> Head<'t> {
    /// Up to the first row of two numbers.
    fn read(text: &'t str) -> Option<Head<'t>> {
        let is_pair = |row: &str, known: &Separators| known.numbers(row).is_some_and(|values| values.len() == 2);
        let rows = || numbered(text).take(MOST_HEADER_LINES).filter(|(_, line)| !is_comment(line));
        let (first, separators) =
            rows().find_map(|(number, line)| Some((number, *KNOWN.iter().find(|known| is_pair(line, known))?)))?;
        let lines = numbered(text).take(first - 1).filter(|(_, line)| !line.trim().is_empty()).collect();
        Some(Head { lines, first, separators })
    }

    /// The unit that the header or a comment names.
    fn unit(&self, reading: &mut Reading) -> Option<Unit> {
        let mut units: Vec<Unit> = self.lines.iter().flat_map(|(_, line)| units_in(line)).collect();
        units.dedup();
        if let [unit] = units[..] {
            return Some(unit);
        }
        let between = self.separators.column;
        let said =
            if units.is_empty() { "nothing says the unit of the accelerations" } else { "there are several units" };
        let expected = format!(
            "expected one of these lines above the numbers: time_s{between}accel_m_s2 where they are in m/s2, \
             time_s{between}accel_g where they are in g"
        );
        reading.refuse(|| on_line(self.first, format!("{said}: {expected}")));
        None
    }

    /// Columns that are no time in s and no acceleration.
    fn check_names(&self, reading: &mut Reading) {
        let Some((number, line)) = self.lines.iter().rfind(|(_, line)| !is_comment(line)) else { return };
        let mut refuse = |expected: &str| {
            reading.refuse(|| on_line(*number, format!("{}: expected {expected}", excerpt(line))));
        };
        let lower = line.to_lowercase();
        let words: Vec<&str> = words(&lower).collect();
        let place = |names: &[&str]| words.iter().position(|word| names.iter().any(|name| word.starts_with(name)));
        let other = ["veloc", "displ", "cm/s", "m/s", "mm/s"];
        let is_other =
            |word: &&str| other.iter().any(|name| word == name || (name.len() > 4 && word.starts_with(name)));
        if words.iter().any(is_other) {
            refuse("an acceleration");
        }
        if let (Some(time), Some(acceleration)) = (place(&["time"]), place(&["acc"]))
            && acceleration < time
        {
            refuse("the time first");
        }
        let unit_of_time =
            |word: &&str| ["ms", "msec", "min"].contains(&word.rsplit(['_', '/']).next().unwrap_or(word));
        if words.iter().any(unit_of_time) {
            refuse("times in s");
        }
    }
}

fn is_comment(line: &str) -> bool {
    line.trim_start().starts_with(['#', '%', '!'])
}

/// Names and units, as punctuation sets them apart.
fn words(line: &str) -> impl Iterator<Item = &str> {
    line.split(|c: char| c.is_whitespace() || "()[]{},;:=\"'#%!|".contains(c)).filter(|word| !word.is_empty())
}

/// The units of acceleration that a line names: as a word, or at the end of one as in `accel_m_s2` and `a/g`. What
/// follows a number is a value with its unit.
fn units_in(line: &str) -> Vec<Unit> {
    let mut is_value = false;
    let mut units = Vec::new();
    for word in words(line).take(MOST_FIELDS).filter(|word| word.len() < LONGEST_WORD) {
        let ends = word.match_indices(['_', '/']).map(|(place, _)| word.get(place + 1..).unwrap_or_default());
        // a_g is how many write the acceleration of the ground.
        let ends = ends.filter(|_| !word.eq_ignore_ascii_case("a_g"));
        let unit = std::iter::once(word).chain(ends).find_map(Unit::read);
        units.extend(unit.filter(|_| !is_value));
        is_value = fortran_number(word).is_some();
    }
    units
}

/// `None` where the text holds no two columns: no row of two numbers, or most rows have others.
pub(super) fn parse(text: &str) -> Option<Result<Accelerogram, RecordError>> {
    let head = Head::read(text)?;
    let mut reading = Reading::with_capacity(0);
    head.check_names(&mut reading);
    let unit = head.unit(&mut reading).unwrap_or(Unit::Metres);
    let mut others = 0;
    for (number, line) in numbered(text).skip(head.first - 1) {
        if line.trim().is_empty() || is_comment(line) {
            continue;
        }
        let fields = head.separators.fields(line);
        let values: Vec<Option<f64>> = fields.iter().map(|field| head.separators.number(field)).collect();
        match values[..] {
            [Some(time), Some(value)] => reading.add(time, unit.in_si(value), |problem| on_line(number, problem)),
            _ => {
                others += usize::from(values.len() > 2 && values.iter().all(Option::is_some));
                reading
                    .skip(|| on_line(number, format!("{}: expected 2 numbers, time and acceleration", excerpt(line))));
            }
        }
    }
    if 2 * others > reading.samples {
        return None;
    }
    let about = head.lines.first().map_or_else(String::new, |(_, line)| excerpt(line));
    Some(reading.accelerogram(Format::Columns, about))
}

/// How many columns of numbers a text has that are not two, and in which line they begin.
pub(super) fn count(text: &str) -> Option<(usize, usize)> {
    let rows = numbered(text).take(MOST_HEADER_LINES).filter(|(_, line)| !is_comment(line));
    let mut counts =
        rows.filter_map(|(number, line)| Some((number, KNOWN.iter().find_map(|known| known.numbers(line))?.len())));
    counts.find(|(_, count)| *count != 2)
}
