#![no_main]

#[path = "../../tests/fmi/fuzzing/calls/mod.rs"]
mod calls;
#[path = "../../tests/support/linked.rs"]
mod linked;
#[path = "../../tests/problems/two_and_three_storeys.rs"]
mod two_and_three_storeys;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| calls::check(bytes));
