//! Runs that try to break the engine, one CSV row each; `benchmarks/extremes.py` runs this and draws.
//!
//! ```text
//! cargo run --release --example extremes -- grid [LAW ...]     # scenes at the extremes of their parameters
//! cargo run --release --example extremes -- drift IMPACTS      # energy over so many elastic impacts, law by law
//! cargo run --release --example extremes -- hour               # an hour of shaking at 100 Hz, in one step and in many
//! ```

#[path = "../tests/common/mod.rs"]
mod common;
#[path = "../tests/physics/stress/elastic.rs"]
#[allow(dead_code, unused_imports, clippy::unwrap_used)]
mod elastic;
#[path = "../tests/physics/stress/extremes.rs"]
mod extremes;
#[path = "../tests/physics/stress/hour.rs"]
#[allow(dead_code, clippy::unwrap_used)]
mod hour;

use common::Run;
use extremes::{Extreme, LAWS, Outcome, Trial, grid};
use std::process::ExitCode;
use std::time::Instant;

fn main() -> ExitCode {
    let words: Vec<String> = std::env::args().skip(1).collect();
    match words.iter().map(String::as_str).collect::<Vec<_>>().as_slice() {
        ["grid", laws @ ..] => run_grid(laws),
        ["drift", impacts] if impacts.parse::<f64>().is_ok() => drift(impacts.parse().unwrap_or_default()),
        ["hour"] => run_hour(),
        _ => {
            eprintln!("usage: extremes grid [LAW ...] | drift IMPACTS | hour");
            return ExitCode::from(2);
        }
    }
    ExitCode::SUCCESS
}

fn run_grid(only: &[&str]) {
    println!("plane,law,stiffness,value,outcome,residual,impacts,contact_steps,flight_steps,seconds,message");
    for law in LAWS.into_iter().filter(|law| only.is_empty() || only.contains(law)) {
        for (plane, value, extreme) in grid(law) {
            print_row(plane, value, &extreme);
        }
    }
}

fn print_row(plane: &str, value: f64, extreme: &Extreme) {
    let (trial, seconds) = timed(extreme);
    let (outcome, residual, message) = match trial.outcome {
        Outcome::Refused(message) => ("refused", f64::NAN, message),
        Outcome::Stopped(message) => ("stopped", f64::NAN, message),
        Outcome::Ended(residual) => ("ended", residual, String::new()),
    };
    let (counters, impacts) = (trial.counters, trial.impacts);
    println!(
        "{plane},{},{:e},{value:e},{outcome},{residual:.2e},{impacts},{},{},{:.2e},\"{}\"",
        extreme.law,
        extreme.stiffness,
        counters.contact_steps(),
        counters.flight_steps(),
        seconds,
        message.replace('\n', "; ").replace('"', "'")
    );
}

/// A run and the least of three times, s; of one that is not quick, its time.
fn timed(extreme: &Extreme) -> (Trial, f64) {
    let run = || {
        let clock = Instant::now();
        (extreme.run(), clock.elapsed().as_secs_f64())
    };
    let (trial, first) = run();
    let again = if first < 0.1 { 2 } else { 0 };
    (trial, (0..again).map(|_| run().1).fold(first, f64::min))
}

fn drift(most: f64) {
    println!("law,impacts,drift");
    for law in &elastic::elastic() {
        let mut run = Run::new(&elastic::rattle(law), None);
        let (mut next, mut worst) = (10.0, 0.0_f64);
        while (run.point.impacts as f64) < most {
            run.to(run.state.time() + 0.1);
            let error = (elastic::energy(&run) / 0.5 - 1.0).abs();
            worst = worst.max(error);
            if run.point.impacts as f64 >= next {
                println!("{},{},{worst:e}", law.replace('\n', " ").replace('"', ""), run.point.impacts);
                next *= 1.3;
            }
        }
    }
}

fn run_hour() {
    println!("law,impacts,residual,difference,seconds");
    for law in hour::LAWS {
        let clock = Instant::now();
        let (impacts, residual, difference) = hour::run(law, 3600.0);
        let seconds = clock.elapsed().as_secs_f64();
        println!("{},{impacts},{residual:e},{difference:e},{seconds:.2}", law.replace('\n', " ").replace('"', ""));
    }
}
