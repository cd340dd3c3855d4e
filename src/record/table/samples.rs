//! The samples of a table, by what its columns are.

use super::found::Table;
use super::names;
use super::roles;
use crate::record::components::Component;
use crate::record::reading::{Reading, excerpt, on_line};
use crate::record::unit::Unit;

impl Table<'_> {
    /// Number after number, as many a line as there are.
    pub(super) fn sequence(&self, step: f64, unit: Unit, reading: &mut Reading) {
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
    pub(super) fn pairs(&self, unit: Unit, reading: &mut Reading) {
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
    pub(super) fn column(
        &self,
        time: Option<usize>,
        step: Option<f64>,
        column: usize,
        unit: Unit,
        reading: &mut Reading,
    ) {
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
    pub(super) fn components(&self, column: usize) -> (Vec<Component>, usize) {
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
}
