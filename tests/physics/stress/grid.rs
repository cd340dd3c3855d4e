//! A part of the grid of extremes: every run ends with its energy accounted for, or with a message that names the
//! parameter. `benchmarks/extremes.py` runs and draws all of it.

use super::extremes::{Extreme, LAWS, ORDINARY, Outcome, grid};

/// The names under which a user finds what to change.
const KEYS: [&str; 9] = [
    "restitution",
    "stiffness",
    "gap",
    "damping",
    "mass",
    "min_approach_velocity",
    "communication steps",
    "exponent",
    "law",
];

fn check(what: &str, extreme: &Extreme) {
    match extreme.run().outcome {
        Outcome::Ended(residual) => assert!(residual.abs() < 1e-12, "{what}: residual {residual:e}, {extreme:?}"),
        Outcome::Refused(message) | Outcome::Stopped(message) => {
            assert!(KEYS.iter().any(|key| message.contains(key)), "{what}: {message}, {extreme:?}");
        }
    }
}

/// Every ninth point of the grid of each law, but for those that take seconds: what they come to is a test of the limits
/// of work.
#[test]
fn every_run_ends_with_a_balanced_account_or_says_what_to_change() {
    for law in LAWS {
        let points = grid(law);
        let is_quick =
            |extreme: &Extreme| extreme.damping <= 100.0 && (extreme.restitution >= 1e-6 || law != "jankowski");
        for (plane, _, extreme) in points.iter().filter(|(.., extreme)| is_quick(extreme)).step_by(9) {
            check(plane, extreme);
        }
    }
}

/// Several at their ends at once.
#[test]
fn extremes_of_several_parameters_at_once_end_as_well() {
    for law in LAWS {
        for stiffness in [1e4, 1e14] {
            for (mass_ratio, restitution) in [(1e-6, 1e-3), (1e6, 1e-3), (1e-6, 1.0), (1e6, 1.0)] {
                for (gap, speed, spacing) in [(0.0, 1e4, 1e-3), (-1e-3, 0.0, 0.1), (1e-6, 1e-6, 1e-2)] {
                    let extreme = Extreme { law, stiffness, mass_ratio, restitution, gap, speed, spacing, ..ORDINARY };
                    check("all at once", &extreme);
                }
            }
        }
    }
}
