//! The engine without FMI: a scene in, tables out.
//!
//! ```text
//! cargo run --release --example simulate -- examples/scenes/feup.toml --csv motion.csv --impacts impacts.csv
//! ```
//!
//! `--csv` has `time` and one column per output of the scene's FMU, under the same names; `--impacts` has one row per
//! contact episode.

use clap::Parser;
use pounding::description::{Package, PackagedRecord};
use pounding::engine::{Episode, Model, Point, Side, State};
use pounding::scene::Scene;
use pounding::variables::{self, Output, Slot, Table, Value};
use std::error::Error;
use std::fs::File;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::{Duration, Instant};

/// Solves a scene with the engine alone.
#[derive(Parser)]
struct Arguments {
    /// The scene.
    #[arg(value_name = "SCENE.toml")]
    scene: PathBuf,
    /// Ground motion (CSV or AT2) of a scene that has no record of its own.
    #[arg(long, value_name = "FILE")]
    record: Option<PathBuf>,
    /// s, from row to row.
    #[arg(long, value_name = "S", default_value_t = 0.01, value_parser = positive)]
    step: f64,
    /// s, time of the last row; without it, the scene's stop_time, else the end of the record, else 10.
    #[arg(long, value_name = "T", value_parser = positive)]
    stop: Option<f64>,
    /// Table of the motion, a row every step.
    #[arg(long, value_name = "OUT")]
    csv: Option<PathBuf>,
    /// Table of the contact episodes.
    #[arg(long, value_name = "OUT")]
    impacts: Option<PathBuf>,
}

fn positive(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(number) if number > 0.0 && number.is_finite() => Ok(number),
        _ => Err("expected a number > 0".into()),
    }
}

fn main() -> ExitCode {
    match run(&Arguments::parse()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

fn run(arguments: &Arguments) -> Result<(), Box<dyn Error>> {
    let mut package = Package::from_scene_file(&arguments.scene)?;
    if let Some(file) = &arguments.record {
        give_record(&mut package, file)?;
    }
    let stop = arguments.stop.or_else(|| package.stop_time()).unwrap_or(10.0);

    let Package { scene, record, .. } = &package;
    let model = Model::new(scene, record.as_ref().map(|packaged| &packaged.record))?;
    let mut motion = arguments.csv.as_deref().map(|file| Motion::create(file, scene)).transpose()?;
    let impacts = arguments.impacts.as_deref().map(create).transpose()?;
    let solution = solve(&model, arguments.step, stop, motion.as_mut())?;
    if let Some(motion) = motion {
        motion.table.into_inner()?;
    }
    if let Some(table) = impacts {
        write_impacts(table, &solution.episodes)?;
    }
    let text = format!(
        "{}{}solve_seconds={}\n",
        summary(scene, stop, &solution),
        frequencies(&model),
        solution.time.as_secs_f64()
    );
    std::io::stdout().write_all(text.as_bytes())?;
    Ok(())
}

/// Reads a record and makes it the scene's.
fn give_record(package: &mut Package, file: &Path) -> Result<(), Box<dyn Error>> {
    if let Some(own) = &package.scene.ground.record {
        return Err(format!("--record is for a scene without one; this one has ground.record = {own:?}").into());
    }
    let name = file.to_string_lossy().into_owned();
    let bytes = std::fs::read(file).map_err(|error| format!("cannot read {name}: {error}"))?;
    let record = PackagedRecord::parse(&name, bytes).map_err(|error| {
        let problems = error.problems.iter().map(|problem| format!("{name}: {problem}"));
        problems.collect::<Vec<_>>().join("\n")
    })?;
    package.record = Some(record);
    package.scene.ground.record = Some(name);
    Ok(())
}

struct Solution {
    rows: u64,
    /// In the order of their start, open ones included.
    episodes: Vec<Episode>,
    /// Of the solve alone: reading and writing files is not in it.
    time: Duration,
}

/// Solves from 0 to `stop`, s, and hands the solution at each multiple of `step` and at `stop` to the table.
fn solve(model: &Model, step: f64, stop: f64, mut motion: Option<&mut Motion>) -> Result<Solution, Box<dyn Error>> {
    let (mut state, mut point) = (model.start(0.0), Point::default());
    let mut solution = Solution { rows: 0, episodes: Vec::new(), time: Duration::ZERO };
    loop {
        let regular = solution.rows as f64 * step;
        // What is left by rounding is no step of its own.
        let time = if regular > stop - 1e-9 * step { stop } else { regular };
        let clock = Instant::now();
        // The first row is the start as an FMU shows it: what happens at that very instant belongs to the first step.
        if time > 0.0 {
            model.advance(&mut state, time, &mut |episode| solution.episodes.push(*episode))?;
        }
        model.observe(&state, &mut point);
        solution.time += clock.elapsed();
        solution.rows += 1;
        if let Some(motion) = &mut motion {
            motion.write(model, &state, &point)?;
        }
        if time == stop {
            break;
        }
    }
    solution.episodes.extend((0..point.contacts.len()).filter_map(|contact| model.open_episode(&state, contact)));
    solution.episodes.sort_by(|one, other| one.start.total_cmp(&other.start));
    Ok(solution)
}

type CsvFile = csv::Writer<File>;

fn create(file: &Path) -> Result<CsvFile, Box<dyn Error>> {
    let created = File::create(file).map_err(|error| format!("cannot write {}: {error}", file.display()))?;
    Ok(csv::Writer::from_writer(created))
}

/// The table of the motion: `time`, then every output of the FMU in its order.
struct Motion {
    table: CsvFile,
    outputs: Vec<Output>,
    cells: Vec<String>,
}

impl Motion {
    fn create(file: &Path, scene: &Scene) -> Result<Motion, Box<dyn Error>> {
        let mut table = create(file)?;
        let (mut names, mut outputs) = (vec!["time".to_owned()], Vec::new());
        for row in Table::new(scene).rows {
            if let Slot::Output(output) = row.slot {
                names.push(row.name);
                outputs.push(output);
            }
        }
        table.write_record(&names)?;
        Ok(Motion { table, outputs, cells: Vec::new() })
    }

    fn write(&mut self, model: &Model, state: &State, point: &Point) -> csv::Result<()> {
        let instant = variables::Instant { model, state, point };
        self.cells.clear();
        self.cells.push(number(point.time));
        self.cells.extend(self.outputs.iter().map(|output| match instant.read(*output) {
            Value::Real(value) => number(value),
            Value::Integer(value) => value.to_string(),
            Value::Boolean(value) => u8::from(value).to_string(),
            Value::String(value) => value.to_owned(),
        }));
        self.table.write_record(&self.cells)
    }
}

/// The shortest text that reads back as the same number.
fn number(value: f64) -> String {
    format!("{value:?}")
}

fn write_impacts(mut table: CsvFile, episodes: &[Episode]) -> csv::Result<()> {
    table.write_record([
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
    ])?;
    for episode in episodes {
        table.write_record([
            (episode.contact + 1).to_string(),
            number(episode.start),
            episode.end.map(number).unwrap_or_default(),
            number(episode.approach_velocity),
            number(episode.separation_velocity),
            number(episode.peak_force),
            number(episode.peak_time),
            number(episode.peak_penetration),
            number(episode.impulse),
            number(episode.dissipated_energy),
        ])?;
    }
    table.flush()?;
    Ok(())
}

/// Natural frequencies of each building alone, ascending.
fn frequencies(model: &Model) -> String {
    let line = |name: &str, side: Side| {
        let numbers: Vec<String> = model.natural_frequencies(side).iter().map(|f| format!("{f:.4}")).collect();
        format!("  {name} frequencies: {} Hz\n", numbers.join(", "))
    };
    line("left", Side::Left) + &line("right", Side::Right)
}

fn summary(scene: &Scene, stop: f64, solution: &Solution) -> String {
    let Solution { rows, episodes, .. } = solution;
    let mut text = format!("{}: 0 s to {stop} s in {rows} rows, {} impacts\n", scene.name, episodes.len());
    for (index, pair) in scene.contacts.iter().enumerate() {
        let of_this: Vec<&Episode> = episodes.iter().filter(|episode| episode.contact == index).collect();
        let largest = |pick: fn(&Episode) -> f64| of_this.iter().map(|episode| pick(episode)).fold(0.0, f64::max);
        text += &format!(
            "  contact {} (left {}, right {}): {} impacts, approach up to {:.4} m/s, force up to {:.4e} N, \
             penetration up to {:.4e} m\n",
            index + 1,
            pair.left_floor,
            pair.right_floor,
            of_this.len(),
            largest(|episode| episode.approach_velocity),
            largest(|episode| episode.peak_force),
            largest(|episode| episode.peak_penetration),
        );
    }
    text
}
