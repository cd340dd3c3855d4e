//! `cargo fmu`.
fn main() {}
