//! FMUs of scenes of two pounding buildings: made, tried, checked, merged. Two commands share it: `cargo fmu` (`main.rs`,
//! in a checkout, compiles the library) and `pounding-fmu` (in `python/`, with libraries that have been compiled before).
//!
//! | file | holds |
//! |---|---|
//! | `arguments.rs`, `command.rs` | the command line: arguments; what is done, exit codes |
//! | `face.rs` | what differs between the two commands |
//! | `main.rs`, `with_check.rs`, `workspace.rs` | `cargo fmu`, and its name for `check`: where the checkout is; compiling the library with cargo |
//! | `libraries.rs` | the libraries that go into an FMU, and a folder of them |
//! | `recipe.rs` | from a scene file to an FMU that has been seen to run, step by step |
//! | `numbers_only.rs` | the scene of an FMU that has numbers alone |
//! | `merge.rs` | one FMU with the libraries of two |
//! | `archive.rs` | the zip, unpacked safely; what an FMU holds and its zip are written in `pack/`, a crate of its own |
//! | `destination.rs` | where an FMU goes: at once and whole, or not at all |
//! | `provenance.rs` | which scene the FMU at the default place is of |
//! | `inspection.rs` | whether a library is what its folder and name say, without running it |
//! | `functions.rs` | the names of the library's C functions |
//! | `c_interface/` | the library's C functions, called by hand, a file for each version (the only unsafe code here) |
//! | `importer/` | the same through an importer that is not ours, and descriptions as it reads them; with the feature `check` alone |
//! | `sight.rs` | whose a description is, its version, what its libraries are called |
//! | `description.rs` | what a description says, in one form for both versions |
//! | `log.rs` | what an FMU says through its logger |
//! | `steps.rs` | what a step of FMI 3.0 says, and whether that may be |
//! | `experiment.rs` | one run of an FMU over its default experiment, through either |
//! | `trial/mod.rs` | an FMU tried in a process of its own, for as long as it may take |
//! | `trial/channel.rs` | what that process reports, which the FMU's library cannot |
//! | `trial/run.rs` | the run after building |
//! | `bounded.rs` | as many texts of an FMU as a person reads |
//! | `trial/report.rs` | what a trial has found, for a person and for a program |
//! | `check/` | the command `check`: what is wrong with an FMU; with the feature `check` alone |
#![deny(unsafe_code)]
// The check is half of this crate, and the run after building needs little of what serves both.
#![cfg_attr(not(feature = "check"), allow(dead_code))]

mod archive;
pub mod arguments;
mod bounded;
#[allow(unsafe_code)]
mod c_interface;
#[cfg(feature = "check")]
mod check;
pub mod command;
mod description;
pub mod destination;
mod experiment;
pub mod face;
mod functions;
#[cfg(feature = "check")]
mod importer;
mod inspection;
pub mod libraries;
mod log;
mod merge;
mod numbers_only;
mod provenance;
mod recipe;
mod sight;
mod steps;
mod trial;

pub use numbers_only::numbers_only;
pub use pounding_pack::platform::folder as host_folder;
pub use pounding_pack::{file_name, pack};
