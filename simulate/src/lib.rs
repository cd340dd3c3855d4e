//! The engine without FMI: what the example `simulate` and the command `pounding-fmu simulate` do.
//!
//! `--csv` has `time` and one column per output of the scene's FMU, under the same names; `--impacts` has one row per
//! contact episode; `--html` is one file with both, drawn, for a browser; `--layout` is what stands where.
//!
//! | file | holds |
//! |---|---|
//! | `lib.rs` | the arguments, and what is done with them |
//! | `instants.rs` | the instants at which a run is looked at |
//! | `couple.rs`, `corrections.rs` | a run with buildings of another program, and what it had from there |
//! | `scenario.rs` | a scene with its record and its parameters |
//! | `solve.rs` | the run over these instants |
//! | `readings.rs` | what is read of a run, by value reference |
//! | `tables.rs` | the tables of a run |
//! | `outcome.rs` | what a run has shown of all variables, whoever has made it |
//! | `summary.rs`, `went_in.rs` | the same for a person: what happened, and what went in |
//! | `layout.rs` | floors, levels and contacts of the scene, for pictures |
//! | `report.rs`, `thinning.rs` | the page, and as much of a long run as it can show |
//! | `written.rs` | files that are written, none of which may be one that is read |

pub mod corrections;
pub mod couple;
pub mod instants;
pub mod layout;
pub mod outcome;
pub mod readings;
pub mod report;
pub mod scenario;
pub mod solve;
pub mod summary;
pub mod tables;
mod thinning;
mod went_in;
pub mod written;

use clap::Args;
use outcome::Follower;
use pounding::description::{Package, PackagedRecord};
use pounding::engine::Model;
use pounding::record::{MOST_TIME, RecordFile};
use pounding::variables::{Settings, Table};
use pounding::warnings;
use solve::{Solution, Solved, events, solve};
use std::error::Error;
use std::io::Write;
use std::path::{Path, PathBuf};
use summary::Problem;
use written::sources;

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
    /// Ground motion, in any of the formats, of a scene that has no record of its own.
    #[arg(long, value_name = "FILE")]
    record: Option<PathBuf>,
    /// Leaves out all contacts: how each building moves by itself.
    #[arg(long)]
    without_contacts: bool,
    /// s, from row to row.
    #[arg(long, value_name = "S", default_value_t = STEP, value_parser = positive)]
    step: f64,
    /// s, time of the last row; without it, the scene's stop_time, else the end of the record, else 10.
    #[arg(long, value_name = "T", value_parser = stop_time)]
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

impl Arguments {
    /// The options that name files to write, and these.
    fn outputs(&self) -> [(&'static str, Option<&Path>); 4] {
        let Arguments { csv, impacts, html, layout, .. } = self;
        [("--csv", csv), ("--impacts", impacts), ("--html", html), ("--layout", layout)]
            .map(|(option, file)| (option, file.as_deref()))
    }
}

fn positive(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(number) if number > 0.0 && number.is_finite() => Ok(number),
        _ => Err("expected a number > 0".into()),
    }
}

fn stop_time(text: &str) -> Result<f64, String> {
    let expected = || format!("expected a number > 0 and at most {MOST_TIME:e}");
    positive(text).ok().filter(|&stop| stop <= MOST_TIME).ok_or_else(expected)
}

/// What a report is made of, and where it goes.
#[derive(Args)]
pub struct ReportArguments {
    /// The scene.
    #[arg(value_name = "SCENE.toml")]
    scene: PathBuf,
    /// Ground motion of a scene that has no record of its own.
    #[arg(long, value_name = "FILE")]
    record: Option<PathBuf>,
    /// Where the page goes; without it, NAME.html (NAME: the scene's) in the current directory.
    #[arg(short, long, value_name = "FILE.html")]
    output: Option<PathBuf>,
    /// One or two buildings whose floors and storeys are charted; without it, of more than two, those of the hardest impact.
    #[arg(long, value_name = "NAME", num_args = 1..)]
    buildings: Vec<String>,
}

/// Solves a scene, writes the files that are asked for, and returns the summary.
///
/// # Errors
/// A scene or record with everything that is wrong with it, a file that cannot be written, a run that cannot go on.
pub fn run(arguments: &Arguments) -> Result<String, Box<dyn Error>> {
    let mut package = read(&arguments.scene, arguments.record.as_deref())?;
    written::check(&sources(&arguments.scene, &package.scene, arguments.record.as_deref()), &arguments.outputs())?;
    if arguments.without_contacts {
        package.scene.contacts.clear();
    }
    let (step, stop) = (arguments.step, arguments.stop.or_else(|| package.stop_time()).unwrap_or(STOP));
    instants::check_count(step, stop)?;
    let model = model(&package)?;
    let table = arguments.csv.as_deref().map(report::create).transpose()?;
    let mut motion = table.map(|file| tables::Motion::new(file, &package.scene)).transpose()?;
    let impacts = arguments.impacts.as_deref().map(report::create).transpose()?;
    let mut page = arguments.html.as_deref().map(report::create).transpose()?;
    if let Some(file) = &arguments.layout {
        report::create(file)?.write_all(serde_json::to_string(&layout::Layout::of(&package.scene))?.as_bytes())?;
    }
    let mut follower = follower(&package, step, stop);
    let show = |solved: Solved| {
        follower.look(&solved);
        motion.as_mut().map_or(Ok(()), |motion| motion.write(solved))
    };
    let within = match arguments.rows_per_impact {
        None => Vec::new(),
        Some(count) => instants::within(&events(&model, stop)?, stop, count),
    };
    let Solution { events, time, .. } =
        solve(&model, instants::merge(instants::regular(step, stop), within), Some(show))?;
    motion.map(tables::Motion::finish).transpose()?;
    if let Some(table) = impacts {
        tables::write_impacts(table, &events.episodes)?;
    }
    if let Some(page) = &mut page {
        page.write_all(report::page(&package, &model, stop, &events)?.as_bytes())?;
    }
    let problem = Problem::from(&package);
    let stop_reason = if arguments.stop.is_some() { "as asked" } else { problem.stop_reason() };
    let summary = summary::text(&follower.outcome(time), Some(problem), stop_reason);
    Ok(format!("{}{summary}solve_seconds={}\n", problem.heading(), time.as_secs_f64()))
}

/// Solves a scene, writes the page about it, and returns where that is.
///
/// # Errors
/// As those of `run`.
pub fn report(arguments: &ReportArguments) -> Result<String, Box<dyn Error>> {
    let package = read(&arguments.scene, arguments.record.as_deref())?;
    let file = arguments.output.clone().unwrap_or_else(|| format!("{}.html", package.scene.name).into());
    written::check(&sources(&arguments.scene, &package.scene, arguments.record.as_deref()), &[("-o", Some(&file))])?;
    let charted = report::charted(&package.scene, &arguments.buildings)?;
    let stop = package.stop_time().unwrap_or(STOP);
    let model = model(&package)?;
    let mut page = report::create(&file)?;
    page.write_all(report::page_about(&package, &model, stop, &events(&model, stop)?, charted)?.as_bytes())?;
    Ok(format!("{}: the run of {} from 0 s to {stop} s, for any browser\n", file.display(), package.scene.name))
}

/// The scene of a file, perhaps under another record; slips in it are told.
fn read(scene: &Path, record: Option<&Path>) -> Result<Package, Box<dyn Error>> {
    let mut package = Package::from_scene_file(scene)
        .map_err(|problems| format!("{} is not a scene that can be run:\n{problems}", scene.display()))?;
    if let Some(file) = record {
        give_record(&mut package, file)?;
    }
    for warning in warnings::of_file(&package.scene, package.record.as_ref().map(|packaged| &packaged.record)) {
        // Nobody may be there to read it.
        let _ = writeln!(std::io::stderr(), "warning: {warning}");
    }
    Ok(package)
}

fn model(package: &Package) -> Result<Model, Box<dyn Error>> {
    Ok(Model::new(&package.scene, package.record.as_ref().map(|packaged| &packaged.record))?)
}

fn follower(package: &Package, step: f64, stop: f64) -> Follower {
    let record = package.record.as_ref().map(|packaged| packaged.record.clone());
    let settings = Settings::new(package.scene.clone(), record);
    Follower::new(&Table::new(&settings.scene), &settings, step, stop)
}

/// Reads a record and makes it the scene's.
fn give_record(package: &mut Package, file: &Path) -> Result<(), Box<dyn Error>> {
    if let Some(own) = &package.scene.ground.record {
        return Err(format!("--record is for a scene without one; this one has ground.record = {own:?}").into());
    }
    let name = file.to_string_lossy().into_owned();
    let read = RecordFile::read(file).map_err(|error| format!("cannot read {name}: {error}"))?;
    let record = PackagedRecord::new(read).map_err(|error| format!("{name}: {error}"))?;
    package.record = Some(record);
    package.scene.ground.record = Some(name);
    Ok(())
}
