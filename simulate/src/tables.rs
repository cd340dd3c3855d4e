//! What a run prints: the table of the motion, that of the impacts, and the summary.

use crate::solve::{Events, Solution, Solved};
use pounding::engine::{Episode, Model, Side};
use pounding::scene::Scene;
use pounding::variables::{Output, Row, Slot, Table, Value};
use std::error::Error;
use std::fs::File;
use std::path::Path;

type CsvFile = csv::Writer<File>;

/// The file, before the work that it is for.
pub(crate) fn create(file: &Path) -> Result<CsvFile, Box<dyn Error>> {
    let created = File::create(file).map_err(|error| format!("cannot write {}: {error}", file.display()))?;
    Ok(csv::Writer::from_writer(created))
}

/// The outputs of a scene's FMU, in its order.
pub fn outputs(scene: &Scene) -> impl Iterator<Item = (Row, Output)> {
    Table::new(scene).rows.into_iter().filter_map(|row| match row.slot {
        Slot::Output(output) => Some((row, output)),
        _ => None,
    })
}

/// The table of the motion: `time`, then every output of the FMU in its order.
pub(crate) struct Motion {
    table: CsvFile,
    outputs: Vec<Output>,
    cells: Vec<String>,
}

impl Motion {
    pub fn create(file: &Path, scene: &Scene) -> Result<Motion, Box<dyn Error>> {
        let mut table = create(file)?;
        let (names, outputs): (Vec<_>, Vec<_>) = outputs(scene).map(|(row, output)| (row.name, output)).unzip();
        table.write_record(std::iter::once("time".to_owned()).chain(names))?;
        Ok(Motion { table, outputs, cells: Vec::new() })
    }

    pub fn write(&mut self, solved: Solved) -> csv::Result<()> {
        self.cells.clear();
        self.cells.push(number(solved.point.time));
        self.cells.extend(self.outputs.iter().map(|output| match solved.read(*output) {
            Value::Real(value) => number(value),
            Value::Integer(value) => value.to_string(),
            Value::Boolean(value) => u8::from(value).to_string(),
            Value::String(value) => value.to_owned(),
        }));
        self.table.write_record(&self.cells)
    }

    pub fn finish(mut self) -> std::io::Result<()> {
        self.table.flush()
    }
}

/// The shortest text that reads back as the same number.
fn number(value: f64) -> String {
    format!("{value:?}")
}

/// The columns of the table of impacts: s, m/s, N, m, N s, J.
pub const IMPACT_COLUMNS: [&str; 10] = [
    "contact",
    "start_s",
    "end_s",
    "approach_velocity",
    "separation_velocity",
    "peak_force",
    "peak_time_s",
    "peak_penetration",
    "impulse",
    "dissipated_energy",
];

/// A row of that table: the contact, counted from 1, and what is in the other columns; no end while it lasts.
pub fn impact(episode: &Episode) -> (usize, [Option<f64>; 9]) {
    let row = [
        Some(episode.start),
        episode.end,
        Some(episode.approach_velocity),
        Some(episode.separation_velocity),
        Some(episode.peak_force),
        Some(episode.peak_time),
        Some(episode.peak_penetration),
        Some(episode.impulse),
        Some(episode.dissipated_energy),
    ];
    (episode.contact + 1, row)
}

/// Writes the table of impacts.
pub(crate) fn write_impacts(mut table: CsvFile, episodes: &[Episode]) -> csv::Result<()> {
    table.write_record(IMPACT_COLUMNS)?;
    for episode in episodes {
        let (contact, row) = impact(episode);
        let cells = row.map(|value| value.map(number).unwrap_or_default());
        table.write_record(std::iter::once(contact.to_string()).chain(cells))?;
    }
    table.flush()?;
    Ok(())
}

/// How many impacts each contact has had, and the hardest.
pub(crate) fn summary(scene: &Scene, stop: f64, solution: &Solution) -> String {
    let Solution { rows, events: Events { episodes, .. }, .. } = solution;
    let mut text = format!("{}: 0 s to {stop} s in {rows} rows, {} impacts\n", scene.name, episodes.len());
    for (index, pair) in scene.contacts.iter().enumerate() {
        let of_this: Vec<&Episode> = episodes.iter().filter(|episode| episode.contact == index).collect();
        let largest = |pick: fn(&Episode) -> f64| of_this.iter().map(|episode| pick(episode)).fold(0.0, f64::max);
        text += &format!(
            "  contact {} ({}): {} impacts, approach up to {:.4} m/s, force up to {:.4e} N, \
             penetration up to {:.4e} m\n",
            index + 1,
            pair.meeting(scene),
            of_this.len(),
            largest(|episode| episode.approach_velocity),
            largest(|episode| episode.peak_force),
            largest(|episode| episode.peak_penetration),
        );
    }
    text
}

/// Natural frequencies of each building alone, ascending.
pub(crate) fn frequencies(model: &Model) -> String {
    let line = |side: Side| {
        let numbers: Vec<String> = model.natural_frequencies(side).iter().map(|f| format!("{f:.4}")).collect();
        if numbers.is_empty() { String::new() } else { format!("  {side} frequencies: {} Hz\n", numbers.join(", ")) }
    };
    line(Side::Left) + &line(Side::Right)
}
