//! The tables of a run: that of the motion, and that of the impacts.

use crate::solve::Solved;
use pounding::engine::{Episode, Output};
use pounding::scene::Scene;
use pounding::variables::{Row, Slot, Table, Type};
use std::io::{self, Write};

/// The outputs of a scene's FMU, in its order.
pub fn outputs(scene: &Scene) -> impl Iterator<Item = (Row, Output)> {
    Table::new(scene).rows.into_iter().filter_map(|row| match row.slot {
        Slot::Output(output) => Some((row, output)),
        _ => None,
    })
}

/// The table of the motion: `time`, then every output of the FMU in its order.
pub struct Motion<W: Write> {
    table: csv::Writer<W>,
    outputs: Vec<(Output, Type)>,
    cells: Vec<String>,
}

impl<W: Write> Motion<W> {
    /// Writes the headings.
    ///
    /// # Errors
    /// What keeps them from being written.
    pub fn new(file: W, scene: &Scene) -> csv::Result<Motion<W>> {
        let mut table = csv::Writer::from_writer(file);
        let (names, outputs): (Vec<_>, Vec<_>) =
            outputs(scene).map(|(row, output)| (row.name, (output, row.ty))).unzip();
        table.write_record(std::iter::once("time".to_owned()).chain(names))?;
        Ok(Motion { table, outputs, cells: Vec::new() })
    }

    /// Writes a row.
    ///
    /// # Errors
    /// What keeps it from being written.
    pub fn write(&mut self, solved: Solved) -> csv::Result<()> {
        self.cells.clear();
        self.cells.push(number(solved.time()));
        self.cells.extend(self.outputs.iter().map(|&(output, ty)| match ty {
            Type::Real(_) => number(solved.read(output)),
            _ => solved.read(output).to_string(),
        }));
        self.table.write_record(&self.cells)
    }

    /// Writes what is left, and gives the file back.
    ///
    /// # Errors
    /// What keeps it from being written.
    pub fn finish(self) -> io::Result<W> {
        self.table.into_inner().map_err(csv::IntoInnerError::into_error)
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

/// Writes the table of impacts, and gives its file back.
///
/// # Errors
/// What keeps it from being written.
pub fn write_impacts<W: Write>(file: W, episodes: &[Episode]) -> io::Result<W> {
    let mut table = csv::Writer::from_writer(file);
    table.write_record(IMPACT_COLUMNS)?;
    for episode in episodes {
        let (contact, row) = impact(episode);
        let cells = row.map(|value| value.map(number).unwrap_or_default());
        table.write_record(std::iter::once(contact.to_string()).chain(cells))?;
    }
    table.into_inner().map_err(csv::IntoInnerError::into_error)
}
