//! Tables of networks, whose headers say step, unit, names and more.

use super::found::{Announced, Table};
use super::layout::{Layout, Separators};
use crate::record::accelerogram::Accelerogram;
use crate::record::components::{self, Component};
use crate::record::error::RecordError;
use crate::record::format::Format;
use crate::record::options::Column;
use crate::record::reading::{Reading, Said};
use crate::record::unit::Unit;

/// What such a header says.
pub(in crate::record) struct Told {
    pub format: Format,
    pub about: String,
    pub unit: Unit,
    /// Line of the first row.
    pub first: usize,
    /// The columns of motion, each with its number in the row, counted from 1.
    pub components: Vec<Component>,
    pub has_times: bool,
    /// s
    pub step: f64,
    /// Number of rows, with its line and its name.
    pub count: (usize, &'static str, usize),
    /// Peak of each component, with its line; as many as are known.
    pub peaks: Vec<(usize, f64)>,
    /// Whether files repeat their last row, as often as they like.
    pub repeats_last: bool,
    /// s, with its line.
    pub duration: Option<(usize, f64)>,
}

impl Told {
    /// Reads the component that is wanted, else the first horizontal one, of the rows of a text.
    pub(in crate::record) fn read(
        self,
        text: &str,
        wanted: Option<&Column>,
        mut reading: Reading,
    ) -> Result<Accelerogram, RecordError> {
        let Told { format, about, unit, components, .. } = self;
        let chosen = components::choose(&components, wanted)?;
        let columns = components.len() + usize::from(self.has_times);
        let separators = Separators { column: ' ', has_decimal_comma: false };
        let layout = Layout { separators, first: self.first, columns };
        let (line, counted, count) = self.count;
        let announced = Some(Announced { line, count, step: None });
        let table = Table { text, lines: Vec::new(), layout, names: Vec::new(), names_line: 0, announced };
        let time = self.has_times.then_some(0);
        table.column(time, Some(self.step), components[chosen].number - 1, unit, &mut reading);
        if self.repeats_last {
            reading.drop_repeated(count);
        }
        reading.check_count(line, counted, count);
        if let Some((line, peak)) = self.peaks.get(chosen) {
            reading.check_peak(*line, *peak, unit);
        }
        if let Some((line, duration)) = self.duration {
            reading.check_duration(line, duration);
        }
        reading.accelerogram(Said { format, unit, about, components, chosen })
    }
}
