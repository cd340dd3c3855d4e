//! Are beginnings and ends of contacts found, each at its time, and nothing else taken for one?
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod beginnings_and_ends;
mod broad_phase;
#[path = "../common/mod.rs"]
mod common;
mod entries_during_contact;
mod output_near_samples;
