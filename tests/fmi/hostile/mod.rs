//! A hostile master: every function in every state with arguments that are null, wrong, huge or not finite.
//!
//! The rows (`life.rs`, `values.rs`, `derivatives.rs`, `state.rs`, `step.rs`, `instantiate.rs`; of FMI 3.0 in `v3/`) state
//! beforehand what the standard asks for: FMI 2.0.4, chapters 2.1 and 4.2, and FMI 3.0.2, chapters 2.2 and 4.2. The cases run
//! in processes that this executable starts of itself, with a time limit: a crash or a hang is that of one case, and the
//! others go on without it. A case passes if its status is the expected one and the instance can be reset afterwards and
//! gives the bits of a fresh one.

mod derivatives;
mod edge;
mod instantiate;
mod life;
mod processes;
mod rows;
mod state;
mod step;
mod target;
mod v3;
mod values;

#[test]
fn every_function_in_every_state_with_hostile_arguments() {
    let cases = rows::cases();
    if let Some(some) = processes::assigned() {
        let shared = rows::Shared::new();
        return some.for_each(|place| {
            processes::begin(place);
            cases[place].check(&shared);
        });
    }
    let names = cases.iter().map(|case| case.name.as_str()).collect::<Vec<_>>();
    let test = "hostile::every_function_in_every_state_with_hostile_arguments";
    let failures = processes::run_each(&names, test);
    assert!(failures.is_empty(), "{} of {} cases:\n{}", failures.len(), names.len(), failures.join("\n"));
}
