//! The C interface of FMI 2.0 for co-simulation: the only unsafe code of the crate, and no physics.
//!
//! `life.rs`, `values.rs`, `step.rs`, `state.rs` and `derivatives.rs` hold the 34 exported functions, each of a few lines.
//! A call runs through the fence (`fence.rs`), which checks instance and call sequence, catches panics (`panics.rs`),
//! and sends the messages (`logger.rs`) when nothing is borrowed any more; `arguments.rs` turns pointers into slices
//! and strings, `instance.rs` begins and ends the life of an instance.
//!
//! What every function relies on, as FMI 2.0.4, chapter 2.1 requires of a caller: a component is null or comes from
//! `fmi2Instantiate` and has not been freed, no two threads use the same component at once, an array has at least as
//! many elements as the call says, and a string ends with a zero. Null arrays and strings are refused, not trusted.
//!
//! The functions have their C names where this crate is compiled into an FMU's library, with `--cfg fmi_exports`, and
//! nowhere else: a program or a Python module that links this crate exports none of them.
#![allow(non_snake_case, reason = "their names in C")]
#![allow(missing_docs, reason = "FMI 2.0.4 says what each function does")]
#![allow(clippy::missing_safety_doc, reason = "one rule for all of them stands above")]

mod arguments;
mod derivatives;
mod fence;
mod instance;
mod life;
mod logger;
mod panics;
mod state;
mod step;
#[cfg(test)]
mod test_support;
mod types;
mod values;

pub use derivatives::*;
pub use life::*;
pub use state::*;
pub use step::*;
pub use types::{CallbackFunctions, Component, FmuState};
pub use values::*;
