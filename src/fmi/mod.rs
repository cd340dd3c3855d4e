//! The C interface of FMI 2.0 and of FMI 3.0 for co-simulation: the only unsafe code of the crate, and no physics.
//!
//! `v2/` has the 44 functions of FMI 2.0, `v3/` the 75 of FMI 3.0, most of them rows of tables (`functions` in
//! `fence.rs`): `life.rs`, `values.rs`, `step.rs`, `state.rs`, `derivatives.rs`, in FMI 3.0 `events.rs`, and what is
//! refused (`refused.rs`). `common/` has what both share. A call runs through the fence (`fence.rs`), which checks
//! instance, version and call sequence, catches panics (`panics.rs`), and sends the messages (`logger.rs`) when nothing is
//! borrowed any more; `arguments.rs` turns pointers into slices and strings, `instance.rs` begins and ends the life of an
//! instance; its `values.rs`, `state.rs` and `derivatives.rs` do the work of functions that only their names tell apart.
//!
//! What every function relies on, as FMI 2.0.4, chapter 2.1, and FMI 3.0.2, chapter 2.2, require of a caller: an
//! instance is null or comes from `fmi2Instantiate` or `fmi3InstantiateCoSimulation` and has not been freed, no two
//! threads use the same instance at once, an array has at least as many elements as the call says, and a string ends
//! with a zero. Null arrays and strings are refused, not trusted, and so is an instance of the other version.
//!
//! The functions have their C names where this crate is compiled into an FMU's library, with `--cfg fmi_exports`, and
//! nowhere else: a program or a Python module that links this crate exports none of them.
#![allow(non_snake_case, reason = "their names in C")]
#![allow(missing_docs, reason = "FMI 2.0.4 and FMI 3.0.2 say what each function does")]
#![allow(clippy::missing_safety_doc, reason = "one rule for all of them stands above")]
#![allow(clippy::too_many_arguments, reason = "as many as in C")]

mod common;
mod v2;
mod v3;

pub use common::types::{Component, FmuState};
pub use v2::*;
pub use v3::*;
