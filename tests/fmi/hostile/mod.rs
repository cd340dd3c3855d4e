//! A hostile master: every function in every state with arguments that are null, wrong, huge or not finite.
//!
//! The rows (`life.rs`, `values.rs`, `derivatives.rs`, `state.rs`, `step.rs`, `instantiate.rs`) state beforehand what the
//! standard asks for, FMI 2.0.4, chapters 2.1 and 4.2. Each case runs in a process of its own, which this executable
//! starts of itself, with a time limit. A case passes if its status is the expected one and the instance can be reset
//! afterwards and gives the bits of a fresh one.

mod derivatives;
mod edge;
mod instantiate;
mod life;
mod processes;
mod rows;
mod state;
mod step;
mod target;
mod values;

use std::env;

/// Tells a child process which case it is for.
const CASE: &str = "HOSTILE_CASE";

#[test]
fn every_function_in_every_state_with_hostile_arguments() {
    let cases = rows::cases();
    if let Some(place) = env::var_os(CASE) {
        let place: usize = place.to_str().unwrap().parse().unwrap();
        return cases[place].check();
    }
    let names = cases.iter().map(|case| case.name.as_str()).collect::<Vec<_>>();
    let failures = processes::run_each(&names, CASE, "hostile::every_function_in_every_state_with_hostile_arguments");
    assert!(failures.is_empty(), "{} of {} cases:\n{}", failures.len(), names.len(), failures.join("\n"));
}
