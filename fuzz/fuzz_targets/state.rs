#![no_main]

#[path = "../../tests/support/linked.rs"]
mod linked;
#[path = "../../tests/fmi/fuzzing/state.rs"]
mod state;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| state::check(bytes));
