#![no_main]

#[path = "../../tests/fmi/fuzzing/record.rs"]
mod record;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| record::check("fuzz.at2", bytes));
