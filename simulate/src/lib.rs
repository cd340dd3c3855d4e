//! The engine without FMI: what the example `simulate` and the command `pounding-fmu simulate` do.
//!
//! `--csv` has `time` and one column per output of the scene's FMU, under the same names; `--impacts` has one row per
//! contact episode; `--html` is one file with both, drawn, for a browser; `--layout` is what stands where.
//!
//! | file | holds |
//! |---|---|
//! | `lib.rs` | the arguments, and what is done with them |
//! | `instants.rs` | the instants at which a run is looked at |
//! | `solve.rs` | the run over these instants |
//! | `tables.rs` | the tables and the summary of a run |
//! | `layout.rs` | floors, levels and contacts of the scene, for pictures |
//! | `report.rs`, `thinning.rs` | the page, and as much of a long run as it can show |

pub mod instants;
mod layout;
mod report;
pub mod solve;
pub mod tables;
mod thinning;

use clap::Args;
use pounding::description::{Package, PackagedRecord};
use pounding::engine::Model;
use pounding::warnings;
use solve::{Solution, Solved, events, solve};
use std::error::Error;
use std::io::Write;
use std::path::{Path, PathBuf};

/// s, from row to row, where nothing else is said.
pub const STEP: f64 = 0.01;
/// s, time of the last row of a scene that has neither a stop time nor a record.
pub const STOP: f64 = 10.0;

/// What is solved, and which files are written.
#[derive(Args)]
#[group(id = "run")]
pub struct Arguments {
    /// The scene.
    #[arg(value_name = "SCENE.toml")]
    scene: PathBuf,
    /// Ground motion (CSV or AT2) of a scene that has no record of its own.
    #[arg(long, value_name = "FILE")]
    record: Option<PathBuf>,
    /// Leaves out all contacts: how each building moves by itself.
    #[arg(long)]
    without_contacts: bool,
    /// s, from row to row.
    #[arg(long, value_name = "S", default_value_t = STEP, value_parser = positive)]
    step: f64,
    /// s, time of the last row; without it, the scene's stop_time, else the end of the record, else 10.
    #[arg(long, value_name = "T", value_parser = positive)]
    stop: Option<f64>,
    /// Table of the motion, a row every step.
    #[arg(long, value_name = "OUT")]
    csv: Option<PathBuf>,
    /// Rows of --csv within each contact, beside those at its beginning, largest force and end, where storeys begin to yield
    /// or turn back, and every step.
    #[arg(long, value_name = "N")]
    rows_per_impact: Option<u16>,
    /// Table of the contact episodes.
    #[arg(long, value_name = "OUT")]
    impacts: Option<PathBuf>,
    /// Report of the run: one file that any browser shows, without a network.
    #[arg(long, value_name = "OUT")]
    html: Option<PathBuf>,
    /// Floors, their levels, and what meets at each contact, as JSON: what pictures are drawn from.
    #[arg(long, value_name = "OUT")]
    layout: Option<PathBuf>,
}

fn positive(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(number) if number > 0.0 && number.is_finite() => Ok(number),
        _ => Err("expected a number > 0".into()),
    }
}

/// Solves a scene, writes the files that are asked for, and returns the summary.
///
/// # Errors
/// A scene or record with everything that is wrong with it, a file that cannot be written, a run that cannot go on.
pub fn run(arguments: &Arguments) -> Result<String, Box<dyn Error>> {
    let mut package = Package::from_scene_file(&arguments.scene)?;
    if let Some(file) = &arguments.record {
        give_record(&mut package, file)?;
    }
    for warning in warnings::of_file(&package.scene, package.record.as_ref().map(|packaged| &packaged.record)) {
        // Nobody may be there to read it.
        let _ = writeln!(std::io::stderr(), "warning: {warning}");
    }
    if arguments.without_contacts {
        package.scene.contacts.clear();
    }
    let stop = arguments.stop.or_else(|| package.stop_time()).unwrap_or(STOP);

    let Package { scene, record, .. } = &package;
    let model = Model::new(scene, record.as_ref().map(|packaged| &packaged.record))?;
    let mut motion = arguments.csv.as_deref().map(|file| tables::Motion::create(file, scene)).transpose()?;
    let impacts = arguments.impacts.as_deref().map(tables::create).transpose()?;
    let mut page = arguments.html.as_deref().map(report::create).transpose()?;

    if let Some(file) = &arguments.layout {
        report::create(file)?.write_all(serde_json::to_string(&layout::Layout::of(scene))?.as_bytes())?;
    }
    let mut write = motion.as_mut().map(|motion| |solved: Solved| motion.write(solved));
    let regular = instants::regular(arguments.step, stop);
    let solution = match arguments.rows_per_impact {
        None => solve(&model, regular, write.as_mut())?,
        Some(count) => {
            let within = instants::within(&events(&model, stop)?, stop, count);
            solve(&model, instants::merge(regular, within), write.as_mut())?
        }
    };
    if let Some(motion) = motion {
        motion.finish()?;
    }
    if let Some(table) = impacts {
        tables::write_impacts(table, &solution.events.episodes)?;
    }
    if let Some(page) = &mut page {
        page.write_all(report::page(&package, &model, stop, &solution.events)?.as_bytes())?;
    }
    let Solution { time, .. } = &solution;
    let summary = tables::summary(scene, stop, &solution) + &tables::frequencies(&model);
    Ok(format!("{summary}solve_seconds={}\n", time.as_secs_f64()))
}

/// Reads a record and makes it the scene's.
fn give_record(package: &mut Package, file: &Path) -> Result<(), Box<dyn Error>> {
    if let Some(own) = &package.scene.ground.record {
        return Err(format!("--record is for a scene without one; this one has ground.record = {own:?}").into());
    }
    let name = file.to_string_lossy().into_owned();
    let bytes = std::fs::read(file).map_err(|error| format!("cannot read {name}: {error}"))?;
    let record = PackagedRecord::parse(&name, bytes).map_err(|error| format!("{name}: {error}"))?;
    package.record = Some(record);
    package.scene.ground.record = Some(name);
    Ok(())
}
