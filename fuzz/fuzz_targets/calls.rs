#![no_main]

#[path = "../../tests/fuzzing/calls.rs"]
mod calls;
#[path = "../../tests/support/linked.rs"]
mod linked;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| calls::check(bytes));
