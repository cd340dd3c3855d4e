//! Records as columns of text, with or without a header that says names, unit and step: time and acceleration, several
//! components beside a time, one column, or a sequence of many values a line. What the file does not say the user may
//! ([`RecordOptions`]).

mod found;
mod layout;
mod names;
mod roles;
mod samples;
mod told;
mod units;

use super::accelerogram::Accelerogram;
use super::error::RecordError;
use super::format::Format;
use super::options::RecordOptions;
use super::reading::{Reading, Said, excerpt};
use super::unit::Unit;
use found::{Announced, Table};
use roles::Roles;

pub(super) use told::Told;

/// `None` where the text holds no row of numbers.
pub(super) fn parse(text: &str, options: &RecordOptions) -> Option<Result<Accelerogram, RecordError>> {
    let table = Table::read(text, options)?;
    Some(table.accelerogram(options))
}

impl Table<'_> {
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
}
