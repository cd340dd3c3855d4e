//! One scene, solved several times by the engine, timed: our side of the benchmark.
//!
//! ```text
//! cargo run --release --example run_time -- SCENE.toml engine TOLERANCE REPEATS OUTPUT
//! cargo run --release --example run_time -- SCENE.toml coupled TOLERANCE REPEATS OUTPUT
//! cargo run --release --example run_time -- SCENE.toml whole TOLERANCE REPEATS OUTPUT
//! cargo run --release --example run_time -- SCENE.toml memory TOLERANCE INSTANCES OUTPUT
//! ```
//!
//! Prints the wall seconds of each repeat, then the number of impacts, then counters of the work and sizes as
//! `name=value`; OUTPUT gets the displacements (float64, a row of floors every 0.05 s). The other compiled solvers of
//! `benchmarks/` are called in the same way. A repeat goes from a fresh state to the end of the record and includes
//! everything that the engine always does: peak forces, impulses, dissipated energies, peaks of the floors where the scene
//! has them, and the reading of the displacements at the output times.
//!
//! `coupled` does the same every 0.01 s, as a co-simulation with that communication step would.
//!
//! `whole` goes to the end in one step and reads what a study does, there alone: OUTPUT gets displacements, their
//! peaks, then impulse, peak force and dissipated energy of each contact.
//!
//! `memory` makes that many instances as an FMU has them instead, ready to run, and prints the bytes that each takes
//! (Linux only).

use pounding::engine::{Model, Output, PeakOf, Point, State};
use pounding::scene::Package;
use pounding::slave::{Log, Slave};
use std::error::Error;
use std::path::Path;
use std::process::ExitCode;
use std::time::Instant;

const OUTPUT_STEP: f64 = 0.05;
const COMMUNICATION_STEP: f64 = 0.01;

fn main() -> ExitCode {
    match run(&std::env::args().skip(1).collect::<Vec<_>>()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

fn run(words: &[String]) -> Result<(), Box<dyn Error>> {
    match words {
        [scene, method, tolerance, repeats, output] if method != "memory" => {
            let way = Way::of(method).ok_or(USAGE)?;
            run_times(Path::new(scene), way, tolerance.parse()?, repeats.parse()?, Path::new(output))
        }
        [scene, method, _, instances, _] if method == "memory" => memory(Path::new(scene), instances.parse()?),
        _ => Err(USAGE.into()),
    }
}

const USAGE: &str = "usage: run_time SCENE.toml engine|coupled|whole|memory TOLERANCE REPEATS OUTPUT";

/// How a run is read.
#[derive(Clone, Copy)]
enum Way {
    /// Displacements, every so many seconds.
    Every(f64),
    /// Displacements, their peaks and what contacts have come to, at the end alone.
    Whole,
}

impl Way {
    fn of(method: &str) -> Option<Way> {
        match method {
            "engine" => Some(Way::Every(OUTPUT_STEP)),
            "coupled" => Some(Way::Every(COMMUNICATION_STEP)),
            "whole" => Some(Way::Whole),
            _ => None,
        }
    }
}

fn run_times(scene: &Path, way: Way, tolerance: f64, repeats: usize, output: &Path) -> Result<(), Box<dyn Error>> {
    let Package { mut scene, record, .. } = Package::from_scene_file(scene)?;
    scene.solver.relative_tolerance = tolerance;
    let record = record.map(|record| record.record);
    let stop = scene.stop_time.ok_or("the scene has no stop_time")?;

    let clock = Instant::now();
    let model = Model::new(&scene, record.as_ref())?;
    let mut state = model.start(0.0);
    let setup = clock.elapsed().as_secs_f64();

    let mut readings = Vec::new();
    let mut point = Point::default();
    for _ in 0..repeats {
        state = model.start(0.0);
        readings.clear();
        let clock = Instant::now();
        solve(way, &model, &mut state, &mut point, stop, &mut readings)?;
        print!("{:e} ", clock.elapsed().as_secs_f64());
    }
    println!("\n{}", point.impacts);
    println!("setup_s={setup:e}");
    let counters = state.counters();
    println!("flight_steps={}", counters.flight_steps());
    println!("narrow_phase_pieces={}", counters.narrow_phase_pieces);
    println!("pairs_evaluated={}", counters.pairs_evaluated);
    println!("contact_steps={}", counters.contact_steps());
    println!("yielding_steps={}", counters.yielding_steps());
    println!("events={}", counters.events);
    let bytes: Vec<u8> = readings.iter().flat_map(|value| value.to_ne_bytes()).collect();
    std::fs::write(output, bytes)?;
    Ok(())
}

/// Goes to the end of the scene, at a time in s, and enters what is read on the way. It keeps its name in the program:
/// `benchmarks/special_paths.py` counts its instructions.
#[inline(never)]
fn solve(
    way: Way,
    model: &Model,
    state: &mut State,
    point: &mut Point,
    stop: f64,
    readings: &mut Vec<f64>,
) -> Result<(), Box<dyn Error>> {
    let step = match way {
        Way::Every(step) => step,
        Way::Whole => stop,
    };
    for row in 0..=(stop / step).round() as u64 {
        model.advance(state, row as f64 * step, &mut |_| ())?;
        let now = model.observe(state, point);
        for side in model.buildings() {
            readings.extend((0..model.floors(side)).map(|floor| now.read(Output::Displacement(side, floor))));
        }
    }
    if let Way::Whole = way {
        let now = model.observed(state, point);
        for side in model.buildings() {
            let peak = |floor| now.read(Output::Peak(PeakOf::Displacement(side, floor)));
            readings.extend((0..model.floors(side)).map(peak));
        }
        for contact in (0..model.contacts()).map(|p| now.contact(p)) {
            readings.extend([contact.impulse, contact.peak_force, contact.dissipated_energy]);
        }
    }
    Ok(())
}

fn memory(scene: &Path, instances: usize) -> Result<(), Box<dyn Error>> {
    let before = resident_bytes()?;
    let mut slaves = Vec::new();
    for _ in 0..instances {
        let mut slave = Slave::new(
            Package::from_scene_file(scene)?,
            pounding::slave::Interface::V2,
            Log::new(pounding::FmiVersion::V2, false),
        );
        slave.setup_experiment(None, 0.0, None).map_err(|refusal| refusal.problems.join("\n"))?;
        slave.enter_initialization();
        slave.exit_initialization().map_err(|refusal| refusal.problems.join("\n"))?;
        slaves.push(slave);
    }
    println!("{}", (resident_bytes()? - before) / slaves.len() as f64);
    Ok(())
}

/// Of this process, from the kernel; whole pages.
fn resident_bytes() -> Result<f64, Box<dyn Error>> {
    let status = std::fs::read_to_string("/proc/self/status")?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmRSS:")).ok_or("no VmRSS")?;
    Ok(1024.0 * line.trim().trim_end_matches(" kB").parse::<f64>()?)
}
