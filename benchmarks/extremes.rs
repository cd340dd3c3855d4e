//! Runs a grid of scenes at the extremes of their parameters and prints a row for each.
//!
//! ```text
//! cargo run --release --example extremes
//! ```

#[path = "../tests/stress/extremes.rs"]
mod extremes;

use extremes::{Extreme, LAWS, ORDINARY, Outcome};

fn decades(low: i32, high: i32, step: usize) -> Vec<f64> {
    (low..=high).step_by(step).map(|e| 10.0_f64.powi(e)).collect()
}

fn main() {
    println!("plane,law,x,y,outcome,residual,impacts,contact_steps,flight_steps,events,seconds,message");
    for law in LAWS {
        let base = Extreme { law, ..ORDINARY };
        for x in decades(4, 14, 2) {
            for y in decades(-6, 6, 3) {
                row("mass", law, x, y, Extreme { stiffness: x, mass_ratio: y, ..base.clone() });
            }
            for y in [1e-12, 1e-9, 1e-6, 1e-3, 0.03, 0.3, 0.9, 0.999, 1.0] {
                row("restitution", law, x, y, Extreme { stiffness: x, restitution: y, ..base.clone() });
            }
            for y in decades(-4, 10, 2) {
                row("speed", law, x, y, Extreme { stiffness: x, speed: y, ..base.clone() });
            }
            for y in [-0.1, -1e-3, -1e-6, 0.0, 1e-6, 1e-3, 0.1] {
                row("gap", law, x, y, Extreme { stiffness: x, gap: y, ..base.clone() });
            }
            for y in [0.0, 1e-4, 1e-2, 1.0, 100.0, 1e4] {
                row("damping", law, x, y, Extreme { stiffness: x, damping: y, ..base.clone() });
            }
            for y in [1e-4, 1e-3, 1e-2, 1e-1] {
                row("spacing", law, x, y, Extreme { stiffness: x, spacing: y, ..base.clone() });
            }
            for y in [1.0, 1.001, 1.3, 1.5, 1.7, 2.0, 3.0] {
                row("exponent", law, x, y, Extreme { stiffness: x, exponent: y, ..base.clone() });
            }
        }
    }
}

fn row(plane: &str, law: &str, x: f64, y: f64, extreme: Extreme) {
    let trial = extreme.run();
    let (outcome, residual, message) = match trial.outcome {
        Outcome::Refused(message) => ("refused", f64::NAN, message),
        Outcome::Stopped(_, message) => ("stopped", f64::NAN, message),
        Outcome::Ended(residual) => ("ended", residual, String::new()),
    };
    let c = trial.counters;
    println!(
        "{plane},{law},{x:e},{y:e},{outcome},{residual:.2e},{},{},{},{},{:.2e},\"{}\"",
        trial.impacts, c.contact_steps, c.flight_steps, c.events, trial.seconds, message.replace('\n', "; ").replace('"', "'")
    );
}
