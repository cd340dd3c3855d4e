//! `cargo fmu` and its commands, as a user runs them. One program: most of a test of a few lines would be compiling it.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod check;
mod check_report;
mod check_trial;
mod common;
mod fmi3;
mod fmi_rs;
mod hostile_archives;
mod licenses;
mod merge;
mod numbers_only;
mod prebuilt;
mod recipe;
mod slips;
