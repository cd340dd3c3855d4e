//! The unit of a table's accelerations: what its header says, what the user says.

use super::found::Table;
use super::roles::Roles;
use crate::record::options::RecordOptions;
use crate::record::reading::{Reading, excerpt, on_line};
use crate::record::said::{self, SaidUnit};
use crate::record::unit::Unit;

impl Table<'_> {
    /// The unit that the header names for the column, that of the user where it names none.
    pub(super) fn unit(&self, options: &RecordOptions, roles: Option<&Roles>, reading: &mut Reading) -> Option<Unit> {
        let name = match roles {
            Some(Roles::Column { column, .. }) => self.names.get(*column),
            _ => None,
        };
        let mut found = name.map_or_else(Vec::new, |name| said::units(name));
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
        let between = self.layout.separators.column;
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
